// A strand segment to a quad of a shadow map. docs/methods.md section 4.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "map_segment.glsl"

layout(location = 0) flat out vec4 out_axis;
layout(location = 1) flat out vec4 out_lines;
layout(location = 2) flat out vec4 out_depth;
layout(location = 3) flat out vec3 out_direction;
layout(location = 4) flat out vec3 out_face;
#ifdef FLK_COVER_WIDTH
layout(location = 5) flat out vec2 out_cover;
layout(location = 6) flat out uint out_seed;
#endif

void main() {
  MapShape shape;
  QuadEnd end_a, end_b;
  gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);
  if (!mapShape(uint(gl_VertexIndex) >> 2, shape, end_a, end_b)) return;
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  bool at_b = (gl_VertexIndex & 2) != 0;
  vec2 corner = (at_b ? end_b.middle : end_a.middle) + side * (at_b ? end_b.arm : end_a.arm);
  // The sides are tested in the fragment shader too, and drawn as much too far along the lines that end the quad.
  float along = at_b ? -end_b.slope : end_a.slope;
  corner += side * kCornerSlack * (leftNormal(shape.direction.xy) + along * shape.direction.xy);

  gl_Position = vec4(corner / shape.face.z, 0.0, 1.0);
  out_axis = shape.axis;
  out_lines = shape.lines;
  out_depth = shape.depth;
  out_direction = shape.direction;
  out_face = shape.face;
#ifdef FLK_COVER_WIDTH
  out_cover = shape.cover;
  out_seed = shape.seed;
#endif
}
