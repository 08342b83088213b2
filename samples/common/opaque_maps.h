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

// The map, of `size` texels a side, that holds the shadow of all that lies in a sphere. False: the light has none, because it shines from
// amid the meshes to all sides.
bool mapOfMeshes(const OpaqueLight& light, const glm::dvec3& centre, double radius, uint32_t size, MeshMap& map);

opaque::FaceConstants faceOf(const FlkShadowMap& map);

}  // namespace forelock::samples
