// Colour: nine bits a channel and a shared exponent, and decoded.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 3
#define OUT 4
#include "items.glsl"
#include "lib/packing.glsl"

void main() {
  if (noItem()) return;
  uint code = packSharedExponent(in3(0));
  outWord(0, code);
  out3(1, unpackSharedExponent(code));
}
