// An eighth of the strands, widened, against all of them: coverage and mean of the picture.
#include "scene.h"

#include "asset_source.h"
#include "strand_lod.h"

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
