// What changes from draw to draw. SPDX-License-Identifier: MIT
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#include "opaque_shared.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Frame { FrameConstants at; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lights { LightConstants at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Faces { FaceConstants at[]; };

layout(push_constant, scalar) uniform Push {
  mat4 clip_from_world;
  vec4 light;    // xyz: where it is, or with w 0 the direction to it
  float behind;  // (m) that points move away from it: 0 for the camera
  float albedo_red, albedo_green, albedo_blue;
  Frame frame;
  Lights lights;
  Faces faces;
} push;

// Unit, from a light (xyz: where it is, or with w 0 the direction to it) on past p.
vec3 awayFrom(vec4 light, vec3 p) {
  vec3 d = light.w > 0.0 ? p - light.xyz : -light.xyz;
  return d * inversesqrt(max(dot(d, d), 1e-30));  // 0 at the light itself
}
