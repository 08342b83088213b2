// Payload codings (docs/methods.md section 3).
#ifndef FORELOCK_LIB_PACKING
#define FORELOCK_LIB_PACKING
#include "../shared/node.h"

// Octahedral map of the unit sphere (Meyer et al. 2010, "On floating-point normal vectors"), two components of `bits` bits
// on an odd number of levels, which codes the axes exactly. The zero vector codes as +z.
uint octEncode(vec3 v, int bits) {
  float sum = abs(v.x) + abs(v.y) + abs(v.z);
  vec2 p = sum > 0.0 ? v.xy / sum : vec2(0.0);
  if (v.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  float steps = float((1 << bits) - 2);
  uvec2 q = uvec2(clamp((p * 0.5 + 0.5) * steps + 0.5, vec2(0.0), vec2(steps)));
  return q.x | q.y << bits;
}

vec3 octDecode(uint code, int bits) {
  float steps = float((1 << bits) - 2);
  uint mask = (1u << bits) - 1u;
  vec2 p = vec2(float(code & mask), float(code >> bits & mask)) / steps * 2.0 - 1.0;
  vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (v.z < 0.0) v.xy = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  return normalize(v);  // |v| >= 1/sqrt(3)
}

// Alpha in [0,1] to a code; 0: the fragment is dropped.
uint encodeAlphaRoot(float alpha, float steps) { return uint(sqrt(alpha) * steps + 0.5); }
uint encodeAlphaLinear(float alpha) { return alpha < 1.0 / 255.0 ? 0u : uint(alpha * 255.0 + 0.5); }

uint alphaCodeTangent(float alpha, int coding) {
  return coding == FLK_CODING_PAPER ? encodeAlphaLinear(alpha) : encodeAlphaRoot(alpha, 1023.0);
}

uint packTangent(vec3 tangent, uint alpha_code, int coding) {
  return coding == FLK_CODING_PAPER ? octEncode(tangent, 12) | alpha_code << 24 : octEncode(tangent, 11) | alpha_code << 22;
}

void unpackTangent(uint payload, int coding, out vec3 tangent, out float alpha) {
  if (coding == FLK_CODING_PAPER) {
    tangent = octDecode(payload, 12);
    alpha = float(payload >> 24) / 255.0;
  } else {
    tangent = octDecode(payload, 11);
    float root = float(payload >> 22) / 1023.0;
    alpha = root * root;
  }
}

uint alphaCodeColor(float alpha, int coding) {
  return coding == FLK_CODING_PAPER ? encodeAlphaLinear(alpha) : encodeAlphaRoot(alpha, 255.0);
}

uint packColor(vec3 radiance, uint alpha_code, float exposure, int coding) {
  vec3 c = radiance * exposure;
  c = coding == FLK_CODING_PAPER ? clamp(c, 0.0, 1.0) : sqrt(clamp(c / FLK_FORWARD_RANGE, 0.0, 1.0));
  uvec3 q = uvec3(c * 255.0 + 0.5);
  return q.x | q.y << 8 | q.z << 16 | alpha_code << 24;
}

void unpackColor(uint payload, float exposure, int coding, out vec3 radiance, out float alpha) {
  vec3 c = vec3(float(payload & 255u), float(payload >> 8 & 255u), float(payload >> 16 & 255u)) / 255.0;
  float a = float(payload >> 24) / 255.0;
  bool paper = coding == FLK_CODING_PAPER;
  radiance = (paper ? c : c * c * FLK_FORWARD_RANGE) / exposure;  // exposure > 0, checked by the API
  alpha = paper ? a : a * a;
}

#endif
