// Section 5 against values in closed form.
#include "reference_support.h"

namespace forelock::reference {
namespace {

Material glossy() {
  Material m;
  m.color[0] = 0.6;
  m.color[1] = 0.4;
  m.color[2] = 0.2;
  m.kd = 0.5;
  m.kr = 0.3;
  m.exponent_r = 20;
  m.kt = 0.7;
  m.exponent_trt = 8;
  return m;
}

Vec3 direction(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

// Roundings of a few trigonometric functions, times an exponent of at most 20.
constexpr double tight = 1e-13;

TEST(ReferenceShading, PerpendicularLightAndEye) {
  Material m = glossy();
  const LobeInput in{{1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  auto c = shadeLobes(m, in, true);
  EXPECT_NEAR(c[0], 0.5 * 0.6 + 0.3 + 0.7 * 0.6, tight);
  EXPECT_NEAR(shadeLobes(m, in, false)[0], 0.5 * 0.6, tight);
  m.cuticle_tilt = radians(10);
  c = shadeLobes(m, in, true);
  EXPECT_NEAR(c[2], 0.5 * 0.2 + 0.3 * std::pow(std::cos(radians(20)), 20) +
                        0.7 * 0.2 * std::pow(std::cos(radians(30)), 8), tight);
}

TEST(ReferenceShading, TiltTurnsTheFirstLobeToTheRootAndTheSecondToTheTip) {
  Material m = glossy();
  m.kd = 0;
  m.cuticle_tilt = radians(5);
  const Vec3 tangent{1, 0, 0}, light = direction(radians(70));  // mirrored: 110 degrees from the tangent
  m.kt = 0;
  EXPECT_NEAR(shadeLobes(m, {tangent, light, direction(radians(120))}, true)[0], 0.3, tight);
  m.kt = 0.7;
  m.kr = 0;
  EXPECT_NEAR(shadeLobes(m, {tangent, light, direction(radians(95))}, true)[0], 0.7 * 0.6, tight);
  // The eye's place around the strand does not matter.
  const double a = radians(95), turn = 1.1;
  const Vec3 around{std::cos(a), std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn)};
  EXPECT_NEAR(shadeLobes(m, {tangent, light, around}, true)[0], 0.7 * 0.6, tight);
}

TEST(ReferenceShading, ParallelLight) {
  Material m = glossy();
  for (const double sign : {1.0, -1.0}) {
    const auto across = shadeLobes(m, {{1, 0, 0}, {sign, 0, 0}, {0, 1, 0}}, true);
    EXPECT_NEAR(across[0], 0, tight);  // diffuse 0, the mirrored light is a right angle away
    const auto mirrored = shadeLobes(m, {{1, 0, 0}, {sign, 0, 0}, {-sign, 0, 0}}, true);
    EXPECT_NEAR(mirrored[0], 0.3 + 0.7 * 0.6, tight);
  }
}

TEST(ReferenceShading, Exponents) {
  Material m = glossy();
  m.kd = m.kt = 0;
  m.kr = 1;
  const LobeInput facing{{1, 0, 0}, direction(radians(70)), direction(radians(60))};     // 50 degrees off the lobe
  const LobeInput averted{{1, 0, 0}, direction(radians(160)), direction(radians(170))};  // 150 degrees off
  m.exponent_r = 0;
  EXPECT_DOUBLE_EQ(shadeLobes(m, facing, true)[0], 1);
  EXPECT_DOUBLE_EQ(shadeLobes(m, averted, true)[0], 0);
  m.exponent_r = -5;
  EXPECT_DOUBLE_EQ(shadeLobes(m, facing, true)[0], 1);
  m.exponent_r = 2;
  EXPECT_NEAR(shadeLobes(m, facing, true)[0], std::pow(std::cos(radians(50)), 2), tight);
  m.exponent_r = 1e30;
  EXPECT_DOUBLE_EQ(shadeLobes(m, facing, true)[0], 0);
  const LobeInput exact{{1, 0, 0}, {0, 0, 1}, {0, 0, 1}};
  EXPECT_NEAR(shadeLobes(m, exact, true)[0], 1, 1e-9);
}

TEST(ReferenceShading, ZeroTangentIsDiffuse) {
  const Material m = glossy();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& t : {Vec3{0, 0, 0}, Vec3{nan, 0, 0}}) {
    EXPECT_NEAR(shadeLobes(m, {t, {0, 0, 1}, {0, 0, 1}}, true)[0], 0.5 * 0.6, tight);
  }
}

TEST(ReferenceShading, FiniteForRandomAndNearlyParallelVectors) {
  std::mt19937 random(12);
  std::normal_distribution<double> normal;
  Material m = glossy();
  for (int i = 0; i < 100000; ++i) {
    auto unit = [&] {
      const Vec3 v{normal(random), normal(random), normal(random)};
      const double l = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
      return Vec3{v.x / l, v.y / l, v.z / l};
    };
    m.exponent_r = std::pow(10.0, i % 7);
    m.cuticle_tilt = i % 5 * 0.1;
    const Vec3 t = unit();
    const Vec3 l = i % 3 ? unit() : i % 2 ? t : Vec3{-t.x, -t.y, -t.z};
    const auto c = shadeLobes(m, {t, l, i % 4 ? unit() : l}, true);
    ASSERT_TRUE(c[0] >= 0 && c[0] <= m.kd + m.kr + m.kt);
  }
}

// One strand across the view with an ambient and two lights: the whole path from scene to pixel.
TEST(ReferenceShading, PixelInClosedForm) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(1);
  scene.hairs[0].material = glossy();
  scene.hairs[0].material.opacity_root = scene.hairs[0].material.opacity_tip = 0.4;
  scene.hairs[0].slot = 7;
  addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 16}, {70, 16}}, 6);
  scene.ambient[0] = 0.1;
  scene.lights.push_back({{0, 0, 1}, {2, 2, 2}, false, 64});
  scene.lights.push_back({{1, 0, 0}, {5, 5, 5}, false, 64});  // along the strand: nothing, the eye is square to it
  const Image image = resolve(scene, camera, {}, gatherFragments(scene, camera));
  const double full = 2 * (0.5 * 0.6 + 0.3 + 0.7 * 0.6) + 0.1 * 0.5 * 0.6;
  EXPECT_NEAR(image.at(16, 16).rgb[0], 0.4 * full, 1e-12);
  EXPECT_NEAR(image.at(16, 16).transmittance, 0.6, 1e-12);
  ResolveOptions low;
  low.method = Method::core_tail;
  low.k = 0;
  const Image all_low = resolve(scene, camera, {}, gatherFragments(scene, camera), low);
  EXPECT_NEAR(all_low.at(16, 16).rgb[0], 0.4 * (2 * 0.5 * 0.6 + 0.1 * 0.5 * 0.6), 1e-12);
}

}  // namespace
}  // namespace forelock::reference
