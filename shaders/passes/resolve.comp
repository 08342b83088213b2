// Core and tail (Hillesland et al. 2014, section 3): the nearest fragments sorted, the rest added to the tail as they come.
// FLK_FORWARD: the lists hold colours; else tangents, shaded here, the nearest k in full.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define FLK_BIND_LISTS
#define FLK_BIND_TARGET
#include "bindings.glsl"
#include "../lib/projection.glsl"
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "list.glsl"
#include "light.glsl"
#include "shade_key.glsl"
#include "tail.glsl"
#include "tile_order.glsl"
#include "composite.glsl"

layout(constant_id = FLK_SPEC_K) const uint kFull = 8;
layout(constant_id = FLK_SPEC_K_SORT) const uint kSort = 8;
#ifdef FLK_FORWARD
const bool kColors = true;
#else
const bool kColors = false;
#endif

vec3 fragmentColor(Key key, ShadeSource source, bool full, out float alpha) {
#ifdef FLK_FORWARD
  vec3 color;
  unpackColor(key.payload, frame.color_range, kPayload, color, alpha);
  return color;
#else
  return shadeKey(key, source, full, alpha);
#endif
}

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  uint index = pixel.y * frame.rect.z + pixel.x;
  uint link = heads[index];
  Aggregate rest = readAggregate(index, kColors);
  if (link == FLK_LINK_END && !(rest.tau > 0.0)) return;
  ShadeSource source = shadeSource(pixel + frame.rect.xy);

  Key core[kSort];
  for (uint i = 0; i < kSort; ++i) core[i] = keyNone();
  Tail tail = emptyTail();
  Key tail_front = keyNone();
  while (link != FLK_LINK_END) {
    Key key = readNode(link);
    if (keyLess(key, core[kSort - 1u], kOneHair, kColor))
      for (uint i = 0; i < kSort; ++i) keySort(core[i], key, kOneHair, kColor);  // constant indices stay in registers
    if (key.depth == kDepthNone) continue;
    vec3 tangent, color = vec3(0.0);
    float alpha;
    if (kTail == FLK_TAIL_KIND_NONE || kTail == FLK_TAIL_KIND_ONCE) unpackTangent(key.payload, kPayload, tangent, alpha);
    else color = fragmentColor(key, source, false, alpha);
    addToTail(tail, alpha, color);
    if (kTail == FLK_TAIL_KIND_ONCE && keyLess(key, tail_front, kOneHair, kColor)) tail_front = key;
  }
  if (kTail == FLK_TAIL_KIND_ONCE && tail_front.depth != kDepthNone) {
    float alpha;
    addColor(tail, tail.tau, fragmentColor(tail_front, source, false, alpha));
  }
  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  Slab slab = slabOf(rest);
#ifndef FLK_FORWARD
  if (rest.tau > 0.0) shadeSlab(slab, rest, source, kFull > 0u);
#endif
  [[dont_unroll]] for (uint i = 0; i < kSort; ++i) {
    // The nearest that is left moves to the front: an index that is not constant would take the array out of registers.
    Key key = core[0];
    for (uint j = 1u; j < kSort; ++j) core[j - 1u] = core[j];
    if (key.depth == kDepthNone) break;
    if (!kColors && rest.tau > 0.0) passSlab(slab, rest, uintBitsToFloat(key.depth), color_sum, transmittance);
    float alpha;
    vec3 color = fragmentColor(key, source, i < kFull, alpha);
    color_sum += transmittance * alpha * color;
    transmittance *= 1.0 - alpha;
  }
  if (rest.tau > 0.0) {
    addAggregate(tail, slab.nearest_tau, slab.nearest_color);
    addAggregate(tail, slab.tau * (1.0 - slab.done), slab.color);
  }
  closeTail(tail);
  compositePixel(pixel, color_sum + transmittance * tail.color, transmittance * tail.transmittance);
  countPixel();
}
