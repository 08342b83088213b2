// What a pixel of a quad becomes: coverage and opacity, then depth and payload into the pixel's list. Compiled three times:
// tangents to shade later (default), colours shaded now (FLK_CAPTURE_FORWARD), colours that show data (FLK_CAPTURE_DISPLAY).
#ifndef FORELOCK_PASSES_CAPTURE_QUAD
#define FORELOCK_PASSES_CAPTURE_QUAD
#include "../lib/capture_fragment.glsl"
#include "../lib/display.glsl"
#include "../lib/modifiers.glsl"
#ifdef FLK_CAPTURE_FORWARD
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "light.glsl"
#endif
#include "capture_store.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;
layout(constant_id = FLK_SPEC_DISPLAY) const int kDisplay = 0;
layout(constant_id = FLK_SPEC_MODIFIERS) const uint kModifiers = 0u;

float modifiersAt(vec2 pixel, float depth) {
  float factor = 1.0;
  for (uint i = 0u; i < FLK_MODIFIER_COUNT; ++i) {
    uint kind = kModifiers >> 2u * i & 3u;
    if (kind != 0u) factor *= opacityModifier(kind, frame.modifiers[i], pixel, depth);
  }
  return factor;
}

// pixel: of the target, inside the hair's rectangle. live: not a helper of its neighbours.
void captureQuad(SegmentShape shape, uvec2 pixel, bool live) {
  vec2 at = vec2(pixel) + 0.5;
  vec2 center = at - frame.size * 0.5;
  StrandFragment f = strandFragment(center, shape.axis, shape.lines, shape.extent, shape.depth, shape.tangent_a.xyz,
                                    shape.tangent_b, shape.direction, shape.joint, frame.orthographic);
  float modifiers = kModifiers == 0u ? 1.0 : modifiersAt(at, f.depth);
  if (kStore == FLK_STORE_HARD_DEPTH || kStore == FLK_STORE_HARD_PAYLOAD) {
    bool inside = insideHard(center, shape.axis, shape.lines, shape.extent, shape.direction, shape.tangent_b.w);
    if (!live || !inside || modifiers < 0.5 || behindHostDepth(pixel, f.depth)) return;
    vec3 fibre = kColor ? fibreColor(shape, f.along, f.fraction) : vec3(0.0);
    storeHard(pixel, f.depth, packHard(f.tangent, hair_slot), kColor ? packSharedExponent(fibre) : 0u);
    return;
  }

  float opacity = mix(frame.hairs[hair_slot].opacity_root, frame.hairs[hair_slot].opacity_tip, f.fraction);
  float alpha = clamp(f.coverage * opacity * modifiers, 0.0, 1.0);
#if defined(FLK_CAPTURE_FORWARD)
  uint code = alphaCodeColor(alpha, kPayload);
#elif defined(FLK_CAPTURE_DISPLAY)
  uint code = alphaCodeColor(alpha, FLK_CODING_DEFAULT);
#else
  uint code = alphaCodeTangent(alpha, kPayload);
#endif
  if (!live || code == 0u || behindHostDepth(pixel, f.depth)) return;
  vec3 fibre = kColor ? fibreColor(shape, f.along, f.fraction) : frame.hairs[hair_slot].color;
#if defined(FLK_CAPTURE_FORWARD)
  if (kStore == FLK_STORE_COUNT) { countFragment(); return; }
  vec3 color = radianceFull(frame.hairs[hair_slot], fibre, frameLight(pixel), f.tangent, pixelRay(at), f.depth, pixel);
  addWork();
  storeFragment(pixel, f.depth, f.tangent, packColor(color, code, frame.color_range, kPayload), 0u, alpha, color);
#elif defined(FLK_CAPTURE_DISPLAY)
  vec3 color = vec3(1.0);
  if (kDisplay == FLK_SHOW_STRAND) color = strandColor(uint(shape.tangent_a.w));
  else if (kDisplay == FLK_SHOW_ROOT_TIP) color = rootTipColor(f.fraction);
  else if (kDisplay == FLK_SHOW_WIDTH) color = widthColor(f.width_px);
  else if (kDisplay == FLK_SHOW_DEPTH) color = depthColor(f.depth, frame.depth_range);
  storeFragment(pixel, f.depth, f.tangent, packColor(color, code, frame.color_range, FLK_CODING_DEFAULT), 0u, alpha, color);
#else
  storeFragment(pixel, f.depth, f.tangent, packTangent(f.tangent, code, kPayload), kColor ? packSharedExponent(fibre) : 0u, alpha, vec3(0.0));
#endif
}

#endif
