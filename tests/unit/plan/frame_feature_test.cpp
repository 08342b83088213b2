// Every feature of a frame: what it adds to the plan, and that a frame which does not use it pays nothing.
#include "gpu/shader_code.h"
#include "passes/recipe.h"
#include "plan/plan.h"

#include "forelock/render.h"
#include "shared/frame.h"
#include "shared/light.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace forelock {
namespace {

class FrameFeature : public testing::Test {
protected:
  FrameFeature() {
    HairFacts hair;
    hair.segments = 1000;
    hair.bounds = {{-0.2, -0.2, -2.2}, {0.2, 0.2, -1.8}};
    hair.radius = 1e-4, hair.length = 100;
    hairs = {hair};
    LightFacts light;
    light.casts_shadow = true, light.shadow_size = 512;
    lights = {light};
    const float clip[16] = {2, 0, 0, 0, 0, -2, 0, 0, 0, 0, -1.001f, -1, 0, 0, -0.1001f, 0};
    EXPECT_EQ(makeCamera(kIdentity.data(), clip, false, 400, 300, facts.camera), nullptr);
  }

  FramePlan plan() {
    facts.hairs = hairs;
    facts.lights = lights;
    return planFrame(facts, 5000);
  }

  static std::vector<std::string> passes(const FramePlan& plan) {
    std::vector<std::string> names;
    for (const Pass& pass : plan.passes) names.emplace_back(pass.name);
    return names;
  }

  static bool omits(const FramePlan& plan, const std::string& beginning) {
    for (const char* omission : plan.omissions)
      if (std::string(omission).starts_with(beginning)) return true;
    return false;
  }

