// Depths, transmittance and velocity of known scenes.
#include "reference_outputs.h"
#include "reference_support.h"
#include "reference_vector.h"

#include <algorithm>

namespace forelock::reference {
namespace {

constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

Matrix translation(Vec3 t) {
  Matrix m = identity;
  m[12] = t.x, m[13] = t.y, m[14] = t.z;
  return m;
}

TEST(ReferenceOutputs, DepthsAndTransmittance) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(1);
  scene.hairs[0].material.opacity_root = scene.hairs[0].material.opacity_tip = 0.4;
  for (const double z : {5.0, -20.0, 8.0}) {
    addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 16}, {70, 16}}, 6, z);
  }
  const FragmentLists lists = gatherFragments(scene, camera);
  const auto out = outputsOf(scene, camera, lists, {camera});
  const OutputPixel& p = out[16 * 32 + 10];
  EXPECT_TRUE(p.written);
  EXPECT_NEAR(p.front_depth, 92, 1e-12);
  EXPECT_NEAR(p.depth_min, 92, 1e-12);
  EXPECT_NEAR(p.depth_max, 120, 1e-12);
  EXPECT_NEAR(p.transmittance, 0.216, 1e-14);
  EXPECT_NEAR(p.transmittance, resolve(scene, camera, {}, lists).at(10, 16).transmittance, 1e-15);
  EXPECT_EQ(p.velocity[0], 0);
  EXPECT_FALSE(out[2 * 32 + 10].written);
  const auto hard = outputsOf(scene, camera, gatherHard(scene, camera), {camera});
  EXPECT_EQ(hard[16 * 32 + 10].transmittance, 0);
  EXPECT_NEAR(hard[16 * 32 + 10].depth_max, 92, 1e-12);
}

TEST(ReferenceOutputs, VelocityOfCameraAndHair) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(2);
  scene.hairs[0].slot = 5;
  scene.hairs[1].slot = 2;
  addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 8}, {70, 8}}, 6);
  addLine(scene.hairs[1], camera, std::vector<Point>{{-40, 24}, {70, 24}}, 6);
  const FragmentLists lists = gatherFragments(scene, camera);
  Motion motion{camera, {translation({7, 1, 0}), identity}, {translation({5, 4, -3}), identity}};
  // The first hair went 2 m to the right and 3 m down: as many pixels, and y points down in the image.
  auto out = outputsOf(scene, camera, lists, motion);
  EXPECT_NEAR(out[8 * 32 + 10].velocity[0], 2, 1e-12);
  EXPECT_NEAR(out[8 * 32 + 10].velocity[1], 3, 1e-12);
  EXPECT_NEAR(out[24 * 32 + 10].velocity[0], 0, 1e-12);
  // A camera that went 4 m to the right carries the picture 4 pixels to the left.
  motion.camera_before.view_from_world[12] += 4;
  out = outputsOf(scene, camera, lists, motion);
  EXPECT_NEAR(out[8 * 32 + 10].velocity[0], -2, 1e-12);
  EXPECT_NEAR(out[24 * 32 + 10].velocity[0], -4, 1e-12);
}

// A fragment lies on its strand: where the strand was is where the moved strand is drawn.
TEST(ReferenceOutputs, VelocityInPerspective) {
  const Camera now = makeCamera({0.2, 0.1, 3}, {0, 0, 0}, {0, 1, 0}, {}, 64, 48);
  const Camera before = makeCamera({-0.1, 0.3, 2.5}, {0.1, 0, 0}, {0, 1, 0}, {}, 64, 48);
  const double c = std::cos(0.2), s = std::sin(0.2);
  const Matrix turned{2 * c, 2 * s, 0, 0, -2 * s, 2 * c, 0, 0, 0, 0, 2, 0, 0.3, -0.1, 0.2, 1};  // twice as large, too
  const Vec3 local[2] = {{-0.3, 0.1, 0.2}, {0.35, -0.05, -0.3}};
  Scene scene;
  scene.hairs.resize(1);
  auto place = [&](const Matrix& m, Vec3 p) {
    return Vec3{m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
  };
  const Vec3 ends[2] = {place(turned, local[0]), place(turned, local[1])};
  addStrand(scene.hairs[0].strands, ends, 0.001);
  const FragmentLists lists = gatherFragments(scene, now);
  const auto out = outputsOf(scene, now, lists, {before, {turned}, {identity}});
  const Projected a = project(before, local[0]), b = project(before, local[1]);
  const double l = std::hypot(b.x - a.x, b.y - a.y);
  int seen = 0;
  double least = 1e9, most = -1e9;
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const OutputPixel& p = out[size_t(y) * 64 + size_t(x)];
      if (!p.written) continue;
      ++seen;
      const double px = x + 0.5 - p.velocity[0] - a.x, py = y + 0.5 - p.velocity[1] - a.y;
      // As far from the strand as the pixel's centre is from it now, by what a pixel was then: half its size.
      EXPECT_LT(std::fabs(px * (b.y - a.y) - py * (b.x - a.x)) / l, 0.8);
      const double along = (px * (b.x - a.x) + py * (b.y - a.y)) / l;
      least = std::min(least, along);
      most = std::max(most, along);
    }
  }
  EXPECT_GT(seen, 20);
  EXPECT_NEAR(least, 0, 1);
  EXPECT_NEAR(most, l, 1);
}

TEST(ReferenceOutputs, BehindTheCameraBeforeIsStill) {
  const Camera now = makeCamera({0, 0, 3}, {0, 0, 0}, {0, 1, 0}, {}, 16, 16);
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 ends[2] = {{-1, 0, 0}, {1, 0, 0}};
  addStrand(scene.hairs[0].strands, ends, 0.3);
  const auto out =
      outputsOf(scene, now, gatherFragments(scene, now), {makeCamera({0, 0, -3}, {0, 0, -6}, {0, 1, 0}, {}, 16, 16)});
  EXPECT_TRUE(out[8 * 16 + 8].written);
  EXPECT_EQ(out[8 * 16 + 8].velocity[0], 0);
}

}  // namespace
}  // namespace forelock::reference
