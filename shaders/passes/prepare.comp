// Positions of the host to the hair's own order, follow strands moved with their guides' roots. docs/methods.md section 7.
#version 460
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = 64) in;
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "../lib/numeric.glsl"
#include "../lib/strand_vertex.glsl"
#include "../shared/hair.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SourceList { StrandSource at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FloatList { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer AttributeList { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer PositionList { vec3 at[]; };
layout(push_constant, scalar) uniform PushConstants {
  uvec2 sources, host_positions, attributes, positions;
  uint strand_count;
  uint stride;        // floats
  float spread_tip;
};

vec3 hostPosition(uint vertex) {
  FloatList list = FloatList(host_positions);
  uint at = vertex * stride;
  return vec3(list.at[at], list.at[at + 1u], list.at[at + 2u]);
}

// v turned by the shortest rotation that takes unit vector a to unit vector b (Rodrigues; half a turn about any axis across a).
vec3 turned(vec3 v, vec3 a, vec3 b) {
  vec3 axis = cross(a, b);
  float cosine = dot(a, b);
  if (cosine > -0.999999) return v * cosine + cross(axis, v) + axis * (dot(axis, v) / (1.0 + cosine));
  vec3 across = unitOrZero(abs(a.x) < 0.6 ? cross(a, vec3(1.0, 0.0, 0.0)) : cross(a, vec3(0.0, 1.0, 0.0)));
  return 2.0 * dot(across, v) * across - v;
}

void main() {
  uint strand = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * 64u;
  if (strand >= strand_count) return;
  StrandSource source = SourceList(sources).at[strand];
  vec3 offset = source.offset;
  if (offset != vec3(0.0)) {
    vec3 now = unitOrZero(hostPosition(source.guide_vertex + 1u) - hostPosition(source.guide_vertex));
    if (now != vec3(0.0)) offset = turned(offset, source.rest, now);
  }
  for (uint i = 0u; i < source.count; ++i) {
    float fraction = attributeFraction(AttributeList(attributes).at[source.vertex + i]);
    PositionList(positions).at[source.vertex + i] = hostPosition(source.guide_vertex + i) + offset * mix(1.0, spread_tip, fraction);
  }
}
