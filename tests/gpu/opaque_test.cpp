// Opaque meshes beside hair: their depth, their shadow on hair, and hair's on them. SPDX-License-Identifier: MIT
#include "opaque_scene.h"

#include "bust.h"
#include "bust_shape.h"
#include "scene.h"

#include <forelock/forelock.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::test {
namespace {

using samples::Camera;
using samples::OpaqueLight;
using samples::OpaqueLook;
using samples::OpaqueMesh;
using samples::OpaqueScene;

constexpr uint32_t kSize = 256;

Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double fov) {
  Camera camera;
  camera.eye = eye;
  camera.target = target;
  camera.vertical_fov = fov;
  camera.near_m = 0.1;
  camera.far_m = 10.0;
  return camera;
}

// Level, facing up, x in [x0, x1], z in [-half, half].
OpaqueMesh plate(float x0, float x1, float half, float y) {
  OpaqueMesh mesh;
  mesh.positions = {x0, y, half, x1, y, half, x1, y, -half, x0, y, -half};
  mesh.normals = {0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.label = "plate";
  return mesh;
}

// Strands along x, side by side in z in [-0.05, 0.05], at height y.
StrandArrays carpet(float x0, float x1, float y) {
  StrandArrays strands;
  for (int i = 0; i <= 100; ++i) {
    const float z = -0.05f + 0.001f * static_cast<float>(i);
    strands.add({{x0, y, z}, {0.5f * (x0 + x1), y, z}, {x1, y, z}}, 0.0004f);
  }
  return strands;
}

struct Drawn {
  std::vector<float> hair, opaque, depth;
  uint32_t maps = 0;
  bool host_maps = false;
  bool host_shadow = false;
  const float* hairAt(uint32_t x, uint32_t y) const { return &hair[(size_t{y} * kSize + x) * 4]; }
  const float* opaqueAt(uint32_t x, uint32_t y) const { return &opaque[(size_t{y} * kSize + x) * 4]; }
};

FlkLight hairLight(const OpaqueLight& light) {
  FlkLight made{};
  made.kind = light.kind;
  for (int i = 0; i < 3; ++i) {
    made.direction[i] = light.to_light[i];
    made.position[i] = light.position[i];
    made.radiance[i] = light.color[i];
  }
  made.inner_angle = light.inner_angle, made.outer_angle = light.outer_angle;
  made.casts_shadow = light.casts_shadow ? 1 : 0;
  made.shadow_size = 1024;
  return made;
}

Drawn draw(const StrandArrays& strands, std::vector<OpaqueMesh> meshes, const Camera& camera, OpaqueLook look) {
  Drawn drawn;
  std::string error;
  const auto opaque = OpaqueScene::create(host(), std::move(meshes), error);
  EXPECT_TRUE(opaque) << error;
  FlkStrands arrays = strandsDesc();
  arrays.strand_count = strands.strands();
  arrays.vertex_count = static_cast<uint32_t>(strands.radii.size());
  arrays.first_vertex = strands.first_vertex.data();
  arrays.positions = strands.positions.data();
  arrays.radii = strands.radii.data();
  Asset asset;
  EXPECT_EQ(create(arrays, nullptr, asset), FLK_SUCCESS);
  FlkMaterial material;
  flkMaterialDefault(&material);
  FlkHairDesc desc = hairDesc();
  desc.asset = asset;
  desc.material = &material;
  FlkHair made = nullptr;
  EXPECT_EQ(host().createHair(desc, &made), FLK_SUCCESS);
  const Hair hair(made);
  View view;
  EXPECT_EQ(create(host().context(), viewDesc(), view), FLK_SUCCESS);

  FlkFrame frame = frameDesc();
  samples::viewMatrix(camera, frame.view_from_world);
  samples::projectionMatrix(camera, 1.0, frame.clip_from_view);
  frame.reversed_depth = camera.reversed_depth ? 1 : 0;
  frame.hairs = &made;
  frame.hair_count = 1;
  std::vector<FlkLight> lights;
  for (const OpaqueLight& light : look.lights) lights.push_back(hairLight(light));
  frame.lights = lights.data();
  frame.light_count = static_cast<uint32_t>(lights.size());
  look.fibre_spacing_m = material.fibre_spacing;
  look.shadow_opacity = material.shadow_opacity;

  samples::GpuImage target;
  EXPECT_TRUE(host().resize(kSize, kSize));
  EXPECT_TRUE(host().resources().createImage({kSize, kSize, 1, VK_IMAGE_VIEW_TYPE_2D, VK_FORMAT_R16G16B16A16_SFLOAT,
                                              VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                              VK_IMAGE_ASPECT_COLOR_BIT},
                                             target));
  EXPECT_TRUE(opaque->prepare(camera, 1.0, kSize, kSize, look));
  samples::HeadlessHost::Around around;
  around.fill = [&](FlkFrame& filled) { opaque->fillFrame(filled, lights); };
  around.before = [&](VkCommandBuffer cmd) { opaque->recordDepth(cmd); };
  around.after = [&](VkCommandBuffer cmd) { opaque->recordColor(cmd, view, target); };
  for (int i = 0; i < 2; ++i) {  // again, so that what a frame leaves behind meets the next one
    EXPECT_EQ(host().render(view, frame, nullptr, around), FLK_SUCCESS);
  }
  drawn.hair = host().readColor();
  drawn.opaque = host().readImage(target, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  if (!opaque->empty()) drawn.depth = host().readImage(opaque->depth(), VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
  drawn.maps = opaque->shadowMapCount();
  drawn.host_maps = frame.host_shadow_maps.image != VK_NULL_HANDLE;
  drawn.host_shadow = std::any_of(lights.begin(), lights.end(), [](const FlkLight& light) { return light.host_shadow; });
  host().resources().destroy(target);
  return drawn;
}

OpaqueLight sun(const glm::vec3& to_light) {
  OpaqueLight light;
  light.to_light = glm::normalize(to_light);
  return light;
}

OpaqueLight lamp(uint32_t kind, const glm::dvec3& position) {
  OpaqueLight light;
  light.kind = kind;
  light.position = position;
  light.to_light = glm::normalize(glm::vec3(position));
  light.inner_angle = 0.3f, light.outer_angle = 0.5f;
  return light;
}

OpaqueLook lit(const OpaqueLight& light) {
  OpaqueLook look;
  look.lights = {light};
  look.ambient = glm::vec3(0.0f);
  return look;
}

// ---- Depth ----

// As in the mesh's own test: how far its triangles lie from the field.
constexpr double kChord = 0.5e-3;

// Where the ray first meets the field, by steps that its slender parts cannot outrun; infinity where it does not. `least`: of the field on the way.
double castRay(const glm::dvec3& origin, const glm::dvec3& direction, double from, double to, double& least) {
  least = 1.0;
  for (double t = from; t < to;) {
    const double d = samples::shape::bust<double>(origin + direction * t);
    least = std::min(least, d);
    if (d < 1e-7) return t;
    t += std::max(0.5 * d, 1e-6);
  }
  return std::numeric_limits<double>::infinity();
}

void expectDepthOfBust(Camera camera) {
  const Drawn drawn = draw(carpet(-0.05f, 0.05f, 0.3f), {samples::bustMesh()}, camera, lit(sun({0, 1, 0})));
  float projection[16];
  samples::projectionMatrix(camera, 1.0, projection);
  const samples::CameraBasis basis = samples::cameraBasis(camera);
  const double half = camera.orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.vertical_fov);
  size_t covered = 0, agree = 0, both = 0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = 0; x < kSize; ++x) {
      const glm::dvec3 across = basis.right * ((x + 0.5) * 2.0 / kSize - 1.0) * half + basis.up * (1.0 - (y + 0.5) * 2.0 / kSize) * half;
      const glm::dvec3 origin = camera.orthographic ? camera.eye + across : camera.eye;
      const glm::dvec3 ray = camera.orthographic ? -basis.back : across - basis.back;  // view depth 1
      const double length = glm::length(ray);
      const double value = static_cast<double>(drawn.depth[size_t{y} * kSize + x]);
      const bool hit = value != (camera.reversed_depth ? 0.0 : 1.0);
      EXPECT_EQ(drawn.opaqueAt(x, y)[3], hit ? 1.0f : 0.0f) << "the colour pass meets every pixel of the depth pass";
      const double p10 = static_cast<double>(projection[10]), p14 = static_cast<double>(projection[14]);
      const double depth = camera.orthographic ? (p14 - value) / p10 : p14 / (value + p10);
      double least = 1.0;
      const double cast = castRay(origin, ray / length, 0.3, hit ? depth * length + 0.05 : 3.0, least) / length;
      if (!hit) {
        // A ray that meets the field only grazes it: no deeper than triangles lie inside.
        EXPECT_TRUE(!std::isfinite(cast) || samples::shape::bust<double>(origin + ray * cast + ray / length * 1e-3) > -kChord) << x << " " << y;
        continue;
      }
      ++covered;
      const glm::dvec3 p = origin + ray * depth;
      EXPECT_LT(std::fabs(samples::shape::bust<double>(p)), kChord) << x << " " << y << ": not on the surface";
      if (!std::isfinite(cast)) continue;
      ++both;
      const double facing = std::fabs(glm::dot(samples::shape::bustNormal<double>(origin + ray * cast), ray / length));
      agree += std::fabs(cast - depth) * length * facing <= kChord ? 1 : 0;
    }
  }
  EXPECT_GT(covered, kSize * kSize / 8);
  EXPECT_GE(static_cast<double>(both), 0.995 * static_cast<double>(covered));
  EXPECT_GE(static_cast<double>(agree), 0.995 * static_cast<double>(both)) << "all but rims, where one of the two passes by";
}

