// The pixels of a group's quads, dealt out evenly: each quad is cut across its longer axis into columns or rows a pixel wide, whose
// lengths hardly differ, and lanes take them in turn. Included by compute rasterisers of kWalkLanes lanes.
#ifndef FORELOCK_PASSES_WALK
#define FORELOCK_PASSES_WALK
#include "../shared/walk.h"

const uint kWalkLanes = uint(FLK_WALK_LANES);
const uint kWalkSegments = FLK_WALK_SEGMENTS;
// Whether a pixel belongs to a quad is decided by its own coverage: some more are visited, so that rounding leaves none out.
const float kWalkSlack = 1.0 / 64.0;

struct QuadWalk {
  bool columns;      // cut along x; else along y
  int first, count;  // the cuts that lie in the rectangle
  float start;       // where the axis crosses the middle of cut 0, on the other axis
  float slope;       // and how far it moves a cut
  float half_length; // pixels of a cut to each side of the axis
};

QuadWalk emptyWalk() { return QuadWalk(true, 0, 0, 0.0, 0.0, 0.0); }

vec2 acrossRange(bool columns, ivec4 rect) { return columns ? vec2(rect.y, rect.w) : vec2(rect.x, rect.z); }

// origin: a point of the axis; the ends' corners count from `middle`. rect: least pixel, and one past the greatest.
// A far coordinate must not wrap when it becomes an integer: all are clamped to the rectangle first.
QuadWalk quadWalk(vec2 origin, vec2 t, QuadEnd a, QuadEnd b, vec2 middle, ivec4 rect) {
  vec2 arm_a = abs(a.arm), arm_b = abs(b.arm), at_a = a.middle + middle, at_b = b.middle + middle;
  vec2 low = min(at_a - arm_a, at_b - arm_b), high = max(at_a + arm_a, at_b + arm_b);
  QuadWalk walk;
  walk.columns = abs(t.x) >= abs(t.y);
  // The strip: what lies within `reach` of the axis. An arm's part across the strand is its reach, whatever the slope.
  float reach = max(abs(dot(a.arm, leftNormal(t))), abs(dot(b.arm, leftNormal(t))));
  float along = walk.columns ? t.x : t.y, across = walk.columns ? t.y : t.x;  // |along| >= 1 / sqrt(2)
  walk.slope = across / along;
  walk.half_length = reach / abs(along);
  vec2 range = walk.columns ? vec2(low.x, high.x) : vec2(low.y, high.y);
  vec2 bounds = walk.columns ? vec2(rect.x, rect.z) : vec2(rect.y, rect.w);
  vec2 other = walk.columns ? vec2(low.y, high.y) : vec2(low.x, high.x);
  vec2 other_bounds = acrossRange(walk.columns, rect);
  float first = clamp(ceil(range.x - 0.5 - kWalkSlack), bounds.x, bounds.y);
  float last = clamp(floor(range.y + 0.5 + kWalkSlack), bounds.x, bounds.y);
  bool seen = last > first && other.y >= other_bounds.x && other.x <= other_bounds.y;  // false for NaN
  walk.first = int(first);
  walk.count = seen ? int(last - first) : 0;
  vec2 o = walk.columns ? origin : origin.yx;
  walk.start = o.y + (first + 0.5 - o.x) * walk.slope;
  walk.half_length += 1e-6 * (abs(o.x) + abs(o.y));  // what fp32 loses on the way from a far origin
  return walk;
}

shared QuadWalk walks[kWalkSegments];
shared uint walk_ends[kWalkSegments];  // sums of counts

// All lanes: the first kWalkSegments hand in a quad each; how many cuts there are.
uint shareWalks(QuadWalk walk) {
  uint lane = gl_LocalInvocationID.x;
  if (lane < kWalkSegments) walks[lane] = walk;
  barrier();
  uint sum = 0u;
  for (uint i = 0u; i < kWalkSegments; ++i) {
    sum += uint(walks[i].count);
    if (i == lane) walk_ends[lane] = sum;
  }
  barrier();
  return sum;
}

bool walkColumns(uint owner) { return walks[owner].columns; }

// Cut number `task`: whose, its first pixel and how many it has. rect: of quadWalk().
void walkTask(uint task, ivec4 rect, out uint owner, out ivec2 first, out int count) {
  owner = 0u;
  for (uint step = kWalkSegments / 2u; step > 0u; step /= 2u)
    if (walk_ends[owner + step - 1u] <= task) owner += step;
  QuadWalk walk = walks[owner];
  int cut = int(task - (owner > 0u ? walk_ends[owner - 1u] : 0u));
  vec2 bounds = acrossRange(walk.columns, rect);
  float center = walk.start + float(cut) * walk.slope;
  float low = clamp(ceil(center - walk.half_length - 0.5 - kWalkSlack), bounds.x, bounds.y);
  float high = clamp(floor(center + walk.half_length + 0.5 + kWalkSlack), bounds.x, bounds.y);
  count = max(int(high - low), 0);
  first = walk.columns ? ivec2(walk.first + cut, int(low)) : ivec2(int(low), walk.first + cut);
}

#endif
