// FLK_DISPLAY_LAYERS: how many fragments the pixel has.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_LISTS
#define FLK_BIND_TARGET
#include "bindings.glsl"
#include "../lib/display.glsl"
#include "list.glsl"
#include "tile_order.glsl"
#include "composite.glsl"

void main() {
  uvec2 pixel;
  uint index, link;
  if (!tilePixel(pixel, index, link)) return;
  uint count = kAggregate ? AggregatePool(frame.aggregates).words[index * FLK_AGGREGATE_WORDS + 3u] : 0u;
  for (; link != FLK_LINK_END; readNode(link)) ++count;
  if (count > 0u) compositePixel(pixel, layersColor(count), 0.0);
}