TEST(Opaque, DepthOfTheBustIsThatOfItsField) {
  expectDepthOfBust(cameraAt({0.6, 0.05, 1.2}, {0, -0.1, 0}, 0.45));
}

TEST(Opaque, DepthOrthographicAndReversed) {
  Camera camera = cameraAt({-0.5, 0.0, 1.0}, {0, -0.05, 0}, 0.5);
  camera.reversed_depth = true;
  expectDepthOfBust(camera);
  camera.orthographic = true;
  camera.view_height = 0.5;
  expectDepthOfBust(camera);
}

// ---- Shadows ----

// Mean green of hair in a band of columns, over its alpha.
double hairMean(const Drawn& drawn, uint32_t x0, uint32_t x1) {
  double color = 0.0, alpha = 0.0;
  for (uint32_t y = 0; y < kSize; ++y) {
    for (uint32_t x = x0; x < x1; ++x) {
      color += static_cast<double>(drawn.hairAt(x, y)[1]);
      alpha += static_cast<double>(drawn.hairAt(x, y)[3]);
    }
  }
  EXPECT_GT(alpha, 30.0);
  return color / alpha;
}

// A carpet of hair whose left half lies below a plate, which the camera looks under.
TEST(Opaque, MeshesDarkenHairBelowThem) {
  const Camera camera = cameraAt({0, 0.12, 1.0}, {0, 0, 0}, 0.25);
  const StrandArrays hair = carpet(-0.1f, 0.1f, 0.0f);
  for (const OpaqueLight& light : {sun({0, 1, 0}), lamp(FLK_LIGHT_POINT, {0, 1, 0}), lamp(FLK_LIGHT_SPOT, {0, 1, 0})}) {
    const Drawn bare = draw(hair, {plate(-0.2f, 0.0f, 0.1f, -1.0f)}, camera, lit(light));
    const Drawn below = draw(hair, {plate(-0.2f, 0.0f, 0.1f, 0.2f)}, camera, lit(light));
    EXPECT_EQ(below.maps, 1u);
    EXPECT_TRUE(below.host_maps && below.host_shadow);
    // Columns are 1 mm wide: 28 of them leave out the edge of the shadow, which of a lamp is 25 % farther out than the plate's.
    EXPECT_LT(hairMean(below, 20, 100), 1e-4) << "kind " << light.kind << ": all of the light is behind the plate";
    EXPECT_NEAR(hairMean(below, 160, 230) / hairMean(bare, 160, 230), 1.0, 1e-3) << "kind " << light.kind << ": beside it nothing changes";
  }
}

