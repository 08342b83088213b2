// Section 4 against values in closed form.
#include "reference_support.h"

namespace forelock::reference {
namespace {

TEST(ReferenceShadow, WeightsSumToOne) {
  double sum = 0;
  for (int j = -2; j <= 2; ++j) {
    for (int i = -2; i <= 2; ++i) sum += gaussianWeight(i, j);
  }
  EXPECT_NEAR(sum, 1, 1e-15);
  EXPECT_NEAR(gaussianWeight(1, 0) / gaussianWeight(0, 0), std::exp(-0.5), 1e-15);
}

TEST(ReferenceShadow, TapIsSafe) {
  EXPECT_DOUBLE_EQ(shadowTap(1, 2, 0, 0.5, 1e-3), 1);
  EXPECT_DOUBLE_EQ(shadowTap(1, std::numeric_limits<double>::infinity(), 0, 0.5, 1e-3), 1);
  EXPECT_DOUBLE_EQ(shadowTap(2, 1, 0, 1, 1e-3), 0);
  EXPECT_DOUBLE_EQ(shadowTap(1, 1, 0, 1, 1e-3), 1);
  EXPECT_DOUBLE_EQ(shadowTap(2, 1, 0, 0, 1e-3), 1);
  EXPECT_DOUBLE_EQ(shadowTap(2, 1, 0, 0.5, 0), std::exp2(-1e6));
  EXPECT_NEAR(shadowTap(1.003, 1, 0.001, 0.3, 1e-3), 0.49, 1e-12);  // two fibres of transmittance 0.7
}

TEST(ReferenceShadow, FrameHoldsEveryHair) {
  Scene scene;
  scene.hairs.resize(2);
  const Vec3 a[2] = {{-1, 0, 0}, {1, 0, 0}}, b[3] = {{4, 0, 0}, {5, 1, 0}, {5, 2, 1}};
  addStrand(scene.hairs[0].strands, a, 0.1);
  addStrand(scene.hairs[1].strands, b, 0.2);
  EXPECT_NEAR(boundingSphere(scene.hairs[0]).radius, 1.1 * 1.001, 1e-14);
  const Sphere all = boundingSphere(scene);
  for (const Hair& hair : scene.hairs) {
    const Sphere s = boundingSphere(hair);
    const Vec3 d{s.center.x - all.center.x, s.center.y - all.center.y, s.center.z - all.center.z};
    EXPECT_LE(std::hypot(d.x, d.y, d.z) + s.radius, all.radius * (1 + 1e-14));
  }
  for (const Vec3& l : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0.6, 0, 0.8}, Vec3{0.5, -0.5, 0.7071}}) {
    const ShadowMap m = shadowFrame(all, l, 16);
    EXPECT_NEAR(m.x.x * m.z.x + m.x.y * m.z.y + m.x.z * m.z.z, 0, 1e-15);
    EXPECT_NEAR(m.x.x * m.x.x + m.x.y * m.x.y + m.x.z * m.x.z, 1, 1e-15);
    EXPECT_NEAR(m.y.x * m.y.x + m.y.y * m.y.y + m.y.z * m.y.z, 1, 1e-15);
  }
  // e is the world axis most square to the light, the first of equals.
  EXPECT_DOUBLE_EQ(shadowFrame(all, {0, 0, 1}, 16).x.x, 1);
  EXPECT_DOUBLE_EQ(shadowFrame(all, {1, 0, 0}, 16).x.y, 1);
}

