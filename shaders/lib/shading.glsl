// Kajiya-Kay diffuse and two shifted lobes (docs/methods.md section 5; Scheuermann 2004, Marschner et al. 2003).
#ifndef FORELOCK_LIB_SHADING
#define FORELOCK_LIB_SHADING
#include "numeric.glsl"
#include "../shared/frame.h"

// max(0, cos(angle))^exponent, where cosine and sine are those of the angle. Near the mirror direction 1 - cosine is formed
// from the sine, which keeps its digits.
float lobe(float cosine, float sine, float exponent) {
  if (!(cosine > 0.0)) return 0.0;
  float q = min(sine * sine / (1.0 + cosine), 1.0);  // 1 - cosine
  return powOneMinus(q, clamp(exponent, 0.0, 1e6));  // infinity times log 1 would be NaN
}

// A unit vector, and not zero, NaN or infinite.
bool isDirection(vec3 v) {
  float square = dot(v, v);
  return square > 0.5 && square < 2.0;
}

struct StrandAngles {
  float diffuse;  // sin(T, L)
  vec2 r;         // cosine and sine of the angle between the R lobe and the eye
  vec2 trt;
};

// T, L, V unit vectors, or T none: then diffuse only (no direction to reflect about).
StrandAngles strandAngles(vec3 T, vec3 L, vec3 V, vec2 turn_r, vec2 turn_trt) {
  StrandAngles s;
  if (!isDirection(T)) {
    s.diffuse = 1.0;
    s.r = vec2(-1.0, 0.0);
    s.trt = vec2(-1.0, 0.0);
    return s;
  }
  // Sines as lengths of cross products: sqrt(1 - cos^2) has no digits left for parallel vectors and may be NaN.
  float cos_l = dot(T, L), sin_l = length(cross(T, L));
  float cos_v = dot(T, V), sin_v = length(cross(T, V));
  s.diffuse = min(sin_l, 1.0);
  // Mirrored light: (-cos_l, sin_l). Turned by +2c (to the root), by -3c (to the tip).
  vec2 r = vec2(-cos_l * turn_r.x - sin_l * turn_r.y, sin_l * turn_r.x - cos_l * turn_r.y);
  vec2 t = vec2(-cos_l * turn_trt.x + sin_l * turn_trt.y, sin_l * turn_trt.x + cos_l * turn_trt.y);
  s.r = vec2(r.x * cos_v + r.y * sin_v, r.y * cos_v - r.x * sin_v);
  s.trt = vec2(t.x * cos_v + t.y * sin_v, t.y * cos_v - t.x * sin_v);
  return s;
}

// What one light adds: diffuse and both lobes. fibre: its colour; light: what arrives.
vec3 shadeFull(HairConstants hair, vec3 fibre, vec3 T, vec3 L, vec3 V, vec3 light) {
  StrandAngles s = strandAngles(T, L, V, vec2(hair.cos_r, hair.sin_r), vec2(hair.cos_trt, hair.sin_trt));
  return light * (hair.diffuse * fibre * s.diffuse + hair.specular_r * lobe(s.r.x, s.r.y, hair.exponent_r) +
                  hair.specular_trt * fibre * lobe(s.trt.x, s.trt.y, hair.exponent_trt));
}

// Share of a light that a strand scatters all round; as of a direction across it where T is none.
float diffuseShare(vec3 T, vec3 L) { return isDirection(T) ? min(length(cross(T, L)), 1.0) : 1.0; }

// Diffuse, and with `mean_lobes` what the lobes give on average.
vec3 shadeLow(HairConstants hair, vec3 fibre, vec3 T, vec3 L, vec3 light, bool mean_lobes) {
  float sine = diffuseShare(T, L);
  vec3 lobes = mean_lobes ? hair.mean_r + hair.mean_trt * fibre : vec3(0.0);
  return light * (hair.diffuse * fibre * sine + lobes);
}

#endif