TEST(Opaque, HairDarkensMeshesBelowIt) {
  const Camera camera = cameraAt({0, 0.5, 0.8}, {0, 0, 0}, 0.35);
  StrandArrays hair = carpet(-0.15f, 0.0f, 0.06f);
  for (float y : {0.062f, 0.064f, 0.066f, 0.068f, 0.070f}) {  // five layers
    const StrandArrays more = carpet(-0.15f, 0.0f, y);
    for (uint32_t s = 0; s < more.strands(); ++s) {
      const float* p = &more.positions[size_t{9} * s];
      hair.add({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}}, 0.0004f);
    }
  }
  for (const OpaqueLight& light : {sun({0, 1, 0}), lamp(FLK_LIGHT_POINT, {0, 1, 0}), lamp(FLK_LIGHT_SPOT, {0, 1, 0})}) {
    OpaqueLight no_shadow = light;
    no_shadow.casts_shadow = false;
    const std::vector<OpaqueMesh> floor{plate(-0.3f, 0.3f, 0.2f, 0.0f)};
    const Drawn shadowed = draw(hair, floor, camera, lit(light)), open = draw(hair, floor, camera, lit(no_shadow));
    // Points of the plate at (-0.07, 0) and (0.1, 0).
    const auto ratioAt = [&](double x) {
      const double half = std::tan(0.5 * camera.vertical_fov) * glm::length(camera.eye);
      const auto column = static_cast<uint32_t>((x / half + 1.0) * 0.5 * kSize);
      return static_cast<double>(shadowed.opaqueAt(column, kSize / 2)[1] / open.opaqueAt(column, kSize / 2)[1]);
    };
    // A texel of hair's map is written where a strand is: 0.06 m or more behind it, of which fibre_spacing 1.5 mm and shadow_opacity 0.35 let
    // through exp2(-0.06 / 0.0015 * 0.62) = 3e-8. Strands of 0.8 mm every 1 mm leave a share of 0.2 open where layers line up.
    EXPECT_LT(ratioAt(-0.07), 0.35) << "kind " << light.kind;
    EXPECT_NEAR(ratioAt(0.1), 1.0, 2e-3) << "kind " << light.kind;
  }
}

