// Words of a text file: what Cursor is for binary ones. Commas count as white space, because some exporters write them between numbers.
// Numbers are read the same whatever the locale.
#pragma once

#include <charconv>
#include <limits>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

namespace forelock {

inline char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Whatever the case of ASCII letters.
inline bool sameWord(std::string_view a, std::string_view b) noexcept {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (lower(a[i]) != lower(b[i])) return false;
  return true;
}

class TextCursor {
public:
  explicit TextCursor(std::span<const std::byte> bytes) noexcept
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()), at_(text_.starts_with("\xef\xbb\xbf") ? 3 : 0) {}

  uint64_t at() const noexcept { return at_; }              // byte
  uint64_t word_at() const noexcept { return word_at_; }    // of the word read last
  uint64_t line() const noexcept { return line_; }          // from 1, of the word read last
  uint64_t left() const noexcept { return text_.size() - at_; }

  // Empty at the end.
  std::string_view word() noexcept {
    while (at_ < text_.size() && isSpace(text_[at_])) line_ += text_[at_++] == '\n';
    word_at_ = at_;
    while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
    return text_.substr(word_at_, at_ - word_at_);
  }

  std::string_view peek() const noexcept {
    TextCursor ahead = *this;
    return ahead.word();
  }

  void skipLine() noexcept {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  // False: `text` is no such number as a whole.
  template <class T> static bool parse(std::string_view text, T& value) noexcept {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* end = text.data() + text.size();
    const std::from_chars_result result = std::from_chars(text.data(), end, value);
    // Too large or too small for a float is a number all the same: the first is found to be beyond all bounds, the second is 0.
    if constexpr (std::is_floating_point_v<T>) {
      if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
        double wide = 0;
        if (std::from_chars(text.data(), end, wide).ec == std::errc::result_out_of_range) {
          // Beyond a double too: its exponent's sign tells which way, or without one its many digits.
          const std::size_t e = text.find_first_of("eE");
          const std::size_t point = text.find('.');
          const bool small = e != std::string_view::npos ? text.substr(e + 1).starts_with('-') : point != std::string_view::npos && point < 300;
          wide = small ? 0 : text.starts_with('-') ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
        }
        value = static_cast<T>(wide);
        return true;
      }
    }
    return result.ec == std::errc() && result.ptr == end && !text.empty();
  }

private:
  static bool isSpace(char c) noexcept { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

  std::string_view text_;
  uint64_t at_ = 0, word_at_ = 0, line_ = 1;
};

}  // namespace forelock
