// Which shaders a plan runs: an image that the frame lacks is in no interface, a constant that is not read makes no pipeline.
#include "passes/recipe.h"

#include "gpu/shader_code.h"

#include "forelock/render.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace forelock {
namespace {

FramePlan planOf(uint32_t method, uint32_t display = 0, bool shadow = false, bool depth = false) {
  FramePlan plan;
  plan.method = display == FLK_DISPLAY_LAYERS ? &kLayersMethod : display ? &kDisplayMethod : &kMethods[method];
  plan.display = display, plan.has_depth = depth;
  plan.k = 8, plan.k_sort = 8;
  if (shadow) {
    plan.shadow.faces.add({});
    plan.shadow.width = plan.shadow.height = 1024;
    plan.face_kinds = FLK_FACES_ORTHOGRAPHIC;
  }
  plan.light_mode = FLK_LIGHTS_SUN, plan.light_kinds = 1;
  return plan;
}

// Name and images of the SPIR-V that a recipe runs.
void expectBuilt(const Recipe& recipe) {
  EXPECT_FALSE(shaderCode(recipe.main, recipe.images).empty()) << int(recipe.main) << " with images " << int(recipe.images);
  if (recipe.vertex != ShaderId::none) { EXPECT_FALSE(shaderCode(recipe.vertex, 0).empty()) << int(recipe.vertex); }
}

TEST(Recipe, MethodsAreInTheOrderOfTheHeader) {
  EXPECT_STREQ(kMethods[FLK_METHOD_CORE_TAIL].name, "core_tail");
  EXPECT_STREQ(kMethods[FLK_METHOD_EXACT].name, "exact");
  EXPECT_STREQ(kMethods[FLK_METHOD_FORWARD].name, "forward");
  EXPECT_STREQ(kMethods[FLK_METHOD_CORE_ONLY].name, "core_only");
  EXPECT_STREQ(kMethods[FLK_METHOD_ALL_LOW].name, "all_low");
  EXPECT_STREQ(kMethods[FLK_METHOD_HARD].name, "hard");
  EXPECT_EQ(std::size(kMethods), std::size_t(FLK_METHOD_HARD) + 1);
  // And values that the shared headers repeat.
  EXPECT_EQ(FLK_MODIFIER_FADE, uint32_t(FLK_OPACITY_NEAR_FADE));
  EXPECT_EQ(FLK_MODIFIER_LENS, uint32_t(FLK_OPACITY_LENS));
  EXPECT_EQ(uint32_t(FLK_MODIFIER_COUNT), FLK_MAX_OPACITY_MODIFIERS);
  EXPECT_EQ(uint32_t(LightKind::directional), uint32_t(FLK_LIGHT_DIRECTIONAL));
  EXPECT_EQ(uint32_t(LightKind::point), uint32_t(FLK_LIGHT_POINT));
  EXPECT_EQ(uint32_t(LightKind::spot), uint32_t(FLK_LIGHT_SPOT));
}

TEST(Recipe, ImagesThatAreNotThereAreInNoShader) {
  const auto capture = [](const FramePlan& plan) { return captureRecipe(plan, PassId::capture); };
  EXPECT_EQ(capture(planOf(FLK_METHOD_CORE_TAIL)).main, ShaderId::capture);
  EXPECT_EQ(capture(planOf(FLK_METHOD_CORE_TAIL)).images, 0);
  EXPECT_EQ(capture(planOf(FLK_METHOD_CORE_TAIL, 0, true, true)).images, kImageDepth);
  EXPECT_EQ(capture(planOf(FLK_METHOD_FORWARD, 0, true, true)).main, ShaderId::capture_forward);
  EXPECT_EQ(capture(planOf(FLK_METHOD_FORWARD, 0, true, true)).images, kImageDepth | kImageShadow);
  EXPECT_EQ(capture(planOf(FLK_METHOD_FORWARD)).images, 0);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, false, true)).main, ShaderId::resolve);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, false, true)).images, 0);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_EXACT, 0, true, true)).main, ShaderId::resolve_exact);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_EXACT, 0, true, true)).images, kImageShadow);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_FORWARD, 0, true, true)).main, ShaderId::resolve_colors);
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_FORWARD, 0, true, true)).images, 0);  // lit at capture
  EXPECT_EQ(resolveRecipe(planOf(FLK_METHOD_HARD, 0, true)).main, ShaderId::resolve_hard);
  EXPECT_EQ(resolveRecipe(planOf(0, FLK_DISPLAY_LAYERS, false, true)).main, ShaderId::resolve_layers);
  FramePlan host = planOf(FLK_METHOD_CORE_TAIL, 0, true);
  host.host_light = FLK_HOST_MAP;
  EXPECT_EQ(resolveRecipe(host).images, kImageShadow | kImageHostLight);
}

