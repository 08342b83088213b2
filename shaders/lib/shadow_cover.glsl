// Which texels of a shadow map are kept by a strand that covers only a share of each (docs/methods.md section 4).
#ifndef FORELOCK_LIB_SHADOW_COVER
#define FORELOCK_LIB_SHADOW_COVER

// One number a segment. Bits are mixed as in Wellons, Prospecting for Hash Functions (2018).
uint coverSeed(uint vertex, uint slot) {
  uint h = vertex << 6 | slot;  // slot < 63
  h = (h ^ h >> 16) * 0x7FEB352Du;
  h = (h ^ h >> 15) * 0x846CA68Bu;
  return h ^ h >> 16;
}

// Texels of a segment take turns by the R2 sequence (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018), in 32 bits
// of fixed point: an even share of them, without two segments agreeing.
bool coverKeeps(uint seed, uvec2 texel, float share) {
  uint turn = seed + texel.x * 3242174889u + texel.y * 2447445414u;  // 2^32 / p, 2^32 / p^2 of the root p of p^3 = p + 1
  return turn >> 8 < uint(clamp(share, 0.0, 1.0) * 16777216.0 + 0.5);
}

#endif
