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

// Of a mix of two tangents, each a unit vector or 0.
vec3 unitTangent(vec3 mixed) {
  float square = dot(mixed, mixed);
  return square > 1e-12 ? mixed * inversesqrt(square) : vec3(0.0);
}

// What the fragments of a quad share, made once for many of them.
struct QuadFacts {
  PixelBox box;
  float inverse_length;
};

QuadFacts quadFacts(vec2 t, float l) {
  QuadFacts facts;
  vec2 n = abs(t);
  facts.box = pixelBox(max(n.x, n.y), min(n.x, n.y));
  facts.inverse_length = 1.0 / l;  // l >= kShortestSegment: others make no quad
  return facts;
}

// Coverage is 0 outside the quad. depth: in perspective the inverses of depths, which are linear on the screen. joint: slopes of the
// lines that end it, share of its opacity.
StrandFragment strandFragment(vec2 center, QuadFacts facts, vec4 axis, vec4 lines, vec4 extent, vec4 depth, vec3 tangent_a, vec4 tangent_b,
                              vec2 t, vec3 joint, float orthographic) {
  StrandFragment f;
  vec2 r = center - axis.xy;
  float x = dot(r, leftNormal(t)), y = dot(r, t), l = tangent_b.w;
  float v = clamp(y * facts.inverse_length, 0.0, 1.0);
  float h = mix(extent.x, extent.y, v);
  float strip = boxEdge(x + h, facts.box) - boxEdge(x - h, facts.box);
  // 1 away from root and tip. The ways to them start at the lines: a mitre's point is no way past the strand's end.
  float ends = boxEdge(y - x * joint.x + extent.z, facts.box) + boxEdge(l - y - x * joint.y + extent.w, facts.box);
  f.coverage = betweenLines(center, axis.xy, axis.zw, lines.xy, lines.zw) ? joint.z * strip * max(ends, 0.0) : 0.0;
  f.width_px = 2.0 * h;

  f.depth = mix(depth.x, depth.y, v);
  float u = v;
  if (orthographic < 0.5) {
    f.depth = 1.0 / f.depth;  // depths >= near plane > 0
    u = clamp(v * f.depth * depth.y, 0.0, 1.0);
  }
  f.fraction = mix(depth.z, depth.w, u);
  f.tangent = unitTangent(mix(tangent_a, tangent_b.xyz, u));
  f.along = u;
  return f;
}

#endif
