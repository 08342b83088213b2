// Decoding of hair attributes and vertex tangents.
#ifndef FORELOCK_LIB_STRAND_VERTEX
#define FORELOCK_LIB_STRAND_VERTEX
#include "numeric.glsl"
#include "../shared/hair.h"

float attributeRadius(uint word, float radius_max) {
  float q = float(word & 0x7FFu) / FLK_RADIUS_STEPS;
  return radius_max * q * q;
}
float attributeFraction(uint word) { return float(word >> FLK_FRACTION_SHIFT & 0xFFFFu) / FLK_FRACTION_STEPS; }
uint attributeHash(uint word) { return word >> FLK_HASH_SHIFT; }

// Tangent at a vertex between unit directions; own is used where the sum says nothing.
vec3 vertexTangent(vec3 before, vec3 after, vec3 own) {
  vec3 sum = before + after;
  float square = dot(sum, sum);
  return square > 1e-8 && dot(before, before) > 0.5 && dot(after, after) > 0.5 ? sum * inversesqrt(square) : own;
}

#endif
