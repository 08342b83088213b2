// Core and tail (Hillesland et al. 2014, section 3): the nearest fragments sorted, the rest added to the tail as they come.
// FLK_FORWARD: the lists hold colours; else tangents, shaded here, the nearest k in full.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define FLK_FRAME_STORED
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

// What is left of the core's keys and this one in `key`: the farthest, or none.
void insertKey(inout Key core[kSort], inout Key key) {
  if (!keyLess(key, core[kSort - 1u], kOneHair, kColor)) return;
  Key added = key;
  for (uint i = 0; i < kSort; ++i) keyInsert(core[i], key, added, kOneHair, kColor);  // constant indices stay in registers
}

// A key that may be none is shaded in any case, as `other` then, and given no opacity: without a branch the reads of both are under way
// at once.
void tailKey(inout Tail tail, inout Key front, Key key, Key other, ShadeSource source) {
  bool there = key.depth != kDepthNone;
  if (kCountWork && !there) return;
  Key read = Key(there ? key.depth : other.depth, there ? key.payload : other.payload, there ? key.slot : other.slot,
                 there ? key.color : other.color);
  vec3 tangent, color = vec3(0.0);
  float alpha;
  if (kTail == FLK_TAIL_KIND_NONE || kTail == FLK_TAIL_KIND_ONCE) unpackTangent(read.payload, kPayload, tangent, alpha);
  else color = fragmentColor(read, source, false, alpha);
  addToTail(tail, there ? alpha : 0.0, color);
  if (kTail == FLK_TAIL_KIND_ONCE && keyLess(key, front, kOneHair, kColor)) front = key;
}

void main() {
  uvec2 pixel;
  uint index, link;
  if (!tilePixel(pixel, index, link)) return;
  if (link == FLK_LINK_END && !hasAggregate(index)) return;
  ShadeSource source = shadeSource(pixel + frame.rect.xy);

  Key core[kSort];
  for (uint i = 0; i < kSort; ++i) core[i] = keyNone();
  Tail tail = emptyTail();
  Key tail_front = keyNone();
  // Two at a time, and the next two are on their way meanwhile: what a long list costs is waiting.
  Key next_a = keyNone(), next_b = keyNone();
  if (link != FLK_LINK_END) next_a = readNode(link);
  if (link != FLK_LINK_END) next_b = readNode(link);
  do {
    Key a = next_a, b = next_b;
    next_a = next_b = keyNone();
    bool more = link != FLK_LINK_END;
    if (more) next_a = readNode(link);
    insertKey(core, a);
    insertKey(core, b);
    if (a.depth != kDepthNone || b.depth != kDepthNone) {
      tailKey(tail, tail_front, a, b, source);
      tailKey(tail, tail_front, b, a, source);
    }
    if (more && link != FLK_LINK_END) next_b = readNode(link);
  } while (anyLane(next_a.depth != kDepthNone));
  if (kTail == FLK_TAIL_KIND_ONCE && tail_front.depth != kDepthNone) {
    float alpha;
    addColorWide(tail, tail.tau, fragmentColor(tail_front, source, false, alpha));
  }
  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  Aggregate rest = readAggregate(index, kColors);  // not before: it would be carried through the walk
  Slab slab = slabOf(rest);
#ifndef FLK_FORWARD
  if (rest.tau > 0.0) shadeSlab(slab, rest, source, kFull > 0u);
#endif
  uint i = 0u;
  [[dont_unroll]] do {
    // The nearest that is left moves to the front: an index that is not constant would take the array out of registers.
    Key key = core[0];
    for (uint j = 1u; j < kSort; ++j) core[j - 1u] = core[j];
    if (key.depth != kDepthNone) {
      if (!kColors && rest.tau > 0.0) passSlab(slab, rest, uintBitsToFloat(key.depth), color_sum, transmittance);
      float alpha;
      vec3 color = fragmentColor(key, source, i < kFull, alpha);
      color_sum += transmittance * alpha * color;
      transmittance *= 1.0 - alpha;
    }
    ++i;
  } while (i < kSort && anyLane(core[0].depth != kDepthNone));
  if (rest.tau > 0.0) {
    addAggregate(tail, slab.nearest_tau, slab.nearest_color);
    addAggregate(tail, slab.tau * (1.0 - slab.done), slab.color);
  }
  closeTail(tail);
  compositePixel(pixel, color_sum + transmittance * tail.color, transmittance * tail.transmittance);
  countPixel();
}
