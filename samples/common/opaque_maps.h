// Where the shadow maps of opaque meshes look, and what their shader is told of hair's. SPDX-License-Identifier: MIT
#pragma once

#include "opaque_scene.h"
#include "opaque_shared.h"

#include <glm/mat4x4.hpp>

namespace forelock::samples {

struct MeshMap {
  glm::dmat4 map_from_world{1.0};  // as FlkHostShadow has it
  glm::mat4 clip_from_world{1.0f};
  glm::vec4 light{0.0f};           // as the vertex shader has it: xyz where it is, or with w 0 the direction to it
  float texel = 0.0f;              // (m) in perspective at one metre along the axis
};

constexpr uint32_t kMeshMapSize = 2048;  // texels a side
constexpr size_t kMostMeshMaps = 8;

// Maps lie behind the surfaces that they are of, for strands that begin on them: hair's roots are on the scalp, or a little under it.
constexpr float kMeshMapPush = 0.004f;  // (m)

// The maps that hold the shadow of all that lies in a box, and of each light its map or -1.
struct MeshMaps {
  std::vector<MeshMap> maps;
  std::vector<int> of_light;
};
MeshMaps mapsOfMeshes(const std::vector<OpaqueLight>& lights, const glm::vec3& low, const glm::vec3& high);

opaque::FaceConstants faceOf(const FlkShadowMap& map);

}  // namespace forelock::samples
