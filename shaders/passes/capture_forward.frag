// Forward capture: each fragment shaded in full, its colour and alpha into its pixel's list (the paper's comparison).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "../lib/capture_fragment.glsl"
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "light.glsl"
#include "capture_store.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;

layout(location = 0) flat in vec4 in_axis;
layout(location = 1) flat in vec4 in_lines;
layout(location = 2) flat in vec4 in_extent;
layout(location = 3) flat in vec4 in_depth;
layout(location = 4) flat in vec4 in_tangent_a;
layout(location = 5) flat in vec4 in_tangent_b;
layout(location = 6) flat in vec2 in_direction;
layout(location = 7) flat in vec3 in_joint;

void main() {
  StrandFragment f = strandFragment(gl_FragCoord.xy - frame.size * 0.5, in_axis, in_lines, in_extent, in_depth, in_tangent_a.xyz, in_tangent_b,
                                    in_direction, in_joint, frame.orthographic);
  HairConstants hair = frame.hairs[hair_slot];
  float opacity = mix(hair.opacity_root, hair.opacity_tip, f.fraction);
  uint alpha = alphaCodeColor(clamp(f.coverage * opacity, 0.0, 1.0), kPayload);
  if (alpha == 0u || behindHostDepth(f.depth)) return;
  vec3 color = radianceFull(hair, frameLight(), f.tangent, pixelRay(gl_FragCoord.xy), f.depth);
  storeFragment(f.depth, packColor(color, alpha, frame.color_range, kPayload));
}
