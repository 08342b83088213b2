// Colour, alpha, range (radiance of white), coding: alpha through the tangent's payload; colour and alpha through the
// forward payload.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 6
#define OUT 7
#include "items.glsl"
#include "lib/packing.glsl"

void main() {
  if (noItem()) return;
  vec3 color = in3(0), tangent;
  float alpha = in1(3), range = in1(4);
  int coding = int(in1(5));
  uint code = alphaCodeTangent(alpha, coding);
  outWord(0, code);
  unpackTangent(packTangent(vec3(1.0, 0.0, 0.0), code, coding), coding, tangent, alpha);
  out1(1, alpha);
  uint payload = packColor(color, alphaCodeColor(in1(3), coding), range, coding);
  outWord(2, payload);
  unpackColor(payload, range, coding, color, alpha);
  out3(3, color);
  out1(6, alpha);
}
