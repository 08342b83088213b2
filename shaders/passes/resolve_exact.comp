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
const uint kBatch = 24;

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  uint head = heads[pixel.y * frame.rect.z + pixel.x];
  if (head == FLK_LINK_END) return;
  PixelRay ray = pixelRay(vec2(pixel + frame.rect.xy) + 0.5);
  NodePool nodes = NodePool(frame.node_pool);

  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  uvec3 last = uvec3(0u);  // the farthest key blended; no key is 0, depths are positive
  uint last_blended = 0u;  // how many fragments of exactly that key
  bool more = true;
  while (more) {
    uvec3 batch[kBatch];
    for (uint i = 0; i < kBatch; ++i) batch[i] = kKeyNone;
    uint farther = 0u, equal = 0u;
    for (uint link = head; link != FLK_LINK_END;) {
      uint base = (link & FLK_LINK_INDEX_MASK) * FLK_NODE_WORDS;
      uvec3 key = uvec3(nodes.words[base], link >> FLK_LINK_SLOT_SHIFT, nodes.words[base + 1u]);
      link = nodes.words[base + 2u];
      if (key == last) ++equal;
      if (!keyLess(last, key)) continue;
      ++farther;
      if (!keyLess(key, batch[kBatch - 1u])) continue;
      for (uint i = 0; i < kBatch; ++i) {
        uvec3 held = batch[i];
        bool before = keyLess(key, held);
        batch[i] = before ? key : held;
        key = before ? held : key;
      }
    }
    // Fragments equal to the last of the batch before may have fallen out of it: they come first now.
    uint again = equal - min(last_blended, equal);
    uint count = again + min(farther, kBatch);
    for (uint i = 0; i < count; ++i) {
      uvec3 key = last;
      if (i >= again) {
        key = batch[i - again];
        last_blended = key == last ? last_blended + 1u : 1u;
        last = key;
      } else {
        ++last_blended;
      }
      vec3 tangent;
      float alpha;
      unpackTangent(key.z, kPayload, tangent, alpha);
      vec3 color = radianceFull(frame.hairs[key.y], tangent, ray, uintBitsToFloat(key.x));
      color_sum += transmittance * alpha * color;
      transmittance *= 1.0 - alpha;
    }
    more = farther > kBatch;
  }
  compositePixel(pixel, color_sum, transmittance);
}
