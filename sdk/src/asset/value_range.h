// Looks over large arrays at the speed of memory: no branch a value, in a shape that compilers turn into vector instructions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace forelock {

// Least and greatest of interleaved values, for any of 1, 2, 3, 4, 6 or 12 values a record.
class ValueRange {
public:
  static constexpr std::size_t lanes = 12;  // four vertices of three coordinates: three vectors of four

  ValueRange() noexcept {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      low_[lane] = std::numeric_limits<float>::infinity();
      high_[lane] = -std::numeric_limits<float>::infinity();
    }
  }

  // A multiple of 12 values; the last call of all may be of any number.
  void add(std::span<const float> values) noexcept {
    float low[lanes], high[lanes];
    uint32_t nan[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) low[lane] = low_[lane], high[lane] = high_[lane], nan[lane] = nan_[lane];
    const std::size_t whole = values.size() / lanes * lanes;
    const float* at = values.data();
    for (std::size_t i = 0; i < whole; i += lanes, at += lanes)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const float value = at[lane];
        low[lane] = value < low[lane] ? value : low[lane];
        high[lane] = value > high[lane] ? value : high[lane];
        nan[lane] |= value != value ? ~0u : 0u;
      }
    for (std::size_t lane = 0; lane < values.size() - whole; ++lane) {
      const float value = at[lane];
      low[lane] = value < low[lane] ? value : low[lane];
      high[lane] = value > high[lane] ? value : high[lane];
      nan[lane] |= value != value ? ~0u : 0u;
    }
    for (std::size_t lane = 0; lane < lanes; ++lane) low_[lane] = low[lane], high_[lane] = high[lane], nan_[lane] = nan[lane];
  }

  // Over every `records`-th lane from `first`.
  float least(std::size_t first = 0, std::size_t records = 1) const noexcept {
    float least = low_[first];
    for (std::size_t lane = first; lane < lanes; lane += records) least = low_[lane] < least ? low_[lane] : least;
    return least;
  }
  float greatest(std::size_t first = 0, std::size_t records = 1) const noexcept {
    float greatest = high_[first];
    for (std::size_t lane = first; lane < lanes; lane += records) greatest = high_[lane] > greatest ? high_[lane] : greatest;
    return greatest;
  }
  // Whether all values are numbers from `from` to `to`.
  bool within(float from, float to) const noexcept {
    uint32_t nan = 0;
    for (const uint32_t lane : nan_) nan |= lane;
    return nan == 0 && least() >= from && greatest() <= to;
  }

private:
  float low_[lanes], high_[lanes];
  uint32_t nan_[lanes] = {};
};

}  // namespace forelock
