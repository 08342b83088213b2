// Capture without a rasteriser: a group takes kWalkSegments segments, shapes each in a lane, and then deals out the columns (or rows,
// across the segment's longer axis) of all their quads evenly. The fragments are those of capture.frag. A lane visits a few pixels
// before what is kept of them is counted and stored: one counter for all would else hold up every fragment.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "../shared/walk.h"
layout(local_size_x = FLK_WALK_LANES) in;
#include "screen_segment.glsl"
#include "capture_quad.glsl"
#include "walk.glsl"

#ifdef FLK_CAPTURE_FORWARD
const int kSteps = 2;  // pixels a lane visits at a time
#else
const int kSteps = 4;
#endif

shared SegmentShape shapes[kWalkSegments];
shared FibreColors fibres[kColor ? kWalkSegments : 1u];

#ifdef FLK_CAPTURE_FORWARD
// Fragments wait here: many of a quad's pixels are not kept, and what is kept is shaded by lanes that are all at work.
const uint kQueue = kWalkLanes * uint(kSteps);
shared uint queued, queue_base, lanes_left;
shared uint queue_pixel[kQueue];
shared float queue_depth[kQueue], queue_alpha[kQueue];
shared vec3 queue_tangent[kQueue];
shared vec3 queue_color[kColor ? kQueue : 1u];

void enqueue(Captured c) {
  uvec4 here = subgroupBallot(true);
  uint at = 0u;
  if (subgroupElect()) at = atomicAdd(queued, subgroupBallotBitCount(here));
  at = subgroupBroadcastFirst(at) + subgroupBallotExclusiveBitCount(here);
  queue_pixel[at] = c.pixel.x | c.pixel.y << 16;
  queue_depth[at] = c.depth;
  queue_alpha[at] = c.alpha;
  queue_tangent[at] = c.tangent;
  if (kColor) queue_color[at] = c.color;
}

Captured dequeue(uint at) {
  uint pixel = queue_pixel[at];
  return Captured(uvec2(pixel & 0xFFFFu, pixel >> 16), queue_depth[at], queue_alpha[at], queue_tangent[at], kColor ? queue_color[at] : vec3(0.0));
}
#endif

// A column of a quad, or what is left of it.
struct Column {
  SegmentShape shape;
  QuadFacts facts;
  FibreColors colors;
  uvec2 pixel, step;
  vec2 at, way;      // the pixel's centre
  int left;
};

Column columnOf(uint task, int done, ivec4 rect) {
  Column column;
  uint owner;
  ivec2 first;
  int count;
  walkTask(task, rect, owner, first, count);
  column.shape = shapes[owner];
  column.facts = factsOf(column.shape);
  if (kColor) column.colors = fibres[owner];
  column.step = walkColumns(owner) ? uvec2(0u, 1u) : uvec2(1u, 0u);
  column.pixel = uvec2(first) + uint(done) * column.step;
  column.at = vec2(column.pixel) + 0.5;
  column.way = vec2(column.step);
  column.left = count - done;
  return column;
}

// What a quad adds to the tiles that its axis runs through, a tile's length at a time.
void countWalk(QuadWalk walk) {
  for (int cut = 0; cut < walk.count; cut += int(FLK_TILE)) {
    int cuts = min(walk.count - cut, int(FLK_TILE));
    float along = float(walk.first + cut) + 0.5 * float(cuts), across = walk.start + (float(cut) + 0.5 * float(cuts - 1)) * walk.slope;
    countTile(walk.columns ? vec2(along, across) : vec2(across, along), uint(cuts));
  }
}

