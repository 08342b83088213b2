// A strand segment to a quad of the shadow map, at least one texel wide. docs/methods.md section 4.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "../lib/strand_quad.glsl"
#include "../lib/strand_vertex.glsl"

layout(location = 0) flat out vec4 out_axis;   // a.xy, t.xy (texel)
layout(location = 1) flat out vec3 out_extent; // length (texel), depths (metre)

vec3 texelPosition(uint vertex) { return frame.hairs[hair_slot].texels_from_hair * vec4(positions[vertex], 1.0); }

float texelHalfWidth(float radius) { return max(radius / frame.shadow_texel, 0.5); }

void main() {
  uint word = segments[gl_VertexIndex >> 2];
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  bool at_b = (gl_VertexIndex & 2) != 0;
  uint ia = word & FLK_SEGMENT_VERTEX_MASK;
  bool root = (word & FLK_SEGMENT_ROOT) != 0u, tip = (word & FLK_SEGMENT_TIP) != 0u;

  vec3 a = texelPosition(ia), b = texelPosition(ia + 1);
  FlatSegment segment = flatSegment(a.xy, b.xy);
  gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
  if (!(segment.l > 0.0)) return;

  uint joint = at_b ? ia + 1 : ia;
  vec2 p = at_b ? segment.b : segment.a;
  float reach = texelHalfWidth(attributeRadius(attributes[joint], frame.hairs[hair_slot].radius_max));
  bool ends = at_b ? tip : root;
  FlatSegment other = segment;
  if (!ends) other = at_b ? flatSegment(segment.b, texelPosition(ia + 2).xy) : flatSegment(texelPosition(ia - 1).xy, segment.a);
  vec2 corner;
  if (ends || !(other.l > 0.0)) corner = endCorner(p, side, reach, segment.t, vec2(0.0), 0.0);
  else if (at_b) corner = jointCorner(p, side, reach, segment, other, true);
  else corner = jointCorner(p, side, reach, other, segment, false);

  gl_Position = vec4(corner / float(frame.shadow_size) * 2.0 - 1.0, 0.0, 1.0);
  out_axis = vec4(segment.a, segment.t);
  out_extent = vec3(segment.l, a.z, b.z);
}
