// Every fragment in key order and in full. The list is walked once for each kBatch fragments of the pixel, each walk keeping
// the next nearest: no scratch memory, any length, the same sum whatever order the list is in.
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
layout(constant_id = FLK_SPEC_ONE_HAIR) const bool kOneHair = false;
const uint kBatch = 24;

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  uint head = heads[pixel.y * frame.rect.z + pixel.x];
  if (head == FLK_LINK_END) return;
  PixelRay ray = pixelRay(vec2(pixel + frame.rect.xy) + 0.5);
  NodePool nodes = NodePool(frame.node_pool);
  HairConstants only = frame.hairs[0];
  FrameLight source = frameLight();

  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  Key last = Key(0u, 0u, 0u);  // the farthest key blended; no key is 0, depths are positive
  uint last_blended = 0u;  // how many fragments of exactly that key
  bool more = true;
  while (more) {
    Key batch[kBatch];
    for (uint i = 0; i < kBatch; ++i) batch[i] = keyNone();
    uint farther = 0u, equal = 0u;
    for (uint link = head; link != FLK_LINK_END;) {
      uint base = (link & FLK_LINK_INDEX_MASK) * FLK_NODE_WORDS;
      Key key = Key(nodes.words[base], nodes.words[base + 1u], kOneHair ? 0u : link >> FLK_LINK_SLOT_SHIFT);
      link = nodes.words[base + 2u];
      if (keyEqual(key, last, kOneHair)) ++equal;
      if (!keyLess(last, key, kOneHair)) continue;
      ++farther;
      if (!keyLess(key, batch[kBatch - 1u], kOneHair)) continue;
      for (uint i = 0; i < kBatch; ++i) keySort(batch[i], key, kOneHair);
    }
    // Fragments equal to the last of the batch before may have fallen out of it: they come first now.
    uint again = equal - min(last_blended, equal);
    uint count = again + min(farther, kBatch);
    for (uint i = 0; i < count; ++i) {
      Key key = last;
      if (i >= again) {
        key = batch[i - again];
        last_blended = keyEqual(key, last, kOneHair) ? last_blended + 1u : 1u;
        last = key;
      } else {
        ++last_blended;
      }
      vec3 tangent;
      float alpha;
      unpackTangent(key.payload, kPayload, tangent, alpha);
      HairConstants hair = only;
      if (!kOneHair) hair = frame.hairs[key.slot];
      vec3 color = radianceFull(hair, source, tangent, ray, uintBitsToFloat(key.depth));
      color_sum += transmittance * alpha * color;
      transmittance *= 1.0 - alpha;
    }
    more = farther > kBatch;
  }
  compositePixel(pixel, color_sum, transmittance);
}
