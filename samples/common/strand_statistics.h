// Numbers that tell one groom from another, and the strands to look at first. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/asset.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

struct Spread {
  double min = 0, median = 0, mean = 0, max = 0;
};

struct RankedStrand {
  uint32_t strand = 0;  // as held by the asset
  double value = 0;
};

struct StrandStatistics {
  Spread vertices;        // of a strand
  Spread length;          // of strands (unit of the positions)
  Spread segment_length;  // of all segments (unit of the positions)
  Spread width;           // diameter at all vertices (unit of the positions)
  Spread turn_degrees;    // between a segment and the next one of the same strand, [0, 180]; of segments of some length
  Spread unevenness;      // of strands: longest segment over mean segment, 1 where all are equal
  uint64_t duplicates = 0;  // strands equal to one before them, vertex for vertex
  std::array<double, 3> direction{};  // sum of all (tip - root) over the sum of all lengths: which way the hair lies, within the unit ball
  std::array<double, 3> min_bounds{}, max_bounds{};  // with half of the width around every vertex
  std::vector<RankedStrand> longest, shortest, sharpest;  // sharpest by their greatest turn
};

// `ranked`: length of the lists of strands. Cost: a few passes, and 4 bytes a segment of memory.
StrandStatistics measureStrands(const FlkStrands& strands, size_t ranked = 5);

// For each strand the first one that it equals vertex for vertex: its own number where it is no copy.
std::vector<uint32_t> firstOfEqualStrands(const FlkStrands& strands);

// What a person would guess, with the reason. `value` is empty where nothing speaks for anything.
struct Guess {
  std::string value, why;
};
Guess guessUnit(const FlkAssetInfo& info);                                  // "m", "cm", "mm"
Guess guessUpAxis(const FlkAssetInfo& info, const StrandStatistics& numbers);  // "x", "y", "z"

// Device memory of a hair made of it (flkHairGetInfo): 16 bytes a vertex, 4 a segment, 4 a vertex for colours.
uint64_t hairBytes(const FlkAssetInfo& info);

// What a default width (FlkAssetInfo.has_radii is 0) is multiplied by where each strand gets `follow` more beside it: the rule of docs/findings.md
// counts them too, but where one of its bounds decided, more strands are no reason to be thinner. (0, 1].
double followWidthScale(const FlkAssetInfo& info, uint32_t follow);

}  // namespace forelock::samples
