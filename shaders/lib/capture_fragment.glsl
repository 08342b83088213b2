// What a quad's pixel holds: coverage, depth, tangent (docs/methods.md section 2). Reads the outputs of capture.vert.
#ifndef FORELOCK_LIB_CAPTURE_FRAGMENT
#define FORELOCK_LIB_CAPTURE_FRAGMENT
#include "coverage.glsl"
#include "numeric.glsl"

struct StrandFragment {
  float coverage;
  float depth;     // metre
  float fraction;  // of the strand's length, 0 at the root
  float width_px;
  vec3 tangent;    // unit, view space, or 0
};

StrandFragment strandFragment(vec2 center, vec4 axis, vec4 extent, vec4 depth, vec4 tangent_a, vec4 tangent_b,
                              float orthographic) {
  StrandFragment f;
  vec2 t = axis.zw;
  vec2 n = vec2(-t.y, t.x);
  float a = max(abs(n.x), abs(n.y)), b = min(abs(n.x), abs(n.y));
  vec2 r = center - axis.xy;
  float x = dot(r, n), y = dot(r, t), l = extent.x;
  float v = clamp(y / l, 0.0, 1.0);  // l >= kShortestSegment
  float h = mix(extent.y, extent.z, v);
  float strip = boxEdge(x + h, a, b) - boxEdge(x - h, a, b);
  float root = extent.w > 0.0 ? boxEdge(y * extent.w, a, b) + 0.5 : 1.0;
  float tip = depth.x > 0.0 ? boxEdge((l - y) * depth.x, a, b) + 0.5 : 1.0;
  f.coverage = strip * max(root + tip - 1.0, 0.0);
  f.width_px = 2.0 * h;

  float u = v;
  if (orthographic > 0.5) {
    f.depth = mix(depth.y, depth.z, v);
  } else {
    f.depth = 1.0 / mix(1.0 / depth.y, 1.0 / depth.z, v);  // depths >= near plane > 0
    u = clamp(v * f.depth / depth.z, 0.0, 1.0);
  }
  f.fraction = mix(depth.w, tangent_a.x, u);
  f.tangent = unitOrZero(mix(tangent_a.yzw, tangent_b.xyz, u));
  return f;
}

#endif
