// Linear depth of the strand's axis at this texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "bindings.glsl"
#include "../lib/strand_quad.glsl"

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_depth;

void main() {
  FlatSegment segment = flatSegment(in_axis.xy, in_axis.zw);
  vec2 r = gl_FragCoord.xy - segment.a;
  float y = dot(r, segment.t) / segment.l;
  float x = dot(r, leftNormal(segment.t));
  if (abs(x) > mix(in_depth.z, in_depth.w, clamp(y, 0.0, 1.0)) || !betweenLines(gl_FragCoord.xy, segment.a, segment.b, in_lines.xy, in_lines.zw))
    discard;
  gl_FragDepth = clamp(mix(in_depth.x, in_depth.y, clamp(y, 0.0, 1.0)) / frame.shadow_range, 0.0, 1.0);
}
