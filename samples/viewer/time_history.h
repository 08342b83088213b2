// How long the last frames took. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/render.h>

#include <array>
#include <cstddef>

namespace forelock::samples {

struct FrameTimes {
  std::array<double, FLK_STAGE_COUNT> stage_ms{};  // by FLK_STAGE_...; below 0: not timed or not run
  double total_ms = -1.0;                          // below 0: not timed
  double resolution_share = 1.0;                   // of the window's pixels a side that were drawn (0, 1]
  bool reduced = false;                            // of fewer strands, coarser meshes, smaller shadow maps
};

class TimeHistory {
 public:
  static constexpr size_t kFrames = 240;
  static constexpr uint32_t kTotal = FLK_STAGE_COUNT;  // stands for the whole frame where a stage is asked for

  void add(const FrameTimes& times);
  void clear() { count_ = 0; }
  size_t size() const { return count_; }
  const FrameTimes& at(size_t ago) const;  // 0: the newest; [0, size())

  // Of a stage in the last n frames that ran it (ms), of frames of the newest one's kind alone: reduced, or full; -1: none did.
  double median(uint32_t stage, size_t n = kFrames) const { return percentile(stage, 50.0, n, true); }
  // Of frames of both kinds, unless they are to be like the newest.
  double percentile(uint32_t stage, double percent, size_t n = kFrames, bool like_newest = false) const;  // linear between frames, [0, 100]

 private:
  std::array<FrameTimes, kFrames> ring_;
  size_t next_ = 0, count_ = 0;
};

}  // namespace forelock::samples
