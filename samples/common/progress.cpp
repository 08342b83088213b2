// SPDX-License-Identifier: MIT
#include "progress.h"

#include <unistd.h>

#include <cstdio>

namespace forelock::samples {

Progress::Progress(std::string label)
    : label_(std::move(label)), is_terminal_(isatty(STDERR_FILENO) == 1), started_(Clock::now()) {}

Progress::~Progress() {
  if (drawn_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
  }
}

void Progress::rename(std::string label) {
  const std::lock_guard<std::mutex> lock(mutex_);
  label_ = std::move(label);
}

void Progress::update(uint64_t done, uint64_t total) {
  if (!is_terminal_ || total == 0) {
    return;
  }
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) {
    return;  // another thread is drawing
  }
  const Clock::time_point now = Clock::now();
  if (now - started_ < std::chrono::seconds(1) || now - last_drawn_ < std::chrono::milliseconds(100)) {
    return;
  }
  last_drawn_ = now;
  drawn_ = true;
  constexpr int width = 30;
  const double share = done < total ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
  char bar[width + 1] = {};
  for (int i = 0; i < width; ++i) {
    bar[i] = i < static_cast<int>(share * width) ? '#' : '.';
  }
  std::fprintf(stderr, "\r\033[K%s [%s] %3d %%", label_.c_str(), bar, static_cast<int>(share * 100.0));
  std::fflush(stderr);
}

}  // namespace forelock::samples
