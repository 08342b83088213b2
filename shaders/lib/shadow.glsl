// Depth-difference attenuation (docs/methods.md section 4).
#ifndef FORELOCK_LIB_SHADOW
#define FORELOCK_LIB_SHADOW
#extension GL_EXT_control_flow_attributes : require

float shadowBias(vec3 T, vec3 L, float texel) {
  return texel * abs(dot(T, L)) / max(length(cross(T, L)), 0.1);
}

// What a fragment's taps share.
struct ShadowTaps {
  ivec2 texel;    // the first
  ivec2 offset;   // of the map in the image
  int size;       // its side (texel)
  float depth;    // of the fragment, less the bias (metre)
  float range;    // metres of a full depth value
  float exponent; // log2 of what a metre of hair lets through: (1 - a)^(metre / spacing)
  float least;    // of the exponent times metres: a million fibres, 2^-126 at least
};

// `position` in texels from the middle of the map and metre. The map is the square of `size` texels that begins at texel `offset` of
// the image. Opaque fibres send log2(1 - a) = -FLT_MAX; all is held finite, because 0 x infinity is NaN.
ShadowTaps shadowTaps(ivec2 offset, ivec2 first, vec3 position, int size, float bias, float range, float fibres_per_metre, float log2_transmittance) {
  return ShadowTaps(first, offset, size, min(position.z - bias, 1e30), range, max(fibres_per_metre * log2_transmittance, -3.4e38),
                    max(1e6 * max(log2_transmittance, -1e30), -126.0));
}

// What hair lets through to a fragment that lies `behind` its front (metre).
float hairTransmittance(float behind, ShadowTaps at) {
  return behind > 0.0 ? exp2(max(behind * at.exponent, at.least)) : 1.0;  // also NaN
}

// front: what the map holds; 1: no hair.
float tapLight(float front, ShadowTaps at) { return front >= 1.0 ? 1.0 : hairTransmittance(at.depth - front * at.range, at); }

// No branches: a GPU has all reads under way at once. A texel outside the map, or without hair, lets all light through.
float shadowTap(sampler2D map, ShadowTaps at, int i, int j) {
  ivec2 texel = at.texel + ivec2(i, j);
  ivec2 held = clamp(texel, ivec2(0), ivec2(at.size - 1));
  float front = texelFetch(map, at.offset + held, 0).r;
  return texel != held ? 1.0 : tapLight(front, at);
}

// `position` from the middle of the map. A far one must not wrap when it becomes an integer.
ivec2 shadowTexel(vec2 position, int size) {
  float most = float(size) * 0.5 + 8.0;
  return ivec2(floor(clamp(position, vec2(-most), vec2(most)))) + size / 2;
}

// Of a tap in a row of 5 or 3. No array: an index that is not constant would put it in memory.
float tapWeight(int side, int i) {
  if (side == 3) return i == 1 ? 0.4518627726 : 0.2740686137;
  return i == 2 ? 0.4026199469 : i == 1 || i == 3 ? 0.2442013422 : 0.0544886845;
}

// 25 taps that all lie in the map: four texels a read, because a texture unit takes as long for one. The sampler clamps at the edge.
float shadowGathered(sampler2D map, ShadowTaps at) {
  vec2 texel = 1.0 / vec2(textureSize(map, 0));
  float light = 0.0;
  for (int j = 0; j < 5; j += 2) {
    for (int i = 0; i < 5; i += 2) {
      vec4 front = textureGather(map, (vec2(at.offset + at.texel + ivec2(i, j)) + 1.0) * texel);  // where four texels meet
      light += tapWeight(5, i) * tapWeight(5, j) * tapLight(front.w, at);
      if (i < 4) light += tapWeight(5, i + 1) * tapWeight(5, j) * tapLight(front.z, at);
      if (j < 4) light += tapWeight(5, i) * tapWeight(5, j + 1) * tapLight(front.x, at);
      if (i < 4 && j < 4) light += tapWeight(5, i + 1) * tapWeight(5, j + 1) * tapLight(front.y, at);
    }
  }
  return light;
}

// Mean of 1, 4, 9 or 25 taps, a texel apart, with weights exp(-(x^2 + y^2) / 2), x and y their distances to the middle of them all.
float shadowFull(sampler2D map, ivec2 offset, vec3 position, int size, float bias, float range, float fibres_per_metre, float log2_transmittance, uint taps) {
  int side = taps == 25u ? 5 : taps == 9u ? 3 : taps == 4u ? 2 : 1;
  ivec2 texel = shadowTexel(taps == 4u ? position.xy - 0.5 : position.xy, size) - (side - 1) / 2;
  ShadowTaps at = shadowTaps(offset, texel, position, size, bias, range, fibres_per_metre, log2_transmittance);
  if (taps == 25u && all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(size - 4)))) return shadowGathered(map, at);
  float light = 0.0;
  if (taps == 25u) {  // rarely: at the map's edge
    [[dont_unroll]] for (int tap = 0; tap < 25; ++tap)
      light += tapWeight(5, tap % 5) * tapWeight(5, tap / 5) * shadowTap(map, at, tap % 5, tap / 5);
    return light;
  }
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      light += (taps == 1u ? 1.0 : taps == 4u ? 0.25 : tapWeight(side, i) * tapWeight(side, j)) * shadowTap(map, at, i, j);
  return light;
}

// One tap.
float shadowLow(sampler2D map, ivec2 offset, vec3 position, int size, float bias, float range, float fibres_per_metre, float log2_transmittance) {
  ShadowTaps at = shadowTaps(offset, ivec2(0), position, size, bias, range, fibres_per_metre, log2_transmittance);
  vec2 place = position.xy + float(size) * 0.5;
  vec2 held = clamp(place, vec2(0.0), vec2(float(size) - 0.5));
  float front = texelFetch(map, offset + ivec2(held), 0).r;
  bool outside = any(lessThan(place, vec2(0.0))) || any(greaterThanEqual(place, vec2(float(size))));
  return outside ? 1.0 : tapLight(front, at);
}

#endif
