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

// d: b - a, not from their difference: that has no digits left where segments are short and far from the origin.
FlatSegment flatSegment(vec2 a, vec2 b, vec2 d) {
  float l = length(d);
  bool drawn = l >= kShortestSegment;  // false for NaN
  return FlatSegment(a, b, drawn ? d / l : vec2(0.0), drawn ? l : 0.0);
}

vec2 leftNormal(vec2 t) { return vec2(-t.y, t.x); }

// Half width across direction t of a cylinder of radius r, for s pixels per metre along x and y.
float halfWidth(float r, vec2 s, vec2 t) {
  return s.x == s.y ? r * s.x : r * s.x * s.y * length(t / s);  // |t| = 1
}

// Rasterisers round corners to a fraction of a pixel (1/256 where it is coarsest): quads are drawn this much longer at joints,
// and the fragment shader tests the line itself, so that segments much shorter than a pixel are not drawn at random.
const float kCornerSlack = 1.0 / 64.0;

struct QuadEnd {
  vec2 corner;
  vec2 line;  // normal of the line that ends the quad, pointing along the strand; 0: no line
};

// The end of `own` at a joint, on side -1 or +1. p: the joint; before, after: the segments that meet there, one of them own;
// reach: of the two the larger.
QuadEnd jointEnd(vec2 p, float side, float reach, FlatSegment before, FlatSegment after, bool own_is_before) {
  float c = clamp(dot(before.t, after.t), -1.0, 1.0);
  float s = before.t.x * after.t.y - before.t.y * after.t.x;
  float k_max = 0.5 * min(before.l, after.l);
  vec2 t = own_is_before ? before.t : after.t;
  float outward = own_is_before ? 1.0 : -1.0;
  QuadEnd end;
  // tan(theta / 2) = |s| / (1 + c); multiplied out, so that a full turn back needs no guard.
  if (reach * abs(s) <= k_max * (1.0 + c) && 1.0 + c > 0.0) {
    end.corner = p + side * reach * (leftNormal(before.t) + leftNormal(after.t)) / (1.0 + c);
    end.line = before.t + after.t;  // the same numbers for both segments: a pixel is in one of them
  } else {
    float along = sign(s) * k_max;
    end.corner = p + side * reach * leftNormal(t) - outward * side * along * t;
    end.line = t * reach + outward * along * leftNormal(t);
  }
  end.corner += outward * kCornerSlack * t;
  return end;
}

// An end without a neighbour, drawn on for `e` past p; cut: the quad ends at p, else coverage fades it out.
QuadEnd freeEnd(vec2 p, float side, float reach, vec2 t, float outward, float e, bool cut) {
  return QuadEnd(p + side * reach * leftNormal(t) + outward * (cut ? kCornerSlack : e) * t, cut ? t : vec2(0.0));
}

// Whether a pixel centre lies between the lines of both ends.
bool betweenLines(vec2 center, vec2 a, vec2 b, vec2 line_a, vec2 line_b) {
  return dot(center - a, line_a) >= 0.0 && (dot(center - b, line_b) < 0.0 || line_b == vec2(0.0));
}

#endif
