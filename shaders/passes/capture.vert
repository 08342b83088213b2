// A strand segment to a quad of the screen: four vertices a segment, two triangles of an index buffer. docs/methods.md section 1.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#include "bindings.glsl"
#include "screen_segment.glsl"

layout(location = 0) flat out vec4 out_axis;
layout(location = 1) flat out vec4 out_lines;
layout(location = 2) flat out vec4 out_extent;
layout(location = 3) flat out vec4 out_depth;
layout(location = 4) flat out vec4 out_tangent_a;
layout(location = 5) flat out vec4 out_tangent_b;
layout(location = 6) flat out vec2 out_direction;
layout(location = 7) flat out vec3 out_joint;
layout(location = 8) flat out vec3 out_color_a;
layout(location = 9) flat out vec3 out_color_b;

void main() {
  SegmentShape shape;
  FibreColors colors;
  QuadEnd end_a, end_b;
  gl_Position = vec4(-2.0, -2.0, 0.0, 1.0);  // four equal corners: nothing is drawn
  if (!segmentShape(uint(gl_VertexIndex) >> 2, shape, colors, end_a, end_b)) return;
  float side = (gl_VertexIndex & 1) == 0 ? -1.0 : 1.0;
  bool at_b = (gl_VertexIndex & 2) != 0;
  vec2 corner = (at_b ? end_b.middle : end_a.middle) + side * (at_b ? end_b.arm : end_a.arm);
  gl_Position = vec4(corner / frame.size * 2.0, 0.0, 1.0);
  out_axis = shape.axis;
  out_lines = shape.lines;
  out_extent = shape.extent;
  out_depth = shape.depth;
  out_tangent_a = shape.tangent_a;
  out_tangent_b = shape.tangent_b;
  out_direction = shape.direction;
  out_joint = shape.joint;
  out_color_a = kColor ? colors.a : vec3(0.0);
  out_color_b = kColor ? colors.b : vec3(0.0);
}
