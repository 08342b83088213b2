// Depth value, P22, P32, orthographic: linear depth.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 4
#define OUT 1
#include "items.glsl"
#include "lib/projection.glsl"

void main() {
  if (noItem()) return;
  out1(0, linearDepth(in1(0), in2(1), in1(3)));
}
