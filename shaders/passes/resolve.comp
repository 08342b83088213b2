// Core and tail (Hillesland et al. 2014, section 3): the nearest fragments sorted, the rest blended as they come.
// FLK_FORWARD: the lists hold colours; else tangents, shaded here, the nearest k in full.
#version 460
#extension GL_GOOGLE_include_directive : require
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

void fragmentColor(uvec3 key, PixelRay ray, bool full, out vec3 color, out float alpha) {
#ifdef FLK_FORWARD
  unpackColor(key.z, frame.color_range, kPayload, color, alpha);
#else
  vec3 tangent;
  unpackTangent(key.z, kPayload, tangent, alpha);
  float depth = uintBitsToFloat(key.x);
  if (full) color = radianceFull(frame.hairs[key.y], tangent, ray, depth);
  else color = radianceLow(frame.hairs[key.y], tangent, ray, depth);
#endif
}

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  uint link = heads[pixel.y * frame.rect.z + pixel.x];
  if (link == FLK_LINK_END) return;
  PixelRay ray = pixelRay(vec2(pixel + frame.rect.xy) + 0.5);
  NodePool nodes = NodePool(frame.node_pool);

  uvec3 core[kSort];
  for (uint i = 0; i < kSort; ++i) core[i] = kKeyNone;
  vec3 tail_color = vec3(0.0);
  float tail_transmittance = 1.0;

  while (link != FLK_LINK_END) {
    uint base = (link & FLK_LINK_INDEX_MASK) * FLK_NODE_WORDS;
    uvec3 key = uvec3(nodes.words[base], link >> FLK_LINK_SLOT_SHIFT, nodes.words[base + 1u]);
    link = nodes.words[base + 2u];
    if (keyLess(key, core[kSort - 1u])) {
      for (uint i = 0; i < kSort; ++i) {  // swapped through: constant indices stay in registers
        uvec3 held = core[i];
        bool before = keyLess(key, held);
        core[i] = before ? key : held;
        key = before ? held : key;
      }
    }
    if (key.x == kKeyNone.x) continue;
    vec3 color;
    float alpha;
    fragmentColor(key, ray, false, color, alpha);
    tail_color = alpha * color + (1.0 - alpha) * tail_color;
    tail_transmittance *= 1.0 - alpha;
  }

  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  for (uint i = 0; i < kSort; ++i) {
    if (core[i].x == kKeyNone.x) break;
    vec3 color;
    float alpha;
    fragmentColor(core[i], ray, i < kFull, color, alpha);
    color_sum += transmittance * alpha * color;
    transmittance *= 1.0 - alpha;
  }
  compositePixel(pixel, color_sum + transmittance * tail_color, transmittance * tail_transmittance);
}
