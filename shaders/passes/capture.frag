// Deferred capture: depth, tangent and alpha of each fragment into its pixel's list (Hillesland et al. 2014, section 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "capture_input.glsl"
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "capture_store.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;

void main() {
  StrandFragment f = fragmentHere();
  float opacity = mix(frame.hairs[hair_slot].opacity_root, frame.hairs[hair_slot].opacity_tip, f.fraction);
  uint alpha = alphaCodeTangent(clamp(f.coverage * opacity, 0.0, 1.0), kPayload);
  if (alpha == 0u || behindHostDepth(f.depth)) return;
  storeFragment(f.depth, packTangent(f.tangent, alpha, kPayload));
}
