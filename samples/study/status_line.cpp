// SPDX-License-Identifier: MIT
#include "status_line.h"

#include <unistd.h>

#include <cstdio>

namespace forelock::study {

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) == 1) {}

void StatusLine::show(std::size_t done, std::size_t total, const std::string& what, double left_s) {
  if (!terminal_) return;
  std::string text;
  if (total > 0) {
    constexpr std::size_t width = 24;
    for (std::size_t i = 0; i < width; ++i) text += i * total < done * width ? '#' : '.';
    text = "[" + text + "] " + std::to_string(done) + "/" + std::to_string(total) + " ";
  }
  text += what;
  if (left_s >= 90) text += ", about " + std::to_string(long(left_s / 60 + 0.5)) + " min left";
  else if (left_s >= 0) text += ", about " + std::to_string(long(left_s + 0.5)) + " s left";
  std::fprintf(stderr, "\r\033[K%.110s", text.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void StatusLine::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void StatusLine::print(const std::string& text) {
  clear();
  std::fprintf(stderr, "forelock-study: %s\n", text.c_str());
}

void StatusLine::printPiped(const std::string& text) {
  if (!terminal_) print(text);
}

}  // namespace forelock::study
