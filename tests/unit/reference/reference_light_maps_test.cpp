// Hair shadow maps of point and spot lights.
#include "reference_support.h"
#include "reference_vector.h"

#include <numbers>

namespace forelock::reference {
namespace {

Light shadowing(LightKind kind, Vec3 position, int size) {
  Light light;
  light.kind = kind;
  light.position = position;
  light.shadow = true;
  light.shadow_size = size;
  return light;
}

// Closed: circles of latitude about the origin, wider than their distance even at the corner of a face, where a ribbon
// that faces the map is 1.73 times narrower than what it covers of a sphere.
Hair shell(double radius) {
  Hair hair;
  hair.material.shadow_opacity = 0.3;
  hair.material.fibre_spacing = 1e-2;
  for (int i = 0; i < 300; ++i) {
    const double polar = (i + 0.5) / 300 * std::numbers::pi;
    std::vector<Vec3> points;
    for (int k = 0; k <= 720; ++k) {
      const double a = k * std::numbers::pi / 360;
      points.push_back(
          {radius * std::sin(polar) * std::cos(a), radius * std::sin(polar) * std::sin(a), radius * std::cos(polar)});
    }
    addStrand(hair.strands, points, 0.0105 * radius);
  }
  return hair;
}

TEST(ReferenceLightMaps, KindOfMapFollowsTheNarrowest) {
  const Sphere sphere{{1, 2, 3}, 2};
  auto frames = [&](Light light) { return lightFrames(light, sphere).faces; };
  Light far = shadowing(LightKind::point, {1, 2, 13}, 64);
  ASSERT_EQ(frames(far).size(), 1u);
  EXPECT_NEAR(frames(far)[0].focal, 29 / std::tan(std::asin(0.2)), 1e-12);
  EXPECT_NEAR(frames(far)[0].near_depth, 8, 1e-12);
  EXPECT_NEAR(frames(far)[0].z.z, -1, 1e-15);
  const Light close = shadowing(LightKind::point, {1, 2, 5.4}, 64);  // 1.2 rho
  ASSERT_EQ(frames(close).size(), 6u);
  EXPECT_NEAR(frames(close)[0].near_depth, 0.4 / std::numbers::sqrt3, 1e-12);
  EXPECT_NEAR(frames(close)[3].z.y, -1, 1e-15);
  EXPECT_NEAR(frames(close)[3].focal, 29, 1e-12);
  EXPECT_NEAR(frames(shadowing(LightKind::point, {1, 2, 3}, 64))[5].near_depth, 0.002, 1e-15);
  // The cone of a spot: narrower than the sphere, wider, too wide.
  Light spot = far;
  spot.kind = LightKind::spot;
  spot.axis = {0, 0.6, -0.8};
  spot.outer_angle = radians(5);
  ASSERT_EQ(frames(spot).size(), 1u);
  EXPECT_NEAR(frames(spot)[0].z.y, 0.6, 1e-15);
  EXPECT_NEAR(frames(spot)[0].focal, 29 / std::tan(radians(5)), 1e-12);
  spot.outer_angle = radians(40);
  EXPECT_NEAR(frames(spot)[0].z.z, -1, 1e-15);
  spot.position = close.position;
  EXPECT_EQ(frames(spot).size(), 1u);
  EXPECT_NEAR(frames(spot)[0].z.y, 0.6, 1e-15);
  spot.outer_angle = radians(61);
  EXPECT_EQ(frames(spot).size(), 6u);
  far.shadow = false;
  EXPECT_EQ(frames(far).size(), 0u);
  EXPECT_EQ(lightFrames(close, {}).faces.size(), 0u);
}

// A light in the middle of a closed shell: the same shade behind it in every direction, over all borders of the faces.
TEST(ReferenceLightMaps, SixFacesCloseWithoutASeam) {
  Scene scene;
  scene.hairs.push_back(shell(1));
  scene.lights.push_back(shadowing(LightKind::point, {0, 0, 0}, 256));
  const std::vector<LightMaps> maps = renderLightMaps(scene);
  ASSERT_EQ(maps[0].faces.size(), 6u);
  std::mt19937 random(20);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec3 d{normal(random), normal(random), normal(random)};
    if (i % 4 == 1) d.y = d.x * (1 + 1e-9 * normal(random));                         // an edge of the cube
    if (i % 4 == 2) d = {1, -1 + 1e-3 * normal(random), 1 + 1e-3 * normal(random)};  // a corner
    d = normalizeOrZero(d);
    if (std::hypot(d.x, d.y) < 0.02) continue;  // circles of few texels at the poles have holes
    const Vec3 along = normalizeOrZero(Vec3{-d.y, d.x, 0});
    const bool core = i % 2;
    const double got = shadowLight(maps[0].faces, scene.hairs[0].material, 1.02 * d, along, core);
    worst = std::max(worst, std::fabs(got - 0.49));  // two fibres of 0.7
    EXPECT_DOUBLE_EQ(shadowLight(maps[0].faces, scene.hairs[0].material, 0.9 * d, along, core), 1);
  }
  std::printf("six faces: worst error of the transmittance %.2e\n", worst);
  // Chords lie up to 1 - cos(pi / 720) = 1e-5 m inside the circle: 1e-3 fibres of ln(0.7) times 0.49, 1.7e-4; fp32
  // depths near 1 m add 3e-6.
  EXPECT_LT(worst, 2e-4);
}

// Each texel holds the way of the light to the strand it shows.
TEST(ReferenceLightMaps, DepthIsTheWayOfTheLight) {
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 a{-1, -0.3, 0.8}, b{1.2, 0.5, -1}, pair[2] = {a, b};
  addStrand(scene.hairs[0].strands, pair, 1e-4);
  const Light light = shadowing(LightKind::point, {0.5, 0.4, 4}, 512);
  scene.lights = {light};
  const ShadowMap map = renderLightMaps(scene)[0].faces[0];
  int written = 0;
  for (int row = 0; row < map.size; ++row) {
    for (int column = 0; column < map.size; ++column) {
      const double got = double(map.depth[size_t(row) * size_t(map.size) + size_t(column)]);
      if (!std::isfinite(got)) continue;
      ++written;
      const Vec3 ray = (column + 0.5 - map.size / 2.0) / map.focal * map.x +
                       (row + 0.5 - map.size / 2.0) / map.focal * map.y + map.z;
      // The point of the strand in the plane through the ray that is square to strand and ray.
      const Vec3 square = cross(ray, cross(ray, b - a));
      const double t = dot(light.position - a, square) / dot(b - a, square);
      const Vec3 p = mix(a, b, t);
      // Half a texel aside on a strand that is at most 45 degrees from the light's way: under a texel of depth.
      EXPECT_NEAR(got, length(p - light.position), dot(p - light.position, map.z) / map.focal) << column << " " << row;
    }
  }
  EXPECT_GT(written, 300);
}

// A strand through the near plane is cut there, one behind the light left out.
TEST(ReferenceLightMaps, CutAtNear) {
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 through[2] = {{-2, 0, 0.1}, {2, 0, -0.3}}, behind[2] = {{-3, -1, 0}, {-3, 1, 0}};
  addStrand(scene.hairs[0].strands, through, 0.01);
  addStrand(scene.hairs[0].strands, behind, 0.01);
  const Light light = shadowing(LightKind::point, {0, 0, 0.5}, 128);
  scene.lights = {light};
  const LightMaps maps = renderLightMaps(scene)[0];
  ASSERT_EQ(maps.faces.size(), 6u);
  auto count = [](const ShadowMap& map) {
    int n = 0;
    for (const float d : map.depth) n += std::isfinite(d);
    return n;
  };
  EXPECT_GT(count(maps.faces[0]), 50);  // the right half of one strand
  EXPECT_GT(count(maps.faces[1]), 50);  // its left half, and the other
  EXPECT_GT(count(maps.faces[5]), 100);
  EXPECT_EQ(count(maps.faces[4]), 0);  // nothing above the light
  for (const float d : maps.faces[0].depth) EXPECT_GE(d, 0.5f - 1e-6f);
}

Scene bush(Light light) {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  Scene scene;
  scene.hairs.resize(1);
  scene.hairs[0].material.fibre_spacing = 0.05;
  for (int s = 0; s < 300; ++s) {
    std::vector<Vec3> points{{normal(random) * 0.2, normal(random) * 0.2, normal(random) * 0.2}};
    for (int v = 0; v < 6; ++v) {
      points.push_back(points.back() + 0.1 * Vec3{normal(random), normal(random), normal(random)});
    }
    addStrand(scene.hairs[0].strands, points, 0.01);
  }
  scene.lights = {light};
  return scene;
}

Image render(const Scene& scene) {
  const Camera camera = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, {}, 96, 96);
  return resolve(scene, camera, renderLightMaps(scene), gatherFragments(scene, camera));
}