bool captureNext(inout Column column, bool live, out Captured kept) {
  bool keeps = captureFragment(column.shape, column.facts, column.colors, column.pixel, column.at, live, kept);
  column.pixel += column.step;
  column.at += column.way;
  return keeps;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kWalkSegments + lane;
  ivec4 rect = ivec4(frame.rect.xy, frame.rect.xy + frame.rect.zw);
  QuadWalk walk = emptyWalk();
  SegmentShape shape;
  FibreColors colors;
  QuadEnd end_a, end_b;
  if (lane < kWalkSegments && index < segment_count && segmentShape(first_segment + index, shape, colors, end_a, end_b)) {
    shapes[lane] = shape;
    if (kColor) fibres[lane] = colors;
    vec2 middle = frame.size * 0.5;
    walk = quadWalk(shape.axis.xy + middle, shape.direction, end_a, end_b, middle, rect);
  }
#ifdef FLK_CAPTURE_FORWARD
  if (lane == 0u) queued = 0u, lanes_left = 0u;
#endif
  uint total = shareWalks(walk);
  if (kStore == FLK_STORE_LISTS) {
    uint from_last = kWalkLanes - 1u - lane;
    if (from_last < kWalkSegments) countWalk(walks[from_last]);
    if (from_last == 0u && total > 0u) countTiles(total);
  }
  uint task = lane;
  int done = 0;  // pixels of the task
  if (kHard || kStore == FLK_STORE_COUNT) {
    uint counted = 0u;
    for (; task < total; task += kWalkLanes) {
      Column column = columnOf(task, 0, rect);
      for (int i = 0; i < column.left; ++i) {
        Captured kept;
        if (kHard) {
          captureHard(column.shape, column.facts, column.colors, column.pixel, column.at);
          column.pixel += column.step, column.at += column.way;
        } else if (captureNext(column, true, kept)) {
          ++counted;
        }
      }
    }
    if (counted > 0u) countFragments(counted);
    return;
  }

#ifdef FLK_CAPTURE_FORWARD
  bool more;
  do {
    if (task < total) {
      Column column = columnOf(task, done, rect);
      for (int i = 0; i < min(column.left, kSteps); ++i) {
        Captured kept;
        if (captureNext(column, true, kept)) enqueue(kept);
      }
      done += kSteps;
      if (column.left <= kSteps) task += kWalkLanes, done = 0;
    }
    if (task < total) lanes_left = 1u;
    barrier();
    uint waiting = queued;
    more = lanes_left != 0u;
    if (lane == 0u && waiting > 0u) queue_base = countFragments(waiting);
    barrier();
    if (lane == 0u) queued = 0u, lanes_left = 0u;
    for (uint at = lane; at < waiting; at += kWalkLanes) {
      Captured c = dequeue(at);
      storeCaptured(c, queue_base + at, linkFragment(c.pixel, queue_base + at));
    }
    barrier();
  } while (more);
  addWork();
#else
  // All lanes of a subgroup stay together until the last has no column left.
  while (subgroupBallot(task < total) != uvec4(0u)) {
    Column column = columnOf(min(task, total - 1u), done, rect);  // the ballot has found a task
    if (task >= total) column.left = 0;
    Captured kept[kSteps];
    uint numbers[kSteps], links[kSteps];
    uint waiting = 0u;
    // Past the column's end as well, where nothing is kept: without branches all of them are under way at once.
    bool keeps[kSteps];
    [[unroll]] for (int i = 0; i < kSteps; ++i) keeps[i] = captureNext(column, i < column.left, kept[i]);
    [[unroll]] for (int i = 0; i < kSteps; ++i) {
      uvec4 keepers = subgroupBallot(keeps[i]);
      numbers[i] = waiting + subgroupBallotExclusiveBitCount(keepers);
      waiting += subgroupBallotBitCount(keepers);
    }
    uint base = 0u;
    if (subgroupElect() && waiting > 0u) base = countFragments(waiting);
    base = subgroupBroadcastFirst(base);
    [[unroll]] for (int i = 0; i < kSteps; ++i)
      if (keeps[i]) links[i] = linkFragment(kept[i].pixel, base + numbers[i]);
    [[unroll]] for (int i = 0; i < kSteps; ++i)
      if (keeps[i]) storeCaptured(kept[i], base + numbers[i], links[i]);
    done += kSteps;
    if (column.left <= kSteps) task += kWalkLanes, done = 0;
  }
#endif
}
