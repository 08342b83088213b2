// Pixel, depth, P00, P11, P20, P21, target's size: the point of view space.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 9
#define OUT 3
#include "items.glsl"
#include "lib/projection.glsl"

void main() {
  if (noItem()) return;
  out3(0, unprojectPixel(in2(0), in1(2), in2(3), in2(5), 0.0, in2(7)));
}
