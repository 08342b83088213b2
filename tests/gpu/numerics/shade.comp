// T, L, V, turns of R and TRT, exponents, three weights: both lobes, and radiance full and low of white hair.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 18
#define OUT 5
#include "items.glsl"
#include "lib/shading.glsl"

void main() {
  if (noItem()) return;
  vec3 T = in3(0), L = in3(3), V = in3(6);
  HairConstants hair;
  hair.color = vec3(1.0);
  hair.cos_r = in1(9), hair.sin_r = in1(10), hair.cos_trt = in1(11), hair.sin_trt = in1(12);
  hair.exponent_r = in1(13), hair.exponent_trt = in1(14);
  hair.diffuse = in1(15), hair.specular_r = in1(16), hair.specular_trt = in1(17);
  StrandAngles s = strandAngles(T, L, V, in2(9), in2(11));
  out1(0, s.diffuse);
  out1(1, lobe(s.r.x, s.r.y, hair.exponent_r));
  out1(2, lobe(s.trt.x, s.trt.y, hair.exponent_trt));
  out1(3, shadeFull(hair, vec3(1.0), T, L, V, vec3(1.0)).r);
  out1(4, shadeLow(hair, vec3(1.0), T, L, vec3(1.0), false).r);
}
