// What arrives of point and spot lights, against closed forms.
#include "reference_support.h"

namespace forelock::reference {
namespace {

Light pointLight(Vec3 position) {
  Light light;
  light.kind = LightKind::point;
  light.position = position;
  return light;
}

TEST(ReferenceLights, DirectionalIsTheSameEverywhere) {
  Light light;
  light.direction_to_light = {0, 3, 4};  // made unit
  light.radiance[1] = 2;
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{100, -5, 3}}) {
    const Arriving a = arrivingLight(light, p);
    EXPECT_NEAR(a.to_light.y, 0.6, 1e-15);
    EXPECT_DOUBLE_EQ(a.radiance[1], 2);
  }
}

TEST(ReferenceLights, PointFallsWithTheSquare) {
  Light light = pointLight({1, 2, 3});
  light.radiance[0] = 5;
  const Arriving one = arrivingLight(light, {1, 2, 2}), three = arrivingLight(light, {1, -1, 3});
  EXPECT_DOUBLE_EQ(one.radiance[0], 5);
  EXPECT_DOUBLE_EQ(one.to_light.z, 1);
  EXPECT_DOUBLE_EQ(three.radiance[0], 5.0 / 9);
  EXPECT_DOUBLE_EQ(three.to_light.y, 1);
  // Inside the source it grows no brighter; at its middle there is no direction and nothing.
  light.source_radius = 0.5;
  EXPECT_DOUBLE_EQ(arrivingLight(light, {1, 2, 2.9}).radiance[0], 20);
  EXPECT_DOUBLE_EQ(arrivingLight(light, {1, 2, 3}).radiance[0], 0);
}

TEST(ReferenceLights, WindowClosesAtTheRange) {
  Light light = pointLight({0, 0, 0});
  light.range = 4;
  EXPECT_NEAR(arrivingLight(light, {2, 0, 0}).radiance[2], std::pow(15.0 / 16, 2) / 4, 1e-15);
  EXPECT_DOUBLE_EQ(arrivingLight(light, {0, 4, 0}).radiance[2], 0);
  EXPECT_DOUBLE_EQ(arrivingLight(light, {0, 9, 0}).radiance[2], 0);
  // No step where it closes: value and slope are 0.
  EXPECT_LT(arrivingLight(light, {3.999, 0, 0}).radiance[2], 1e-6);
}

TEST(ReferenceLights, SpotCone) {
  Light light = pointLight({0, 0, 0});
  light.kind = LightKind::spot;
  light.axis = {0, -2, 0};  // made unit
  light.inner_angle = radians(20);
  light.outer_angle = radians(40);
  auto at = [&](double degrees) {
    const double a = radians(degrees);
    return arrivingLight(light, {std::sin(a), -std::cos(a), 0}).radiance[0];
  };
  EXPECT_NEAR(at(0), 1, 1e-15);
  EXPECT_NEAR(at(19.99), 1, 1e-15);
  EXPECT_DOUBLE_EQ(at(40.01), 0);
  EXPECT_DOUBLE_EQ(at(180), 0);
  const double t = (std::cos(radians(33)) - std::cos(radians(40))) / (std::cos(radians(20)) - std::cos(radians(40)));
  EXPECT_NEAR(at(33), t * t, 1e-14);
  EXPECT_NEAR(at(-33), t * t, 1e-14);
  // No soft edge: a step.
  light.inner_angle = light.outer_angle;
  EXPECT_DOUBLE_EQ(at(39.999), 1);
  EXPECT_DOUBLE_EQ(at(40.001), 0);
}

// The whole path from many lights to a pixel: they add.
TEST(ReferenceLights, ManyLightsAdd) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.kr = 0.3;
  m.exponent_r = 4;
  addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 16}, {70, 16}}, 6);
  const FragmentLists lists = gatherFragments(scene, camera);
  double sum = 0;
  std::vector<Light> all;
  for (int i = 0; i < 70; ++i) {
    Light light = pointLight({3.0 * i - 100, 5, 20.0 + i});
    light.kind = i % 3 ? LightKind::point : LightKind::spot;
    light.axis = {0, 0, -1};
    light.outer_angle = radians(60);
    light.radiance[0] = 100 + i;
    scene.lights = {light};
    sum += resolve(scene, camera, {}, lists).at(20, 16).rgb[0];
    all.push_back(light);
  }
  scene.lights = all;
  EXPECT_NEAR(resolve(scene, camera, {}, lists).at(20, 16).rgb[0], sum, 1e-12 * sum);
  EXPECT_GT(sum, 0.1);
}

}  // namespace
}  // namespace forelock::reference
