// Hair shadow maps: which faces a light has, what they see, and where they lie in their image.
#include "plan/shadow_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace forelock {
namespace {

// A hair whose sphere lies around `center`, of about `radius`.
HairFacts hairAt(const Vec3& center, double radius) {
  HairFacts hair;
  hair.segments = 100;
  const double half = radius / std::sqrt(3.0);
  hair.bounds = {{-half, -half, -half}, {half, half, half}};
  hair.world_from_hair[12] = center[0], hair.world_from_hair[13] = center[1], hair.world_from_hair[14] = center[2];
  return hair;
}

LightFacts sun(uint32_t size) {
  LightFacts light;
  light.casts_shadow = true, light.shadow_size = size;
  light.direction = normalize({0.3, 1, 0.5});
  return light;
}

LightFacts pointAt(const Vec3& position, uint32_t size) {
  LightFacts light = sun(size);
  light.kind = LightKind::point, light.position = position;
  return light;
}

LightFacts spotAt(const Vec3& position, const Vec3& towards, double outer, uint32_t size) {
  LightFacts light = pointAt(position, size);
  light.kind = LightKind::spot, light.outer_angle = outer;
  light.direction = normalize(position - towards);
  return light;
}

struct Placed {
  const char* fault;
  ShadowLayout layout;
};

Placed place(const std::vector<LightFacts>& lights, const std::vector<HairFacts>& hairs, uint32_t limit = 16384) {
  Placed placed{};
  placed.fault = layoutShadowMaps(lights, hairs, limit, placed.layout);
  return placed;
}

// Texel of the map (from its corner) and depth of a world position, by docs/methods.md section 4.
struct Texel {
  double x, y, depth, along;
};
Texel texelOf(const ShadowFace& face, const Vec3& world) {
  const Vec3 v = transformPoint(face.map_from_world, world);
  const double middle = face.size / 2.0;
  if (face.focal == 0) return {v[0] + middle, v[1] + middle, v[2], v[2]};
  return {middle + face.focal * v[0] / v[2], middle + face.focal * v[1] / v[2], length(v), v[2]};
}

// Points all over the surface of a sphere.
std::vector<Vec3> surface(const Vec3& center, double radius) {
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) {
    const double z = 1 - 2 * (i + 0.5) / 500, turn = 2.399963229728653 * i, across = std::sqrt(1 - z * z);
    points.push_back(center + Vec3{across * std::cos(turn), across * std::sin(turn), z} * radius);
  }
  return points;
}

void expectApart(const ShadowLayout& layout, uint32_t limit) {
  EXPECT_LE(layout.width, limit);
  EXPECT_LE(layout.height, limit);
  uint32_t right = 0, bottom = 0;
  for (std::size_t i = 0; i < layout.faces.count; ++i) {
    const ShadowFace& a = layout.faces.items[i];
    right = std::max(right, a.x + a.size), bottom = std::max(bottom, a.y + a.size);
    for (std::size_t j = 0; j < i; ++j) {
      const ShadowFace& b = layout.faces.items[j];
      EXPECT_TRUE(a.x + a.size <= b.x || b.x + b.size <= a.x || a.y + a.size <= b.y || b.y + b.size <= a.y) << i << " over " << j;
    }
  }
  // Not a texel more than they take.
  EXPECT_EQ(layout.width, right);
  EXPECT_EQ(layout.height, bottom);
}

TEST(ShadowMaps, NoneWithoutALightThatCasts) {
  LightFacts light = sun(512);
  light.casts_shadow = false;
  const Placed placed = place({light, light}, {hairAt({0, 0, 0}, 0.1)});
  EXPECT_EQ(placed.fault, nullptr);
  EXPECT_EQ(placed.layout.faces.count, 0u);
  EXPECT_EQ(placed.layout.width, 0u);
  EXPECT_EQ(placed.layout.height, 0u);
}

TEST(ShadowMaps, OneSunIsTheWholeImage) {
  for (const uint32_t size : {64u, 512u, 1000u, 8192u}) {
    const Placed placed = place({sun(size)}, {hairAt({1, 2, 3}, 0.2)});
    ASSERT_EQ(placed.fault, nullptr);
    ASSERT_EQ(placed.layout.faces.count, 1u);
    EXPECT_EQ(placed.layout.width, size);
    EXPECT_EQ(placed.layout.height, size);
    const ShadowFace& face = placed.layout.faces.items[0];
    EXPECT_EQ(face.x, 0u);
    EXPECT_EQ(face.y, 0u);
    EXPECT_EQ(face.focal, 0.0);
    // The sphere, front at depth 0 and back at the range, fills the map.
    for (const Vec3& p : surface({1, 2, 3}, 0.2)) {
      const Texel texel = texelOf(face, p);
      EXPECT_GE(texel.x, 0.0);
      EXPECT_LE(texel.x, double(size));
      EXPECT_GE(texel.y, 0.0);
      EXPECT_LE(texel.y, double(size));
      EXPECT_GE(texel.depth, 0.0);
      EXPECT_LE(texel.depth, face.range);
    }
    EXPECT_NEAR(face.range, 0.4, 0.002);
    EXPECT_NEAR(face.texel * size, face.range, 1e-12);
  }
}

