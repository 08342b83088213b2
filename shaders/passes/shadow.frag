// Linear depth of the strand's axis at this texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec3 in_extent;

void main() {
  float v = clamp(dot(gl_FragCoord.xy - in_axis.xy, in_axis.zw) / in_extent.x, 0.0, 1.0);
  gl_FragDepth = clamp(mix(in_extent.y, in_extent.z, v) / frame.shadow_range, 0.0, 1.0);
}