// Six texels more give the perspective map the texels of the directional one in the limit, three to each side for taps.
TEST(ReferenceLightMaps, FarPointLightIsDirectional) {
  Light sun;
  sun.direction_to_light = {0.48, 0.6, 0.64};
  sun.shadow = true;
  sun.shadow_size = 128;
  const Scene scene = bush(sun);
  const Image expected = render(scene);
  Scene dark = scene;
  dark.lights[0].shadow = false;
  EXPECT_GT(compare(expected, render(dark)).rmse, 20);  // the shadows are a good part of the image
  double before = 1e30;
  for (const LightKind kind : {LightKind::point, LightKind::spot}) {
    before = 1e30;
    for (const double r : {16.0, 128.0, 1024.0}) {
      Light light = shadowing(kind, boundingSphere(scene).center + r * sun.direction_to_light, 134);
      light.axis = -1.0 * sun.direction_to_light;
      light.inner_angle = 0.1;
      light.outer_angle = 0.3;
      for (double& c : light.radiance) c = r * r;
      const double rmse = compare(expected, render(bush(light))).rmse;
      std::printf("point light at %4.0f m against directional: RMSE %.3f\n", r, rmse);
      EXPECT_LT(rmse, before);
      before = rmse;
    }
    // At 1024 m a tap's place is off by rho / r of half a map, 0.1 texel: that share of texels shows another strand.
    EXPECT_LT(before, 2);
  }
}

TEST(ReferenceLightMaps, OneMapALightIsTheSameByEitherCall) {
  Light sun;
  sun.direction_to_light = {0, 0.6, 0.8};
  sun.shadow = true;
  sun.shadow_size = 64;
  Scene scene = bush(sun);
  scene.lights.push_back(shadowing(LightKind::spot, {0, 3, 1}, 64));
  scene.lights[1].axis = {0, -3, -1};
  scene.lights.push_back({});
  const Camera camera = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, {}, 48, 48);
  const FragmentLists lists = gatherFragments(scene, camera);
  const Image a = resolve(scene, camera, renderShadowMaps(scene), lists);
  EXPECT_EQ(compare(a, resolve(scene, camera, renderLightMaps(scene), lists)).rmse, 0);
  EXPECT_GT(compare(a, resolve(scene, camera, {}, lists)).rmse, 1);
}

}  // namespace
}  // namespace forelock::reference
