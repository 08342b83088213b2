// How many nodes the fragment lists hold: from the exact counts of completed frames, an estimate before there is one.
#pragma once

#include <cstdint>

namespace forelock {

struct PoolState {
  uint64_t capacity = 0;       // nodes allocated now
  uint64_t last_count = 0;     // fragments of the last completed frame
  uint64_t last_estimate = 0;  // the plan's estimate for that frame; 0: there is no count yet
  bool counted = false;        // last_count is new since the last choice
  uint32_t roomy_frames = 0;   // consecutive counts that would have fitted in a smaller pool
};

// Nodes to have for a frame estimated at `estimate`, at most `limit` (>= 1). Updates roomy_frames and counted.
// Growth is immediate; shrinking waits for three roomy counts, so that a swinging camera does not allocate every frame.
uint64_t choosePoolCapacity(PoolState& state, uint64_t estimate, uint64_t limit);

}  // namespace forelock
