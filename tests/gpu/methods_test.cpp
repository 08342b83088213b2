// FLK_METHOD_FORWARD and FLK_METHOD_CORE_TAIL against their float64 twins at 256x256. Lists are in submission order on lavapipe's
// rasteriser, which is what the twins assume of the tail.
#include "scene.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace forelock::test {
namespace {

using samples::HairColor;

class MethodAt : public testing::TestWithParam<std::tuple<int, double, int>> {};

// 1.5: the bound; what is left is the coding of colours or tangents, and fragments whose order fp32 changes.
TEST_P(MethodAt, MatchesItsTwin) {
  const AssetCase& c = kAssetCases[std::get<0>(GetParam())];
  const double width = std::get<1>(GetParam());
  const HairColor color = std::get<2>(GetParam()) ? HairColor::light : HairColor::dark;
  const StrandArrays& strands = caseStrands(c);
  if (strands.strands() == 0) GTEST_SKIP() << "no " << c.source << ": it was not tested";
  Scene scene(strands, samples::conditionMaterial(color), frameStrands(strands, 256, 256));
  scene.setWidthScale(scene.widthScaleFor(width));
  scene.setLight(samples::kConditionLight, 1.0, 1024);
  scene.expose(samples::conditionMean(color), scene.gather());

  const struct {
    uint32_t method;
    reference::Method twin;
    const char* name;
  } methods[] = {{FLK_METHOD_FORWARD, reference::Method::forward, "forward"},
                 {FLK_METHOD_CORE_TAIL, reference::Method::core_tail, "core_tail"}};
  for (const auto& method : methods) {
    FlkFrame frame{};
    frame.method = method.method;
    frame.tail = FLK_TAIL_LIST;
    const reference::Image actual = scene.toImage(scene.render(frame));
    reference::ResolveOptions options;
    options.method = method.twin;
    const reference::Image expected = scene.referenceImage(options, {scene.readShadowMap()});
    const reference::Difference d = reference::compare(actual, expected);
    std::printf("ROW %s %s %s %.2f px: rmse %.3f p99.9 %.3f mean %.1f / %.1f\n", method.name, c.name,
                color == HairColor::dark ? "dark" : "light", width, d.rmse, d.p999, d.mean_a, d.mean_b);
    EXPECT_LE(d.rmse, color == HairColor::light ? 3.0 : 1.5) << method.name;
    if (HasFailure()) writeFailure(std::string(method.name) + "-" + c.name, actual, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Views, MethodAt,
                         testing::Combine(testing::Range(0, 3), testing::Values(0.02, 0.1, 0.3, 1.0, 5.0),
                                          testing::Values(0, 1)));

// The paper's payload drops and rounds alpha on purpose: it must still match at widths it was made for.
TEST(PaperPayload, MatchesTheReferenceAtOnePixel) {
  const StrandArrays& strands = caseStrands(kAssetCases[0]);
  Scene scene(strands, samples::conditionMaterial(HairColor::dark), frameStrands(strands, 256, 256));
  scene.setWidthScale(scene.widthScaleFor(1.0));
  scene.setLight(samples::kConditionLight, 1.0, 1024);
  scene.expose(samples::conditionMean(HairColor::dark), scene.gather());
  for (const uint32_t method : {FLK_METHOD_EXACT, FLK_METHOD_FORWARD}) {
    FlkFrame frame{};
    frame.method = method;
    frame.payload = FLK_PAYLOAD_PAPER;
    frame.exposure = 0.25f;  // the brightest fragments are about 4
    const reference::Image actual = scene.toImage(scene.render(frame));
    reference::ResolveOptions options;
    options.method = method == FLK_METHOD_EXACT ? reference::Method::exact : reference::Method::forward;
    const reference::Difference d = reference::compare(actual, scene.referenceImage(options, {scene.readShadowMap()}));
    std::printf("ROW paper payload, method %u: rmse %.3f p99.9 %.3f\n", method, d.rmse, d.p999);
    EXPECT_LE(d.rmse, 1.5);
  }
}

// k and k_sort: more of either comes nearer to the exact picture.
TEST(CoreTail, ErrorFallsWithK) {
  const StrandArrays& strands = caseStrands(kAssetCases[0]);
  Scene scene(strands, samples::conditionMaterial(HairColor::dark), frameStrands(strands, 256, 256));
  scene.setWidthScale(scene.widthScaleFor(2.0));
  scene.setLight(samples::kConditionLight, 1.0, 1024);
  scene.expose(samples::conditionMean(HairColor::dark), scene.gather());
  FlkFrame frame{};
  frame.method = FLK_METHOD_EXACT;
  const reference::Image exact = scene.toImage(scene.render(frame));
  double last = 1e9;
  for (const uint32_t k : {FLK_K_NONE, 1u, 2u, 4u, 8u, 16u, 32u}) {
    frame.method = FLK_METHOD_CORE_TAIL;
    frame.k = k;
    const double rmse = reference::compare(scene.toImage(scene.render(frame)), exact).rmse;
    std::printf("ROW core_tail k %d: rmse against exact %.2f\n", k == FLK_K_NONE ? 0 : int(k), rmse);
    EXPECT_LE(rmse, last);
    last = rmse;
  }
}

}  // namespace
}  // namespace forelock::test
