// Fewer, wider strands that stand for all of them. SPDX-License-Identifier: MIT
#pragma once

#include "strand_edit.h"

namespace forelock::samples {

// An order in which the first n strands, for every n, are spread as evenly as all of them: over the scalp and over where strands end. Any
// level of detail is then a prefix, and contains all smaller ones. Halves of the strands, halved again along whichever of root and tip
// varies most, take turns. Deterministic.
std::vector<uint32_t> evenOrder(const EditableStrands& strands);

// Strands in this order; entries may be left out.
void orderStrands(EditableStrands& strands, const std::vector<uint32_t>& order);

struct LodReport {
  uint32_t kept = 0;
  double widening = 1;                             // factor of the widths
  double coverage_before = 0, coverage_after = 0;  // CoverageMeter's, of the whole picture
};
// Keeps the first `count` strands and widens them so that they cover what all did, seen from six sides, to 1 part in 1,000 where they can at a
// width of at most four times what the number of strands alone asks for. `opacity` is a fibre's. Strands need radii.
LodReport keepFirstStrands(EditableStrands& strands, uint32_t count, double opacity);

}  // namespace forelock::samples
