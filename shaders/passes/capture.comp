// Capture without a rasteriser: a group takes 64 segments, shapes each in a lane, and then deals out the columns (or rows, across
// the segment's longer axis) of all their quads evenly. The fragments are those of capture.frag.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_LISTS
layout(local_size_x = 64) in;
#include "bindings.glsl"
#include "screen_segment.glsl"
#include "capture_quad.glsl"
#include "walk.glsl"

shared SegmentShape shapes[kWalkSegments];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kWalkSegments + lane;
  QuadWalk walk = emptyWalk();
  SegmentShape shape;
  QuadEnd end_a, end_b;
  if (index < segment_count && segmentShape(first_segment + index, shape, end_a, end_b)) {
    shapes[lane] = shape;
    vec2 middle = frame.size * 0.5;
    walk = quadWalk(shape.axis.xy + middle, shape.direction, end_a, end_b, middle, ivec4(frame.rect.xy, frame.rect.xy + frame.rect.zw));
  }
  uint total = shareWalks(walk);
  for (uint task = lane; task < total; task += kWalkSegments) {
    uint owner;
    ivec2 first;
    int count;
    walkTask(task, owner, first, count);
    SegmentShape of = shapes[owner];
    bool columns = walkColumns(owner);
    for (int i = 0; i < count; ++i) captureQuad(of, uvec2(first + (columns ? ivec2(0, i) : ivec2(i, 0))), true);
  }
}
