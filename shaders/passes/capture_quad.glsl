// What a pixel of a quad becomes: coverage and opacity, then depth and payload into the pixel's list. Compiled three times:
// tangents to shade later (default), colours shaded now (FLK_CAPTURE_FORWARD), colours that show data (FLK_CAPTURE_DISPLAY).
#ifndef FORELOCK_PASSES_CAPTURE_QUAD
#define FORELOCK_PASSES_CAPTURE_QUAD
#include "../lib/capture_fragment.glsl"
#include "../lib/display.glsl"
#include "../lib/modifiers.glsl"
#if defined(FLK_CAPTURE_FORWARD) || defined(FLK_CAPTURE_DISPLAY)
#define FLK_CAPTURE_COLORS
#endif
#ifdef FLK_CAPTURE_FORWARD
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "light.glsl"
#endif

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;
#include "capture_store.glsl"
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

// A fragment that is kept, on its way to the list.
struct Captured {
  uvec2 pixel;     // of the target
  float depth;
  float alpha;     // before it is coded
#ifdef FLK_CAPTURE_FORWARD
  vec3 tangent;
#endif
#ifdef FLK_CAPTURE_COLORS
  vec3 color;      // FLK_CAPTURE_FORWARD: of the fibre, with kColor; else what is shown
#else
  uint payload;
  uint color;      // of the fibre, with kColor
#endif
};

uint alphaCode(float alpha) {
#if defined(FLK_CAPTURE_FORWARD)
  return alphaCodeColor(alpha, kPayload);
#elif defined(FLK_CAPTURE_DISPLAY)
  return alphaCodeColor(alpha, FLK_CODING_DEFAULT);
#else
  return alphaCodeTangent(alpha, kPayload);
#endif
}

QuadFacts factsOf(SegmentShape shape) { return quadFacts(shape.direction, shape.tangent_b.w); }

StrandFragment fragmentAt(SegmentShape shape, QuadFacts facts, vec2 center) {
  return strandFragment(center, facts, shape.axis, shape.lines, shape.extent, shape.depth, shape.tangent_a.xyz, shape.tangent_b, shape.direction,
                        shape.joint, frame.orthographic);
}

// pixel: of the target; at: its centre. live: inside the hair's rectangle, and wanted. False: nothing is kept.
bool captureFragment(SegmentShape shape, QuadFacts facts, FibreColors colors, uvec2 pixel, vec2 at, bool live, out Captured kept) {
  StrandFragment f = fragmentAt(shape, facts, at - frame.size * 0.5);
  float opacity = mix(frame.hairs[hair_slot].opacity_root, frame.hairs[hair_slot].opacity_tip, f.fraction);
  if (kModifiers != 0u) opacity *= modifiersAt(at, f.depth);
  float alpha = clamp(f.coverage * opacity, 0.0, 1.0);
  uint code = alphaCode(alpha);
  kept.pixel = pixel;
  kept.depth = f.depth;
  kept.alpha = alpha;
#if defined(FLK_CAPTURE_FORWARD)
  kept.tangent = f.tangent;
  kept.color = kColor ? fibreColor(colors, f.along, f.fraction) : vec3(0.0);
#elif defined(FLK_CAPTURE_DISPLAY)
  kept.color = vec3(1.0);
  if (kDisplay == FLK_SHOW_STRAND) kept.color = strandColor(uint(shape.tangent_a.w));
  else if (kDisplay == FLK_SHOW_ROOT_TIP) kept.color = rootTipColor(f.fraction);
  else if (kDisplay == FLK_SHOW_WIDTH) kept.color = widthColor(f.width_px);
  else if (kDisplay == FLK_SHOW_DEPTH) kept.color = depthColor(f.depth, frame.depth_range);
#else
  kept.payload = packTangent(f.tangent, code, kPayload);
  kept.color = kColor ? packSharedExponent(fibreColor(colors, f.along, f.fraction)) : 0u;
#endif
  bool keeps = live && code != 0u;
  if (keeps) keeps = !behindHostDepth(pixel, f.depth);
  return keeps;
}

// index: a number of its own for every fragment; link: of linkFragment().
void storeCaptured(Captured c, uint index, uint link) {
#if defined(FLK_CAPTURE_FORWARD)
  vec3 fibre = kColor ? c.color : frame.hairs[hair_slot].color;
  vec3 color = radianceFull(frame.hairs[hair_slot], fibre, frameLight(c.pixel), c.tangent, pixelRay(vec2(c.pixel) + 0.5), c.depth, c.pixel);
  storeFragment(c.pixel, c.depth, index, link, packColor(color, alphaCode(c.alpha), frame.color_range, kPayload), 0u, c.alpha, color);
#elif defined(FLK_CAPTURE_DISPLAY)
  storeFragment(c.pixel, c.depth, index, link, packColor(c.color, alphaCode(c.alpha), frame.color_range, FLK_CODING_DEFAULT), 0u, c.alpha, c.color);
#else
  storeFragment(c.pixel, c.depth, index, link, c.payload, c.color, c.alpha, vec3(0.0));
#endif
}

const bool kHard = kStore == FLK_STORE_HARD_DEPTH || kStore == FLK_STORE_HARD_PAYLOAD;

void captureHard(SegmentShape shape, QuadFacts facts, FibreColors colors, uvec2 pixel, vec2 at) {
  vec2 center = at - frame.size * 0.5;
  StrandFragment f = fragmentAt(shape, facts, center);
  if (!insideHard(center, shape.axis, shape.lines, shape.extent, shape.direction, shape.tangent_b.w) || behindHostDepth(pixel, f.depth)) return;
  if (kModifiers != 0u && modifiersAt(at, f.depth) < 0.5) return;
  vec3 fibre = kColor ? fibreColor(colors, f.along, f.fraction) : vec3(0.0);
  storeHard(pixel, f.depth, packHard(f.tangent, hair_slot), kColor ? packSharedExponent(fibre) : 0u);
}

#endif
