// What capture.vert hands to every capture fragment shader. Included after bindings.glsl.
#ifndef FORELOCK_PASSES_CAPTURE_INPUT
#define FORELOCK_PASSES_CAPTURE_INPUT
#include "../lib/capture_fragment.glsl"

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_extent;
layout(location = 3) flat in vec4 in_depth;
layout(location = 4) flat in vec4 in_tangent_a;
layout(location = 5) flat in vec4 in_tangent_b;
layout(location = 6) flat in vec2 in_direction;
layout(location = 7) flat in vec3 in_joint;

StrandFragment fragmentHere() {
  return strandFragment(gl_FragCoord.xy - frame.size * 0.5, in_axis, in_lines, in_extent, in_depth, in_tangent_a.xyz,
                        in_tangent_b, in_direction, in_joint, frame.orthographic);
}

#endif
