// A straight strand through a point, far from its ends: sums over the pixels of one row (or column), as drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IN 9
#define OUT 3
#include "items.glsl"
// In: point on the axis (pixel), unit direction, radius (metre), pixels per metre, opacity, target's size.
// Out: coverage; opacity after the default and the paper coding.
#include "lib/capture_fragment.glsl"
#include "lib/packing.glsl"

void main() {
  if (noItem()) return;
  vec2 p = in2(0), t = in2(2), pixels_per_metre = in2(5);
  float h = halfWidth(in1(4), pixels_per_metre, t), opacity = in1(7), length_px = in1(8);
  // A long segment, as capture.vert sends one of the middle of a strand: no line ends it, root and tip are far.
  vec2 a = p - 0.5 * length_px * t, b = p + 0.5 * length_px * t;
  bool upright = abs(t.y) >= abs(t.x);
  float along = upright ? t.y : t.x, across = upright ? p.x : p.y;
  float reach = (h + pixelHalfExtent(leftNormal(t))) / abs(along) + 2.0;
  QuadFacts facts = quadFacts(t, length_px);
  vec3 sum = vec3(0.0);
  for (float c = floor(across - reach) + 0.5; c < across + reach; c += 1.0) {
    vec2 center = upright ? vec2(c, floor(p.y) + 0.5) : vec2(floor(p.x) + 0.5, c);
    StrandFragment f = strandFragment(center, facts, vec4(a, b), vec4(0.0), vec4(h, h, length_px, length_px),
                                      vec4(1.0, 1.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0), vec4(1.0, 0.0, 0.0, length_px),
                                      t, vec3(0.0, 0.0, 1.0), 0.0);
    sum.x += f.coverage;
    for (int coding = 0; coding < 2; ++coding) {
      vec3 tangent;
      float alpha;
      uint code = alphaCodeTangent(clamp(f.coverage * opacity, 0.0, 1.0), coding);
      unpackTangent(packTangent(f.tangent, code, coding), coding, tangent, alpha);
      if (code != 0u) sum[1 + coding] += alpha;
    }
  }
  out3(0, sum);
}