  std::vector<HairFacts> hairs;
  std::vector<LightFacts> lights;
  FrameFacts facts;
};

// All that the GPU would do and hold.
std::string described(const FramePlan& plan) {
  std::string text;
  for (const Pass& pass : plan.passes) {
    const Recipe recipe = recipeOf(plan, pass);
    text += std::string(pass.name) + ' ' + std::to_string(recipe.main == ShaderId::none ? 0 : recipeHash(recipe)) + ' ' +
            std::to_string(pass.groups[0]) + ' ' + std::to_string(pass.indices) + ' ' + std::to_string(pass.segments) + '\n';
  }
  for (const Resource& resource : plan.resources) text += std::string(resource.name) + ' ' + std::to_string(resource.bytes) + '\n';
  return text;
}

// A frame that could use something but has nothing for it is the frame that never mentions it: same passes, code and bytes.
TEST_F(FrameFeature, WhatIsNotThereCostsNothing) {
  const std::string plain = described(plan());
  const FrameFacts base = facts;
  const auto same = [&](const char* what, const std::function<void()>& mention) {
    const auto hairs_before = hairs;
    const auto lights_before = lights;
    mention();
    EXPECT_EQ(described(plan()), plain) << what;
    facts = base, hairs = hairs_before, lights = lights_before;
  };
  same("k_sort of a frame without more", [&] { facts.k_sort = 8; });
  same("shape of a directional light", [&] { lights[0].outer_angle = 1, lights[0].position = {1, 2, 3}; });
  same("strands", [&] { hairs[0].strands = 77; });
  same("the image limit", [&] { facts.image_limit = 1024; });
  same("timestamps", [&] { facts.timestamps = 1; });
  same("tail of a default", [&] { facts.tail = FLK_TAIL_DETERMINISTIC; });
  // A method that reads no tail, no k, no sorted core.
  facts.method = FLK_METHOD_EXACT;
  const std::string exact = described(plan());
  facts.tail = FLK_TAIL_LIST, facts.k = 3, facts.k_sort = 20;
  EXPECT_EQ(described(plan()), exact);
  facts = base;
  // Data has no light: neither lights nor what counts their work.
  facts.display = FLK_DISPLAY_STRAND;
  const std::string strands = described(plan());
  facts.ambient_sh = facts.light_tiles = facts.count_work = true;
  facts.method = FLK_METHOD_HARD, facts.payload = FLK_PAYLOAD_PAPER;
  hairs[0].colors = true;
  lights[0].host_shadow = lights[0].host_visibility = true;
  lights[0].kind = LightKind::point;
  EXPECT_EQ(described(plan()), strands);
}

// And each feature that is used changes something, so that the test above compares what matters.
TEST_F(FrameFeature, WhatIsThereIsSeen) {
  const std::string plain = described(plan());
  const FrameFacts base = facts;
  const auto differs = [&](const char* what, const std::function<void()>& use) {
    const auto hairs_before = hairs;
    const auto lights_before = lights;
    use();
    EXPECT_NE(described(plan()), plain) << what;
    facts = base, hairs = hairs_before, lights = lights_before;
  };
  differs("compute", [&] { facts.compute = true; });
  differs("drop", [&] { facts.drop_overflow = true; });
  differs("count_only", [&] { facts.count_only = true; });
  differs("count_work", [&] { facts.count_work = true; });
  differs("ambient", [&] { facts.ambient_sh = true; });
  differs("tiles", [&] { facts.light_tiles = true; });
  differs("modifier", [&] { facts.modifiers = FLK_OPACITY_LENS; });
  differs("output", [&] { facts.outputs = 1; });
  differs("depth", [&] { facts.has_depth = true; });
  differs("tail", [&] { facts.tail = FLK_TAIL_LIST; });
  differs("tail once", [&] { facts.tail = FLK_TAIL_ONCE; });
  differs("taps", [&] { facts.core_taps = 9; });
  differs("low shade", [&] { facts.low_shade = FLK_LOW_SHADE_MEAN_LOBES; });
  differs("host positions", [&] { hairs[0].host_positions = true; });
  differs("colours", [&] { hairs[0].colors = true; });
  differs("host shadow", [&] { lights[0].host_shadow = true; });
  differs("visibility", [&] { lights[0].host_visibility = true; });
  differs("point light", [&] { lights[0].kind = LightKind::point; });
  for (uint32_t method = 1; method <= FLK_METHOD_HARD; ++method) differs(kMethods[method].name, [&] { facts.method = method; });
}

TEST_F(FrameFeature, HardHasNoLists) {
  facts.method = FLK_METHOD_HARD;
  FramePlan p = plan();
  EXPECT_EQ(passes(p), (std::vector<std::string>{"clear", "shadow", "capture depth", "capture nearest", "resolve"}));
  EXPECT_EQ(p.node_capacity, 0u);
  EXPECT_EQ(p.bytes(ResourceId::nodes), 0u);
  EXPECT_EQ(p.bytes(ResourceId::aggregates), 0u);
  const uint64_t pixels = uint64_t(p.rect.width) * p.rect.height;
  EXPECT_EQ(p.bytes(ResourceId::heads), pixels * 8);
  EXPECT_TRUE(omits(p, "lists of fragments"));
  hairs[0].colors = true;
  EXPECT_EQ(plan().bytes(ResourceId::heads), pixels * 12);
}

TEST_F(FrameFeature, CountOnlyIsCaptureAndNothingElse) {
  facts.count_only = true, facts.outputs = 15, facts.count_work = true, facts.ambient_sh = true, facts.light_tiles = true;
  hairs[0].colors = true;
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method) {
    facts.method = method;
    const FramePlan p = plan();
    EXPECT_EQ(passes(p), (std::vector<std::string>{"clear", "count"})) << method;
    for (const ResourceId id : {ResourceId::heads, ResourceId::nodes, ResourceId::aggregates, ResourceId::lights, ResourceId::shadow_map})
      EXPECT_EQ(p.bytes(id), 0u) << method;
    EXPECT_GT(p.bytes(ResourceId::counters), 0u);
    EXPECT_GT(p.bytes(ResourceId::read_back), 0u);
    EXPECT_GT(p.estimate, 0u);
    EXPECT_EQ(p.outputs, 0u);
  }
}

