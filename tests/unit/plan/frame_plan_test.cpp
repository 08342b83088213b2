// What a frame is given and what it is spared, without a device.
#include "plan/plan.h"

#include "shared/light.h"

#include <gtest/gtest.h>

namespace forelock {
namespace {

FrameFacts someFrame(const HairFacts& hair, const LightFacts& light) {
  FrameFacts facts;
  const float clip[16] = {2, 0, 0, 0, 0, -2, 0, 0, 0, 0, -1.001f, -1, 0, 0, -0.1001f, 0};
  EXPECT_EQ(makeCamera(kIdentity.data(), clip, false, 400, 300, facts.camera), nullptr);
  facts.hairs = {&hair, 1};
  facts.lights = {&light, 1};
  return facts;
}

HairFacts someHair() {
  HairFacts hair;
  hair.segments = 1000;
  hair.bounds = {{-0.2, -0.2, -2.2}, {0.2, 0.2, -1.8}};
  hair.radius = 1e-4;
  hair.length = 100;
  return hair;
}

std::size_t omissions(const FramePlan& plan) { return plan.omissions.count; }

TEST(FramePlan, ListsExactlyThePassesOfAShadowedFrame) {
  const HairFacts hair = someHair();
  const LightFacts light{true, 512};
  const FramePlan plan = planFrame(someFrame(hair, light), 5000);
  ASSERT_EQ(plan.passes.count, 4u);
  EXPECT_TRUE(plan.has(PassId::clear) && plan.has(PassId::shadow) && plan.has(PassId::capture) &&
              plan.has(PassId::resolve));
  EXPECT_EQ(plan.bytes(ResourceId::shadow_map), 512u * 512u * 4u);
  EXPECT_EQ(plan.bytes(ResourceId::nodes), 5000u * 12u);
  EXPECT_EQ(plan.bytes(ResourceId::heads), uint64_t(plan.rect.width) * plan.rect.height * 4u);
  EXPECT_LT(uint64_t(plan.rect.width) * plan.rect.height, 400u * 300u);  // heads follow the hair, not the screen
  EXPECT_EQ(plan.bytes(ResourceId::aggregates), uint64_t(plan.rect.width) * plan.rect.height * 16u);
  EXPECT_EQ(plan.bytes(ResourceId::lights), sizeof(gpu::LightConstants) + sizeof(gpu::FaceConstants));
  EXPECT_EQ(plan.transientBytes(), plan.bytes(ResourceId::shadow_map) + plan.bytes(ResourceId::nodes) +
                                       plan.bytes(ResourceId::heads) + plan.bytes(ResourceId::aggregates) +
                                       plan.bytes(ResourceId::constants) + plan.bytes(ResourceId::lights) +
                                       plan.bytes(ResourceId::counters) + plan.bytes(ResourceId::read_back));
}

TEST(FramePlan, NoShadowingLightMeansNoShadow) {
  const HairFacts hair = someHair();
  for (const LightFacts& light : {LightFacts{false, 512}}) {
    const FramePlan plan = planFrame(someFrame(hair, light), 5000);
    EXPECT_FALSE(plan.has(PassId::shadow));
    EXPECT_EQ(plan.bytes(ResourceId::shadow_map), 0u);
    EXPECT_GE(omissions(plan), 1u);
  }
  FrameFacts dark = someFrame(hair, {});
  dark.lights = {};
  EXPECT_FALSE(planFrame(dark, 5000).has(PassId::shadow));
}

TEST(FramePlan, DisplaysNeedNoLight) {
  const HairFacts hair = someHair();
  const LightFacts light{true, 512};
  for (uint32_t display = 1; display <= kDisplayLayers; ++display) {
    FrameFacts facts = someFrame(hair, light);
    facts.display = display;
    EXPECT_FALSE(planFrame(facts, 5000).has(PassId::shadow)) << display;
  }
}

TEST(FramePlan, NothingInViewMeansNothingAtAll) {
  HairFacts hair = someHair();
  hair.world_from_hair[14] = 10;  // behind the camera
  const LightFacts light{true, 512};
  for (const bool none : {false, true}) {
    FrameFacts facts = someFrame(hair, light);
    if (none) facts.hairs = {};
    const FramePlan plan = planFrame(facts, 5000);
    EXPECT_EQ(plan.passes.count, 0u);
    EXPECT_EQ(plan.resources.count, 0u);
    EXPECT_EQ(plan.transientBytes(), 0u);
    EXPECT_EQ(estimateFragments(facts), 0u);
    EXPECT_EQ(omissions(plan), 1u);
  }
}

TEST(FramePlan, AHairOutOfViewIsNotCapturedButCastsShadow) {
  const HairFacts seen = someHair();
  HairFacts unseen = someHair();
  unseen.world_from_hair[14] = 10;
  const HairFacts hairs[] = {seen, unseen};
  const LightFacts light{true, 512};
  FrameFacts facts = someFrame(seen, light);
  facts.hairs = hairs;
  const FramePlan plan = planFrame(facts, 5000);
  EXPECT_EQ(plan.visible, 1u);
  EXPECT_EQ(plan.segments, 1000u);
  for (const Pass& pass : plan.passes) {
    if (pass.id == PassId::capture) {
      EXPECT_EQ(pass.indices, 6000u);
    }
    if (pass.id == PassId::shadow) {
      EXPECT_EQ(pass.indices, 12000u);
    }
  }
}

// Scale and camera together by any factor: the same picture needs the same lists.
TEST(FramePlan, TheEstimateDoesNotKnowUnits) {
  HairFacts hair = someHair();
  const LightFacts light{};
  const uint64_t metres = estimateFragments(someFrame(hair, light));
  for (double& v : hair.bounds.min) v *= 100;
  for (double& v : hair.bounds.max) v *= 100;
  hair.radius *= 100, hair.length *= 100;
  const uint64_t centimetres = estimateFragments(someFrame(hair, light));
  EXPECT_NEAR(double(centimetres), double(metres), 0.01 * double(metres));
}

}  // namespace
}  // namespace forelock
