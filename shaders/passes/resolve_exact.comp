// Every fragment in key order and in full. The list is walked once for each kBatch fragments of the pixel, each walk keeping
// the next nearest: no scratch memory, any length, the same sum whatever order the list is in.
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
#include "tile_order.glsl"
#include "composite.glsl"

const uint kBatch = 24;

void main() {
  uvec2 pixel;
  uint index, head;
  if (!tilePixel(pixel, index, head)) return;
  Aggregate rest = readAggregate(index, false);
  if (head == FLK_LINK_END && !(rest.tau > 0.0)) return;
  ShadeSource source = shadeSource(pixel + frame.rect.xy);

  vec3 color_sum = vec3(0.0);
  float transmittance = 1.0;
  Slab slab = slabOf(rest);
  if (rest.tau > 0.0) shadeSlab(slab, rest, source, true);
  Key last = Key(0u, 0u, 0u, 0u);  // the farthest key blended; no key is 0, depths are positive
  uint last_blended = 0u;  // how many fragments of exactly that key
  bool more = head != FLK_LINK_END;
  while (more) {
    Key batch[kBatch];
    for (uint i = 0; i < kBatch; ++i) batch[i] = keyNone();
    uint farther = 0u, equal = 0u;
    uint link = head;
    Key ahead = readNode(link);
    for (bool left = true; left;) {
      Key key = ahead;
      left = link != FLK_LINK_END;
      if (left) ahead = readNode(link);  // on its way while this one is sorted
      if (keyEqual(key, last, kOneHair, kColor)) ++equal;
      if (!keyLess(last, key, kOneHair, kColor)) continue;
      ++farther;
      if (!keyLess(key, batch[kBatch - 1u], kOneHair, kColor)) continue;
      Key added = key;
      for (uint i = 0; i < kBatch; ++i) keyInsert(batch[i], key, added, kOneHair, kColor);
    }
    // Fragments equal to the last of the batch before may have fallen out of it: they come first now.
    uint again = equal - min(last_blended, equal);
    uint count = again + min(farther, kBatch);
    [[dont_unroll]] for (uint i = 0; i < count; ++i) {
      Key key = last;
      if (i >= again) {
        // The nearest that is left moves to the front: an index that is not constant would take the array out of registers.
        key = batch[0];
        for (uint j = 1u; j < kBatch; ++j) batch[j - 1u] = batch[j];
        last_blended = keyEqual(key, last, kOneHair, kColor) ? last_blended + 1u : 1u;
        last = key;
      } else {
        ++last_blended;
      }
      if (rest.tau > 0.0) passSlab(slab, rest, uintBitsToFloat(key.depth), color_sum, transmittance);
      float alpha;
      vec3 color = shadeKey(key, source, true, alpha);
      color_sum += transmittance * alpha * color;
      transmittance *= 1.0 - alpha;
    }
    more = farther > kBatch;
  }
  if (rest.tau > 0.0) passSlab(slab, rest, 3.4e38, color_sum, transmittance);
  compositePixel(pixel, color_sum, transmittance);
  countPixel();
}
