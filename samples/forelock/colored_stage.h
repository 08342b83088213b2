// A stage whose strands have colours that show data. SPDX-License-Identifier: MIT
#pragma once

#include "stage.h"

namespace forelock::samples {

// Copies the stage's strands with colours that are seen as they are, lit by nothing. Its assets may be more: what is to stand out is a
// hair of its own, opaque and at least two pixels wide in the first view. `plain` has no colouring. Throws AssetError.
Stage coloredStage(const Stage& plain, StrandColoring coloring);

}  // namespace forelock::samples
