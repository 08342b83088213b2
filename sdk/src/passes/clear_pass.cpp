#include "passes/recipe.h"

namespace forelock {

Recipe clearRecipe(const FramePlan& plan) {
  Recipe recipe;
  if (plan.compute && plan.hasShadow()) recipe.main = ShaderId::clear;
  return recipe;
}

}  // namespace forelock
