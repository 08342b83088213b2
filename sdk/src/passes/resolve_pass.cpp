#include "passes/recipe.h"

namespace forelock {

Recipe resolveRecipe(const FramePlan& plan) {
  Recipe recipe;
  switch (plan.method->resolve) {
    case ResolveKind::core_tail: recipe.main = ShaderId::resolve; break;
    case ResolveKind::colors: recipe.main = ShaderId::resolve_colors; break;
    case ResolveKind::exact: recipe.main = ShaderId::resolve_exact; break;
    case ResolveKind::layers: recipe.main = ShaderId::resolve_layers; break;
    case ResolveKind::hard: recipe.main = ShaderId::resolve_hard; break;
  }
  // A constant that the method does not read stays 0, so that its value makes no second pipeline.
  recipe.constants[FLK_SPEC_AGGREGATE] = plan.aggregate;
  recipe.constants[FLK_SPEC_LONG_FIRST] = plan.long_first;
  if (plan.method->resolve == ResolveKind::layers) return recipe;
  recipe.constants[FLK_SPEC_ONE_HAIR] = plan.one_hair;
  recipe.constants[FLK_SPEC_COLOR] = plan.colors;
  if (plan.method->lists()) recipe.constants[FLK_SPEC_PAYLOAD] = plan.payload;
  if (plan.method->shades_front) recipe.constants[FLK_SPEC_K] = plan.k;
  if (plan.method->sorts_front_only) recipe.constants[FLK_SPEC_K_SORT] = plan.k_sort;
  recipe.constants[FLK_SPEC_TAIL] = plan.tail;
  recipe.constants[FLK_SPEC_LOCKSTEP] = plan.lockstep;
  if (plan.method->resolve != ResolveKind::colors) addLight(plan, recipe);
  return recipe;
}

}  // namespace forelock
