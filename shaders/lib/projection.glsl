// Pixels and view space (docs/methods.md section 1).
#ifndef FORELOCK_LIB_PROJECTION
#define FORELOCK_LIB_PROJECTION
#include "../shared/frame.h"

// Pixel position, from the middle of the target (where fp32 is finest), of a view-space point at depth -p.z > 0.
vec2 projectToPixel(vec3 p, vec2 scale, vec2 offset, float orthographic, vec2 size) {
  vec2 ndc = orthographic > 0.5 ? p.xy * scale + offset : (p.xy * scale + p.z * offset) / -p.z;
  return ndc * 0.5 * size;
}

// Pixels from the projection of p to that of p + d, without the cancellation of two projections.
vec2 projectDelta(vec3 p, vec3 d, vec2 scale, float orthographic, vec2 size) {
  vec2 ndc = orthographic > 0.5 ? d.xy * scale : (d.xy - p.xy * (d.z / p.z)) * scale / -(p.z + d.z);
  return ndc * 0.5 * size;
}

// View-space point at a pixel position and depth.
vec3 unprojectPixel(vec2 pixel, float depth, vec2 scale, vec2 offset, float orthographic, vec2 size) {
  vec2 ndc = pixel / size * 2.0 - 1.0;
  vec2 xy = orthographic > 0.5 ? (ndc - offset) / scale : (ndc + offset) * depth / scale;
  return vec3(xy, -depth);
}

// Linear depth of a value of the host's depth buffer; at infinity a large number, never NaN.
float linearDepth(float value, vec2 proj_depth, float orthographic) {
  if (orthographic > 0.5) return (proj_depth.y - value) / proj_depth.x;
  float denominator = value + proj_depth.x;
  float d = abs(denominator) > 1e-30 ? proj_depth.y / denominator : 3e38;
  return d >= 0.0 ? d : 3e38;  // beyond an infinite far plane by rounding
}

#endif