TEST(ShadowMaps, APointLightOutsideHasOneMapOfTheSphere) {
  const Vec3 center{0, 1, 0};
  const HairFacts hair = hairAt(center, 0.2);
  const Sphere sphere = sphereOfAll({&hair, 1});
  for (const double away : {1.2501, 2.0, 30.0}) {
    const Vec3 light = center + normalize({1, -2, 0.5}) * (away * sphere.radius);
    const Placed placed = place({pointAt(light, 256)}, {hair});
    ASSERT_EQ(placed.fault, nullptr);
    ASSERT_EQ(placed.layout.faces.count, 1u) << away;
    const ShadowFace& face = placed.layout.faces.items[0];
    EXPECT_GT(face.focal, 0.0);
    EXPECT_GT(face.near, 0.0);
    for (const Vec3& p : surface(center, sphere.radius)) {
      const Texel texel = texelOf(face, p);
      // 3 texels are left for taps around the last fragment.
      EXPECT_GE(texel.x, 3 - 1e-6);
      EXPECT_LE(texel.x, 253 + 1e-6);
      EXPECT_GE(texel.y, 3 - 1e-6);
      EXPECT_LE(texel.y, 253 + 1e-6);
      EXPECT_GE(texel.along, face.near - 1e-9);
      EXPECT_LE(texel.depth, face.range + 1e-9);
    }
  }
}

TEST(ShadowMaps, APointLightAmidHairHasSix) {
  const Vec3 center{0, 1, 0};
  const HairFacts hair = hairAt(center, 0.2);
  const Sphere sphere = sphereOfAll({&hair, 1});
  for (const double away : {0.0, 0.5, 1.0, 1.2499}) {
    const Vec3 light = center + normalize({1, -2, 0.5}) * (away * sphere.radius);
    const Placed placed = place({pointAt(light, 256)}, {hair});
    ASSERT_EQ(placed.fault, nullptr);
    ASSERT_EQ(placed.layout.faces.count, 6u) << away;
    expectApart(placed.layout, 16384);
    for (const Vec3& p : surface(center, sphere.radius)) {
      // In the map of the largest component, and by the light's own way.
      const Vec3 v = p - light;
      uint32_t face_index = 0;
      for (uint32_t i = 0; i < 6; ++i) {
        const double component = i % 2 ? -v[i / 2] : v[i / 2], best = face_index % 2 ? -v[face_index / 2] : v[face_index / 2];
        if (component > best) face_index = i;
      }
      const ShadowFace& face = placed.layout.faces.items[face_index];
      EXPECT_EQ(face.face, face_index);
      const Texel texel = texelOf(face, p);
      EXPECT_GE(texel.x, 3 - 1e-6);
      EXPECT_LE(texel.x, 253 + 1e-6);
      EXPECT_GE(texel.y, 3 - 1e-6);
      EXPECT_LE(texel.y, 253 + 1e-6);
      EXPECT_NEAR(texel.depth, length(v), 1e-9);
      EXPECT_LE(texel.depth, face.range + 1e-9);
    }
  }
}

TEST(ShadowMaps, ASpotTakesTheNarrowerOfConeAndSphere) {
  const Vec3 center{0, 0, 0};
  const HairFacts hair = hairAt(center, 0.2);
  const Sphere sphere = sphereOfAll({&hair, 1});
  const Vec3 light{0, 1, 0};
  const double seen = std::asin(sphere.radius);  // the sphere's half angle from one metre
  // Aimed past the middle: the cone's map looks along the spot, the sphere's at the sphere.
  const Vec3 towards{0.05, 0, 0};
  const Placed narrow = place({spotAt(light, towards, seen / 2, 256)}, {hair});
  ASSERT_EQ(narrow.layout.faces.count, 1u);
  EXPECT_NEAR(narrow.layout.faces.items[0].focal, (128 - 3) / std::tan(seen / 2), 1e-9);
  EXPECT_NEAR(texelOf(narrow.layout.faces.items[0], towards).x, 128, 1e-6);
  const Placed wide = place({spotAt(light, towards, 2 * seen, 256)}, {hair});
  ASSERT_EQ(wide.layout.faces.count, 1u);
  EXPECT_NEAR(wide.layout.faces.items[0].focal, (128 - 3) / std::tan(seen), 1e-6);
  EXPECT_NEAR(texelOf(wide.layout.faces.items[0], center).x, 128, 1e-6);
  // Amid hair: one up to 60 degrees, six beyond.
  EXPECT_EQ(place({spotAt({0.01, 0, 0}, {1, 0, 0}, 1.04, 256)}, {hair}).layout.faces.count, 1u);
  EXPECT_EQ(place({spotAt({0.01, 0, 0}, {1, 0, 0}, 1.05, 256)}, {hair}).layout.faces.count, 6u);
}

