// Core and tail (Hillesland et al. 2014, section 3): the nearest fragments sorted, the rest blended as they come.
// FLK_FORWARD: the lists hold colours; else tangents, shaded here, the nearest k in full.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define FLK_BIND_LISTS
#define FLK_BIND_TARGET
#include "bindings.glsl"
#include "../lib/packing.glsl"
#include "../lib/projection.glsl"
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "../lib/order.glsl"
#include "light.glsl"
#include "tile_order.glsl"
#include "composite.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;
layout(constant_id = FLK_SPEC_K) const uint kFull = 8;
layout(constant_id = FLK_SPEC_K_SORT) const uint kSort = 8;
layout(constant_id = FLK_SPEC_ONE_HAIR) const bool kOneHair = false;

// `only`: the hair of a frame of one.
void fragmentColor(Key key, HairConstants only, FrameLight source, PixelRay ray, bool full, out vec3 color, out float alpha) {
#ifdef FLK_FORWARD
  unpackColor(key.payload, frame.color_range, kPayload, color, alpha);
#else
  vec3 tangent;
  unpackTangent(key.payload, kPayload, tangent, alpha);
  float depth = uintBitsToFloat(key.depth);
  HairConstants hair = only;
  if (!kOneHair) hair = frame.hairs[key.slot];
  if (full) color = radianceFull(hair, source, tangent, ray, depth);
  else color = radianceLow(hair, source, tangent, ray, depth);
#endif
}

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  uint link = heads[pixel.y * frame.rect.z + pixel.x];
  if (link == FLK_LINK_END) return;
  PixelRay ray = pixelRay(vec2(pixel + frame.rect.xy) + 0.5);
  NodePool nodes = NodePool(frame.node_pool);
  HairConstants only = frame.hairs[0];
  FrameLight source = frameLight();

  Key core[kSort];
  for (uint i = 0; i < kSort; ++i) core[i] = keyNone();
  vec3 tail_color = vec3(0.0);
  float tail_transmittance = 1.0;

  while (link != FLK_LINK_END) {
    uint base = (link & FLK_LINK_INDEX_MASK) * FLK_NODE_WORDS;
    Key key = Key(nodes.words[base], nodes.words[base + 1u], kOneHair ? 0u : link >> FLK_LINK_SLOT_SHIFT);
    link = nodes.words[base + 2u];
    if (keyLess(key, core[kSort - 1u], kOneHair))
      for (uint i = 0; i < kSort; ++i) keySort(core[i], key, kOneHair);  // constant indices stay in registers
    if (key.depth == kDepthNone) continue;
    vec3 color;
    float alpha;
    fragmentColor(key, only, source, ray, false, color, alpha);
    tail_color = alpha * color + (1.0 - alpha) * tail_color;
    tail_transmittance *= 1.0 - alpha;
  }

  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  [[dont_unroll]] for (uint i = 0; i < kSort; ++i) {
    if (core[i].depth == kDepthNone) break;
    vec3 color;
    float alpha;
    fragmentColor(core[i], only, source, ray, i < kFull, color, alpha);
    color_sum += transmittance * alpha * color;
    transmittance *= 1.0 - alpha;
  }
  compositePixel(pixel, color_sum + transmittance * tail_color, transmittance * tail_transmittance);
}
