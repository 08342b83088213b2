// The frame's light on a fragment. Included after bindings.glsl; FLK_BIND_SHADOW where the light casts hair shadows.
#ifndef FORELOCK_PASSES_LIGHT
#define FORELOCK_PASSES_LIGHT

vec3 fragmentPosition(vec2 pixel, float depth) {
  return unprojectPixel(pixel, depth, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size);
}

vec3 towardsEye(vec3 position) { return frame.orthographic > 0.5 ? vec3(0.0, 0.0, 1.0) : unitOrZero(-position); }

vec3 radianceFull(HairConstants hair, vec3 tangent, vec2 pixel, float depth) {
  vec3 position = fragmentPosition(pixel, depth);
  float light = 1.0;
#ifdef FLK_BIND_SHADOW
  light = shadowFull(shadow_map, frame.texels_from_view * vec4(position, 1.0), int(frame.shadow_size),
                     shadowBias(tangent, frame.light_direction, frame.shadow_texel), frame.shadow_range,
                     hair.fibres_per_metre, hair.shadow_log2);
#endif
  return shadeFull(hair, tangent, frame.light_direction, towardsEye(position), light * frame.light_radiance, frame.ambient);
}

vec3 radianceLow(HairConstants hair, vec3 tangent, vec2 pixel, float depth) {
  float light = 1.0;
#ifdef FLK_BIND_SHADOW
  light = shadowLow(shadow_map, frame.texels_from_view * vec4(fragmentPosition(pixel, depth), 1.0), int(frame.shadow_size),
                    shadowBias(tangent, frame.light_direction, frame.shadow_texel), frame.shadow_range,
                    hair.fibres_per_metre, hair.shadow_log2);
#endif
  return shadeLow(hair, tangent, frame.light_direction, light * frame.light_radiance, frame.ambient);
}

#endif
