// XXH64 (Yann Collet, "xxHash fast digest algorithm", format description 0.1.1) with seed 0: a checksum against damage, not against
// forgery. Fed in pieces, so that a piece can be looked at while it is in the cache.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace forelock {

class Checksum {
public:
  static constexpr std::size_t stripe = 32;

  // `bytes`: a multiple of 32, of any alignment.
  void add(std::span<const std::byte> bytes) noexcept {
    uint64_t a = lanes_[0], b = lanes_[1], c = lanes_[2], d = lanes_[3];
    const std::byte* at = bytes.data();
    for (std::size_t left = bytes.size() / stripe; left > 0; --left, at += stripe) {
      a = round(a, word<uint64_t>(at));
      b = round(b, word<uint64_t>(at + 8));
      c = round(c, word<uint64_t>(at + 16));
      d = round(d, word<uint64_t>(at + 24));
    }
    lanes_[0] = a, lanes_[1] = b, lanes_[2] = c, lanes_[3] = d;
    length_ += bytes.size() / stripe * stripe;
  }

  // The checksum of everything added and of `rest`, which is shorter than 32 bytes.
  uint64_t finish(std::span<const std::byte> rest) const noexcept {
    uint64_t hash = p5;
    if (length_ != 0) {
      hash = std::rotl(lanes_[0], 1) + std::rotl(lanes_[1], 7) + std::rotl(lanes_[2], 12) + std::rotl(lanes_[3], 18);
      for (const uint64_t lane : lanes_) hash = (hash ^ round(0, lane)) * p1 + p4;
    }
    hash += length_ + rest.size();
    const std::byte* at = rest.data();
    std::size_t left = rest.size();
    for (; left >= 8; left -= 8, at += 8) hash = std::rotl(hash ^ round(0, word<uint64_t>(at)), 27) * p1 + p4;
    if (left >= 4) hash = std::rotl(hash ^ word<uint32_t>(at) * p1, 23) * p2 + p3, left -= 4, at += 4;
    for (; left > 0; --left, ++at) hash = std::rotl(hash ^ std::to_integer<uint64_t>(*at) * p5, 11) * p1;
    hash = (hash ^ hash >> 33) * p2;
    hash = (hash ^ hash >> 29) * p3;
    return hash ^ hash >> 32;
  }

  static uint64_t of(std::span<const std::byte> bytes) noexcept {
    Checksum sum;
    const std::size_t whole = bytes.size() / stripe * stripe;
    sum.add(bytes.first(whole));
    return sum.finish(bytes.subspan(whole));
  }

private:
  static constexpr uint64_t p1 = 0x9e3779b185ebca87, p2 = 0xc2b2ae3d27d4eb4f, p3 = 0x165667b19e3779f9, p4 = 0x85ebca77c2b2ae63,
                            p5 = 0x27d4eb2f165667c5;

  static uint64_t round(uint64_t lane, uint64_t input) noexcept { return std::rotl(lane + input * p2, 31) * p1; }
  template <class U> static uint64_t word(const std::byte* at) noexcept {
    U value;
    std::memcpy(&value, at, sizeof value);
    if constexpr (std::endian::native == std::endian::big) {
      U swapped = 0;
      for (std::size_t i = 0; i < sizeof(U); ++i) swapped = static_cast<U>(swapped << 8 | (value >> (8 * i) & 0xff));
      value = swapped;
    }
    return value;
  }

  uint64_t lanes_[4] = {p1 + p2, p2, 0, 0 - p1};
  uint64_t length_ = 0;
};

}  // namespace forelock
