// A strand segment as a quad in pixels or texels (docs/methods.md section 1).
#ifndef FORELOCK_LIB_STRAND_QUAD
#define FORELOCK_LIB_STRAND_QUAD
#include "coverage.glsl"

// Shorter segments have no direction worth drawing.
const float kShortestSegment = 1e-6;

struct FlatSegment {
  vec2 a, b;
  vec2 t;   // unit direction a to b, or 0
  float l;  // length; 0 where the segment makes no quad
};

FlatSegment flatSegment(vec2 a, vec2 b) {
  vec2 d = b - a;
  float l = length(d);
  bool drawn = l >= kShortestSegment;  // false for NaN
  return FlatSegment(a, b, drawn ? d / l : vec2(0.0), drawn ? l : 0.0);
}

vec2 leftNormal(vec2 t) { return vec2(-t.y, t.x); }

// Half width across direction t of a cylinder of radius r, for s pixels per metre along x and y.
float halfWidth(float r, vec2 s, vec2 t) {
  return s.x == s.y ? r * s.x : r * s.x * s.y * length(t / s);  // |t| = 1
}

// Corner at a joint, on side -1 or +1 of `own`. p: the joint; before, after: the segments that meet there, one of them own;
// reach: of the two the larger.
vec2 jointCorner(vec2 p, float side, float reach, FlatSegment before, FlatSegment after, bool own_is_before) {
  float c = clamp(dot(before.t, after.t), -1.0, 1.0);
  float s = before.t.x * after.t.y - before.t.y * after.t.x;
  float k_max = 0.5 * min(before.l, after.l);
  // tan(theta / 2) = |s| / (1 + c); multiplied out, so that a full turn back needs no guard.
  if (reach * abs(s) <= k_max * (1.0 + c) && 1.0 + c > 0.0)
    return p + side * reach * (leftNormal(before.t) + leftNormal(after.t)) / (1.0 + c);
  float along = side * sign(s) * k_max;
  return own_is_before ? p + side * reach * leftNormal(before.t) - along * before.t
                       : p + side * reach * leftNormal(after.t) + along * after.t;
}

// Corner at an end without a neighbour; `outward` is +t or -t, `e` how far the quad goes on.
vec2 endCorner(vec2 p, float side, float reach, vec2 t, vec2 outward, float e) {
  return p + side * reach * leftNormal(t) + outward * e;
}

#endif
