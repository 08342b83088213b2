// An eighth of the strands, widened, against all of them: coverage and mean of the picture.
#include "scene.h"

#include "asset_source.h"
#include "reference_follow.h"
#include "strand_lod.h"
#include "strand_multiply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::test {
namespace {

struct Means {
  double coverage = 0, light = 0;
};

Means meansOf(const std::vector<float>& rgba) {
  Means means;
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    means.coverage += double(rgba[i + 3]);
    means.light += double(rgba[i]) + double(rgba[i + 1]) + double(rgba[i + 2]);
  }
  return means;
}

samples::EditableStrands groomStrands(const std::string& groom) {
  const samples::OpenedAsset opened = samples::openAsset("groom:" + groom);
  FlkStrands held{};
  flkAssetGetStrands(opened.asset.get(), &held);
  return samples::editableStrands(held, true);
}

StrandArrays arraysOf(const samples::EditableStrands& strands) {
  StrandArrays arrays;
  arrays.first_vertex = strands.first_vertex, arrays.positions = strands.positions, arrays.radii = strands.radii;
  return arrays;
}

// As strands of their own they are those that the renderer draws without storing them.
TEST(FollowStrands, AreThoseOfTheReference) {
  samples::EditableStrands strands = groomStrands("paper-load");
  reference::Strands guides;
  guides.first_vertex.clear();
  for (const uint32_t first : strands.first_vertex) guides.first_vertex.push_back(first);
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    const std::vector<double> along = samples::lengthsAlong(strands, strand);
    for (const double way : along) guides.fraction.push_back(way / along.back());
  }
  for (std::size_t v = 0; v < strands.vertices(); ++v) {
    guides.positions.push_back({double(strands.positions[3 * v]), double(strands.positions[3 * v + 1]), double(strands.positions[3 * v + 2])});
    guides.radii.push_back(double(strands.radii[v]));
  }
  const reference::Strands expected = reference::followStrands(guides, 3, 0.004, 1.5, 11);
  samples::addFollowStrands(strands, 3, 0.004, 1.5, 11);
  ASSERT_EQ(strands.vertices(), expected.positions.size());
  double worst = 0;
  for (std::size_t v = 0; v < strands.vertices(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const reference::Vec3& p = expected.positions[v];
      worst = std::max(worst, std::fabs(double(strands.positions[3 * v + axis]) - (axis == 0 ? p.x : axis == 1 ? p.y : p.z)));
    }
  // Half a step of a 32-bit float below 1 m, the rest of both in doubles.
  EXPECT_LT(worst, 6e-8);
}

