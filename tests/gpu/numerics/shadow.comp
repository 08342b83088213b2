// Position in the map, T, L, texel, size, range, fibres per metre, log2(1 - a), corner of the map in the image: bias, light of 25 taps, of one.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 16
#define OUT 3
#include "items.glsl"
#include "lib/shadow.glsl"

layout(set = 0, binding = 2) uniform sampler2D shadow_map;

void main() {
  if (noItem()) return;
  int size = int(in1(10));
  // Inputs count from the corner of the map, the functions from its middle.
  vec3 position = in3(0) - vec3(vec2(size / 2), 0.0);
  ivec2 corner = ivec2(in2(14));
  float bias = shadowBias(in3(3), in3(6), in1(9));
  out1(0, bias);
  out1(1, shadowFull(shadow_map, corner, position, size, bias, in1(11), in1(12), in1(13), 25));
  out1(2, shadowLow(shadow_map, corner, position, size, bias, in1(11), in1(12), in1(13)));
}
