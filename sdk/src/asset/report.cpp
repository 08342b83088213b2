#include "asset/report.h"

#include <cstdio>
#include <cstring>

namespace forelock {

Report::Report(const Messages& messages, std::string_view name) noexcept : messages_(messages) {
  constexpr std::string_view ellipsis = "...";
  std::size_t used = 0;
  if (name.size() >= sizeof name_) {
    name.remove_prefix(name.size() - (sizeof name_ - 1 - ellipsis.size()));
    while (!name.empty() && (static_cast<unsigned char>(name.front()) & 0xc0) == 0x80) name.remove_prefix(1);
    std::memcpy(name_, ellipsis.data(), ellipsis.size());
    used = ellipsis.size();
  }
  std::memcpy(name_ + used, name.data(), name.size());
  name_[used + name.size()] = '\0';
}

FlkResult Report::fail(FlkResult result, const char* id, const char* format, ...) const noexcept {
  char text[768];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  messages_.say(FLK_SEVERITY_ERROR, id, "%s: %s", name_, text);
  return result;
}

void Report::say(uint32_t severity, const char* id, const char* format, ...) const noexcept {
  char text[768];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  messages_.say(severity, id, "%s: %s", name_, text);
}

}  // namespace forelock