// A closed sheet of strands square to the light, and points behind it.
TEST(ReferenceShadow, SlabOfKnownDepth) {
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.shadow_opacity = 0.3;
  m.fibre_spacing = 2e-3;
  for (int i = -100; i <= 100; ++i) {
    const Vec3 ends[2] = {{i * 0.01, -1, 0}, {i * 0.01, 1, 0}};
    addStrand(scene.hairs[0].strands, ends, 0.0055);  // wider than half their distance: no hole
  }
  const Light light{{0, 0, 1}, {1, 1, 1}, true, 256};
  const ShadowMap map = renderShadowMap(scene, light);
  double worst = 0;
  for (const double d : {0.0, 1e-3, 4e-3, 0.02, 0.1}) {
    for (const bool core : {true, false}) {
      const double got = shadowLight(map, m, {0.123, -0.2, -d}, {0, 1, 0}, core);
      const double expected = std::pow(0.7, d / 2e-3);
      worst = std::max(worst, std::fabs(got - expected));
      // The map holds fp32 depths near rho = 1.4 m: 6e-8 m, 3e-5 fibres of ln(0.7) each.
      EXPECT_NEAR(got, expected, 2e-5) << d;
    }
  }
  std::printf("slab: worst error of the transmittance %.2e\n", worst);
  EXPECT_DOUBLE_EQ(shadowLight(map, m, {0.123, -0.2, 0.5}, {0, 1, 0}, true), 1);  // before the slab
  EXPECT_DOUBLE_EQ(shadowLight(map, m, {40, 0, -1}, {0, 1, 0}, true), 1);         // outside the map
  // Tangent at 45 degrees to the light: one texel of bias.
  const double half = std::numbers::sqrt2 / 2;
  EXPECT_NEAR(shadowLight(map, m, {0.123, -0.2, -0.02}, {0, half, half}, false),
              std::pow(0.7, (0.02 - map.texel) / 2e-3), 2e-5);
  // Along the light the sine is held at 0.1: ten texels.
  EXPECT_NEAR(shadowLight(map, m, {0.123, -0.2, -0.2}, {0, 0, 1}, false),
              std::pow(0.7, (0.2 - 10 * map.texel) / 2e-3), 2e-5);
}

TEST(ReferenceShadow, MapHoldsTheNearestDepth) {
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 sloped[2] = {{-1, 0, -0.5}, {1, 0, 0.5}}, behind[2] = {{-1, 0, -0.8}, {1, 0, -0.8}};
  addStrand(scene.hairs[0].strands, behind, 0.05);
  addStrand(scene.hairs[0].strands, sloped, 0.05);
  const ShadowMap map = renderShadowMap(scene, {{0, 0, 1}, {1, 1, 1}, true, 200});
  int written = 0;
  for (int row = 0; row < 200; ++row) {
    for (int column = 0; column < 200; ++column) {
      const double d = double(map.depth[size_t(row) * 200 + size_t(column)]);
      if (!std::isfinite(d)) continue;
      ++written;
      const double x = ((column + 0.5) / 200 * 2 - 1) * map.rho * map.x.x + map.center.x;
      EXPECT_NEAR(d, -(0.5 * x - map.center.z) + map.rho, 1e-6);  // fp32
    }
  }
  // 2 m x 0.1 m of texels, each centre counted once; a row and a column of texels may be in or out.
  EXPECT_NEAR(written, 0.2 / (map.texel * map.texel), 2.2 / map.texel);
}

TEST(ReferenceShadow, ScalingTheSceneChangesNothing) {
  auto render = [](double scale) {
    std::mt19937 random(13);
    std::normal_distribution<double> normal;
    Scene scene;
    scene.hairs.resize(1);
    Material& m = scene.hairs[0].material;
    m.opacity_root = 0.6;
    m.kr = m.kt = 0.2;
    m.exponent_r = m.exponent_trt = 12;
    m.fibre_spacing = 0.01 * scale;
    for (int i = 0; i < 200; ++i) {
      Vec3 p{normal(random) * 0.3 * scale, normal(random) * 0.3 * scale, normal(random) * 0.3 * scale};
      std::vector<Vec3> points;
      for (int v = 0; v < 6; ++v) {
        points.push_back(p);
        const double step = 0.1 * scale;
        p = {p.x + step * normal(random), p.y + step * normal(random), p.z + step * normal(random)};
      }
      addStrand(scene.hairs[0].strands, points, 0.004 * scale);
    }
    scene.lights.push_back({{0.48, 0.6, 0.64}, {1, 1, 1}, true, 256});
    Projection p;
    p.near_plane = 0.125 * scale;
    p.far_plane = 64 * scale;
    const Camera camera = makeCamera({0, 0, 2 * scale}, {0, 0, 0}, {0, 1, 0}, p, 128, 128);
    return resolve(scene, camera, renderShadowMaps(scene), gatherFragments(scene, camera));
  };
  const Image one = render(1);
  // Powers of two scale without rounding, so nothing may change at all; 1000 rounds, and a texel may change sides.
  for (const double scale : {1024.0, 1.0 / 256}) {
    const Difference d = compare(one, render(scale));
    EXPECT_GT(d.pixels, 1000u);
    EXPECT_EQ(d.rmse, 0) << scale;
  }
  const Difference d = compare(one, render(1000));
  std::printf("scaled by 1000: RMSE %.2e\n", d.rmse);
  EXPECT_LT(d.rmse, 0.01);
}

}  // namespace
}  // namespace forelock::reference
