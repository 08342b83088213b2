// A strand segment to a quad of the shadow map, at least one texel wide. docs/methods.md section 4.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "../lib/strand_quad.glsl"
#include "../lib/strand_vertex.glsl"

layout(location = 0) flat out vec4 out_axis;  // a.xy, b.xy (texel from the middle of the map)
layout(location = 1) flat out vec4 out_lines; // normals of the lines that end the quad
layout(location = 2) flat out vec4 out_depth; // depths (metre), half widths (texel)
layout(location = 3) flat out vec3 out_direction; // unit, a to b; length (texel)

vec3 texelPosition(uint vertex) { return frame.hairs[hair_slot].texels_from_hair * vec4(positions[vertex], 1.0); }

vec2 texelDelta(uint from, uint to) { return (mat3(frame.hairs[hair_slot].texels_from_hair) * (positions[to] - positions[from])).xy; }

float texelHalfWidth(float radius) { return max(radius / frame.shadow_texel, 0.5); }

void main() {
  uint word = segments[gl_VertexIndex >> 2];
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  bool at_b = (gl_VertexIndex & 2) != 0;
  uint ia = word & FLK_SEGMENT_VERTEX_MASK;
  bool root = (word & FLK_SEGMENT_ROOT) != 0u, tip = (word & FLK_SEGMENT_TIP) != 0u;

  vec3 a = texelPosition(ia), b = texelPosition(ia + 1);
  FlatSegment segment = flatSegment(a.xy, b.xy, texelDelta(ia, ia + 1));
  gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
  if (!(segment.l > 0.0)) return;

  float radius_max = frame.hairs[hair_slot].radius_max;
  float ha = texelHalfWidth(attributeRadius(attributes[ia], radius_max));
  float hb = texelHalfWidth(attributeRadius(attributes[ia + 1], radius_max));
  FlatSegment before = segment, after = segment;
  if (!root) before = flatSegment(texelPosition(ia - 1).xy, segment.a, texelDelta(ia - 1, ia));
  if (!tip) after = flatSegment(segment.b, texelPosition(ia + 2).xy, texelDelta(ia + 1, ia + 2));
  QuadEnd end_a, end_b;
  if (root || !(before.l > 0.0)) end_a = freeEnd(segment.a, side, ha, segment.t, -1.0, 0.0, true);
  else end_a = jointEnd(segment.a, side, ha, before, segment, false);
  if (tip || !(after.l > 0.0)) end_b = freeEnd(segment.b, side, hb, segment.t, 1.0, 0.0, true);
  else end_b = jointEnd(segment.b, side, hb, segment, after, true);
  // The sides are tested in the fragment shader too, and drawn as much too far along the lines that end the quad.
  vec2 corner = at_b ? end_b.corner : end_a.corner;
  float along = at_b ? -end_b.slope : end_a.slope;
  corner += side * kCornerSlack * (leftNormal(segment.t) + along * segment.t);

  gl_Position = vec4(corner / float(frame.shadow_size) * 2.0, 0.0, 1.0);
  out_axis = vec4(segment.a, segment.b);
  out_lines = vec4(end_a.line, end_b.line);
  out_depth = vec4(a.z, b.z, ha, hb);
  out_direction = vec3(segment.t, segment.l);
}
