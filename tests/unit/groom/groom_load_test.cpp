// The measuring load: fragments and hair pixels of the four stored views of paper-load. SPDX-License-Identifier: MIT
#include "fragment_walk.h"
#include "groom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace forelock::samples {
namespace {

struct Load {
  double fragments;
  double hair_pixels;
};

TEST(GroomLoad, PaperLoadHasThePapersFragmentsAndPixels) {
  const Recipe recipe = loadRecipe(FORELOCK_SOURCE_DIR "/hairassets/paper-load.json");
  // Hillesland et al. 2014, at 1920x1200.
  const std::map<std::string, Load> wanted = {
      {"35k", {1.05e6, 35e3}}, {"78k", {1.95e6, 78e3}}, {"198k", {3.96e6, 198e3}}, {"365k", {6.57e6, 365e3}}};
  ASSERT_EQ(recipe.cameras.size(), wanted.size());
  const Groom groom = makeGroom(recipe);
  const FlkStrands strands = describeGroom(groom);
  for (const RecipeCamera& stored : recipe.cameras) {
    ASSERT_TRUE(wanted.count(stored.name)) << stored.name;
    ASSERT_EQ(stored.width, 1920u);
    ASSERT_EQ(stored.height, 1200u);
    const Load& load = wanted.at(stored.name);
    const FragmentCounts counts =
        countFragments(strands, fromRecipeCamera(stored), stored.width, stored.height, 1.0);
    std::printf("%5s: F = %llu (%+.1f %%), P = %llu (%+.1f %%), D = %.1f, max %u\n", stored.name.c_str(),
                static_cast<unsigned long long>(counts.fragments),
                100.0 * (static_cast<double>(counts.fragments) / load.fragments - 1.0),
                static_cast<unsigned long long>(counts.hair_pixels),
                100.0 * (static_cast<double>(counts.hair_pixels) / load.hair_pixels - 1.0),
                static_cast<double>(counts.fragments) / static_cast<double>(counts.hair_pixels), counts.max_overdraw);
    EXPECT_NEAR(static_cast<double>(counts.fragments), load.fragments, 0.1 * load.fragments) << stored.name;
    EXPECT_NEAR(static_cast<double>(counts.hair_pixels), load.hair_pixels, 0.1 * load.hair_pixels) << stored.name;
  }
}

// The coverage of a long straight strand sums to its width a unit of length, whatever the width and the angle.
TEST(GroomLoad, CoverageSumsToWidthTimesLength) {
  for (double width_px : {0.05, 0.7, 3.0, 12.0}) {
    for (int step = 0; step < 9; ++step) {
      const double angle = 0.05 + 0.35 * step;
      const double length_px = 150.0;
      const float dx = static_cast<float>(length_px * std::cos(angle));
      const float dy = static_cast<float>(length_px * std::sin(angle));
      const float positions[6] = {-0.5f * dx, -0.5f * dy, 0.0f, 0.5f * dx, 0.5f * dy, 0.0f};
      const float radii[2] = {static_cast<float>(0.5 * width_px), static_cast<float>(0.5 * width_px)};
      const uint32_t first[2] = {0, 2};
      FlkStrands strands = {};
      strands.strand_count = 1;
      strands.vertex_count = 2;
      strands.first_vertex = first;
      strands.positions = positions;
      strands.radii = radii;
      Camera camera;
      camera.eye = glm::dvec3(0, 0, 5);
      camera.orthographic = true;
      camera.view_height = 200.0;  // a pixel a unit
      double sum = 0.0;
      walkFragments(strands, camera, 200, 200, 0.0, [&](const WalkedFragment& f) { sum += f.coverage; });
      // What the two ends cut from pixels: at most about one pixel's worth of width each.
      EXPECT_NEAR(sum, width_px * length_px, 0.01 * width_px * length_px) << width_px << " px at " << angle;
    }
  }
}

}  // namespace
}  // namespace forelock::samples
