// Hair shadow maps covered by width: section 4. What is kept is the share that it should be, whatever strands are cut into.
#include "reference_support.h"
#include "reference_vector.h"

namespace forelock::reference {
namespace {

constexpr int kSize = 256;

// A map that looks along -z and whose texels are `texel` metre wide.
ShadowMap flatMap(bool cover_width, double texel = 1) {
  ShadowMap map = shadowFrame({{0, 0, 0}, kSize / 2.0 * texel}, {0, 0, 1}, kSize);
  map.cover_width = cover_width;
  return map;
}

// A strand across the map in a heading, cut into `pieces`, at a depth of its own.
void addAcross(Hair& hair, double heading, int pieces, double radius, double z = 0, double reach = 100) {
  std::vector<Vec3> points;
  for (int i = 0; i <= pieces; ++i) {
    const double along = reach * (2.0 * i / pieces - 1);
    points.push_back({along * std::cos(heading), along * std::sin(heading), z});
  }
  addStrand(hair.strands, points, radius);
}

size_t covered(const ShadowMap& map) {
  size_t count = 0;
  for (const float depth : map.depth) count += std::isfinite(depth);
  return count;
}

size_t drawn(const Scene& scene, bool cover_width, double texel = 1) {
  ShadowMap map = flatMap(cover_width, texel);
  drawShadowMap(map, scene);
  return covered(map);
}

Scene oneStrand(double heading, int pieces, double radius, double opacity = 1) {
  Scene scene;
  scene.hairs.resize(1);
  scene.hairs[0].material.opacity_root = scene.hairs[0].material.opacity_tip = opacity;
  addAcross(scene.hairs[0], heading, pieces, radius);
  return scene;
}

// 300 strands one by one, so that none hides another, within four standard deviations of independent choice: sqrt(n p (1 - p)). Cut into
// one or 400 segments they keep as much: a texel is in the quad of one of them.
TEST(ReferenceCover, StrandsKeepTheirWidthTimesTheirOpacity) {
  for (const int pieces : {1, 20, 400}) {
    for (const double width : {0.02, 0.2, 0.7, 1.0, 3.0}) {
      for (const double opacity : {0.25, 1.0}) {
        double all = 0, kept = 0;
        for (int i = 0; i < 300; ++i) {
          const Scene scene = oneStrand(0.37 + 0.011 * i, pieces, width / 2, opacity);
          all += double(drawn(scene, false));
          kept += double(drawn(scene, true));
        }
        const double share = std::min(width, 1.0) * opacity;
        std::printf("width %.2f, opacity %.2f, %3d segments: %.5f of the texels are kept, %.5f expected\n", width, opacity, pieces, kept / all, share);
        EXPECT_NEAR(kept, share * all, 4 * std::sqrt(all * share * (1 - share)) + 1e-9);
      }
    }
  }
}

// Hair that is opaque and nowhere thinner than a texel is drawn as ever.
TEST(ReferenceCover, WideOpaqueStrandsAreThoseOfTheTexel) {
  Scene scene;
  scene.hairs.resize(1);
  for (int i = 0; i < 40; ++i) addAcross(scene.hairs[0], 0.08 * i, 7, 0.5 + 0.1 * i, i);
  ShadowMap texel = flatMap(false), width = flatMap(true);
  drawShadowMap(texel, scene);
  drawShadowMap(width, scene);
  EXPECT_EQ(texel.depth, width.depth);
}

// Opacity runs along the strand, and a strand that has none casts no shadow.
TEST(ReferenceCover, OpacityRunsFromRootToTip) {
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.opacity_root = 1, m.opacity_tip = 0;
  double kept[2] = {}, all[2] = {};  // near the root, near the tip
  for (int i = 0; i < 300; ++i) {
    scene.hairs[0].strands = {};
    addAcross(scene.hairs[0], 0.001 * i, 10, 0.25);
    for (const bool cover : {false, true}) {
      ShadowMap map = flatMap(cover);
      drawShadowMap(map, scene);
      for (int t = 0; t < kSize * kSize; ++t)
        if (std::isfinite(map.depth[size_t(t)])) (cover ? kept : all)[t % kSize < kSize / 2 ? 0 : 1] += 1;
    }
  }
  // Means of 1 - s over either half of the strand, times the width of half a texel. x of the map runs along x of the world.
  EXPECT_NEAR(kept[0] / all[0], 0.75 * 0.5, 0.01);
  EXPECT_NEAR(kept[1] / all[1], 0.25 * 0.5, 0.01);
  m.opacity_root = 0;
  EXPECT_EQ(drawn(scene, true), 0u);
}

// A slab of strands at random: what lies behind all of them is covered by 1 - exp(-width x length per area), whatever the texels and
// whether one strand stands for eight. By the texel it is not.
TEST(ReferenceCover, CoverageKnowsNeitherTexelsNorStrands) {
  const auto coverage = [](int strands, double radius, double texel, bool by_width) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-60, 60), turn(0, std::numbers::pi);
    Scene scene;
    scene.hairs.resize(1);
    for (int i = 0; i < strands; ++i) {
      const double x = place(random), y = place(random), a = turn(random);
      const Vec3 ends[2] = {{x - 10 * std::cos(a), y - 10 * std::sin(a), 0}, {x + 10 * std::cos(a), y + 10 * std::sin(a), 0}};
      addStrand(scene.hairs[0].strands, ends, radius);
    }
    ShadowMap map = shadowFrame({{0, 0, 0}, 64}, {0, 0, 1}, int(128 / texel));
    map.cover_width = by_width;
    drawShadowMap(map, scene);
    const int margin = int(24 / texel);  // where strands begin all around
    double sum = 0, count = 0;
    for (int row = margin; row < map.size - margin; ++row)
      for (int column = margin; column < map.size - margin; ++column) {
        sum += std::isfinite(map.depth[size_t(row) * size_t(map.size) + size_t(column)]);
        count += 1;
      }
    return sum / count;
  };
  // 20 m long, 0.02 m wide, 28,800 in 120 x 120 m^2: 0.8 of the area.
  const double expected = 1 - std::exp(-0.8);
  for (const double texel : {0.25, 0.5, 1.0}) {
    const double full = coverage(28800, 0.01, texel, true), eighth = coverage(3600, 0.08, texel, true), paper = coverage(28800, 0.01, texel, false);
    std::printf("texels of %.2f m: %.4f covered, %.4f by an eighth of the strands, %.4f by the texel; %.4f expected\n", texel, full, eighth, paper, expected);
    // An eighth leaves 3,600 strands in place: their number over the 80 x 80 m^2 varies by 1 / sqrt(2,000), coverage by a third of that.
    EXPECT_NEAR(full, expected, 0.015);
    EXPECT_NEAR(eighth, expected, 0.02);
    EXPECT_GT(paper, 0.99);
  }
}

// Perspective: width in texels falls with distance, and so does what is kept.
TEST(ReferenceCover, APointLightSeesDistantStrandsThinner) {
  const Sphere sphere{{0, 0, 0}, 100};
  double before = 2;
  for (const double z : {80.0, 0.0, -80.0}) {
    double all = 0, kept = 0, share = 0;
    for (int i = 0; i < 300; ++i) {
      Scene scene;
      scene.hairs.resize(1);
      addAcross(scene.hairs[0], 0.0104 * i, 5, 0.25, z, 50);
      for (const bool cover : {false, true}) {
        ShadowMap map = perspectiveFrame(sphere, {0, 0, 200}, {0, 0, -1}, std::asin(0.5), kSize, 1);
        map.cover_width = cover;
        share = 0.5 * map.focal / (200 - z);
        drawShadowMap(map, scene);
        (cover ? kept : all) += double(covered(map));
      }
    }
    EXPECT_LT(share, before);
    EXPECT_LT(share, 1);
    EXPECT_NEAR(kept / all, share, 4 * std::sqrt(share * (1 - share) / all));
    before = share;
  }
}

}  // namespace
}  // namespace forelock::reference
