#include "asset/report.h"

#include <charconv>
#include <cstdio>
#include <cstring>

namespace forelock {

namespace {

// Bytes of the character that `text` begins with; 0: it begins with none that may be shown.
std::size_t characterSize(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first >= 0x20 && first < 0x7f) return 1;
  if (first >= 0xc2 && first < 0xe0) return follows(1) && !(first == 0xc2 && byte(1) < 0xa0) ? 2 : 0;
  // Not longer than needed, no surrogates, nothing beyond U+10FFFF.
  if (first >= 0xe0 && first < 0xf0)
    return follows(1) && follows(2) && !(first == 0xe0 && byte(1) < 0xa0) && !(first == 0xed && byte(1) >= 0xa0) ? 3 : 0;
  if (first >= 0xf0 && first < 0xf5)
    return follows(1) && follows(2) && follows(3) && !(first == 0xf0 && byte(1) < 0x90) && !(first == 0xf4 && byte(1) >= 0x90) ? 4 : 0;
  return 0;
}

}  // namespace

Quoted::Quoted(std::string_view word) noexcept {
  constexpr std::size_t most = 60;
  std::size_t used = 0;
  while (!word.empty()) {
    const std::size_t size = characterSize(word);
    const std::size_t taken = size == 0 ? 1 : size;
    if (used + taken > most) break;
    if (size == 0) text[used] = '?';
    else std::memcpy(text + used, word.data(), size);
    used += taken;
    word.remove_prefix(taken);
  }
  text[used] = '\0';
}

Number::Number(double value, int digits) noexcept {
  *std::to_chars(text, text + sizeof text - 1, value, std::chars_format::general, digits).ptr = '\0';
}

bool isSentence(std::string_view text) noexcept {
  while (!text.empty()) {
    const std::size_t size = characterSize(text);
    if (size == 0) return false;
    text.remove_prefix(size);
  }
  return true;
}

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
