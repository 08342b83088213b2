// SPDX-License-Identifier: MIT
#include "opaque_maps.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

// World to axes with z along `along`: rows x, y, z about `origin`.
glm::dmat4 axesAlong(const glm::dvec3& along, const glm::dvec3& origin) {
  const glm::dvec3 z = glm::normalize(along);
  glm::dvec3 e(0.0);
  e[std::fabs(z.x) <= std::fabs(z.y) && std::fabs(z.x) <= std::fabs(z.z) ? 0 : std::fabs(z.y) <= std::fabs(z.z) ? 1 : 2] = 1.0;
  const glm::dvec3 x = glm::normalize(e - z * glm::dot(e, z)), y = glm::cross(z, x);
  glm::dmat4 m(1.0);
  const glm::dvec3 rows[3] = {x, y, z};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      m[column][row] = rows[row][column];
    }
    m[3][row] = -glm::dot(rows[row], origin);
  }
  return m;
}

// False: the light has none, because it shines from amid the meshes to all sides.
bool mapOfSphere(const OpaqueLight& light, const glm::dvec3& centre, double radius, MeshMap& map) {
  constexpr uint32_t size = kMeshMapSize;
  constexpr double rim = 10.0;  // texels that are left empty all around, for filters
  const double middle = 0.5 * size;
  glm::dmat4 project(0.0);  // from axes to texels and value
  glm::dmat4 axes;
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    const glm::dvec3 to_light(light.to_light);
    axes = axesAlong(-to_light, centre);
    const double scale = (middle - rim) / radius;
    project[0][0] = project[1][1] = scale;
    project[3][0] = project[3][1] = middle;
    // An empty texel holds 1: hair behind the meshes must come to less, however far it is. Floats are as fine near 0 as anywhere.
    const double range = 1024.0 * radius;
    project[2][2] = 1.0 / range;
    project[3][2] = radius / range;
    project[3][3] = 1.0;
    map.texel = static_cast<float>(1.0 / scale);
    map.light = glm::vec4(glm::normalize(light.to_light), 0.0f);
  } else {
    const glm::dvec3 to_centre = centre - light.position;
    const double distance = glm::length(to_centre);
    const bool outside = distance >= 1.25 * radius;
    const double widest = light.kind == FLK_LIGHT_SPOT ? static_cast<double>(light.outer_angle) : 4.0;
    const double sphere = outside ? std::asin(radius / distance) : 4.0;
    constexpr double sixty_degrees = 1.0471976;
    double half = sphere;
    glm::dvec3 along = to_centre;
    if (widest <= sixty_degrees && widest < sphere) {
      half = widest;
      along = -glm::dvec3(light.to_light);
    } else if (!outside) {
      return false;
    }
    axes = axesAlong(along, light.position);
    const double focal = (middle - rim) / std::tan(half);
    const double near_m = std::max(outside ? (distance - radius) * std::cos(half) : 0.0, 1e-3 * radius);
    project[0][0] = project[1][1] = focal;
    project[2][0] = project[2][1] = middle;
    project[2][2] = 1.0;  // value 1 - near / z
    project[3][2] = -near_m;
    project[2][3] = 1.0;
    map.texel = static_cast<float>(1.0 / focal);
    map.light = glm::vec4(glm::vec3(light.position), 1.0f);
  }
  map.map_from_world = project * axes;
  glm::dmat4 clip(1.0);  // from texels
  clip[0][0] = clip[1][1] = 2.0 / size;
  clip[3][0] = clip[3][1] = -1.0;
  map.clip_from_world = glm::mat4(clip * map.map_from_world);
  return true;
}

}  // namespace

MeshMaps mapsOfMeshes(const std::vector<OpaqueLight>& lights, const glm::vec3& low, const glm::vec3& high) {
  const glm::dvec3 centre = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
  const double radius = 0.5 * glm::length(glm::dvec3(high) - glm::dvec3(low)) + 2.0 * static_cast<double>(kMeshMapPush);
  MeshMaps result;
  for (const OpaqueLight& light : lights) {
    MeshMap map;
    const bool has = light.casts_shadow && result.maps.size() < kMostMeshMaps && mapOfSphere(light, centre, radius, map);
    result.of_light.push_back(has ? static_cast<int>(result.maps.size()) : -1);
    if (has) {
      result.maps.push_back(map);
    }
  }
  return result;
}

opaque::FaceConstants faceOf(const FlkShadowMap& map) {
  opaque::FaceConstants face{};
  for (int i = 0; i < 16; ++i) {
    face.texels_from_world[i / 4][i % 4] = static_cast<float>(map.texels_from_world[i]);
  }
  face.offset = {map.offset[0], map.offset[1]};
  face.size = map.size;
  face.perspective = map.perspective;
  face.depth_range = map.depth_range;
  face.texel = map.texel;
  return face;
}

}  // namespace forelock::samples
