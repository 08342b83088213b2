// Empties what a frame by compute fills: list heads, counters, hair shadow maps. One dispatch, because a device's own fills may each
// take as long as all of it, and its clear of an image may run on the few processors that draw (76 us of 1024 x 1024 texels on an
// NVIDIA H200).
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_LISTS
#define FLK_BIND_SHADOW_STORE
#include "bindings.glsl"
#include "../shared/node.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { uint head_count; };

void main() {
  uvec2 id = gl_GlobalInvocationID.xy, count = gl_NumWorkGroups.xy * 8u;
  // A group takes a square of texels: with a texel a lane it was the number of groups that took the time.
  uvec2 corner = gl_WorkGroupID.xy * FLK_CLEAR_SIDE;
  if (all(lessThan(corner, uvec2(imageSize(shadow_store)))))
    for (uint y = 0u; y < FLK_CLEAR_SIDE; y += 8u)
      for (uint x = 0u; x < FLK_CLEAR_SIDE; x += 8u)  // past the edge: nothing
        imageStore(shadow_store, ivec2(corner + gl_LocalInvocationID.xy + uvec2(x, y)), uvec4(floatBitsToUint(1.0)));
  uint at = id.y * count.x + id.x;
  if (at < FLK_COUNTER_WORDS) counters[at] = 0u;
  for (; at < head_count; at += count.x * count.y) heads[at] = FLK_LINK_END;
}