TEST_F(FrameFeature, AggregatesAreLeftOutWithDrop) {
  const FramePlan with = plan();
  EXPECT_EQ(with.bytes(ResourceId::aggregates), uint64_t(with.rect.width) * with.rect.height * 16);
  facts.drop_overflow = true;
  const FramePlan without = plan();
  EXPECT_EQ(without.bytes(ResourceId::aggregates), 0u);
  EXPECT_TRUE(omits(without, "aggregates"));
  EXPECT_EQ(with.transientBytes() - without.transientBytes(), with.bytes(ResourceId::aggregates));
}

TEST_F(FrameFeature, ColoursOnlyWhenAVisibleHairHasThem) {
  hairs.push_back(hairs[0]);
  hairs[1].world_from_hair[14] = 10;  // behind the camera
  hairs[1].colors = true;
  FramePlan p = plan();
  EXPECT_FALSE(p.colors);
  EXPECT_EQ(nodeBytes(facts), kNodeBytes);
  EXPECT_EQ(p.bytes(ResourceId::nodes), 5000 * kNodeBytes);
  EXPECT_TRUE(omits(p, "a fragment's own colour"));

  hairs[0].colors = true;
  p = plan();
  EXPECT_TRUE(p.colors);
  EXPECT_EQ(nodeBytes(facts), kColorNodeBytes);
  EXPECT_EQ(p.bytes(ResourceId::nodes), 5000 * kColorNodeBytes);
  EXPECT_FALSE(omits(p, "a fragment's own colour"));

  // Colours that are shaded at capture need no word of their own; data has none.
  facts.method = FLK_METHOD_FORWARD;
  p = plan();
  EXPECT_FALSE(p.colors);
  EXPECT_TRUE(p.fibre_colors);
  EXPECT_EQ(nodeBytes(facts), kNodeBytes);
  EXPECT_EQ(p.bytes(ResourceId::nodes), 5000 * kNodeBytes);
  facts.method = FLK_METHOD_CORE_TAIL;
  for (uint32_t display = 1; display <= kDisplayLayers; ++display) {
    facts.display = display;
    EXPECT_FALSE(plan().colors) << display;
    EXPECT_EQ(nodeBytes(facts), kNodeBytes) << display;
  }
}

// What the capacity is chosen by and what the plan lists are the same bytes a node, whatever the frame.
TEST_F(FrameFeature, NodeBytesAgreeWithThePlan) {
  for (const bool colors : {false, true})
    for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
      for (uint32_t display = 0; display <= kDisplayLayers; ++display) {
        hairs[0].colors = colors, facts.method = method, facts.display = display;
        const FramePlan p = plan();
        if (p.method->lists()) { EXPECT_EQ(p.bytes(ResourceId::nodes), 5000 * nodeBytes(facts)) << method << ' ' << display; }
      }
}

TEST_F(FrameFeature, OutputsAreAPassEach) {
  const char* names[] = {"output front depth", "output transmittance", "output velocity", "output depth range"};
  const uint64_t lights_plain = plan().bytes(ResourceId::lights);
  for (uint32_t outputs = 0; outputs < 16; ++outputs) {
    facts.outputs = outputs;
    const FramePlan p = plan();
    std::vector<std::string> expected{"clear", "shadow", "capture", "resolve"};
    for (uint32_t i = 0; i < 4; ++i)
      if (outputs >> i & 1) expected.emplace_back(names[i]);
    EXPECT_EQ(passes(p), expected);
    EXPECT_EQ(omits(p, "output passes"), outputs == 0);
    const uint64_t motion = outputs >> FLK_OUTPUT_VELOCITY & 1 ? sizeof(gpu::mat4) : 0;
    EXPECT_EQ(p.bytes(ResourceId::lights), lights_plain + motion);
  }
  facts.outputs = 15;
  lights.clear();
  EXPECT_EQ(plan().bytes(ResourceId::lights), sizeof(gpu::mat4));
}

