#include "passes/recipe.h"

namespace forelock {

Recipe recipeOf(const FramePlan& plan, const Pass& pass) {
  switch (pass.id) {
    case PassId::clear: return clearRecipe(plan);
    case PassId::prepare: return prepareRecipe();
    case PassId::shadow: return shadowRecipe(plan);
    case PassId::count:
    case PassId::capture:
    case PassId::hard_depth:
    case PassId::hard_payload: return captureRecipe(plan, pass.id);
    case PassId::resolve: return resolveRecipe(plan);
    case PassId::output: return outputRecipe(plan, pass.output);
  }
  return {};
}

void addLight(const FramePlan& plan, Recipe& recipe) {
  recipe.images |= (plan.hasShadow() ? kImageShadow : 0) | (plan.host_light ? kImageHostLight : 0);
  recipe.constants[FLK_SPEC_LIGHTS] = plan.light_mode;
  // A sun is read as what it is: kinds that cannot differ make no second pipeline.
  const bool loop = plan.light_mode == FLK_LIGHTS_ALL || plan.light_mode == FLK_LIGHTS_TILES;
  recipe.constants[FLK_SPEC_LIGHT_KINDS] = loop ? plan.light_kinds : 0;
  recipe.constants[FLK_SPEC_FACES] = loop ? plan.face_kinds : 0;
  recipe.constants[FLK_SPEC_HOST] = plan.host_light;
  recipe.constants[FLK_SPEC_AMBIENT] = plan.ambient_sh;
  recipe.constants[FLK_SPEC_COUNT_WORK] = plan.count_work;
  recipe.constants[FLK_SPEC_LOCKSTEP] = plan.lockstep;
  recipe.constants[FLK_SPEC_TAPS] = plan.full_taps;
  recipe.constants[FLK_SPEC_LOW_SHADE] = plan.low_shade;
}

}  // namespace forelock
