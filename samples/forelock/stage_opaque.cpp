// SPDX-License-Identifier: MIT
#include "bust.h"
#include "opaque_maps.h"
#include "stage.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

OpaqueMesh inPlace(const StagedMesh& staged) {
  OpaqueMesh mesh = *staged.read;
  mesh.albedo = staged.albedo;
  const double* m = staged.world_from_mesh;
  const glm::dmat3 turn(glm::dvec3(m[0], m[1], m[2]), glm::dvec3(m[4], m[5], m[6]), glm::dvec3(m[8], m[9], m[10]));
  const glm::dvec3 shift(m[12], m[13], m[14]);
  const double scale = glm::length(turn[0]);  // in all directions the same
  for (size_t v = 0; v < mesh.vertices(); ++v) {
    float* position = &mesh.positions[3 * v];
    float* normal = &mesh.normals[3 * v];
    const glm::dvec3 p = turn * glm::dvec3(position[0], position[1], position[2]) + shift;
    const glm::dvec3 n = turn * glm::dvec3(normal[0], normal[1], normal[2]) / scale;
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = static_cast<float>(p[axis]);
      normal[axis] = static_cast<float>(n[axis]);
    }
  }
  return mesh;
}

}  // namespace

std::vector<OpaqueMesh> opaqueMeshes(const Stage& stage) {
  std::vector<OpaqueMesh> meshes;
  if (*stage.scene.head) {
    meshes.push_back(bustMesh());
  }
  for (const StagedMesh& staged : stage.meshes) {
    meshes.push_back(inPlace(staged));
  }
  return meshes;
}

// The lights keep their colours and what they are to each other, but come to 2.2 at the head's centre, or less where the light around is
// most of it. Light from behind counts for less: it would leave the side that is seen in the dark.
OpaqueLook opaqueLook(const Stage& stage, const Camera& camera) {
  const Scene& scene = stage.scene;
  const auto strongest = [](const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); };
  Harmonics harmonics{};
  stageHarmonics(stage, harmonics);
  const glm::dvec3 back = cameraBasis(camera).back;
  double direct = 0.0;
  for (const SceneLight& light : scene.lights) {
    const glm::dvec3 towards = light.kind == FLK_LIGHT_DIRECTIONAL ? towardsLight(light, camera) : light.position;
    const double facing = glm::dot(towards, back) / std::max(glm::length(towards), 1e-9);
    direct += strongest(light.color) * light.intensity * lightFalloff(light, glm::dvec3(0.0)) *
              std::clamp((facing + 0.2) / 0.7, 0.3, 1.0);
  }
  const double around = strongest(scene.ambient + 0.282095 * harmonics[0]);
  const double scale = 2.2 / std::max({direct, 4.0 * around, 1e-9});
  OpaqueLook look;
  for (const SceneLight& wanted : scene.lights) {
    OpaqueLight& light = look.lights.emplace_back();
    light.kind = wanted.kind;
    light.color = glm::vec3(wanted.color * (wanted.intensity * scale));
    light.to_light = glm::vec3(towardsLight(wanted, camera));
    light.position = wanted.position;
    light.range = static_cast<float>(wanted.range_m);
    light.source_radius = static_cast<float>(wanted.source_radius_mm * 1e-3);
    light.inner_angle = static_cast<float>(glm::radians(wanted.inner_angle_deg));
    light.outer_angle = static_cast<float>(glm::radians(wanted.outer_angle_deg));
    light.casts_shadow = wanted.shadow;
  }
  constexpr double around_skin = 0.76;  // of the lights' scale: 2.4 times what is physical, so that no side is black
  look.ambient = glm::vec3(scene.ambient * (scale * around_skin));
  for (size_t i = 0; i < harmonics.size(); ++i) {
    look.ambient_sh[i] = glm::vec3(harmonics[i] * (scale * around_skin));
  }
  const FlkMaterial& material = stage.assets[0].material;
  look.fibre_spacing_m = material.fibre_spacing;
  look.shadow_opacity = material.shadow_opacity;
  look.flat = scene.display != FLK_DISPLAY_SHADED || scene.coloring != StrandColoring::none;
  return look;
}

void planMeshes(const Stage& stage, const Camera& camera, const FlkHostShadow& shadow, FlkFrame& frame, std::vector<FlkLight>& lights) {
  if (!*stage.scene.head && stage.meshes.empty()) {
    return;
  }
  glm::vec3 low(0.0f), high(0.0f);
  if (*stage.scene.head) {
    bustBounds(&low[0], &high[0]);
  } else {
    low = stage.meshes[0].low, high = stage.meshes[0].high;
  }
  for (const StagedMesh& mesh : stage.meshes) {
    low = glm::min(low, mesh.low), high = glm::max(high, mesh.high);
  }
  const auto some = reinterpret_cast<VkImageView>(uintptr_t{1});  // says that there is one
  frame.depth.view = some;
  frame.depth.format = VK_FORMAT_D32_SFLOAT;
  frame.depth.samples = VK_SAMPLE_COUNT_1_BIT;
  frame.depth.layout = VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL;
  const MeshMaps maps = mapsOfMeshes(opaqueLook(stage, camera).lights, low, high);
  for (size_t light = 0; light < lights.size(); ++light) {
    if (maps.of_light[light] >= 0) {
      lights[light].host_shadow = &shadow;
      frame.host_shadow_maps.view = some;
    }
  }
}

}  // namespace forelock::samples
