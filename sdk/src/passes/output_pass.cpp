#include "passes/recipe.h"

namespace forelock {

Recipe outputRecipe(const FramePlan& plan, uint32_t output) {
  constexpr ShaderId kShaders[kOutputCount] = {ShaderId::output_front_depth, ShaderId::output_transmittance,
                                               ShaderId::output_velocity, ShaderId::output_depth_range};
  Recipe recipe;
  recipe.main = kShaders[output];
  const bool hard = !plan.method->lists();
  recipe.constants[FLK_SPEC_STORE] = hard ? FLK_STORE_HARD_PAYLOAD : FLK_STORE_LISTS;
  recipe.constants[FLK_SPEC_ONE_HAIR] = plan.one_hair;
  if (hard) return recipe;
  recipe.constants[FLK_SPEC_PAYLOAD] = plan.payload;
  recipe.constants[FLK_SPEC_COLOR] = plan.colors;
  recipe.constants[FLK_SPEC_AGGREGATE] = plan.aggregate;
  recipe.constants[FLK_SPEC_COLORS_LISTED] = plan.method->colorsListed();
  return recipe;
}

}  // namespace forelock
