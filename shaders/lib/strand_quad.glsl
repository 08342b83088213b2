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

// Slope that the line that splits two segments may always have: the mitre of a bend of 127 degrees.
const float kSteepestSplit = 2.0;

struct QuadEnd {
  vec2 middle, arm;  // its two corners are middle - arm, middle + arm
  vec2 line;         // normal of the line that ends the quad, pointing along the strand; 0: no line
  float slope;       // of that line: how far it leans along the strand per pixel towards the left of a start, the right of an end
};

// The end of `own` at a joint. p: the joint; before, after: the segments that meet there, one of them own;
// reach: of the two the larger. Where the lines of both ends cross inside the reach the corners do too: both triangles of the
// quad then cover what lies between the lines, one of them nothing else.
QuadEnd jointEnd(vec2 p, float reach, FlatSegment before, FlatSegment after, bool own_is_before) {
  vec2 sum = before.t + after.t;  // the same numbers for both segments: a pixel is in one of them
  float c = 0.5 * dot(sum, sum);  // 1 + cos(theta), with all its digits near a full turn back
  float s = before.t.x * after.t.y - before.t.y * after.t.x;
  vec2 t = own_is_before ? before.t : after.t;
  float outward = own_is_before ? 1.0 : -1.0;
  // Half a segment is left to each joint: split lines that stay within it never cross, however steep. reach > 0.
  float steepest = max(kSteepestSplit, 0.5 * min(before.l, after.l) / reach);
  QuadEnd end;
  // tan(theta / 2) = |s| / c; multiplied out, so that a full turn back needs no guard.
  if (abs(s) <= steepest * c && c > 0.0) {
    end.slope = s / c;
    end.arm = reach * (leftNormal(before.t) + leftNormal(after.t)) / c;
    end.line = sum;
  } else {
    end.slope = sign(s) * steepest;
    end.arm = reach * (leftNormal(t) - outward * end.slope * t);
    end.line = t + outward * end.slope * leftNormal(t);
  }
  end.middle = p + outward * kCornerSlack * t;
  return end;
}

// An end without a neighbour, drawn on for `e` past p; cut: the quad ends at p, else coverage fades it out.
QuadEnd freeEnd(vec2 p, float reach, vec2 t, float outward, float e, bool cut) {
  return QuadEnd(p + outward * (cut ? kCornerSlack : e) * t, reach * leftNormal(t), cut ? t : vec2(0.0), 0.0);
}

// Points across a segment beside a strand's end where its area is summed.
const int kShareNodes = 32;

// Area of the ends' ramps where the lines of both ends are y apart. on: drawn past the strand's root, tip; p: way to them.
float rampArea(float y, vec2 on, vec2 p, float a, float b) {
  float whole = y + on.x + on.y;
  if (whole <= 0.0) return 0.0;
  return max(boxEdgeSum(y + on.y + p.x, a, b) - boxEdgeSum(p.x - on.x, a, b) + boxEdgeSum(y + on.x + p.y, a, b) -
                 boxEdgeSum(p.y - on.y, a, b) - whole, 0.0);
}

// What is left of a segment's opacity so that its pixels still sum to its area: lines that cross let in more on the outside
// of the bend than they leave out inside. slope: sum of both ends'.
float areaShare(FlatSegment segment, float h, float slope, vec2 on, vec2 p) {
  vec2 n = abs(segment.t);
  float a = max(n.x, n.y), b = min(n.x, n.y);
  float extent = 0.5 * (a + b), reach = h + extent, s = abs(slope);
  if (min(p.x, p.y) >= extent) {
    if (s * reach <= segment.l) return 1.0;  // also s = 0
    float x = segment.l / s;
    // Mean of boxEdgeSum(-t) over x - h to x + h; the difference has no digits where the strand is thin.
    float mean = h < 0.05 ? (boxEdgeSum(h - x, a, b) + 4.0 * boxEdgeSum(-x, a, b) + boxEdgeSum(-x - h, a, b)) / 6.0
                          : (boxEdgeBeyond(x - h, a, b) - boxEdgeBeyond(x + h, a, b)) / (2.0 * h);
    return clamp(x / (x + mean), 0.0, 1.0);  // x > 0
  }
  if (s * reach <= segment.l - extent || s == 0.0) return 1.0;
  float whole = 0.0, left = 0.0;
  for (int i = 0; i < kShareNodes; ++i) {
    float x = reach * (float(2 * i + 1) / float(kShareNodes) - 1.0);
    float strip = boxEdge(x + h, a, b) - boxEdge(x - h, a, b);
    whole += strip;
    left += strip * rampArea(segment.l - s * x, on, p, a, b);
  }
  float wanted = whole * rampArea(segment.l, on, p, a, b);
  return left > wanted ? wanted / left : 1.0;
}

// Whether a pixel centre lies between the lines of both ends.
bool betweenLines(vec2 center, vec2 a, vec2 b, vec2 line_a, vec2 line_b) {
  bool after_a = dot(center - a, line_a) >= 0.0, before_b = dot(center - b, line_b) < 0.0, no_line = line_b == vec2(0.0);
  return after_a && (before_b || no_line);
}

#endif
