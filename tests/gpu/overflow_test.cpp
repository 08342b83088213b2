// Lists that are too short: opacity stays, the picture degrades evenly, the count is exact; and lists that are long enough at once,
// because fragments were counted first.
#include "world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::test {
namespace {

// A view whose lists hold `nodes` fragments, and hair in an order that spreads what overflows.
std::unique_ptr<World> worldWith(uint64_t nodes, const StrandArrays& strands, const ViewSpec& view, float width_scale) {
  auto world = std::make_unique<World>(view, std::max<uint64_t>(nodes, 1) * 12);
  HairSpec spec;
  spec.strands = strands;
  spec.material.width_scale = width_scale;
  spec.flags = 0, spec.seed = 5;
  world->add(spec);
  FlkLight light{};
  light.direction[0] = -0.1f, light.direction[1] = 0.7f, light.direction[2] = 0.7f;
  for (float& r : light.radiance) r = 3;
  light.casts_shadow = 1, light.shadow_size = 1024;
  world->addLight(light);
  return world;
}

// 2 / 255 of opacity, 0.5 of RMSE, 4 times the mean: the bounds of the issue.
TEST(Overflow, DegradesEvenlyAndLosesNoPixel) {
  const StrandArrays& strands = caseStrands(kAssetCases[0]);
  const ViewSpec view = frameStrands(strands, 256, 256);
  const float scale = widthScale(strands, view, 1.0);
  for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_EXACT, FLK_METHOD_FORWARD}) {
    for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE}) {
      if (method == FLK_METHOD_FORWARD && capture == FLK_CAPTURE_COMPUTE) continue;  // its list order alone is another picture every time
      reference::Image full;
      uint64_t need = 0;
      float radiance = 3;
      {
        const auto world = worldWith(uint64_t(1) << 26, strands, view, scale);
        FlkFrame frame = world->frame();
        frame.method = method, frame.capture = capture;
        full = world->image(world->render(frame));
        need = world->statistics.fragments;
        double sum = 0, pixels = 0;
        for (const reference::Pixel& p : full.pixels)
          if (p.fragments) sum += (p.rgb[0] + p.rgb[1] + p.rgb[2]) / 3, pixels += 1;
        radiance *= float(samples::conditionMean(samples::HairColor::dark) * pixels / sum);
      }
      double last = 0;
      for (const int percent : {100, 90, 80, 70, 60, 50, 40, 30, 20, 10, 5, 0}) {
        const uint64_t nodes = std::max<uint64_t>(need * uint64_t(percent) / 100, 1);
        double opacity = 0, sum = 0;
        std::size_t lost = 0;
        std::vector<double> blocks(16 * 16), hair_pixels(16 * 16);
        // What comes last differs from frame to frame: the error is that of three.
        constexpr int draws = 3;
        for (int draw = 0; draw < draws; ++draw) {
          const auto world = worldWith(nodes, strands, view, scale);
          for (float& r : world->lights[0].radiance) r = radiance;
          FlkFrame frame = world->frame();
          frame.method = method, frame.capture = capture;
          const reference::Image image = world->image(world->render(frame, true));
          if (percent == 100 && draw == 0) full = image;
          EXPECT_EQ(world->statistics.fragments, need);
          EXPECT_EQ(world->statistics.overflow_fragments, need - std::min(need, nodes));
          for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const reference::Pixel &a = image.pixels[i], &b = full.pixels[i];
            opacity = std::max(opacity, std::abs(a.transmittance - b.transmittance));
            lost += b.fragments && !a.fragments;
            double square = 0;
            for (int c = 0; c < 3; ++c)
              square += std::pow(255 * (std::clamp(a.rgb[c], 0.0, 1.0) - std::clamp(b.rgb[c], 0.0, 1.0)), 2);
            const std::size_t block = i / 256 / 16 * 16 + i % 256 / 16;
            blocks[block] += square, sum += square, hair_pixels[block] += b.fragments > 0;
          }
        }
        double pixels = 0, worst = 0, worst_at_rim = 0;
        for (const double n : hair_pixels) pixels += n;
        const double rmse = std::sqrt(sum / pixels);
        // A block of which hair covers less than a quarter is a strand at the rim and no patch: reported apart.
        for (std::size_t i = 0; i < blocks.size(); ++i) {
          double& most = hair_pixels[i] >= 64 * draws ? worst : worst_at_rim;
          if (hair_pixels[i] > 0) most = std::max(most, std::sqrt(blocks[i] / hair_pixels[i]));
        }
        const double mean = std::max(rmse, 1e-9);
        std::printf("ROW overflow, method %u, %s, %3d %% of %llu: rmse %.2f, opacity off by %.2f / 255, worst block %.2f of the mean (at the rim "
                    "%.2f), %zu pixels lost\n", method, capture == FLK_CAPTURE_COMPUTE ? "compute" : "raster", percent,
                    static_cast<unsigned long long>(need), rmse, 255 * opacity, worst / mean, worst_at_rim / mean, lost);
        EXPECT_LE(255 * opacity, 2.0) << percent;
        EXPECT_EQ(lost, 0u);
        EXPECT_GE(rmse, last - 0.5) << "an error that falls with memory";
        if (rmse > 0.5 && nodes < need) {
          EXPECT_LE(worst, 4 * rmse);
        }
        last = std::max(last, rmse);
      }
    }
  }
}

