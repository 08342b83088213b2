// Vertices of opaque meshes, seen from the camera or from a light. SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "opaque_push.glsl"

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in float in_openness;
layout(location = 0) out vec3 out_position;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out float out_openness;

invariant gl_Position;  // the colour pass meets the depth pass's values

void main() {
  out_position = in_position;
  out_normal = in_normal;
  out_openness = in_openness;
  gl_Position = push.clip_from_world * vec4(in_position + push.behind * awayFrom(push.light, in_position), 1.0);
}
