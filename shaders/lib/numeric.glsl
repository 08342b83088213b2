// Guarded arithmetic: each function says what it keeps from happening.
#ifndef FORELOCK_LIB_NUMERIC
#define FORELOCK_LIB_NUMERIC

// Unit vector, or (0,0,0) where there is no direction (zero, NaN, or a length whose square leaves the range of fp32).
vec3 unitOrZero(vec3 v) {
  float largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
  if (!(largest > 0.0) || isinf(largest)) return vec3(0.0);  // also NaN
  // Every implementation may flush denormals: 1e-37 is the last length that surely divides.
  if (largest < 1e-37) return vec3(0.0);
  // A GPU may divide by a reciprocal, which denormals away beyond 8e37 and is infinite below 3e-39: both are far off after this.
  vec3 near_one = v * (largest > 1.0 ? 5.421010862e-20 : 1.844674407e19);  // 2^-64, 2^64
  vec3 scaled = near_one / max(abs(near_one.x), max(abs(near_one.y), abs(near_one.z)));
  if (any(isnan(scaled))) return vec3(0.0);
  return scaled * inversesqrt(dot(scaled, scaled));
}

// (1 - q)^n for q in [0, 1], n in [0, 1e6]: the log is taken of 1 - q by its series in z = q / (2 - q), because log2 near 1
// may be off by 2^-21, which n would multiply.
float powOneMinus(float q, float n) {
  if (q >= 1.0) return n > 0.0 ? 0.0 : 1.0;
  float log_e;
  if (q < 0.5) {
    float z = q / (2.0 - q);
    float z2 = z * z;
    log_e = -2.0 * z * (1.0 + z2 * (1.0 / 3.0 + z2 * (1.0 / 5.0 + z2 * (1.0 / 7.0 + z2 * (1.0 / 9.0 + z2 * (1.0 / 11.0))))));
  } else {
    log_e = log(1.0 - q);
  }
  return exp(max(n * log_e, -100.0)) * (n * log_e < -100.0 ? 0.0 : 1.0);
}

#endif