TEST(Recipe, AConstantThatIsNotReadMakesNoPipeline) {
  FramePlan a = planOf(FLK_METHOD_EXACT, 0, true, true), b = a;
  b.k = 3, b.k_sort = 17;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  a = planOf(FLK_METHOD_FORWARD, 0, true, true), b = a;
  b.k = 3;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  b.k_sort = 16;
  EXPECT_NE(resolveRecipe(a), resolveRecipe(b));
  EXPECT_EQ(resolveRecipe(b).constants[FLK_SPEC_K_SORT], 16u);
  // Opaque strands have no payload coding of fragments and no tail.
  a = planOf(FLK_METHOD_HARD), b = a;
  b.payload = FLK_PAYLOAD_PAPER, b.k = 3, b.k_sort = 17;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  EXPECT_EQ(captureRecipe(a, PassId::hard_depth), captureRecipe(b, PassId::hard_depth));
  // A sun is a sun, whatever the bits of a loop that does not run say.
  a = planOf(FLK_METHOD_CORE_TAIL, 0, true), b = a;
  b.light_kinds = 7, b.face_kinds = 7;
  EXPECT_EQ(resolveRecipe(a), resolveRecipe(b));
  b.light_mode = FLK_LIGHTS_ALL;
  EXPECT_EQ(resolveRecipe(b).constants[FLK_SPEC_LIGHT_KINDS], 7u);
  EXPECT_EQ(resolveRecipe(b).constants[FLK_SPEC_FACES], 7u);
  // What capture stores does not depend on lights, unless it shades.
  EXPECT_EQ(captureRecipe(a, PassId::capture), captureRecipe(b, PassId::capture));
  a = planOf(FLK_METHOD_FORWARD), b = a;
  b.light_mode = FLK_LIGHTS_ALL;
  EXPECT_NE(captureRecipe(a, PassId::capture), captureRecipe(b, PassId::capture));
}

TEST(Recipe, CountingStoresAndShadesNothing) {
  for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_FORWARD, FLK_METHOD_HARD}) {
    FramePlan plan = planOf(method, 0, false, true);
    plan.count_only = true, plan.light_mode = FLK_LIGHTS_NONE;
    const Recipe recipe = captureRecipe(plan, PassId::count);
    EXPECT_EQ(recipe.constants[FLK_SPEC_STORE], uint32_t(FLK_STORE_COUNT));
    EXPECT_EQ(recipe.constants[FLK_SPEC_AGGREGATE], 0u);
    EXPECT_EQ(recipe.constants[FLK_SPEC_LIGHTS], uint32_t(FLK_LIGHTS_NONE));
    EXPECT_EQ(recipe.images, kImageDepth);
  }
}

TEST(Recipe, HardWritesDepthThenWhatLiesThere) {
  FramePlan plan = planOf(FLK_METHOD_HARD);
  plan.fibre_colors = plan.colors = true;
  EXPECT_EQ(captureRecipe(plan, PassId::hard_depth).constants[FLK_SPEC_STORE], uint32_t(FLK_STORE_HARD_DEPTH));
  EXPECT_EQ(captureRecipe(plan, PassId::hard_payload).constants[FLK_SPEC_STORE], uint32_t(FLK_STORE_HARD_PAYLOAD));
  EXPECT_EQ(captureRecipe(plan, PassId::hard_depth).constants[FLK_SPEC_COLOR], 0u);
  EXPECT_EQ(captureRecipe(plan, PassId::hard_payload).constants[FLK_SPEC_COLOR], 1u);
}

TEST(Recipe, ComputeRunsNoVertexShader) {
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method) {
    FramePlan plan = planOf(method, 0, true, true);
    plan.compute = true;
    for (const Recipe& recipe : {captureRecipe(plan, PassId::capture), shadowRecipe(plan)}) {
      EXPECT_EQ(recipe.vertex, ShaderId::none);
      EXPECT_FALSE(recipe.depth_attachment);
    }
  }
}

TEST(Recipe, ShadowKnowsOnlyTheProjection) {
  FramePlan plan = planOf(FLK_METHOD_CORE_TAIL, 0, true);
  const Recipe sun = shadowRecipe(plan);
  EXPECT_TRUE(sun.depth_attachment);
  plan.face_kinds = FLK_FACES_PERSPECTIVE;
  const Recipe spot = shadowRecipe(plan);
  EXPECT_NE(spot, sun);
  plan.face_kinds = FLK_FACES_CUBE;
  EXPECT_EQ(shadowRecipe(plan), spot);
  plan.face_kinds = FLK_FACES_ORTHOGRAPHIC | FLK_FACES_CUBE;
  EXPECT_EQ(shadowRecipe(plan), spot);
  plan.k = 3, plan.payload = FLK_PAYLOAD_PAPER, plan.light_mode = FLK_LIGHTS_TILES, plan.count_work = true;
  EXPECT_EQ(shadowRecipe(plan), spot);
}

