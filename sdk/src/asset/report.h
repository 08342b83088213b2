// What a call tells a person: the name the caller gave the asset, and where sentences go.
#pragma once

#include "host/memory.h"

#include <string_view>

namespace forelock {

// A word of a file as a sentence may show it: at most 60 bytes, whole characters of UTF-8, a question mark for any other byte.
struct Quoted {
  explicit Quoted(std::string_view word) noexcept;
  char text[64];
};

// A number as "%.4g" would have it in the locale C, whatever the host's locale is: the same asset is told in the same words.
struct Number {
  explicit Number(double value, int digits = 4) noexcept;
  char text[32];
};

// Whether all of it is characters of UTF-8, none of them a control character: what terminals and logs may be given.
bool isSentence(std::string_view text) noexcept;

class Report {
public:
  // `name` may be longer than a message: its end is kept, which holds the file's own name.
  Report(const Messages& messages, std::string_view name) noexcept;

  // Says "NAME: sentence" with severity error and hands `result` back, so that a refusal is one return statement.
  FlkResult fail(FlkResult result, const char* id, const char* format, ...) const noexcept
      __attribute__((format(printf, 4, 5)));
  void say(uint32_t severity, const char* id, const char* format, ...) const noexcept
      __attribute__((format(printf, 4, 5)));

  const char* name() const noexcept { return name_; }

private:
  Messages messages_;
  char name_[256];
};

}  // namespace forelock
