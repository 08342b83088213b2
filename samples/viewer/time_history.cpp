// SPDX-License-Identifier: MIT
#include "time_history.h"

#include <algorithm>

namespace forelock::samples {

void TimeHistory::add(const FrameTimes& times) {
  ring_[next_] = times;
  next_ = (next_ + 1) % kFrames;
  count_ = std::min(count_ + 1, kFrames);
}

const FrameTimes& TimeHistory::at(size_t ago) const { return ring_[(next_ + kFrames - 1 - ago % kFrames) % kFrames]; }

double TimeHistory::percentile(uint32_t stage, double percent, size_t n, bool like_newest) const {
  std::array<double, kFrames> values;
  size_t found = 0;
  for (size_t ago = 0; ago < std::min(n, count_); ++ago) {
    if (like_newest && at(ago).reduced != at(0).reduced) {
      continue;
    }
    const double ms = stage == kTotal ? at(ago).total_ms : at(ago).stage_ms[stage];
    if (ms >= 0.0) {
      values[found++] = ms;
    }
  }
  if (found == 0) {
    return -1.0;
  }
  std::sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(found));
  const double place = std::clamp(percent, 0.0, 100.0) / 100.0 * static_cast<double>(found - 1);
  const size_t low = static_cast<size_t>(place), high = std::min(low + 1, found - 1);
  return values[low] + (values[high] - values[low]) * (place - static_cast<double>(low));
}

}  // namespace forelock::samples
