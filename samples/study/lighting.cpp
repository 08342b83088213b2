// SPDX-License-Identifier: MIT
#include "lighting.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace forelock::study {

using namespace samples;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

glm::dvec3 intoWorld(const Camera& camera, double x, double y, double z) {
  const CameraBasis basis = cameraBasis(camera);
  return basis.right * x + basis.up * y + basis.back * z;
}

FlkLight sceneLight(const SceneLight& wanted, const Camera& camera) {
  FlkLight light{};
  light.kind = wanted.kind;
  glm::dvec3 towards(0.0);
  if (wanted.kind == FLK_LIGHT_DIRECTIONAL) {
    const double azimuth = wanted.azimuth_deg * kDegree, elevation = wanted.elevation_deg * kDegree;
    towards = intoWorld(camera, std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation));
  } else if (wanted.kind == FLK_LIGHT_SPOT) {
    towards = glm::normalize(wanted.position - wanted.target);
  }
  for (int i = 0; i < 3; ++i) {
    light.direction[i] = float(towards[i]);
    light.radiance[i] = float(wanted.color[i] * wanted.intensity);
    light.position[i] = wanted.position[i];
  }
  light.range = float(wanted.range_m);
  light.source_radius = float(wanted.source_radius_mm * 1e-3);
  light.inner_angle = float(wanted.inner_angle_deg * kDegree);
  light.outer_angle = float(wanted.outer_angle_deg * kDegree);
  light.casts_shadow = wanted.shadow;
  light.shadow_size = wanted.shadow_size;
  light.shadow_cover = wanted.shadow_cover;
  return light;
}

}  // namespace

void Lighting::scale(double factor) {
  for (FlkLight& light : lights)
    for (float& c : light.radiance) c = float(double(c) * factor);
  for (float& c : ambient) c = float(double(c) * factor);
  for (float& c : ambient_sh) c = float(double(c) * factor);
}

Lighting makeLighting(const Subject& subject, const Camera& camera, uint32_t count) {
  Lighting lighting;
  if (!subject.has_setting) {
    for (uint32_t i = 0; i < count && i < kConditionLightCount; ++i) {
      const ConditionLight& given = kConditionLights[i];
      FlkLight light{};
      const glm::dvec3 towards = intoWorld(camera, given.to_light[0], given.to_light[1], given.to_light[2]);
      for (int c = 0; c < 3; ++c) light.direction[c] = float(towards[c]), light.radiance[c] = float(given.strength);
      light.casts_shadow = 1;
      light.shadow_size = kDefaultShadowSize;
      lighting.lights.push_back(light);
    }
    return lighting;
  }
  const Scene& scene = subject.scene;
  for (const SceneLight& wanted : scene.lights) lighting.lights.push_back(sceneLight(wanted, camera));
  for (int c = 0; c < 3; ++c) lighting.ambient[c] = float(scene.ambient[c]);
  lighting.has_sh = scene.sky || scene.ambient_sh;
  if (lighting.has_sh) {
    const glm::dvec3 up = scene.camera.up == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const Harmonics harmonics = scene.sky ? skyHarmonics(*scene.sky, up) : *scene.ambient_sh;
    for (std::size_t i = 0; i < 27; ++i) lighting.ambient_sh[i] = float(harmonics[i / 3][int(i % 3)]);
  }
  return lighting;
}

uint32_t shadowSizeOf(const Lighting& lighting) {
  for (const FlkLight& light : lighting.lights)
    if (light.casts_shadow) return light.shadow_size;
  return kDefaultShadowSize;
}

}  // namespace forelock::study
