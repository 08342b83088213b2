// q, n, cosine, sine: (1 - q)^n, lobe of exponent n.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 4
#define OUT 2
#include "items.glsl"
#include "lib/shading.glsl"

void main() {
  if (noItem()) return;
  out1(0, powOneMinus(in1(0), in1(1)));
  out1(1, lobe(in1(2), in1(3), in1(1)));
}
