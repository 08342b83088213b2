#include "passes/recipe.h"

namespace forelock {

Recipe resolveRecipe(const FramePlan& plan) {
  Recipe recipe;
  const bool shadow = plan.shadow_size != 0;
  switch (plan.method->resolve) {
    case ResolveKind::core_tail: recipe.main = shadow ? ShaderId::resolve_shadow_comp : ShaderId::resolve_comp; break;
    case ResolveKind::colors: recipe.main = ShaderId::resolve_forward_comp; break;
    case ResolveKind::exact: recipe.main = shadow ? ShaderId::resolve_exact_shadow_comp : ShaderId::resolve_exact_comp; break;
    case ResolveKind::layers: recipe.main = ShaderId::resolve_layers_comp; break;
  }
  // A constant that the method does not read stays 0, so that its value makes no second pipeline.
  if (plan.method->resolve != ResolveKind::layers) recipe.constants[FLK_SPEC_PAYLOAD] = plan.payload;
  if (plan.method->resolve != ResolveKind::layers) recipe.constants[FLK_SPEC_ONE_HAIR] = plan.one_hair;
  if (plan.method->shades_front) recipe.constants[FLK_SPEC_K] = plan.k;
  if (plan.method->sorts_front_only) recipe.constants[FLK_SPEC_K_SORT] = plan.k_sort;
  return recipe;
}

}  // namespace forelock
