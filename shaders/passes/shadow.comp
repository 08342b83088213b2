// Shadow maps without a rasteriser: quads are walked as in capture.comp, and a texel keeps the least depth by an atomic (positive floats
// sort as integers).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_HAIR
#define FLK_BIND_SHADOW_STORE
#include "bindings.glsl"
#include "../shared/walk.h"
layout(local_size_x = FLK_WALK_LANES) in;
#include "map_segment.glsl"
#include "walk.glsl"

shared MapShape shapes[kWalkSegments];

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * kWalkSegments + lane;
  ivec2 corner = ivec2(FaceList(frame.faces).at[FLK_FACE].offset);
  int size = int(FaceList(frame.faces).at[FLK_FACE].size);
  float middle = float(size) * 0.5;
  ivec4 rect = ivec4(0, 0, size, size);
  QuadWalk walk = emptyWalk();
  MapShape shape;
  QuadEnd end_a, end_b;
  if (lane < kWalkSegments && index < segment_count && mapShape(first_segment + index, shape, end_a, end_b)) {
    shapes[lane] = shape;
    walk = quadWalk(shape.axis.xy + middle, shape.direction.xy, end_a, end_b, vec2(middle), rect);
  }
  uint total = shareWalks(walk);
  for (uint task = lane; task < total; task += kWalkLanes) {
    uint owner;
    ivec2 first;
    int count;
    walkTask(task, rect, owner, first, count);
    MapShape of = shapes[owner];
    bool columns = walkColumns(owner);
    for (int i = 0; i < count; ++i) {
      ivec2 texel = first + (columns ? ivec2(0, i) : ivec2(i, 0));
      float value;
      if (mapDepth(of, vec2(texel) + 0.5 - middle, value)) imageAtomicMin(shadow_store, corner + texel, floatBitsToUint(value));
    }
  }
}