TEST(Recipe, CoverageByWidthIsASetOfShadersOfItsOwn) {
  FramePlan plan = planOf(FLK_METHOD_CORE_TAIL, 0, true);
  const Recipe texel = shadowRecipe(plan);
  EXPECT_EQ(texel.vertex, ShaderId::shadow_vert);
  EXPECT_EQ(texel.main, ShaderId::shadow_frag);
  plan.cover_width = true;
  const Recipe width = shadowRecipe(plan);
  EXPECT_EQ(width.vertex, ShaderId::shadow_width_vert);
  EXPECT_EQ(width.main, ShaderId::shadow_width_frag);
  EXPECT_TRUE(width.depth_attachment);
  expectBuilt(width);
  // What reads the map does not know.
  FramePlan plain = plan;
  plain.cover_width = false;
  EXPECT_EQ(resolveRecipe(plan), resolveRecipe(plain));
  EXPECT_EQ(captureRecipe(plan, PassId::capture), captureRecipe(plain, PassId::capture));
  plan.compute = true;
  EXPECT_EQ(shadowRecipe(plan).vertex, ShaderId::none);
  EXPECT_EQ(shadowRecipe(plan).main, ShaderId::shadow_width_compute);
  expectBuilt(shadowRecipe(plan));
}

TEST(Recipe, OutputsReadTheListsAsTheyAre) {
  std::set<ShaderId> shaders;
  for (uint32_t output = 0; output < kOutputCount; ++output) {
    FramePlan plan = planOf(FLK_METHOD_CORE_TAIL, 0, true, true);
    const Recipe recipe = outputRecipe(plan, output);
    shaders.insert(recipe.main);
    EXPECT_EQ(recipe.images, 0);
    EXPECT_EQ(recipe.constants[FLK_SPEC_COLORS_LISTED], 0u);
    EXPECT_EQ(recipe.constants[FLK_SPEC_STORE], uint32_t(FLK_STORE_LISTS));
    EXPECT_EQ(outputRecipe(planOf(FLK_METHOD_FORWARD), output).constants[FLK_SPEC_COLORS_LISTED], 1u);
    EXPECT_EQ(outputRecipe(planOf(0, FLK_DISPLAY_STRAND), output).constants[FLK_SPEC_COLORS_LISTED], 1u);
    EXPECT_EQ(outputRecipe(planOf(FLK_METHOD_HARD), output).constants[FLK_SPEC_STORE], uint32_t(FLK_STORE_HARD_PAYLOAD));
  }
  EXPECT_EQ(shaders.size(), std::size_t(kOutputCount));
}

// A recipe without SPIR-V would be FLK_ERROR_NOT_BUILT: this build has everything.
TEST(Recipe, EveryRecipeIsBuilt) {
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
    for (uint32_t display = 0; display <= kDisplayLayers; ++display)
      for (const bool shadow : {false, true})
        for (const bool depth : {false, true})
          for (const bool host : {false, true})
            for (const bool compute : {false, true}) {
              FramePlan plan = planOf(method, display, shadow && display == 0, depth);
              plan.compute = compute;
              plan.host_light = host && display == 0 ? FLK_HOST_MAP : 0;
              for (const PassId pass : {PassId::count, PassId::capture, PassId::hard_depth, PassId::hard_payload})
                expectBuilt(captureRecipe(plan, pass));
              expectBuilt(shadowRecipe(plan));
              expectBuilt(resolveRecipe(plan));
              for (uint32_t output = 0; output < kOutputCount; ++output) expectBuilt(outputRecipe(plan, output));
            }
  expectBuilt(prepareRecipe());
}

// The hash sees the constants that the SPIR-V declares, and no others.
TEST(Recipe, EqualHashesAreEqualCode) {
  Recipe recipe = resolveRecipe(planOf(FLK_METHOD_CORE_TAIL, 0, true));
  const uint64_t hash = recipeHash(recipe);
  Recipe other = recipe;
  other.constants[FLK_SPEC_K] = 3;
  EXPECT_NE(recipeHash(other), hash);
  other = recipe;
  other.constants[FLK_SPEC_DISPLAY] = 3;  // of capture alone
  EXPECT_EQ(recipeHash(other), hash);
  other = recipe;
  other.images = 0;
  EXPECT_NE(recipeHash(other), hash);
}

}  // namespace
}  // namespace forelock
