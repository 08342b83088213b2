// Payload codings (docs/methods.md section 3).
#ifndef FORELOCK_LIB_PACKING
#define FORELOCK_LIB_PACKING
#include "../shared/node.h"

// Octahedral map of the unit sphere (Meyer et al. 2010, "On floating-point normal vectors"), two components of `bits` bits
// on an odd number of levels, which codes the axes exactly. What is no direction (zero, NaN, infinite) takes the code that this
// leaves free, all bits set, and decodes as zero.
uint octEncode(vec3 v, int bits) {
  float sum = abs(v.x) + abs(v.y) + abs(v.z);
  bool none = !(sum > 0.0) || isinf(sum);  // also NaN
  vec2 p = v.xy / sum;
  if (v.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  float steps = float((1 << bits) - 2);
  uvec2 q = uvec2(clamp((p * 0.5 + 0.5) * steps + 0.5, vec2(0.0), vec2(steps)));
  return none ? (1u << 2 * bits) - 1u : q.x | q.y << bits;
}

vec3 octDecode(uint code, int bits) {
  float steps = float((1 << bits) - 2);
  uint mask = (1u << bits) - 1u;
  bool none = (code & mask) == mask;
  vec2 p = (2.0 * vec2(float(code & mask), float(code >> bits & mask)) - steps) / steps;  // 0 is exact whatever the division is
  vec3 v = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (v.z < 0.0) v.xy = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
  float square = dot(v, v);  // >= 1/3; exactly 1 on the axes, which an approximate root would miss
  return v * (none ? 0.0 : square == 1.0 ? 1.0 : inversesqrt(square));
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

// Shared-exponent colour: three 9-bit mantissas and a 5-bit exponent, as of GL_EXT_texture_shared_exponent. c in [0, 65408].
float powerOfTwo(int exponent) { return uintBitsToFloat(uint(exponent + 127) << 23); }  // exact, unlike exp2; [-126, 127]

uint packSharedExponent(vec3 c) {
  c = clamp(c, vec3(0.0), vec3(65408.0));
  float largest = max(c.x, max(c.y, c.z));
  if (!(largest > 3e-8)) return 0u;  // below half a step of the least exponent; also NaN
  int exponent = max(int(floatBitsToUint(largest) >> 23) - 127 + 1, -15);
  if (uint(largest * powerOfTwo(9 - exponent) + 0.5) == 512u) ++exponent;
  uvec3 q = uvec3(c * powerOfTwo(9 - exponent) + 0.5);
  return q.x | q.y << 9 | q.z << 18 | uint(exponent + 15) << 27;
}

vec3 unpackSharedExponent(uint word) {
  return vec3(float(word & 511u), float(word >> 9 & 511u), float(word >> 18 & 511u)) * powerOfTwo(int(word >> 27) - 24);
}

// Key of FLK_METHOD_HARD: slot and tangent in 13 + 13 bits, which alpha leaves free there.
uint packHard(vec3 tangent, uint slot) { return octEncode(tangent, 13) | slot << 26; }

uint alphaCodeColor(float alpha, int coding) {
  return coding == FLK_CODING_PAPER ? encodeAlphaLinear(alpha) : encodeAlphaRoot(alpha, 511.0);
}

// range > 0: the radiance that codes as 1; more is cut.
uint packColor(vec3 radiance, uint alpha_code, float range, int coding) {
  vec3 c = clamp(radiance / range, 0.0, 1.0);
  if (coding == FLK_CODING_PAPER) {
    uvec3 q = uvec3(c * 255.0 + 0.5);
    return q.x | q.y << 8 | q.z << 16 | alpha_code << 24;
  }
  // A bit of blue, the channel that hair has least of, goes to alpha, which thin strands need.
  uvec3 q = uvec3(sqrt(c) * vec3(255.0, 255.0, 127.0) + 0.5);
  return q.x | q.y << 8 | q.z << 16 | alpha_code << 23;
}

void unpackColor(uint payload, float range, int coding, out vec3 radiance, out float alpha) {
  if (coding == FLK_CODING_PAPER) {
    radiance = vec3(float(payload & 255u), float(payload >> 8 & 255u), float(payload >> 16 & 255u)) / 255.0 * range;
    alpha = float(payload >> 24) / 255.0;
  } else {
    vec3 c = vec3(float(payload & 255u) / 255.0, float(payload >> 8 & 255u) / 255.0, float(payload >> 16 & 127u) / 127.0);
    float a = float(payload >> 23) / 511.0;
    radiance = c * c * range;
    alpha = a * a;
  }
}

#endif
