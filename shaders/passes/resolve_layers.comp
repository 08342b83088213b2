// FLK_DISPLAY_LAYERS: how many fragments the pixel has.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_LISTS
#define FLK_BIND_TARGET
#include "bindings.glsl"
#include "../lib/display.glsl"
#include "tile_order.glsl"
#include "composite.glsl"

void main() {
  uvec2 pixel;
  if (!tilePixel(frame.rect.zw, pixel)) return;
  NodePool nodes = NodePool(frame.node_pool);
  uint count = 0u;
  for (uint link = heads[pixel.y * frame.rect.z + pixel.x]; link != FLK_LINK_END;
       link = nodes.words[(link & FLK_LINK_INDEX_MASK) * FLK_NODE_WORDS + 2u])
    ++count;
  if (count > 0u) compositePixel(pixel, layersColor(count), 0.0);
}
