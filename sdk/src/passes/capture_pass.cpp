#include "passes/recipe.h"

#include "shared/node.h"

namespace forelock {

Recipe captureRecipe(const FramePlan& plan) {
  Recipe recipe;
  recipe.vertex = ShaderId::capture_vert;
  const bool depth = plan.has_depth;
  switch (plan.method->capture) {
    case CaptureKind::tangent:
      recipe.main = depth ? ShaderId::capture_depth_frag : ShaderId::capture_frag;
      break;
    case CaptureKind::color:
      if (plan.shadow_size)
        recipe.main = depth ? ShaderId::capture_forward_shadow_depth_frag : ShaderId::capture_forward_shadow_frag;
      else
        recipe.main = depth ? ShaderId::capture_forward_depth_frag : ShaderId::capture_forward_frag;
      break;
    case CaptureKind::display:
      recipe.main = depth ? ShaderId::capture_display_depth_frag : ShaderId::capture_display_frag;
      recipe.constants[FLK_SPEC_DISPLAY] = plan.display;
      break;
  }
  if (plan.method->capture != CaptureKind::display) recipe.constants[FLK_SPEC_PAYLOAD] = plan.payload;
  return recipe;
}

}  // namespace forelock
