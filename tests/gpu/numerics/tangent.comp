// A vector: its unit vector, and that coded and decoded with 11, with 12 and (FLK_METHOD_HARD) with 13 bits.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 3
#define OUT 15
#include "items.glsl"
#include "lib/numeric.glsl"
#include "lib/packing.glsl"

void main() {
  if (noItem()) return;
  vec3 unit = unitOrZero(in3(0));
  out3(0, unit);
  for (int coding = 0; coding < 2; ++coding) {
    uint payload = packTangent(unit, 0u, coding);
    vec3 tangent;
    float alpha;
    unpackTangent(payload, coding, tangent, alpha);
    outWord(3 + 4 * coding, payload);
    out3(4 + 4 * coding, tangent);
  }
  uint hard = packHard(unit, 0u);
  outWord(11, hard);
  out3(12, octDecode(hard, 13));
}
