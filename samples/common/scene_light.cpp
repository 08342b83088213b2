// SPDX-License-Identifier: MIT
#include "scene_light.h"

#include "scene_keys.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

// Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001, equation 3.
std::array<double, 9> harmonicsBasis(const glm::dvec3& d) {
  const double band1 = std::sqrt(3.0 / (4.0 * kPi)), band2 = std::sqrt(15.0 / (4.0 * kPi));
  return {std::sqrt(1.0 / (4.0 * kPi)), band1 * d.y, band1 * d.z, band1 * d.x, band2 * d.x * d.y, band2 * d.y * d.z,
          std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * d.z * d.z - 1.0), band2 * d.x * d.z,
          0.5 * band2 * (d.x * d.x - d.y * d.y)};
}

Harmonics skyHarmonics(const SceneSky& sky, const glm::dvec3& up) {
  // With t the sine of the elevation the sky is h + (m - h) |t| + (top - bottom) t / 2, m the mean of top and bottom.
  // Its Legendre coefficients f_l = (2 l + 1) / 2 times the integral of P_l over t, and the addition theorem:
  const glm::dvec3 rise = 0.5 * (sky.top + sky.bottom) - sky.horizon;
  const glm::dvec3 legendre[3] = {sky.horizon + 0.5 * rise, 0.5 * (sky.top - sky.bottom), 0.625 * rise};
  constexpr size_t band_of[9] = {0, 1, 1, 1, 2, 2, 2, 2, 2};
  const std::array<double, 9> basis = harmonicsBasis(up);
  Harmonics result;
  for (size_t i = 0; i < 9; ++i) {
    const size_t band = band_of[i];
    result[i] = sky.intensity * legendre[band] * (4.0 * kPi / static_cast<double>(2 * band + 1) * basis[i]);
  }
  return result;
}

double lightFalloff(const SceneLight& light, const glm::dvec3& point) {
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    return 1.0;
  }
  const glm::dvec3 d = light.position - point;
  const double square = glm::dot(d, d), source = 1e-3 * light.source_radius_mm;
  const double reach = light.range_m > 0.0 ? square / (light.range_m * light.range_m) : 0.0;
  const double window = std::max(1.0 - reach * reach, 0.0);
  return window * window / std::max(square, source * source);
}

SceneLight readLight(const nlohmann::json& json, const std::string& path) {
  checkKeys(json, path, {"kind", "azimuth", "elevation", "position", "target", "range", "source_radius_mm",
                         "inner_angle", "outer_angle", "color", "intensity", "shadow", "shadow_size", "shadow_cover"});
  SceneLight light;
  KeyReader reader(json, path);
  light.kind = readChoice(reader, "kind", lightKindNames(), light.kind);
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    refuseKeys(reader, {"position", "range", "source_radius_mm"}, "a light of kind point or spot");
    reader.number("azimuth", light.azimuth_deg, -360.0, 360.0, "degrees");
    reader.number("elevation", light.elevation_deg, -90.0, 90.0, "degrees");
  } else {
    refuseKeys(reader, {"azimuth", "elevation"}, "a light of kind directional");
    reader.require("position");
    reader.vector("position", light.position, -1e6, 1e6, "m");
    reader.number("range", light.range_m, 0.0, 1e6, "m");
    reader.number("source_radius_mm", light.source_radius_mm, 0.1, 1e6, "mm");
  }
  if (light.kind == FLK_LIGHT_SPOT) {
    reader.vector("target", light.target, -1e6, 1e6, "m");
    reader.number("outer_angle", light.outer_angle_deg, 0.1, 90.0, "degrees");
    light.inner_angle_deg = std::min(light.inner_angle_deg, light.outer_angle_deg * (2.0 / 3.0));
    reader.number("inner_angle", light.inner_angle_deg, 0.0, 90.0, "degrees");
    if (light.inner_angle_deg >= light.outer_angle_deg) {
      throw SceneError(reader.fullKey("inner_angle") + " is " + json.at("inner_angle").dump() +
                       ", must be less than outer_angle");
    }
    if (light.position == light.target) {
      throw SceneError(reader.fullKey("target") + " is the same as position, must differ");
    }
  } else {
    refuseKeys(reader, {"target", "inner_angle", "outer_angle"}, "a light of kind spot");
  }
  readColor(reader, "color", light.color);
  reader.number("intensity", light.intensity, 0.0, 1e6, "");
  readFlag(json, reader, "shadow", light.shadow);
  light.shadow_size = light.kind == FLK_LIGHT_POINT ? 1024 : 2048;  // amid hair a point light has six
  reader.integer("shadow_size", light.shadow_size, 64, 8192);
  light.shadow_size -= light.shadow_size % 2;
  light.shadow_cover = readChoice(reader, "shadow_cover", shadowCoverNames(), light.shadow_cover);
  return light;
}

