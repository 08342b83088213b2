// Pixels of the hair's rectangle to 8x8 groups. Some devices (lavapipe) cut a dispatch into one contiguous run a thread:
// 128 strips of tiles are dealt out bit-reversed, so that every run sees all parts of the picture; in a strip tiles stay neighbours,
// which share what a GPU's caches hold.
#ifndef FORELOCK_PASSES_TILE_ORDER
#define FORELOCK_PASSES_TILE_ORDER

layout(local_size_x = 64) in;

// Pixel relative to the rectangle; false outside it.
bool tilePixel(uvec2 size, out uvec2 pixel) {
  uint tiles_x = (size.x + 7u) / 8u;
  uint tile = (bitfieldReverse(gl_WorkGroupID.y) >> 25) * gl_NumWorkGroups.x + gl_WorkGroupID.x;  // y in 0..127
  uint lane = gl_LocalInvocationID.x;
  pixel = uvec2(tile % tiles_x, tile / tiles_x) * 8u + uvec2(lane & 7u, lane >> 3);
  return all(lessThan(pixel, size));
}

#endif
