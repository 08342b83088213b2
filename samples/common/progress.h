// A progress bar for a person who waits; silent for pipes and for what is quick. SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace forelock::samples {

// Draws on stderr, only where that is a terminal and only once the work has taken over a second. The line is cleared
// when the work is done. Any thread may call update.
class Progress {
 public:
  explicit Progress(std::string label);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(uint64_t done, uint64_t total);
  void rename(std::string label);

 private:
  using Clock = std::chrono::steady_clock;

  std::string label_;
  bool is_terminal_;
  bool drawn_ = false;
  Clock::time_point started_;
  Clock::time_point last_drawn_;
  std::mutex mutex_;
};

}  // namespace forelock::samples
