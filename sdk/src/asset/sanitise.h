// Brings strands of any source to what every asset promises (forelock/asset.h): degenerate strands are dropped one by
// one, senseless values replaced, each kind with a finding; everything else stays bit for bit.
#pragma once

#include "asset/strand_arrays.h"

namespace forelock {

// Segments shorter than this count as having no length: their square vanishes in 32-bit floats, and with it every
// tangent computed from them.
inline constexpr double vanishing_length = 1e-18;
inline constexpr float largest_coordinate = 1e6f;

// Half of the width in metres that strands get where the source has none: thin hair stands for more of it.
float defaultRadius(uint32_t strands) noexcept;

// Changes `arrays` and fills the counts and measures of `info`. FLK_ERROR_EMPTY_ASSET (told to `report`) if no strand is
// left. Temporaries are taken from `memory`. Throws std::bad_alloc.
FlkResult sanitise(StrandArrays& arrays, const Places& places, std::pmr::memory_resource* memory, Findings& findings,
                   const Report& report, FlkAssetInfo& info);

}  // namespace forelock
