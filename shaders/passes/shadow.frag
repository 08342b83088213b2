// Distance of the strand's axis from the light at this texel.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "map_segment.glsl"

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_depth;
layout(location = 3) flat in vec3 in_direction;
layout(location = 4) flat in vec3 in_face;
#ifdef FLK_COVER_WIDTH
layout(location = 5) flat in vec2 in_cover;
layout(location = 6) flat in uint in_seed;
#define FLK_COVER_IN , in_cover, in_seed
#else
#define FLK_COVER_IN
#endif

void main() {
  vec2 corner = vec2(FaceList(frame.faces).at[FLK_FACE].offset);
  float value;
  if (!mapDepth(MapShape(in_axis, in_lines, in_depth, in_direction, in_face FLK_COVER_IN), gl_FragCoord.xy - corner - in_face.z, value)) discard;
  gl_FragDepth = value;
}
