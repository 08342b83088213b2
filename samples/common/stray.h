// Strands that lie so far off that a picture of all would show the rest as a dot. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/asset.h>

#include <cstdint>
#include <vector>

namespace forelock::samples {

// Strands that reach beyond a gap around the rest: sorted by how far they reach from the median vertex, one reaches 2.5 times as far as
// the one before it, and it and what follows are a tenth of the strands or fewer; or 50 times, and they are a third or fewer. A long
// tail without a gap is none, nor are two strands far apart. Empty: none; else an entry a strand, 1: stray. Cost: a few passes.
std::vector<uint8_t> findStrayStrands(const FlkStrands& strands);

}  // namespace forelock::samples