// What an engine does far away, and the same hair under maps of other sizes. Strands that cover whole texels are shadowed by their number
// of texels: that is reported. By width both are held.
TEST(Lod, AnEighthLooksLikeAll) {
  for (const char* groom : {"long-wavy", "short-straight", "curly", "fur-ball"}) {
    samples::EditableStrands all = groomStrands(groom);
    samples::orderStrands(all, samples::evenOrder(all));
    samples::EditableStrands eighth = all;
    samples::keepFirstStrands(eighth, all.strands() / 8, 0.63);
    const StrandArrays full = arraysOf(all), few = arraysOf(eighth);
    const ViewSpec view = frameStrands(full, 256, 256);
    const FlkMaterial material = samples::conditionMaterial(samples::HairColor::dark);
    Scene scene(full, material, view), far(few, material, view);
    FlkFrame frame{};
    frame.method = FLK_METHOD_EXACT;
    scene.setLight(samples::kConditionLight, 1, 0), far.setLight(samples::kConditionLight, 1, 0);
    const Means lit = meansOf(scene.render(frame)), lit_far = meansOf(far.render(frame));
    std::printf("ROW lod %s: coverage %+.2f %%, mean of the picture %+.2f %% without shadows\n", groom, 100 * (lit_far.coverage / lit.coverage - 1),
                100 * (lit_far.light / lit.light - 1));
    EXPECT_NEAR(lit_far.coverage / lit.coverage, 1, 0.05) << groom;
    EXPECT_NEAR(lit_far.light / lit.light, 1, 0.03) << groom;
    for (const uint32_t cover : {FLK_SHADOW_COVER_TEXEL, FLK_SHADOW_COVER_WIDTH}) {
      const char* name = cover == FLK_SHADOW_COVER_WIDTH ? "width" : "texel";
      double of_size[2] = {};
      for (const uint32_t size : {1024u, 4096u}) {  // the default, and one with texels finer than strands
        scene.setLight(samples::kConditionLight, 1, size, cover), far.setLight(samples::kConditionLight, 1, size, cover);
        const double a = meansOf(scene.render(frame)).light, b = meansOf(far.render(frame)).light;
        of_size[size == 4096] = a;
        std::printf("ROW lod %s, map of %u by %s: %.4f of the light without shadows, %+.2f %% with an eighth of the strands\n", groom, size, name,
                    a / lit.light, 100 * (b / a - 1));
        if (cover == FLK_SHADOW_COVER_WIDTH) { EXPECT_NEAR(b / a, 1, 0.03) << groom << ", a map of " << size; }
      }
      std::printf("ROW lod %s by %s: %+.2f %% with the small map\n", groom, name, 100 * (of_size[0] / of_size[1] - 1));
      if (cover == FLK_SHADOW_COVER_WIDTH) { EXPECT_NEAR(of_size[0] / of_size[1], 1, 0.03) << groom; }
    }
    // Other lights, reported: one at the eye sees what the eye sees, the more so the wider the strands; one behind leaves a tenth of the light.
    constexpr struct {
      const char* name;
      double to_light[3];
    } kOthers[] = {{"right", {0.77, 0.24, 0.59}}, {"side", {-0.8, 0.6, 0}}, {"eye", {0, 0, 1}}, {"behind", {0.28, 0.48, -0.83}}};
    for (const auto& other : kOthers) {
      scene.setLight(other.to_light, 1, 1024, FLK_SHADOW_COVER_WIDTH), far.setLight(other.to_light, 1, 1024, FLK_SHADOW_COVER_WIDTH);
      std::printf("ROW lod %s, map of 1024 by width, light at %s: %+.2f %% with an eighth of the strands\n", groom, other.name,
                  100 * (meansOf(far.render(frame)).light / meansOf(scene.render(frame)).light - 1));
    }
  }
}

// Other texels are picked where strands are drawn in another order: the same light, and how far apart single pixels are.
TEST(Lod, AnotherPickIsAsBright) {
  for (const char* groom : {"long-wavy", "curly", "fur-ball"}) {
    const StrandArrays strands = arraysOf(groomStrands(groom));
    const ViewSpec view = frameStrands(strands, 256, 256);
    const FlkMaterial material = samples::conditionMaterial(samples::HairColor::dark);
    Scene one(strands, material, view, 0, 1), other(strands, material, view, 0, 2);
    one.setLight(samples::kConditionLight, 1, 1024, FLK_SHADOW_COVER_WIDTH), other.setLight(samples::kConditionLight, 1, 1024, FLK_SHADOW_COVER_WIDTH);
    FlkFrame frame{};
    frame.method = FLK_METHOD_EXACT;
    for (const uint32_t taps : {25u, 9u, 1u}) {
      frame.core_taps = taps;
      const std::vector<float> a = one.render(frame), b = other.render(frame);
      double square = 0, sum = 0, pixels = 0;
      for (std::size_t i = 0; i < a.size(); i += 4) {
        if (a[i + 3] <= 0) continue;
        pixels += 1;
        for (std::size_t c = 0; c < 3; ++c) {
          sum += double(a[i + c]) / 3;
          square += std::pow(double(a[i + c]) - double(b[i + c]), 2);
        }
      }
      const double codes = 255 * samples::conditionMean(samples::HairColor::dark) * pixels / sum;
      std::printf("ROW pick %s, %u taps: two picks differ by RMSE %.1f codes at a mean of 64, in the mean by %+.2f %%\n", groom, taps,
                  codes * std::sqrt(square / pixels), 100 * (meansOf(b).light / meansOf(a).light - 1));
      // Ten thousand pixels and more, each off by a fifth, a dozen of them together: 0.7 %.
      EXPECT_NEAR(meansOf(b).light / meansOf(a).light, 1, 0.01) << groom;
    }
  }
}

}  // namespace
}  // namespace forelock::test
