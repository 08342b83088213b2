// One picture besides the colour (FlkFrame.outputs), from the same lists. FLK_OUTPUT: which.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_LISTS
#include "bindings.glsl"
#include "../lib/projection.glsl"
#include "list.glsl"
#include "tile_order.glsl"

#define FLK_FRONT_DEPTH 0
#define FLK_TRANSMITTANCE 1
#define FLK_VELOCITY 2
#define FLK_DEPTH_RANGE 3
layout(constant_id = FLK_SPEC_STORE) const int kStore = FLK_STORE_LISTS;  // FLK_STORE_HARD_PAYLOAD: one opaque fragment a pixel
layout(constant_id = FLK_SPEC_COLORS_LISTED) const bool kColorsListed = false;

#if FLK_OUTPUT == FLK_VELOCITY
layout(set = 0, binding = 5, rg16f) writeonly uniform image2D picture;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MatrixList { mat4 at[]; };
layout(push_constant, scalar) uniform PushConstants { uvec2 before; };  // clip space of the frame before from view space now, a matrix a hair
#elif FLK_OUTPUT == FLK_DEPTH_RANGE
layout(set = 0, binding = 5, rg32f) writeonly uniform image2D picture;
#else
layout(set = 0, binding = 5, r32f) writeonly uniform image2D picture;
#endif

void main() {
  uvec2 pixel;
  uint index, link;
  if (!tilePixel(pixel, index, link)) return;
  float least = 3.4e38, greatest = 0.0, transmittance = 1.0;
  uint slot = 0u;
  if (kStore == FLK_STORE_HARD_PAYLOAD) {
    if (link == kDepthNone) return;
    least = greatest = uintBitsToFloat(link);  // that method's heads are depths
    transmittance = 0.0;
    slot = min(heads[frame.rect.z * frame.rect.w + index] >> 26, FLK_MAX_HAIRS - 1u);
  } else {
    Key front = keyNone();
    uint tau = 0u;  // integers: the same whatever the order of the list
    bool opaque = false;
    while (link != FLK_LINK_END) {
      Key key = readNode(link);
      if (keyLess(key, front, kOneHair, kColor)) front = key;
      greatest = max(greatest, uintBitsToFloat(key.depth));
      vec3 unused;
      float alpha;
      if (kColorsListed) unpackColor(key.payload, 1.0, kPayload, unused, alpha);
      else unpackTangent(key.payload, kPayload, unused, alpha);
      tau += uint(min(-log2(max(1.0 - alpha, 1.0 / 8192.0)), FLK_TAU_MOST) * FLK_TAU_STEPS + 0.5);
      opaque = opaque || alpha >= 1.0;
    }
    Aggregate rest = readAggregate(index, kColorsListed);
    if (front.depth == kDepthNone && !(rest.tau > 0.0)) return;
    if (front.depth != kDepthNone) least = uintBitsToFloat(front.depth), slot = front.slot;
    if (rest.tau > 0.0 && !kColorsListed) {  // aggregates of colours know no depth
      if (rest.least < least) slot = rest.slot;
      least = min(least, rest.least), greatest = max(greatest, rest.greatest);
    }
    transmittance = opaque ? 0.0 : exp2(-min(float(tau) / FLK_TAU_STEPS + rest.tau, 126.0));
  }
  ivec2 p = ivec2(pixel + frame.rect.xy);
#if FLK_OUTPUT == FLK_FRONT_DEPTH
  imageStore(picture, p, vec4(least));
#elif FLK_OUTPUT == FLK_TRANSMITTANCE
  imageStore(picture, p, vec4(transmittance));
#elif FLK_OUTPUT == FLK_DEPTH_RANGE
  imageStore(picture, p, vec4(least, greatest, 0.0, 0.0));
#else
  vec2 at = vec2(p) + 0.5;
  vec3 now = unprojectPixel(at, least, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size);
  vec4 was = MatrixList(before).at[slot] * vec4(now, 1.0);
  // Behind the camera before, or a camera that jumped: no motion rather than a wild one.
  vec2 velocity = was.w > 0.0 ? at - (was.xy / was.w * 0.5 + 0.5) * frame.size : vec2(0.0);
  imageStore(picture, p, vec4(clamp(velocity, vec2(-65504.0), vec2(65504.0)), 0.0, 0.0));
#endif
}
