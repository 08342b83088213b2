// Colours that show data instead of light, captured like the forward method.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "capture_input.glsl"
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "../lib/display.glsl"
#include "capture_store.glsl"

layout(constant_id = FLK_SPEC_DISPLAY) const int kDisplay = 0;

void main() {
  StrandFragment f = fragmentHere();
  float opacity = mix(frame.hairs[hair_slot].opacity_root, frame.hairs[hair_slot].opacity_tip, f.fraction);
  uint alpha = alphaCodeColor(clamp(f.coverage * opacity, 0.0, 1.0), FLK_CODING_DEFAULT);
  if (alpha == 0u || behindHostDepth(f.depth)) return;
  vec3 color = vec3(1.0);
  if (kDisplay == FLK_SHOW_STRAND) color = strandColor(uint(in_tangent_a.w));
  else if (kDisplay == FLK_SHOW_ROOT_TIP) color = rootTipColor(f.fraction);
  else if (kDisplay == FLK_SHOW_WIDTH) color = widthColor(f.width_px);
  else if (kDisplay == FLK_SHOW_DEPTH) color = depthColor(f.depth, frame.depth_range);
  storeFragment(f.depth, packColor(color, alpha, frame.color_range, FLK_CODING_DEFAULT));
}