SceneSky readSky(const nlohmann::json& json) {
  checkKeys(json, "sky", {"top", "horizon", "bottom", "intensity"});
  SceneSky sky{};
  KeyReader reader(json, "sky");
  reader.require("top");
  reader.require("bottom");
  readColor(reader, "top", sky.top);
  readColor(reader, "bottom", sky.bottom);
  sky.horizon = 0.5 * (sky.top + sky.bottom);
  readColor(reader, "horizon", sky.horizon);
  reader.number("intensity", sky.intensity, 0.0, 1e3, "");
  return sky;
}

Harmonics readHarmonics(const nlohmann::json& json) {
  const auto refuse = [] {
    throw SceneError("ambient_sh must be 27 numbers in [-1000, 1000], or 9 triples of them");
  };
  Harmonics result;
  const auto put = [&](size_t i, const nlohmann::json& number) {
    if (!number.is_number() || std::fabs(number.get<double>()) > 1e3) {
      refuse();
    }
    result[i / 3][static_cast<int>(i % 3)] = number.get<double>();
  };
  const bool triples = json.is_array() && json.size() == 9;
  if (!triples && !(json.is_array() && json.size() == 27)) {
    refuse();
  }
  for (size_t i = 0; i < 27; ++i) {
    if (triples && (!json[i / 3].is_array() || json[i / 3].size() != 3)) {
      refuse();
    }
    put(i, triples ? json[i / 3][i % 3] : json[i]);
  }
  return result;
}

nlohmann::ordered_json lightJson(const SceneLight& light) {
  const auto triple = [](const glm::dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
  nlohmann::ordered_json json;
  json["kind"] = lightKindNames()[light.kind];
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    json["azimuth"] = light.azimuth_deg;
    json["elevation"] = light.elevation_deg;
  } else {
    json["position"] = triple(light.position);
    json["range"] = light.range_m;
    json["source_radius_mm"] = light.source_radius_mm;
  }
  if (light.kind == FLK_LIGHT_SPOT) {
    json["target"] = triple(light.target);
    json["inner_angle"] = light.inner_angle_deg;
    json["outer_angle"] = light.outer_angle_deg;
  }
  json["color"] = colorJson(light.color);
  json["intensity"] = light.intensity;
  json["shadow"] = light.shadow;
  json["shadow_size"] = light.shadow_size;
  json["shadow_cover"] = shadowCoverNames()[light.shadow_cover];
  return json;
}

nlohmann::ordered_json skyJson(const SceneSky& sky) {
  return {{"top", colorJson(sky.top)}, {"horizon", colorJson(sky.horizon)}, {"bottom", colorJson(sky.bottom)},
          {"intensity", sky.intensity}};
}

const std::vector<std::string>& lightKindNames() {
  static const std::vector<std::string> names{"directional", "point", "spot"};
  return names;
}

const std::vector<std::string>& shadowCoverNames() {
  static const std::vector<std::string> names{"texel", "width"};
  return names;
}

}  // namespace forelock::samples