// Dropped fragments leave holes and no memory for an aggregate: what a view with lists that suffice does without.
TEST(Overflow, MayBeDropped) {
  const StrandArrays& strands = caseStrands(kAssetCases[0]);
  const ViewSpec view = frameStrands(strands, 128, 128);
  const auto world = worldWith(1000, strands, view, widthScale(strands, view, 1.0));
  FlkFrame frame = world->frame();
  frame.overflow = FLK_OVERFLOW_DROP;
  world->render(frame, true);
  EXPECT_GT(world->statistics.overflow_fragments, 0u);
  FlkPlanInfo info{};
  flkPlanGetInfo(world->plan, &info);
  for (uint32_t i = 0; i < info.resource_count; ++i) {
    FlkResourceInfo resource{};
    flkPlanGetResource(world->plan, i, &resource);
    EXPECT_STRNE(resource.name, "aggregates");
  }
}

// From far to near in one frame. Without counting the lists may overflow, which shows in no pixel's opacity; counted first they
// never do.
TEST(CameraCut, NoPixelIsLostAndCountingFirstOverflowsNothing) {
  const StrandArrays& strands = caseStrands(kAssetCases[0], false);
  const ViewSpec far_view = storedView("35k"), near_view = storedView("365k");
  for (const bool counted : {false, true}) {
    const auto world = worldWith(uint64_t(1) << 26, strands, far_view, 1);
    FlkFrame frame = world->frame();
    world->render(frame);
    const uint64_t far_fragments = world->statistics.fragments;
    world->camera = reference::makeCamera(near_view.eye, near_view.target, near_view.up, near_view.projection, near_view.width,
                                          near_view.height);
    frame = world->frame();
    if (counted) {
      frame.count_only = 1;
      world->render(frame, true);
      FlkPlanInfo info{};
      flkPlanGetInfo(world->plan, &info);
      EXPECT_EQ(info.node_capacity, 0u);
      frame.count_only = 0;
    }
    const uint64_t before = world->statistics.fragments;
    const reference::Image cut = world->image(world->render(frame, true));
    const uint64_t overflow = world->statistics.overflow_fragments, need = world->statistics.fragments;
    const reference::Image whole = world->image(world->render(frame));
    std::size_t lost = 0;
    double opacity = 0;
    for (std::size_t i = 0; i < cut.pixels.size(); ++i) {
      lost += whole.pixels[i].fragments && !cut.pixels[i].fragments;
      opacity = std::max(opacity, std::abs(whole.pixels[i].transmittance - cut.pixels[i].transmittance));
    }
    std::printf("ROW cut from 35k (%llu fragments) to 365k (%llu), %s: %llu overflowed, %zu pixels lost, opacity off by %.2f / 255\n",
                static_cast<unsigned long long>(far_fragments), static_cast<unsigned long long>(need),
                counted ? "counted first" : "not counted", static_cast<unsigned long long>(overflow), lost, 255 * opacity);
    EXPECT_EQ(lost, 0u);
    EXPECT_LE(255 * opacity, 2.0);
    if (counted) {
      EXPECT_EQ(before, need);
      EXPECT_EQ(overflow, 0u);
    }
  }
}

}  // namespace
}  // namespace forelock::test
