// How large the bust of bust_shape.h is. SPDX-License-Identifier: MIT
#pragma once

namespace forelock::samples {

// Box around the bust's head and shoulders (m), for framing together with hair.
void bustBounds(float min_bounds[3], float max_bounds[3]);

// Box around the head alone, crown to chin (m).
void headBounds(float min_bounds[3], float max_bounds[3]);

}  // namespace forelock::samples
