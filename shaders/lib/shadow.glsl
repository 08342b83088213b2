// Depth-difference attenuation (docs/methods.md section 4).
#ifndef FORELOCK_LIB_SHADOW
#define FORELOCK_LIB_SHADOW
#extension GL_EXT_samplerless_texture_functions : require

// (1 - a)^fibres from log2(1 - a): 1 for no fibre in between, also where a = 1 (log2 sent as -FLT_MAX).
float fibreTransmittance(float fibres, float log2_transmittance) {
  float n = clamp(fibres, 0.0, 1e6);
  if (!(n > 0.0)) return 1.0;  // also NaN
  return exp2(max(n * log2_transmittance, -126.0)) * (n * log2_transmittance < -126.0 ? 0.0 : 1.0);
}

float shadowBias(vec3 T, vec3 L, float texel) {
  return texel * abs(dot(T, L)) / max(length(cross(T, L)), 0.1);
}

// `position` in texels from the middle of the map and metre, `range` the metres of a full depth value. The map is the square of
// `size` texels that begins at texel `offset` of the image.
float shadowTap(texture2D map, ivec2 offset, ivec2 texel, int size, float depth, float range, float fibres_per_metre, float log2_transmittance) {
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(size)))) return 1.0;
  float front = texelFetch(map, offset + texel, 0).r;
  if (front >= 1.0) return 1.0;  // no hair towards the light
  return fibreTransmittance((depth - front * range) * fibres_per_metre, log2_transmittance);
}

// `position` from the middle of the map. A far one must not wrap when it becomes an integer.
ivec2 shadowTexel(vec2 position, int size) {
  float most = float(size) * 0.5 + 8.0;
  return ivec2(floor(clamp(position, vec2(-most), vec2(most)))) + size / 2;
}

// Mean of 1, 4, 9 or 25 taps, a texel apart, with weights exp(-(x^2 + y^2) / 2), x and y their distances to the middle of them all.
float shadowFull(texture2D map, ivec2 offset, vec3 position, int size, float bias, float range, float fibres_per_metre, float log2_transmittance, uint taps) {
  const float weights[8] = float[8](0.0544886845, 0.2442013422, 0.4026199469, 0.2442013422, 0.0544886845, 0.2740686137, 0.4518627726, 0.2740686137);
  int side = taps == 25u ? 5 : taps == 9u ? 3 : taps == 4u ? 2 : 1;
  int row = taps == 25u ? 0 : 5;
  ivec2 texel = shadowTexel(taps == 4u ? position.xy - 0.5 : position.xy, size) - (side - 1) / 2;
  float light = 0.0;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      float weight = taps == 1u ? 1.0 : taps == 4u ? 0.25 : weights[row + i] * weights[row + j];
      light += weight * shadowTap(map, offset, texel + ivec2(i, j), size, position.z - bias, range, fibres_per_metre, log2_transmittance);
    }
  return light;
}

float shadowLow(texture2D map, ivec2 offset, vec3 position, int size, float bias, float range, float fibres_per_metre, float log2_transmittance) {
  return shadowTap(map, offset, shadowTexel(position.xy, size), size, position.z - bias, range, fibres_per_metre, log2_transmittance);
}

#endif
