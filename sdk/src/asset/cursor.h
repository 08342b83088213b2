// The only way this room looks at bytes of a file: a position in a span that cannot leave it. Values are little endian
// in every format read here and are copied out, because records of .hair files are only 2-byte aligned.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace forelock {

// a x b, or the largest value where that does not fit: what a damaged header asks for is only ever compared and printed.
inline uint64_t saturatingProduct(uint64_t a, uint64_t b) noexcept {
  return b != 0 && a > UINT64_MAX / b ? UINT64_MAX : a * b;
}

inline uint64_t saturatingSum(uint64_t a, uint64_t b) noexcept { return a > UINT64_MAX - b ? UINT64_MAX : a + b; }

class Cursor {
public:
  explicit Cursor(std::span<const std::byte> bytes, uint64_t offset = 0) noexcept
      : bytes_(bytes), at_(offset <= bytes.size() ? offset : bytes.size()), failed_(offset > bytes.size()) {}

  uint64_t at() const noexcept { return at_; }
  uint64_t left() const noexcept { return bytes_.size() - at_; }

  // Whether `count` records fit into what is left. True is the proof that memory for them may be asked for.
  bool holds(uint64_t count, uint64_t record_size) const noexcept {
    return record_size == 0 || count <= left() / record_size;
  }

  // A read past the end gives 0, stays at the end and is remembered here.
  bool failed() const noexcept { return failed_; }

  uint8_t u8() noexcept { return load<uint8_t>(); }
  uint16_t u16() noexcept { return load<uint16_t>(); }
  uint32_t u32() noexcept { return load<uint32_t>(); }
  uint64_t u64() noexcept { return load<uint64_t>(); }
  float f32() noexcept { return std::bit_cast<float>(load<uint32_t>()); }

  void skip(uint64_t bytes) noexcept {
    if (bytes > left()) fail();
    else at_ += bytes;
  }

  void floats(std::span<float> out) noexcept { words(out); }
  void u32s(std::span<uint32_t> out) noexcept { words(out); }

private:
  template <class Word> void words(std::span<Word> out) noexcept {
    static_assert(sizeof(Word) == sizeof(uint32_t));
    if (out.empty()) return;
    if (!holds(out.size(), sizeof(Word))) {
      std::memset(out.data(), 0, out.size_bytes());
      fail();
    } else if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(out.data(), bytes_.data() + at_, out.size_bytes());
      at_ += out.size_bytes();
    } else {
      for (Word& value : out) value = std::bit_cast<Word>(load<uint32_t>());
    }
  }
  template <std::unsigned_integral U> U load() noexcept {
    if (left() < sizeof(U)) {
      fail();
      return 0;
    }
    U value = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&value, bytes_.data() + at_, sizeof(U));
    } else {
      for (std::size_t i = sizeof(U); i-- > 0;)
        value = static_cast<U>(value << 8 | std::to_integer<U>(bytes_[at_ + i]));
    }
    at_ += sizeof(U);
    return value;
  }
  void fail() noexcept {
    failed_ = true;
    at_ = bytes_.size();
  }

  std::span<const std::byte> bytes_;
  uint64_t at_;
  bool failed_;
};

// The same for writing: fills a span of exactly the length that the codec announced.
class ByteSink {
public:
  explicit ByteSink(std::span<std::byte> bytes) noexcept : bytes_(bytes) {}

  bool complete() const noexcept { return !failed_ && at_ == bytes_.size(); }

  void u16(uint16_t value) noexcept { store(value); }
  void u32(uint32_t value) noexcept { store(value); }
  void u64(uint64_t value) noexcept { store(value); }
  void f32(float value) noexcept { store(std::bit_cast<uint32_t>(value)); }
  template <class Word> void words(std::span<const Word> values) noexcept {
    static_assert(sizeof(Word) == sizeof(uint32_t));
    if constexpr (std::endian::native == std::endian::little) {
      if (bytes_.size() - at_ < values.size_bytes()) {
        failed_ = true;
      } else if (!values.empty()) {
        std::memcpy(bytes_.data() + at_, values.data(), values.size_bytes());
        at_ += values.size_bytes();
      }
    } else {
      for (const Word value : values) store(std::bit_cast<uint32_t>(value));
    }
  }
  void zeros(uint64_t count) noexcept {
    for (; count > 0; --count) store(uint8_t{0});
  }
  void text(std::string_view text) noexcept {
    for (const char c : text) store(static_cast<uint8_t>(c));
  }
  std::size_t at() const noexcept { return at_; }
  // What has been written so far; for a checksum, and to set a field that depends on what follows it.
  std::span<std::byte> written() noexcept { return bytes_.first(at_); }
  // `text` cut or filled with zeros to `length` bytes.
  void text(const char* text, std::size_t length) noexcept {
    const std::size_t used = std::strlen(text);
    for (std::size_t i = 0; i < length; ++i) store(static_cast<uint8_t>(i < used ? text[i] : 0));
  }

private:
  template <std::unsigned_integral U> void store(U value) noexcept {
    if (bytes_.size() - at_ < sizeof(U)) {
      failed_ = true;
      return;
    }
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(bytes_.data() + at_, &value, sizeof(U));
    } else {
      for (std::size_t i = 0; i < sizeof(U); ++i) bytes_[at_ + i] = static_cast<std::byte>(value >> (8 * i) & 0xff);
    }
    at_ += sizeof(U);
  }

  std::span<std::byte> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace forelock