// A plate in a shadow of another, and none of its own.
TEST(Opaque, MeshesDarkenEachOtherAndNotThemselves) {
  const Camera camera = cameraAt({0, 0.5, 0.8}, {0, 0, 0}, 0.5);
  const StrandArrays hair = carpet(2.0f, 2.1f, 0.0f);
  for (const glm::vec3 towards : {glm::vec3(0, 1, 0), glm::vec3(0.3f, 0.2f, 0.1f), glm::vec3(-1.0f, 0.12f, 0.4f)}) {
    OpaqueLight without = sun(towards);
    without.casts_shadow = false;
    const std::vector<OpaqueMesh> alone{plate(-0.2f, 0.2f, 0.15f, 0.0f)};
    const Drawn own = draw(hair, alone, camera, lit(sun(towards))), open = draw(hair, alone, camera, lit(without));
    for (size_t i = 0; i < own.opaque.size(); ++i) ASSERT_NEAR(own.opaque[i], open.opaque[i], 1e-3f * open.opaque[i]) << "acne " << i;
  }
  const std::vector<OpaqueMesh> two{plate(-0.2f, 0.2f, 0.15f, 0.0f), plate(-0.2f, 0.0f, 0.02f, 0.1f)};
  const Drawn both = draw(hair, two, camera, lit(sun({0, 1, 0})));
  EXPECT_LT(both.opaqueAt(80, 128)[1], 1e-4f);
  EXPECT_GT(both.opaqueAt(170, 128)[1], 0.05f);
}

