// Follow strands: section 7.
#pragma once

#include "reference_scene.h"

namespace forelock::reference {

// Guide 0, its follow strands 1 .. n, guide 1, ... Radii, fractions and colours are the guide's.
Strands followStrands(const Strands& guides, uint32_t n, double radius, double spread_tip, uint64_t seed);
// `current`: the guides as the host has moved them; the offsets turn with the root. Fractions are those at rest.
Strands followStrands(const Strands& rest, const Strands& current, uint32_t n, double radius, double spread_tip,
                      uint64_t seed);

}  // namespace forelock::reference
