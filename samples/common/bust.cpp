// SPDX-License-Identifier: MIT
#include "bust.h"

#include <algorithm>

namespace forelock::samples {

void bustBounds(float min_bounds[3], float max_bounds[3]) {
  const float low[3] = {-0.25f, -0.43f, -0.15f};
  const float high[3] = {0.25f, 0.11f, 0.12f};
  std::copy(low, low + 3, min_bounds);
  std::copy(high, high + 3, max_bounds);
}

void headBounds(float min_bounds[3], float max_bounds[3]) {
  const float low[3] = {-0.085f, -0.125f, -0.11f};
  const float high[3] = {0.085f, 0.11f, 0.105f};
  std::copy(low, low + 3, min_bounds);
  std::copy(high, high + 3, max_bounds);
}

}  // namespace forelock::samples
