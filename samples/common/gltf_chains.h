// Polylines of the index lists that glTF keeps lines in. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace forelock::samples {

// What there is to say about a polyline.
enum ChainMark : uint8_t {
  kChainBranch = 1,       // it ends where more than two segments meet
  kChainCycle = 2,        // it was closed; the segment that closes it was left out
  kChainRootGuessed = 4,  // its indices do not rise from one end to the other
  kChainLoop = 8          // of a LINE_LOOP; opened
};

struct Chains {
  std::vector<uint32_t> first{0};  // of polyline i in `vertices`: first[i] .. first[i + 1] - 1
  std::vector<uint32_t> vertices;  // of the primitive
  std::vector<uint8_t> marks;      // ChainMark, a polyline each
  uint64_t self_edges = 0, repeated_edges = 0, odd_indices = 0, joined = 0;
};

// Segments as pairs of vertices, in any order and direction. Polylines run between vertices at which one segment ends or more
// than two meet, and are split there. The end with the lower index is the root. Polylines come
// in the order of their roots, closed ones last. Time: that of sorting the pairs.
Chains chainsOfPairs(std::vector<uint32_t> pairs);

// Pairs without indices, 0 1, 2 3, ...: a pair goes on where the last one ended, if same(a, b) says that vertices a and b are one.
Chains chainsOfVertices(uint32_t count, const std::function<bool(uint32_t, uint32_t)>& same);

constexpr uint32_t kRestart = UINT32_MAX;

// A strip, root first; kRestart ends it and begins another. `loop`: each is closed, and opened here.
Chains chainsOfStrip(const std::vector<uint32_t>& indices, bool loop);

}  // namespace forelock::samples
