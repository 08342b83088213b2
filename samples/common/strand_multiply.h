// More strands from few: follow strands beside each, and strands between guides. SPDX-License-Identifier: MIT
#pragma once

#include "strand_edit.h"

namespace forelock::samples {

// `count` strands beside each, which start in a disc of `radius` about the guide's root, square to it, and keep their offset, at the tip
// `spread_tip` times as far: those that FlkFollowStrands draws (docs/methods.md section 7), as strands of their own. Each guide is followed by its
// own. Throws std::length_error where that is more than FlkStrands may hold.
void addFollowStrands(EditableStrands& strands, uint32_t count, double radius, double spread_tip, uint32_t seed);

struct InterpolationReport {
  uint32_t added = 0, triangles = 0;
  uint32_t parted = 0;        // strands between guides that part: they follow the nearest
  double mean_length = 0;     // of those added, against mean_guide_length
  double mean_guide_length = 0;
};
// Adds strands until there are `total`, the guides first and unchanged. Roots are spread evenly over the triangles that neighbouring
// guides' roots make; a strand's segments are those of its three guides, weighed by the place of its root among theirs, with
// the weighed length. Where guides part by more than 60 degrees, it follows the nearest alone. Nothing grows outside the guides' roots or across
// gaps of more than four times the usual distance. Throws std::invalid_argument where no three guides are neighbours.
InterpolationReport interpolateGuides(EditableStrands& strands, uint32_t total);

}  // namespace forelock::samples
