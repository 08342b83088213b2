// FLK_METHOD_EXACT against R_exact: shading with the device's own shadow map fed to the reference, and end to end.
#include "scene.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace forelock::test {
namespace {

using samples::HairColor;

class ExactAt : public testing::TestWithParam<std::tuple<int, double, int>> {};

// Bounds of the issue: what is left is fp32 against float64, the 11-bit tangent and the 10-bit alpha.
TEST_P(ExactAt, MatchesReference) {
  const AssetCase& c = kAssetCases[std::get<0>(GetParam())];
  const double width = std::get<1>(GetParam());
  const HairColor color = std::get<2>(GetParam()) ? HairColor::light : HairColor::dark;
  const double factor = color == HairColor::light ? 2 : 1;
  const StrandArrays& strands = caseStrands(c);
  if (strands.strands() == 0) GTEST_SKIP() << "no " << c.source << ": it was not tested";
  Scene scene(strands, samples::conditionMaterial(color), frameStrands(strands, 256, 256));
  scene.setWidthScale(scene.widthScaleFor(width));
  scene.setLight(samples::kConditionLight, 1.0, 1024);
  scene.expose(samples::conditionMean(color), scene.gather());

  FlkFrame frame{};
  frame.method = FLK_METHOD_EXACT;
  const reference::Image actual = scene.toImage(scene.render(frame));
  const reference::ShadowMap fed = scene.readShadowMap();
  const reference::ShadowMap own = reference::renderShadowMap(scene.reference_scene, scene.reference_scene.lights[0]);
  const reference::Image with_fed = scene.referenceImage({}, {fed});
  const reference::Image with_own = scene.referenceImage({}, {own});
  const reference::Difference shading = reference::compare(actual, with_fed),
                              whole = reference::compare(actual, with_own);
  const double off_percent = mapDifference(own, fed, 0.1 * double(scene.material.fibre_spacing));
  std::printf(
      "ROW exact %s %s %.2f px: fed rmse %.3f p99.9 %.3f | own rmse %.3f p99.9 %.3f | map off %.3f %% | mean %.1f / "
      "%.1f | fragments %llu\n",
      c.name, color == HairColor::dark ? "dark" : "light", width, shading.rmse, shading.p999, whole.rmse, whole.p999,
      off_percent, shading.mean_a, shading.mean_b, static_cast<unsigned long long>(scene.statistics.fragments));
  EXPECT_LE(shading.rmse, 0.5 * factor);
  EXPECT_LE(shading.p999, 3.0 * factor);
  EXPECT_LE(whole.rmse, 1.0 * factor);
  EXPECT_LE(off_percent, 0.5);
  if (HasFailure()) writeFailure(std::string("exact-") + c.name, actual, with_fed);
}

INSTANTIATE_TEST_SUITE_P(Views, ExactAt,
                         testing::Combine(testing::Range(0, 3), testing::Values(0.02, 0.1, 0.3, 1.0, 5.0),
                                          testing::Values(0, 1)));

}  // namespace
}  // namespace forelock::test
