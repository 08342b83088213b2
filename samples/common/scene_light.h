// What lights a scene: lights, and a sky around it. docs/scene.md explains every key. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/render.h>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

struct SceneLight {
  uint32_t kind = FLK_LIGHT_DIRECTIONAL;
  // Directional, seen from the camera: azimuth 0 shines along the view, negative comes from the left.
  double azimuth_deg = -42.0;
  double elevation_deg = 44.0;
  // Point and spot, in the world.
  glm::dvec3 position{0.0, 0.0, 0.0};  // (m)
  glm::dvec3 target{0.0, 0.0, 0.0};    // (m) a spot shines there
  double range_m = 0.0;                // 0: no end
  double source_radius_mm = 10.0;
  double inner_angle_deg = 20.0;       // of a spot: from the axis
  double outer_angle_deg = 30.0;
  glm::dvec3 color{1.0, 0.97, 0.93};   // linear
  double intensity = 1.0;              // times the exposure: what arrives, of point and spot at one metre
  bool shadow = true;
  uint32_t shadow_size = 2048;
  uint32_t shadow_cover = FLK_SHADOW_COVER_TEXEL;
};

// Radiance over directions, as a share of the light's: linear from the bottom over the horizon to the top in the sine of
// the elevation.
struct SceneSky {
  glm::dvec3 top, horizon, bottom;  // linear
  double intensity = 0.15;
};

// Nine coefficients by real spherical harmonics in the order of FlkFrame.ambient_sh.
using Harmonics = std::array<glm::dvec3, 9>;
std::array<double, 9> harmonicsBasis(const glm::dvec3& unit);
Harmonics skyHarmonics(const SceneSky& sky, const glm::dvec3& up);

// What arrives at a point of a light of radiance 1, shadows and a spot's cone left out: docs/methods.md section 4.
double lightFalloff(const SceneLight& light, const glm::dvec3& point);

// Each throws SceneError or RecipeError; `path` is how messages call the key.
SceneLight readLight(const nlohmann::json& json, const std::string& path);
SceneSky readSky(const nlohmann::json& json);
Harmonics readHarmonics(const nlohmann::json& json);

// As the readers read them back.
nlohmann::ordered_json lightJson(const SceneLight& light);
nlohmann::ordered_json skyJson(const SceneSky& sky);

const std::vector<std::string>& lightKindNames();
const std::vector<std::string>& shadowCoverNames();

}  // namespace forelock::samples
