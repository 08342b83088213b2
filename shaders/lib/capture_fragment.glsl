// What a quad's pixel holds: coverage, depth, tangent (docs/methods.md section 2). Reads the outputs of capture.vert.
#ifndef FORELOCK_LIB_CAPTURE_FRAGMENT
#define FORELOCK_LIB_CAPTURE_FRAGMENT
#include "coverage.glsl"
#include "numeric.glsl"
#include "strand_quad.glsl"

struct StrandFragment {
  float coverage;
  float depth;     // metre
  float fraction;  // of the strand's length, 0 at the root
  float width_px;
  vec3 tangent;    // unit, view space, or 0
  float along;     // parameter of the segment, 0 at a
};

// Whether a pixel belongs to a strand that is at least a pixel wide (FLK_METHOD_HARD).
bool insideHard(vec2 center, vec4 axis, vec4 lines, vec4 extent, vec2 t, float l) {
  vec2 r = center - axis.xy;
  float y = dot(r, t), h = mix(extent.x, extent.y, clamp(y / l, 0.0, 1.0));
  // A line of 0 is a strand's own end: it stops there.
  return abs(dot(r, leftNormal(t))) <= max(h, 0.5) && betweenLines(center, axis.xy, axis.zw, lines.xy, lines.zw) &&
         (lines.xy != vec2(0.0) || y >= 0.0) && (lines.zw != vec2(0.0) || y < l);
}

// Coverage is 0 outside the quad. joint: slopes of the lines that end it, share of its opacity.
StrandFragment strandFragment(vec2 center, vec4 axis, vec4 lines, vec4 extent, vec4 depth, vec3 tangent_a, vec4 tangent_b,
                              vec2 t, vec3 joint, float orthographic) {
  StrandFragment f;
  vec2 n = leftNormal(t);
  float a = max(abs(n.x), abs(n.y)), b = min(abs(n.x), abs(n.y));
  vec2 r = center - axis.xy;
  float x = dot(r, n), y = dot(r, t), l = tangent_b.w;  // l >= kShortestSegment: others make no quad
  float v = clamp(y / l, 0.0, 1.0);
  float h = mix(extent.x, extent.y, v);
  float strip = boxEdge(x + h, a, b) - boxEdge(x - h, a, b);
  // 1 away from root and tip. The ways to them start at the lines: a mitre's point is no way past the strand's end.
  float ends = boxEdge(y - x * joint.x + extent.z, a, b) + boxEdge(l - y - x * joint.y + extent.w, a, b);
  f.coverage = betweenLines(center, axis.xy, axis.zw, lines.xy, lines.zw) ? joint.z * strip * max(ends, 0.0) : 0.0;
  f.width_px = 2.0 * h;

  float u = v;
  if (orthographic > 0.5) {
    f.depth = mix(depth.x, depth.y, v);
  } else {
    f.depth = 1.0 / mix(1.0 / depth.x, 1.0 / depth.y, v);  // depths >= near plane > 0
    u = clamp(v * f.depth / depth.y, 0.0, 1.0);
  }
  f.fraction = mix(depth.z, depth.w, u);
  f.tangent = unitOrZero(mix(tangent_a, tangent_b.xyz, u));
  f.along = u;
  return f;
}

#endif
