// Kind, start, inverse ramp, inside, centre, pixel, depth: the factor.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 9
#define OUT 1
#include "items.glsl"
#include "lib/modifiers.glsl"

void main() {
  if (noItem()) return;
  OpacityModifier m;
  m.kind = uint(in1(0));
  m.start = in1(1), m.inverse_ramp = in1(2), m.inside = in1(3), m.center = in2(4);
  out1(0, opacityModifier(m.kind, m, in2(6), in1(8)));
}
