// SPDX-License-Identifier: MIT
#include "stray.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {

std::vector<uint8_t> findStrayStrands(const FlkStrands& strands) {
  const uint32_t count = strands.strand_count;
  if (count < 3) {
    return {};
  }
  float middle[3];
  std::vector<float> along(strands.vertex_count);
  for (size_t axis = 0; axis < 3; ++axis) {
    for (size_t v = 0; v < along.size(); ++v) {
      along[v] = strands.positions[3 * v + axis];
    }
    const auto half = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), half, along.end());
    middle[axis] = *half;
  }
  std::vector<float> reach(count, 0.0f);
  for (uint32_t s = 0; s < count; ++s) {
    for (uint32_t v = strands.first_vertex[s]; v < strands.first_vertex[s + 1]; ++v) {
      const float* p = strands.positions + size_t{3} * v;
      reach[s] = std::max(reach[s], std::hypot(p[0] - middle[0], p[1] - middle[1], p[2] - middle[2]));
    }
  }
  std::vector<float> sorted(reach);
  std::sort(sorted.begin(), sorted.end());
  for (uint32_t i = count - count / 3; i < count; ++i) {
    const bool few = count - i <= count / 10;
    if (sorted[i] > (few ? 2.5f : 50.0f) * sorted[i - 1]) {
      std::vector<uint8_t> stray(count);
      std::transform(reach.begin(), reach.end(), stray.begin(), [&](float r) { return static_cast<uint8_t>(r >= sorted[i] ? 1 : 0); });
      return stray;
    }
  }
  return {};
}

}  // namespace forelock::samples
