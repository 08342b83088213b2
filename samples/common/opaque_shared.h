// Layouts that opaque_scene.cpp writes and its shaders read: scalar. SPDX-License-Identifier: MIT
#ifndef FORELOCK_OPAQUE_SHARED_H
#define FORELOCK_OPAQUE_SHARED_H

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace forelock::samples::opaque {

using glm::mat4;
using glm::uvec2;
using glm::vec3;
using glm::vec4;
using uint = uint32_t;
#endif

struct LightConstants {
  vec3 to_light;        // directional: unit; spot: against its axis; point: 0
  uint placed;          // 1: shines from `position`
  vec3 position;        // (m)
  float inverse_range;  // (1/m) 0: no end
  vec3 color;
  float least_square;   // (m^2) of the source's radius
  float cos_outer;
  float cone_scale;     // 1 / (cos_inner - cos_outer), 0: no cone
  int layer;            // of the meshes' maps; -1: none
  float texel;          // (m) of that map; in perspective at one metre along its axis
  mat4 map_from_world;  // x, y in texels, z the value, w the divisor
  uint first_face;      // of hair's maps
  uint face_count;      // 0: no shadow of hair
};

// A shadow map of hair (FlkShadowMap).
struct FaceConstants {
  mat4 texels_from_world;
  uvec2 offset;
  uint size;
  uint perspective;
  float depth_range;  // (m)
  float texel;        // (m) in perspective at one metre
};

struct FrameConstants {
  vec3 eye;   // (m)
  uint orthographic;
  vec3 back;  // unit, towards the camera
  uint light_count;
  vec3 ambient;
  float fibres_per_metre;
  float log2_transmittance;  // of one fibre
  float push;                // (m) by which maps lie behind the surfaces that they are of
  vec3 ambient_sh[9];
};

#ifdef __cplusplus
static_assert(sizeof(LightConstants) == 136 && sizeof(FaceConstants) == 88 && sizeof(FrameConstants) == 164);
}  // namespace forelock::samples::opaque
#endif
#endif
