// Reads .pfm, as the study writes it. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

// Linear floats, row 0 at the top.
struct FloatPicture {
  uint32_t width = 0, height = 0, channels = 0;  // 1 or 3
  std::vector<float> values;
  size_t not_finite = 0;  // values that were, and are 0 now

  const float* pixel(uint32_t x, uint32_t y) const { return &values[(size_t{y} * width + x) * channels]; }
  size_t pixelCount() const { return size_t{width} * height; }
};

// Throws std::runtime_error with what is wrong.
FloatPicture readPfm(const std::string& path);

}  // namespace forelock::samples
