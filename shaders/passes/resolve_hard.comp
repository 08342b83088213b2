// FLK_METHOD_HARD: the one fragment of a pixel, in full and opaque.
#version 460
#extension GL_GOOGLE_include_directive : require
#define FLK_BIND_LISTS
#define FLK_BIND_TARGET
#include "bindings.glsl"
#include "../lib/projection.glsl"
#include "../lib/shading.glsl"
#include "../lib/shadow.glsl"
#include "list.glsl"
#include "light.glsl"
#include "shade_key.glsl"
#include "tile_order.glsl"
#include "composite.glsl"

void main() {
  uvec2 pixel;
  uint index, depth;
  if (!tilePixel(pixel, index, depth)) return;
  uint plane = frame.rect.z * frame.rect.w;
  if (depth == kDepthNone) return;
  uint key = heads[plane + index];
  vec3 color = shadeTangent(min(key >> 26, FLK_MAX_HAIRS - 1u), octDecode(key, 13), uintBitsToFloat(depth),
                            kColor ? heads[2u * plane + index] : 0u, shadeSource(pixel + frame.rect.xy), true);
  compositePixel(pixel, color, 0.0);
  countPixel();
}