TEST_F(FrameFeature, LightModes) {
  FramePlan p = plan();
  EXPECT_EQ(p.light_mode, uint32_t(FLK_LIGHTS_SUN));
  EXPECT_TRUE(omits(p, "the loop over lights"));
  lights[0].kind = LightKind::point;
  EXPECT_EQ(plan().light_mode, uint32_t(FLK_LIGHTS_ALL));
  lights[0].kind = LightKind::directional;
  lights[0].host_shadow = true;
  p = plan();
  EXPECT_EQ(p.light_mode, uint32_t(FLK_LIGHTS_ALL));
  EXPECT_EQ(p.host_light, uint32_t(FLK_HOST_MAP));
  lights[0].host_visibility = true;
  EXPECT_EQ(plan().host_light, uint32_t(FLK_HOST_MAP | FLK_HOST_VISIBILITY));
  lights[0].host_shadow = lights[0].host_visibility = false;
  facts.light_tiles = true;
  EXPECT_EQ(plan().light_mode, uint32_t(FLK_LIGHTS_TILES));
  facts.light_tiles = false;
  lights.push_back(lights[0]);
  p = plan();
  EXPECT_EQ(p.light_mode, uint32_t(FLK_LIGHTS_ALL));
  EXPECT_EQ(p.shadow.faces.count, 2u);
  EXPECT_EQ(p.bytes(ResourceId::lights), 2 * (sizeof(gpu::LightConstants) + sizeof(gpu::FaceConstants)));
  EXPECT_EQ(p.bytes(ResourceId::shadow_map), uint64_t(p.shadow.width) * p.shadow.height * 4);
  lights[1].kind = LightKind::spot, lights[1].outer_angle = 1;
  p = plan();
  EXPECT_EQ(p.light_kinds, 1u << uint32_t(LightKind::directional) | 1u << uint32_t(LightKind::spot));
  // Without lights tiles mean nothing.
  lights.clear();
  facts.light_tiles = true;
  p = plan();
  EXPECT_EQ(p.light_mode, uint32_t(FLK_LIGHTS_NONE));
  EXPECT_EQ(p.bytes(ResourceId::lights), 0u);
}

TEST_F(FrameFeature, EveryFaceIsDrawnOfEveryHair) {
  hairs.push_back(hairs[0]);
  hairs[1].world_from_hair[14] = 10;  // out of view, but it casts a shadow
  lights[0].kind = LightKind::point, lights[0].position = {0, 0, 4};  // amid all hair
  FramePlan p = plan();
  ASSERT_EQ(p.shadow.faces.count, 6u);
  EXPECT_EQ(p.face_kinds & FLK_FACES_CUBE, uint32_t(FLK_FACES_CUBE));
  for (const Pass& pass : p.passes)
    if (pass.id == PassId::shadow) { EXPECT_EQ(pass.indices, 6u * 2000u * 6u); }
  facts.compute = true;
  p = plan();
  for (const Pass& pass : p.passes) {
    EXPECT_EQ(pass.indices, 0u) << pass.name;
    if (pass.id == PassId::shadow) { EXPECT_EQ(pass.segments, 2000u * 6u); }
    if (pass.id == PassId::capture) { EXPECT_EQ(pass.segments, 1000u); }
  }
}

