#include "passes/recipe.h"

namespace forelock {

Recipe captureRecipe(const FramePlan& plan, PassId pass) {
  Recipe recipe;
  recipe.vertex = plan.compute ? ShaderId::none : ShaderId::capture_vert;
  recipe.images = plan.has_depth ? kImageDepth : 0;
  recipe.constants[FLK_SPEC_MODIFIERS] = plan.modifiers;
  const CaptureKind kind = plan.method->capture;
  switch (kind) {
    case CaptureKind::tangent:
    case CaptureKind::hard: recipe.main = plan.compute ? ShaderId::capture_compute : ShaderId::capture; break;
    case CaptureKind::color:
      recipe.main = plan.compute ? ShaderId::capture_forward_compute : ShaderId::capture_forward;
      if (!plan.count_only) addLight(plan, recipe);
      break;
    case CaptureKind::display:
      recipe.main = plan.compute ? ShaderId::capture_display_compute : ShaderId::capture_display;
      recipe.constants[FLK_SPEC_DISPLAY] = plan.count_only ? 0 : plan.display;
      break;
  }
  if (kind == CaptureKind::tangent || kind == CaptureKind::color) recipe.constants[FLK_SPEC_PAYLOAD] = plan.payload;
  recipe.constants[FLK_SPEC_COLOR] = plan.fibre_colors && (pass == PassId::capture || pass == PassId::hard_payload);
  recipe.constants[FLK_SPEC_AGGREGATE] = plan.aggregate;
  recipe.constants[FLK_SPEC_SHARES] = plan.node_shares;
  switch (pass) {
    case PassId::count: recipe.constants[FLK_SPEC_STORE] = FLK_STORE_COUNT; break;
    case PassId::hard_depth: recipe.constants[FLK_SPEC_STORE] = FLK_STORE_HARD_DEPTH; break;
    case PassId::hard_payload: recipe.constants[FLK_SPEC_STORE] = FLK_STORE_HARD_PAYLOAD; break;
    default: break;
  }
  return recipe;
}

}  // namespace forelock