// Roots lie on the scalp: strands that stand on the bust are lit where it is, and dark behind it.
TEST(Opaque, RootsOnTheScalpAreLit) {
  StrandArrays towards, away;
  for (int i = 0; i < 400; ++i) {
    const double a = 0.12 * i, r = 0.8 * std::sqrt((i + 0.5) / 400.0);  // of the upper hemisphere the middle
    glm::dvec3 p = glm::dvec3(r * std::cos(a), std::sqrt(1.0 - r * r), r * std::sin(a)) * 0.2;
    double least = 0.0;
    const glm::dvec3 in = -glm::normalize(p);
    p += in * castRay(p, in, 0.0, 0.3, least);
    const glm::dvec3 n = samples::shape::bustNormal<double>(p);
    const glm::dvec3 under = p - n * 0.0005, over = p + n * 0.004;
    (n.x > 0.3 ? towards : away).add({{float(under.x), float(under.y), float(under.z)}, {float(over.x), float(over.y), float(over.z)}}, 0.0003f);
  }
  const std::vector<OpaqueMesh> bust{samples::bustMesh()};
  const auto mean = [&](const StrandArrays& strands, const glm::dvec3& eye, bool shadow) {
    OpaqueLight light = sun({1, 0, 0});
    light.casts_shadow = shadow;
    return hairMean(draw(strands, bust, cameraAt(eye, {0, 0.05, 0}, 0.3), lit(light)), 0, kSize);
  };
  const glm::dvec3 right(0.8, 0.8, 0), left(-0.8, 0.8, 0);
  EXPECT_GT(mean(towards, right, true), 0.95 * mean(towards, right, false));
  // Strands of |n.x| below 0.3 about the terminator are still lit.
  EXPECT_LT(mean(away, left, true), 0.6 * mean(away, left, false));
}

TEST(Opaque, WithoutShadowsThereAreNoMaps) {
  OpaqueLight light = sun({0, 1, 0});
  light.casts_shadow = false;
  const Drawn drawn = draw(carpet(-0.1f, 0.1f, 0.0f), {plate(-0.2f, 0.0f, 0.1f, 0.2f)}, cameraAt({0, 0.12, 1.0}, {0, 0, 0}, 0.25), lit(light));
  EXPECT_EQ(drawn.maps, 0u);
  EXPECT_FALSE(drawn.host_maps);
  EXPECT_FALSE(drawn.host_shadow);
  EXPECT_GT(hairMean(drawn, 20, 100), 0.01);
}

TEST(Opaque, AScoreOfLightsHasEightMaps) {
  OpaqueLook look;
  for (int i = 0; i < 20; ++i) look.lights.push_back(sun({std::cos(0.3f * static_cast<float>(i)), 1.0f, std::sin(0.3f * static_cast<float>(i))}));
  look.lights[1] = lamp(FLK_LIGHT_POINT, {0, 0.05, 0});  // amid the plates: none
  const Drawn drawn = draw(carpet(-0.1f, 0.1f, 0.0f), {plate(-0.2f, 0.2f, 0.1f, 0.1f), plate(-0.2f, 0.2f, 0.1f, -0.1f)},
                           cameraAt({0, 0.12, 1.0}, {0, 0, 0}, 0.25), look);
  EXPECT_EQ(drawn.maps, 8u);
}

TEST(Opaque, NothingIsNothing) {
  const Drawn drawn = draw(carpet(-0.1f, 0.1f, 0.0f), {}, cameraAt({0, 0.12, 1.0}, {0, 0, 0}, 0.25), lit(sun({0, 1, 0})));
  EXPECT_EQ(drawn.maps, 0u);
  EXPECT_GT(hairMean(drawn, 20, 230), 0.01);
}

}  // namespace
}  // namespace forelock::test
