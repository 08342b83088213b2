// Brings strands of any source to what every asset promises (forelock/asset.h): degenerate strands are dropped one by
// one, senseless values replaced, each kind with a finding; everything else stays bit for bit.
#pragma once

#include "asset/strand_arrays.h"

namespace forelock {

// Segments shorter than this count as having no length: their square vanishes in 32-bit floats, and with it every
// tangent computed from them.
inline constexpr double vanishing_length = 1e-18;
inline constexpr float largest_coordinate = 1e6f;

// Half of the width that strands get where the source has none, from the bounds and strand count of `info`: thin hair stands for more of it.
// It depends on the hair's own size and not on a unit, so that hair in centimetres looks as it does in metres. 1/5,000 of the longest side is
// 80 um for the hair of a head, 0.4 m; the bounds of 1/1,000 of the side
// and of 1/100 of a strand keep few strands from being ribbons: 1 mm for 516 strands of a ponytail a metre across.
float defaultRadius(const FlkAssetInfo& info, double median_length) noexcept;

// Changes `arrays` and fills the counts and measures of `info`. FLK_ERROR_EMPTY_ASSET (told to `report`) if no strand is
// left. Temporaries are taken from `memory`. Throws std::bad_alloc.
FlkResult sanitise(StrandArrays& arrays, const Places& places, std::pmr::memory_resource* memory, Findings& findings,
                   const Report& report, FlkAssetInfo& info);

}  // namespace forelock
