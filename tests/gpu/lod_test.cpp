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

// What an engine does far away. A shadow map whose texels are wider than a strand widens the thin ones, and so has more of the full hair than of
// its eighth: the map here resolves both. The rest of the difference is of wide strands that shade themselves; it is reported for 1024 too.
TEST(Lod, AnEighthLooksLikeAll) {
  for (const char* groom : {"curly", "short-straight"}) {
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
    double light_error[3];
    for (int s = 0; s < 3; ++s) {
      const uint32_t size = s == 0 ? 0 : s == 1 ? 4096 : 1024;
      scene.setLight(samples::kConditionLight, 1, size), far.setLight(samples::kConditionLight, 1, size);
      const Means a = meansOf(scene.render(frame)), b = meansOf(far.render(frame));
      light_error[s] = b.light / a.light - 1;
      if (s == 0) {
        std::printf("ROW lod %s: coverage %+.2f %% with an eighth of the strands\n", groom, 100 * (b.coverage / a.coverage - 1));
        EXPECT_NEAR(b.coverage / a.coverage, 1, 0.05) << groom;
      }
    }
    std::printf("ROW lod %s: mean of the picture %+.2f %% without shadows, %+.2f %% with a map of 4096, %+.2f %% of 1024\n", groom, 100 * light_error[0],
                100 * light_error[1], 100 * light_error[2]);
    EXPECT_NEAR(light_error[0], 0, 0.03) << groom;
  }
}

}  // namespace
}  // namespace forelock::test
