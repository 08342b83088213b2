// Ambient harmonics, host shadow maps, visibility and tile masks.
#include "reference_support.h"
#include "reference_vector.h"

namespace forelock::reference {
namespace {

// Y_lm in the order of the coefficients, as Ramamoorthi and Hanrahan print them.
std::array<double, 9> harmonics(Vec3 d) {
  return {0.282095,
          0.488603 * d.y,
          0.488603 * d.z,
          0.488603 * d.x,
          1.092548 * d.x * d.y,
          1.092548 * d.y * d.z,
          0.315392 * (3 * d.z * d.z - 1),
          1.092548 * d.x * d.z,
          0.546274 * (d.x * d.x - d.y * d.y)};
}

Vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalizeOrZero(Vec3{normal(random), normal(random), normal(random)});
}

TEST(ReferenceAmbient, HarmonicsAgainstIntegration) {
  std::mt19937 random(50);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 20; ++round) {
    Scene scene;
    scene.ambient[0] = 0.3;
    scene.ambient_sh.emplace();
    for (auto& c : *scene.ambient_sh) c = {normal(random) * 0.3, 0, 0};
    (*scene.ambient_sh)[0][0] = 4;  // positive throughout
    const Vec3 t = randomDirection(random);
    // Midpoints in cos(polar) and azimuth.
    const int rows = 400, columns = 200;
    double sum = 0, weights = 0;
    for (int i = 0; i < rows; ++i) {
      const double z = (2 * i + 1.0) / rows - 1, r = std::sqrt(1 - z * z);
      for (int k = 0; k < columns; ++k) {
        const double a = (k + 0.5) * 2 * std::numbers::pi / columns;
        const Vec3 d{r * std::cos(a), r * std::sin(a), z};
        const auto y = harmonics(d);
        double radiance = 0.3;
        for (size_t j = 0; j < 9; ++j) radiance += (*scene.ambient_sh)[j][0] * y[j];
        const double sine = length(cross(t, d));
        sum += radiance * sine;
        weights += sine;
      }
    }
    EXPECT_NEAR(weights / (rows * columns), std::numbers::pi / 4, 1e-3);
    // The kink of the sine at both poles of T costs the midpoint rule about a step squared; six digits are printed.
    EXPECT_NEAR(ambientLight(scene, t)[0], sum / weights, 2e-4);
  }
}

TEST(ReferenceAmbient, ConstantZeroTangentAndClamp) {
  Scene scene;
  scene.ambient[1] = 0.25;
  EXPECT_EQ(ambientLight(scene, {1, 0, 0})[1], 0.25);
  scene.ambient_sh.emplace();
  (*scene.ambient_sh)[0][1] = 1;
  (*scene.ambient_sh)[6][1] = 1;
  EXPECT_NEAR(ambientLight(scene, {})[1], 0.25 + 0.282095, 1e-6);
  EXPECT_NEAR(ambientLight(scene, {0, 0, 1})[1], 0.25 + 0.282095 - 0.630783 / 8, 1e-6);
  (*scene.ambient_sh)[0][1] = -5;
  EXPECT_EQ(ambientLight(scene, {0, 0, 1})[1], 0);
  for (const size_t odd : {1u, 2u, 3u}) (*scene.ambient_sh)[odd][2] = 10;
  EXPECT_EQ(ambientLight(scene, {0.6, 0.8, 0})[2], 0);
}

// Before the pixel camera, x is a texel and z the value; w is 1.
HostShadow flatShadow() {
  HostShadow s;
  s.width = 8;
  s.height = 4;
  s.values.assign(32, 0.5f);
  s.right = 8;
  s.bottom = 4;
  for (int i = 0; i < 16; i += 5) s.texel_from_world[i] = 1;
  return s;
}