TEST(ShadowMaps, FacesFollowTheirLights) {
  LightFacts dark = sun(256);
  dark.casts_shadow = false;
  const HairFacts hair = hairAt({0, 0, 0}, 0.2);
  const Placed placed = place({sun(256), dark, pointAt({0, 0, 0}, 128), sun(512)}, {hair});
  ASSERT_EQ(placed.layout.faces.count, 8u);
  const uint32_t lights[] = {0, 2, 2, 2, 2, 2, 2, 3}, faces[] = {0, 0, 1, 2, 3, 4, 5, 0};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(placed.layout.faces.items[i].light, lights[i]);
    EXPECT_EQ(placed.layout.faces.items[i].face, faces[i]);
  }
  expectApart(placed.layout, 16384);
}

TEST(ShadowMaps, UpTo96OfAnySizeLieApart) {
  const HairFacts hair = hairAt({0, 0, 0}, 0.2);
  uint64_t state = 1;
  for (int round = 0; round < 200; ++round) {
    std::vector<LightFacts> lights;
    const std::size_t count = round == 0 ? 96 : 1 + std::size_t(state >> 33) % 96;
    double area = 0;
    for (std::size_t i = 0; i < count; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      const uint32_t size = 64 + uint32_t(state >> 40) % 992 * 2;
      area += double(size) * size;
      lights.push_back(sun(size));
    }
    const Placed placed = place(lights, {hair});
    ASSERT_EQ(placed.fault, nullptr) << round;
    ASSERT_EQ(placed.layout.faces.count, count);
    expectApart(placed.layout, 16384);
    // At least a third of the image is maps, once there are some.
    if (count >= 16) { EXPECT_LT(double(placed.layout.width) * placed.layout.height, 3 * area) << round; }
  }
}

TEST(ShadowMaps, EqualMapsFillTheLimit) {
  const HairFacts hair = hairAt({0, 0, 0}, 0.2);
  EXPECT_EQ(place(std::vector<LightFacts>(64, sun(512)), {hair}, 4096).fault, nullptr);
  EXPECT_EQ(place(std::vector<LightFacts>(4, sun(8192)), {hair}, 16384).fault, nullptr);
  EXPECT_NE(place(std::vector<LightFacts>(65, sun(512)), {hair}, 4096).fault, nullptr);
  EXPECT_NE(place({sun(8192)}, {hair}, 4096).fault, nullptr);
}

TEST(ShadowMaps, MoreThan96IsAFault) {
  const HairFacts hair = hairAt({0, 0, 0}, 0.2);
  EXPECT_EQ(place(std::vector<LightFacts>(96, sun(64)), {hair}).fault, nullptr);
  EXPECT_NE(place(std::vector<LightFacts>(97, sun(64)), {hair}).fault, nullptr);
  EXPECT_EQ(place(std::vector<LightFacts>(16, pointAt({0, 0, 0}, 64)), {hair}).fault, nullptr);
  EXPECT_NE(place(std::vector<LightFacts>(17, pointAt({0, 0, 0}, 64)), {hair}).fault, nullptr);
}

TEST(ShadowMaps, TheSphereHoldsAllHairs) {
  const std::vector<HairFacts> hairs = {hairAt({0, 0, 0}, 0.1), hairAt({3, 0, 0}, 0.2), hairAt({1, -2, 4}, 0.05)};
  const Sphere all = sphereOfAll(hairs);
  for (const HairFacts& hair : hairs) {
    const Sphere one = sphereOfAll({&hair, 1});
    EXPECT_LE(length(one.center - all.center) + one.radius, all.radius * (1 + 1e-12));
  }
}

// As far and as narrow as render.h allows: nothing that is not finite reaches the device, as float.
TEST(ShadowMaps, ExtremesStayFinite) {
  const HairFacts hair = hairAt({0, 0, 0}, 0.1);
  const std::vector<LightFacts> lights = {pointAt({1e15, 0, 0}, 64), spotAt({1e15, -1e15, 0}, {0, 0, 0}, 1.5, 64),
                                          spotAt({0, 1, 0}, {0, 0, 0}, 1e-38, 64), pointAt({0, 0, 0}, 64), sun(64)};
  const Placed placed = place(lights, {hair});
  ASSERT_EQ(placed.fault, nullptr);
  for (const ShadowFace& face : placed.layout.faces) {
    for (const double value : {face.focal, face.texel, face.range, face.near}) {
      EXPECT_TRUE(std::isfinite(value) && std::abs(value) < 3e38) << face.light << ' ' << value;
    }
    for (const double value : face.map_from_world) EXPECT_TRUE(std::isfinite(value) && std::abs(value) < 3e38) << face.light;
  }
}

}  // namespace
}  // namespace forelock
