// Which shaders a plan runs: an image that the frame lacks is in no interface, a constant that is not read makes no pipeline.
#include "passes/recipe.h"

#include "forelock/render.h"
#include "shared/node.h"

#include <gtest/gtest.h>

namespace forelock {
namespace {

FramePlan planOf(uint32_t method, uint32_t display, uint32_t shadow_size, bool depth) {
  FramePlan plan;
  plan.method = display == FLK_DISPLAY_LAYERS ? &kLayersMethod : display ? &kDisplayMethod : &kMethods[method];
  plan.display = display, plan.shadow_size = shadow_size, plan.has_depth = depth;
  plan.k = 8, plan.k_sort = 8;
  return plan;
}

TEST(Recipe, MethodsAreInTheOrderOfTheHeader) {
  EXPECT_STREQ(kMethods[FLK_METHOD_CORE_TAIL].name, "core_tail");
  EXPECT_STREQ(kMethods[FLK_METHOD_EXACT].name, "exact");
  EXPECT_STREQ(kMethods[FLK_METHOD_FORWARD].name, "forward");
}

TEST(Recipe, ImagesThatAreNotThereAreInNoShader) {
  EXPECT_EQ(captureRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, 1024, false)).main, ShaderId::capture_frag);
  EXPECT_EQ(captureRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, 1024, true)).main, ShaderId::capture_depth_frag);
  EXPECT_EQ(captureRecipe(planOf(FLK_METHOD_FORWARD, 0, 1024, true)).main, ShaderId::capture_forward_shadow_depth_frag);
  EXPECT_EQ(captureRecipe(planOf(FLK_METHOD_FORWARD, 0, 0, false)).main, ShaderId::capture_forward_frag);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, 0, true)).main, ShaderId::resolve_comp);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_EXACT, 0, 1024, true)).main, ShaderId::resolve_exact_shadow_comp);
  EXPECT_EQ(resolveRecipe(planOf(0, FLK_DISPLAY_LAYERS, 0, true)).main, ShaderId::resolve_layers_comp);
}

TEST(Recipe, AConstantThatIsNotReadMakesNoPipeline) {
  FramePlan a = planOf(FLK_METHOD_EXACT, 0, 1024, true), b = a;
  b.k = 3, b.k_sort = 17;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  a = planOf(FLK_METHOD_FORWARD, 0, 1024, true), b = a;
  b.k = 3;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  b.k_sort = 16;
  EXPECT_NE(resolveRecipe(a), resolveRecipe(b));
  EXPECT_EQ(resolveRecipe(b).constants[FLK_SPEC_K_SORT], 16u);
}

}  // namespace
}  // namespace forelock