TEST(ReferenceHostShadow, FourTapsBlended) {
  HostShadow s = flatShadow();
  EXPECT_EQ(hostShadowLight(s, {3, 2, 0.4}), 1);
  EXPECT_EQ(hostShadowLight(s, {3, 2, 0.6}), 0);
  s.bias = 0.2;
  EXPECT_EQ(hostShadowLight(s, {3, 2, 0.6}), 1);
  s.bias = 0;
  s.values[2 * 8 + 3] = 1;  // one texel is farther
  EXPECT_EQ(hostShadowLight(s, {3.5, 2.5, 0.6}), 1);
  EXPECT_NEAR(hostShadowLight(s, {3.75, 2.5, 0.6}), 0.75, 1e-15);
  EXPECT_NEAR(hostShadowLight(s, {3.25, 2.25, 0.6}), 0.75 * 0.75, 1e-15);
  EXPECT_EQ(hostShadowLight(s, {4.5, 2.5, 0.6}), 0);
  // Outside the rectangle: lit, and half of the taps across its border.
  EXPECT_EQ(hostShadowLight(s, {-1, 2, 0.6}), 1);
  EXPECT_NEAR(hostShadowLight(s, {0, 1.5, 0.6}), 0.5, 1e-15);
  s.left = 2;
  EXPECT_NEAR(hostShadowLight(s, {2, 1.5, 0.6}), 0.5, 1e-15);
  EXPECT_EQ(hostShadowLight(s, {1e30, 2, 0.6}), 1);
  // Reversed: the lit side is the greater one.
  s.reversed = true;
  EXPECT_EQ(hostShadowLight(s, {5, 1.5, 0.6}), 1);
  EXPECT_EQ(hostShadowLight(s, {5, 1.5, 0.4}), 0);
  s.bias = 0.2;
  EXPECT_EQ(hostShadowLight(s, {5, 1.5, 0.4}), 1);
}

TEST(ReferenceHostShadow, Projective) {
  HostShadow s = flatShadow();
  s.texel_from_world[11] = -1;  // w = -z
  s.texel_from_world[15] = 0;
  s.texel_from_world[10] = 0;
  s.texel_from_world[14] = 1;                    // value 1 / -z
  EXPECT_EQ(hostShadowLight(s, {6, 4, -2}), 1);  // texel (3, 2), value 0.5
  EXPECT_EQ(hostShadowLight(s, {3, 2, -1}), 0);  // value 1
  EXPECT_EQ(hostShadowLight(s, {3, 2, 1}), 1);   // behind
  EXPECT_EQ(hostShadowLight(s, {3, 2, 0}), 1);
}

// Map, visibility and what arrives are factors of one light alone; masks leave a light out.
TEST(ReferenceHostShadow, InTheImage) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(1);
  addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 16}, {70, 16}}, 6);
  Light sun;
  sun.direction_to_light = {0, 0, 1};
  sun.radiance[0] = 2;
  scene.lights = {sun, sun};
  const FragmentLists lists = gatherFragments(scene, camera);
  auto red = [&](int x) { return resolve(scene, camera, {}, lists).at(x, 16).rgb[0]; };
  EXPECT_NEAR(red(10), 2, 1e-14);  // two lights of 2 on a colour of 0.5
  HostShadow s = flatShadow();
  s.right = 4;  // the world's x from 0 to 4: pixels 16 to 20
  s.texel_from_world[13] = 2;
  s.texel_from_world[14] = 1;  // value 1 > 0.5
  scene.lights[0].host_shadow = s;
  EXPECT_NEAR(red(10), 2, 1e-14);
  EXPECT_NEAR(red(17), 1, 1e-14);
  scene.lights[1].visibility.assign(32 * 32, 1);
  scene.lights[1].visibility[16 * 32 + 17] = 0.25;
  EXPECT_NEAR(red(17), 0.25, 1e-14);
  EXPECT_NEAR(red(18), 1, 1e-14);

  // 40 lights: two layers of words, tiles of 16 pixels.
  scene.lights.assign(40, sun);
  scene.light_tiles = {16, 2, 2, std::vector<uint32_t>(8, 0)};
  scene.light_tiles.words[2] = 0b1011;    // layer 0, tile (0, 1)
  scene.light_tiles.words[4 + 3] = 0xff;  // layer 1, tile (1, 1)
  EXPECT_NEAR(red(15), 3, 1e-14);
  EXPECT_NEAR(red(16), 8, 1e-13);
  EXPECT_FALSE(lightReaches(scene.light_tiles, 2, 0, 16));
  EXPECT_TRUE(lightReaches(scene.light_tiles, 39, 31, 31));
  EXPECT_FALSE(lightReaches(scene.light_tiles, 64, 31, 31));
}

}  // namespace
}  // namespace forelock::reference
