// Looks at strands that are sound, and says where they are most likely not what their maker meant: run from tip to root, doubled, of odd
// widths, far away. Nothing is changed. Statistics come from samples that depend on nothing but the strands.
#pragma once

#include "asset/strand_arrays.h"

#include <span>

namespace forelock {

// After everything else: `arrays` keep what asset.h promises, `info` holds their measures. `lengths`: of the strands of the source, in
// its order, negative where one was dropped; `median_length` of the others. Cost: about 4 ms a million vertices. Temporaries are
// taken from `memory`: 16 to 32 bytes a strand. Throws std::bad_alloc.
void noteSuspicions(const StrandArrays& arrays, const Places& places, std::span<const float> lengths, double median_length,
                    const FlkAssetInfo& info, std::pmr::memory_resource* memory, Findings& findings);

}  // namespace forelock
