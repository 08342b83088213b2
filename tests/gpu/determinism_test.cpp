// FLK_METHOD_EXACT gives the same bits whatever the order in which fragments arrive.
#include "scene.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace forelock::test {
namespace {

TEST(Exact, TenRunsAndFivePermutationsAreBitIdentical) {
  for (const AssetCase& c : kAssetCases) {
    const StrandArrays& strands = caseStrands(c);
    if (strands.strands() == 0) {
      std::printf("ROW determinism %s: NOT TESTED, the file is absent\n", c.name);
      continue;
    }
    std::vector<float> first;
    for (uint32_t seed = 0; seed < 6; ++seed) {  // 0: the asset's order
      Scene scene(strands, samples::conditionMaterial(samples::HairColor::dark), frameStrands(strands, 256, 256),
                  seed ? 0u : uint32_t(FLK_HAIR_KEEP_ORDER), seed);
      scene.setWidthScale(scene.widthScaleFor(0.7));
      scene.setLight(samples::kConditionLight, 3.0, 1024);
      FlkFrame frame{};
      frame.method = FLK_METHOD_EXACT;
      for (int run = 0; run < (seed ? 2 : 10); ++run) {
        const std::vector<float> image = scene.render(frame);
        if (first.empty()) first = image;
        ASSERT_EQ(image, first) << c.name << " seed " << seed << " run " << run;
      }
    }
    std::printf("ROW determinism %s: 10 runs and 5 permutations bit-identical\n", c.name);
  }
}

// Coincident strands: equal keys are equal fragments, so their order cannot show; none may be lost between two batches.
TEST(Exact, ManyEqualFragmentsAreAllBlended) {
  for (const uint32_t layers : {1u, 2u, 24u, 25u, 48u, 49u, 130u}) {
    StrandArrays strands;
    for (uint32_t i = 0; i < layers; ++i) strands.add({{-0.5f, 0.003f, 0.0f}, {0.5f, 0.003f, 0.0f}}, 0.05f);
    FlkMaterial material = samples::conditionMaterial(samples::HairColor::dark);
    material.opacity_root = material.opacity_tip = 0.01f;
    ViewSpec view;
    view.width = view.height = 64;
    view.eye = {0, 0, 2};
    Scene scene(strands, material, view);
    FlkFrame frame{};
    frame.method = FLK_METHOD_EXACT;
    frame.ambient[0] = 1;
    const std::vector<float> image = scene.render(frame);
    // Closed form with the coded alpha: (round(1023 sqrt(0.01)) / 1023)^2 = (102 / 1023)^2; fp16 keeps 11 bits.
    const double expected = 1 - std::pow(1 - std::pow(102.0 / 1023.0, 2), layers);
    EXPECT_NEAR(double(image[(32 * 64 + 32) * 4 + 3]), expected, expected / 1024) << layers;
  }
}

}  // namespace
}  // namespace forelock::test
