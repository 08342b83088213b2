// fibres, log2(1 - a): transmittance.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 2
#define OUT 1
#include "items.glsl"
#include "lib/shadow.glsl"

void main() {
  if (noItem()) return;
  out1(0, hairTransmittance(in1(0), shadowTaps(ivec2(0), ivec2(0), vec3(0.0, 0.0, in1(0)), 1, 0.0, 1.0, 1.0, in1(1))));
}
