// t, a, b: boxEdge.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 3
#define OUT 1
#include "items.glsl"
#include "lib/coverage.glsl"

void main() {
  if (noItem()) return;
  out1(0, boxEdge(in1(0), in1(1), in1(2)));
}
