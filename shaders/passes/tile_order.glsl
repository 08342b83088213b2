// Pixels of the hair's rectangle to 8x8 groups. Some devices (lavapipe) cut a dispatch into one contiguous run a thread:
// 128 strips of tiles are dealt out bit-reversed, so that every run sees all parts of the picture; in a strip tiles stay neighbours,
// which share what a GPU's caches hold.
#ifndef FORELOCK_PASSES_TILE_ORDER
#define FORELOCK_PASSES_TILE_ORDER
#include "../shared/node.h"

layout(constant_id = FLK_SPEC_LONG_FIRST) const bool kLongFirst = false;

layout(local_size_x = 64) in;

// Whether this half of a dispatch is the one that resolves the tile. A pixel's list takes as long as it is, however many pixels a GPU
// works on: long ones must not begin last (docs/results.md).
bool tileNow(uint tile, uint tiles, uint pixels) {
  if (!kLongFirst) return true;
  bool is_long = float(~heads[pixels + tile]) * float(tiles) >= FLK_LONG_TILE * float(~heads[pixels + tiles]);
  return is_long == (gl_WorkGroupID.y < 128u);
}

// pixel: relative to the rectangle; index: of its head, which is read in any case, together with the tile's count. False: outside, or not now.
bool tilePixel(out uvec2 pixel, out uint index, out uint head) {
  uvec2 size = frame.rect.zw, tiles = (size + FLK_TILE - 1u) / FLK_TILE;
  uint tile = (bitfieldReverse(gl_WorkGroupID.y & 127u) >> 25) * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x;
  pixel = uvec2(tile % tiles.x, tile / tiles.x) * FLK_TILE + uvec2(lane & 7u, lane >> 3);
  bool inside = all(lessThan(pixel, size));
  index = inside ? pixel.y * size.x + pixel.x : 0u;
  head = heads[index];
  return inside && tileNow(tile, tiles.x * tiles.y, size.x * size.y);
}

#endif
