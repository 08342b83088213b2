// What a person who waits sees: one line that is drawn over on a terminal, a plain line now and then where piped.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

namespace forelock::study {

class StatusLine {
public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  // Only on a terminal; `left_s` below 0: not known. `total` 0: no bar.
  void show(std::size_t done, std::size_t total, const std::string& what, double left_s = -1);
  // A line that stays, on stderr.
  void print(const std::string& text);
  // A line that stays, only where it is no terminal.
  void printPiped(const std::string& text);
  void clear();

private:
  bool terminal_, drawn_ = false;
};

}  // namespace forelock::study
