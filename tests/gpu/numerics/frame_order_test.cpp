// Rows G18 to G20: the same bits whatever the order of arrival.
#include "frame_kit.h"

#include <gtest/gtest.h>

#include <string>

namespace forelock::test {
namespace {

const MethodWay kHard = {"hard", FLK_METHOD_HARD, FLK_TAIL_DEFAULT, reference::Method::hard,
                         reference::TailOrder::list};

// `count` strands through one another at one depth, in pairs that coincide: keys differ by tangent and opacity, or not at all.
StrandArrays coincident(const ViewSpec& view, uint32_t count) {
  StrandArrays strands;
  for (uint32_t i = 0; i < count; ++i) {
    const double angle = 0.1 + double(i / 2) * 2.39996, dx = 30 * std::cos(angle), dy = 30 * std::sin(angle);
    strands.add({flatPoint(view, 12 - dx, 12 - dy), flatPoint(view, 12 + dx, 12 + dy)}, 0.4f);
  }
  return strands;
}

TEST(DepthTies, BitStable) {
  const ViewSpec view = flatView(24, 24);
  std::size_t runs = 0, different = 0, between = 0;
  for (const uint32_t count : {2u, 3u, 9u, 16u, 64u})
    for (int m = 0; m <= int(kDeterministic); ++m) {
      const MethodWay& way = m < int(kDeterministic) ? kMethodWays[m] : kHard;
      std::vector<float> first[2];
      for (uint32_t seed = 0; seed < 5; ++seed) {
        Scene scene(coincident(view, count), plainMaterial(0.7f, 0.1f), view, seed ? 0u : uint32_t(FLK_HAIR_KEEP_ORDER),
                    seed);
        scene.setLight(samples::kConditionLight, 1, 64);
        for (int run = 0; run < 4; ++run) {
          std::vector<float>& reference_bits = first[run % 2];
          const std::vector<float> image = scene.render(frameOf(way, kCaptures[run % 2].capture));
          if (reference_bits.empty()) reference_bits = image;
          different += image != reference_bits;
          ++runs;
        }
      }
      between += first[0] != first[1];
    }
  EXPECT_EQ(different, 0u);
  record("G18",
         "2 to 64 strands at one depth, 5 orders, exact, core_tail, core_only, all_low, hard, raster and compute: "
         "pictures not the same to the bit, of " +
             std::to_string(runs),
         "0", std::to_string(different));
  record("G18", "the same: cases, of 25, in which raster and compute differ by a bit", "reported",
         std::to_string(between));
  std::size_t again = 0;
  Scene scene(coincident(view, 64), plainMaterial(0.7f, 0.1f), view);
  scene.setLight(samples::kConditionLight, 1, 64);
  const std::vector<float> once = scene.render();
  for (int run = 0; run < 100; ++run) again += scene.render() != once;
  EXPECT_EQ(again, 0u);
  record("G18", "64 strands at one depth, core_tail, 100 runs: pictures not the same to the bit", "0",
         std::to_string(again));
}

TEST(Determinism, RunsAndOrders) {
  const StrandArrays strands = loadStrands("groom:paper-load", 6);
  const ViewSpec view = frameStrands(strands, 128, 128);
  Worst between, list_spread;
  std::size_t different = 0, runs = 0, pixels = 0;
  for (int m = 0; m <= int(std::size(kMethodWays)); ++m) {
    const MethodWay& way = m < int(std::size(kMethodWays)) ? kMethodWays[m] : kHard;
    const bool deterministic = m < int(kDeterministic) || way.method == FLK_METHOD_HARD;
    std::vector<float> first[2];
    for (uint32_t seed = 0; seed < 3; ++seed) {
      Scene scene(strands, samples::conditionMaterial(samples::HairColor::dark), view,
                  seed ? 0u : uint32_t(FLK_HAIR_KEEP_ORDER), seed);
      scene.setWidthScale(scene.widthScaleFor(0.7));
      scene.setLight(samples::kConditionLight, 3, 512);
      for (int run = 0; run < 4; ++run) {
        std::vector<float>& bits = first[run % 2];
        const std::vector<float> image = scene.render(frameOf(way, kCaptures[run % 2].capture));
        if (bits.empty()) bits = image;
        if (!deterministic) {
          list_spread.see(reference::compare(scene.toImage(image), scene.toImage(bits)).rmse);
          continue;
        }
        different += image != bits;
        ++runs;
      }
    }
    if (!deterministic) continue;
    between.see(255 * largestDifference(first[0], first[1]));
    for (std::size_t i = 0; i < first[0].size(); i += 4)
      pixels += !std::equal(&first[0][i], &first[0][i] + 4, &first[1][i]);
  }
  EXPECT_EQ(different, 0u);
  record("G19",
         "a groom, 2 runs of each of 3 orders, exact, core_tail, core_only, all_low, hard, raster and compute: "
         "pictures not the same to the bit, of " +
             std::to_string(runs),
         "0", std::to_string(different));
  record("G19", "the same: raster against compute (two programs): pixels that differ, of all methods; most", "reported",
         std::to_string(pixels) + "; " + format(between.value()) + " codes");
  record("G19", "core_tail and forward with the tail in list order, orders against one another: rmse", "reported",
         format(list_spread.value()));
}

TEST(OrderIndependentTail, FramesOf500Layers) {
  const ViewSpec view = flatView(128, 8);
  Worst error;
  std::size_t spread = 0;
  const double most = -std::expm1(std::log(1e-6) / 500);
  const FlkMaterial material = plainMaterial(0, float(most));
  for (const CaptureWay& capture : kCaptures) {
    std::vector<float> colors, through;
    for (uint32_t seed = 0; seed < 6; ++seed) {
      Scene scene(layers(view, 500, true, 1 + seed / 2), material, view, seed ? 0u : uint32_t(FLK_HAIR_KEEP_ORDER),
                  seed);
      scene.setLight(samples::kConditionLight, 1, 0);
      host().setOutputs(1u << FLK_OUTPUT_TRANSMITTANCE);
      const std::vector<float> image = scene.render(frameOf(kMethodWays[1], capture.capture));
      const std::vector<float> output = host().readOutput(FLK_OUTPUT_TRANSMITTANCE);
      host().setOutputs(0);
      if (colors.empty()) colors = image, through = output;
      spread += image != colors || output != through;
    }
    for (int x = 0; x < view.width; ++x) {
      const double a = double(float(most)) * (x + 2.5) / (view.width + 4);
      if (nearTie(a, 1023) || rootCoded(a, 1023) == 0) continue;
      error.see(
          100 *
          std::fabs(double(through[std::size_t(3 * view.width + x)]) / std::pow(1 - rootCoded(a, 1023), 500) - 1));
    }
  }
  EXPECT_EQ(spread, 0u);
  EXPECT_LE(error.value(), 0.3);
  record(
      "G20",
      "frames of 500 layers, 6 orders, raster and compute, picture and transmittance output: not the same to the bit",
      "0", std::to_string(spread));
  record("G20", "the same, T from 1 to 1e-6: |dT| / T of the output against float64", "<= 0.3 %",
         format(error.value()) + " %");
}

}  // namespace
}  // namespace forelock::test