TEST_F(FrameFeature, CoverageByWidthOnlyWhereAMapHasIt) {
  EXPECT_FALSE(plan().cover_width);
  EXPECT_TRUE(omits(plan(), "coverage by width"));
  lights.push_back(lights[0]);
  lights[1].cover_width = true;
  FramePlan p = plan();
  EXPECT_TRUE(p.cover_width);
  EXPECT_FALSE(omits(p, "coverage by width"));
  EXPECT_FALSE(p.shadow.faces.items[0].cover_width);
  EXPECT_TRUE(p.shadow.faces.items[1].cover_width);
  lights[1].kind = LightKind::point, lights[1].position = {0, 0, -2};
  p = plan();
  ASSERT_EQ(p.shadow.faces.count, 7u);
  for (std::size_t i = 1; i < 7; ++i) EXPECT_TRUE(p.shadow.faces.items[i].cover_width);
  lights[1].casts_shadow = false;  // without a map nothing is covered
  EXPECT_FALSE(plan().cover_width);
  lights[0].casts_shadow = false;
  EXPECT_FALSE(omits(plan(), "coverage by width")) << "there is no map";
}

TEST_F(FrameFeature, TooManyMapsAreAFault) {
  lights.assign(97, lights[0]);
  EXPECT_NE(plan().fault, nullptr);
  facts.count_only = true;  // which has no lights
  EXPECT_EQ(plan().fault, nullptr);
}

TEST_F(FrameFeature, PrepareOnlyForHostPositions) {
  EXPECT_TRUE(omits(plan(), "the prepare pass"));
  hairs.push_back(hairs[0]);
  hairs[1].host_positions = true;
  EXPECT_EQ(passes(plan())[1], "prepare");
  // Out of view it is needed for its shadow alone.
  hairs[1].world_from_hair[14] = 10;
  EXPECT_TRUE(plan().has(PassId::prepare));
  lights[0].casts_shadow = false;
  EXPECT_FALSE(plan().has(PassId::prepare));
}

TEST_F(FrameFeature, Tails) {
  const auto tail = [&](uint32_t method, uint32_t asked) {
    facts.method = method, facts.tail = asked;
    return plan().tail;
  };
  for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_ALL_LOW}) {
    EXPECT_EQ(tail(method, FLK_TAIL_DEFAULT), uint32_t(FLK_TAIL_KIND_MEAN));
    EXPECT_EQ(tail(method, FLK_TAIL_DETERMINISTIC), uint32_t(FLK_TAIL_KIND_MEAN));
    EXPECT_EQ(tail(method, FLK_TAIL_LIST), uint32_t(FLK_TAIL_KIND_LIST));
    EXPECT_EQ(tail(method, FLK_TAIL_ONCE), uint32_t(FLK_TAIL_KIND_ONCE));
  }
  EXPECT_EQ(tail(FLK_METHOD_CORE_ONLY, FLK_TAIL_LIST), uint32_t(FLK_TAIL_KIND_NONE));
  EXPECT_EQ(tail(FLK_METHOD_FORWARD, FLK_TAIL_DETERMINISTIC), uint32_t(FLK_TAIL_KIND_LIST));
}

// The lists that one frame may have are enough for everything that a frame can ask for.
TEST_F(FrameFeature, EverythingAtOnceFits) {
  hairs.assign(kMaxHairs, hairs[0]);
  for (HairFacts& hair : hairs) hair.host_positions = hair.colors = true;
  lights.assign(96, lights[0]);
  for (LightFacts& light : lights) light.shadow_size = 64, light.host_shadow = light.host_visibility = true;
  facts.outputs = 15, facts.timestamps = 1, facts.has_depth = facts.count_work = facts.ambient_sh = facts.light_tiles = true;
  facts.modifiers = 0x55;
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method) {
    facts.method = method;
    const FramePlan p = plan();
    EXPECT_EQ(p.fault, nullptr);
    EXPECT_EQ(p.passes.count, method == FLK_METHOD_HARD ? 10u : 9u);
    EXPECT_LE(p.resources.count, p.resources.items.size());
    EXPECT_EQ(p.bytes(ResourceId::lights),
              96 * (sizeof(gpu::LightConstants) + sizeof(gpu::FaceConstants)) + kMaxHairs * sizeof(gpu::mat4));
  }
}

}  // namespace
}  // namespace forelock
