#include "passes/recipe.h"

namespace forelock {

Recipe shadowRecipe(const FramePlan& plan) {
  Recipe recipe;
  if (plan.cover_width) {
    recipe.vertex = plan.compute ? ShaderId::none : ShaderId::shadow_width_vert;
    recipe.main = plan.compute ? ShaderId::shadow_width_compute : ShaderId::shadow_width_frag;
  } else {
    recipe.vertex = plan.compute ? ShaderId::none : ShaderId::shadow_vert;
    recipe.main = plan.compute ? ShaderId::shadow_compute : ShaderId::shadow_frag;
  }
  recipe.depth_attachment = !plan.compute;
  recipe.constants[FLK_SPEC_FACES] = plan.face_kinds & ~uint32_t(FLK_FACES_ORTHOGRAPHIC) ? FLK_FACES_PERSPECTIVE : FLK_FACES_ORTHOGRAPHIC;
  return recipe;
}

}  // namespace forelock
