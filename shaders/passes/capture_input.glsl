// What capture.vert hands to every capture fragment shader, as captureQuad() of capture_fragment.glsl wants it.
#ifndef FORELOCK_PASSES_CAPTURE_INPUT
#define FORELOCK_PASSES_CAPTURE_INPUT

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_extent;
layout(location = 3) flat in vec4 in_depth;
layout(location = 4) flat in vec4 in_tangent_a;
layout(location = 5) flat in vec4 in_tangent_b;
layout(location = 6) flat in vec2 in_direction;
layout(location = 7) flat in vec3 in_joint;
layout(location = 8) flat in vec3 in_color_a;
layout(location = 9) flat in vec3 in_color_b;

SegmentShape shapeHere() {
  return SegmentShape(in_axis, in_lines, in_extent, in_depth, in_tangent_a, in_tangent_b, in_direction, in_joint);
}

FibreColors colorsHere() { return FibreColors(in_color_a, in_color_b); }

#endif
