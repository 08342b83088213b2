#include "passes/recipe.h"

namespace forelock {

Recipe shadowRecipe(const FramePlan&) { return {ShaderId::shadow_vert, ShaderId::shadow_frag, true, {}}; }

}  // namespace forelock
