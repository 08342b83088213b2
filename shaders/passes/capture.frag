// Capture by the rasteriser: each fragment of a quad into its pixel's list (Hillesland et al. 2014, section 3.1).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "screen_segment.glsl"
#include "capture_input.glsl"
#include "capture_quad.glsl"

void main() {
  SegmentShape shape = shapeHere();
  FibreColors colors = colorsHere();
  QuadFacts facts = factsOf(shape);
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (kHard) {
    if (!gl_HelperInvocation) captureHard(shape, facts, colors, pixel, gl_FragCoord.xy);
    return;
  }
  Captured kept;
  if (!captureFragment(shape, facts, colors, pixel, gl_FragCoord.xy, !gl_HelperInvocation, kept)) return;
  uint index = kShares ? countInShares(kept.pixel) : countFragment();
  if (kStore == FLK_STORE_COUNT) return;
  storeCaptured(kept, index, linkFragment(kept.pixel, index));
#ifdef FLK_CAPTURE_FORWARD
  addWork();
#endif
}
