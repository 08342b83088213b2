// Linear depth of the strand's axis at this texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "../lib/strand_quad.glsl"

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_depth;
layout(location = 3) flat in vec3 in_direction;

void main() {
  vec2 center = gl_FragCoord.xy - float(frame.shadow_size) * 0.5;
  vec2 r = center - in_axis.xy;
  float v = clamp(dot(r, in_direction.xy) / in_direction.z, 0.0, 1.0);
  float x = dot(r, leftNormal(in_direction.xy));
  if (abs(x) > mix(in_depth.z, in_depth.w, v) || !betweenLines(center, in_axis.xy, in_axis.zw, in_lines.xy, in_lines.zw)) discard;
  gl_FragDepth = clamp(mix(in_depth.x, in_depth.y, v) / frame.shadow_range, 0.0, 1.0);
}
