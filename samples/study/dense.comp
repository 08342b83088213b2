// Every fragment of a view shaded in full, one a lane, from memory in order: what `forward` would pay for shading alone if capture handed
// it over without loss. The light is that of the SDK's own passes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define FLK_BIND_SHADOW
#include "passes/bindings.glsl"
#include "lib/packing.glsl"
#include "lib/projection.glsl"
#include "lib/shading.glsl"
#include "lib/shadow.glsl"
#include "passes/light.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1) writeonly buffer Results { uint results[]; };
layout(set = 0, binding = 2) readonly buffer Fragments { uvec4 fragments[]; };  // pixel, depth, tangent, code of alpha
layout(push_constant) uniform Push { uint count; };

void main() {
  uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (index >= count) return;
  uvec4 held = fragments[index];
  uvec2 pixel = uvec2(held.x & 0xFFFFu, held.x >> 16);
  vec3 color = radianceFull(frame.hairs[0], frame.hairs[0].color, frameLight(pixel), octDecode(held.z, 13), pixelRay(vec2(pixel) + 0.5),
                            uintBitsToFloat(held.y), pixel);
  results[index] = packColor(color, held.w, frame.color_range, FLK_CODING_DEFAULT);
}
