// Forward capture: each fragment shaded in full, its colour and alpha into its pixel's list (the paper's comparison).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "capture_input.glsl"
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "light.glsl"
#include "capture_store.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;

void main() {
  StrandFragment f = fragmentHere();
  HairConstants hair = frame.hairs[hair_slot];
  float opacity = mix(hair.opacity_root, hair.opacity_tip, f.fraction);
  uint alpha = alphaCodeColor(clamp(f.coverage * opacity, 0.0, 1.0), kPayload);
  if (alpha == 0u || behindHostDepth(f.depth)) return;
  vec3 color = radianceFull(hair, frameLight(), f.tangent, pixelRay(gl_FragCoord.xy), f.depth);
  storeFragment(f.depth, packColor(color, alpha, frame.color_range, kPayload));
}
