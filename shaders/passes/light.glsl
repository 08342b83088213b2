// The frame's light on a fragment. Included after bindings.glsl; FLK_BIND_SHADOW where the light casts hair shadows.
#ifndef FORELOCK_PASSES_LIGHT
#define FORELOCK_PASSES_LIGHT

// What all fragments of a pixel share: positions are a line in depth, in view space and so in the shadow map.
struct PixelRay {
  vec3 to_eye;         // unit
  vec3 shadow_origin;  // of depth 0: texels and metre
  vec3 shadow_step;    // a metre of depth
};

PixelRay pixelRay(vec2 pixel) {
  vec3 at_one = unprojectPixel(pixel, 1.0, frame.proj_scale, frame.proj_offset, frame.orthographic, frame.size);
  bool orthographic = frame.orthographic > 0.5;
  vec3 origin = orthographic ? vec3(at_one.xy, 0.0) : vec3(0.0);
  PixelRay ray;
  ray.to_eye = orthographic ? vec3(0.0, 0.0, 1.0) : unitOrZero(-at_one);
  ray.shadow_origin = frame.texels_from_view * vec4(origin, 1.0);
  ray.shadow_step = mat3(frame.texels_from_view) * (at_one - origin);
  return ray;
}

// The light as read from the frame: loops over fragments read it once, before they begin.
struct FrameLight {
  vec3 direction, radiance, ambient;
  float texel, range;
  int size;
};

FrameLight frameLight() {
  return FrameLight(frame.light_direction, frame.light_radiance, frame.ambient, frame.shadow_texel, frame.shadow_range,
                    int(frame.shadow_size));
}

vec3 radianceFull(HairConstants hair, FrameLight source, vec3 tangent, PixelRay ray, float depth) {
  float light = 1.0;
#ifdef FLK_BIND_SHADOW
  light = shadowFull(shadow_map, ray.shadow_origin + depth * ray.shadow_step, source.size,
                     shadowBias(tangent, source.direction, source.texel), source.range,
                     hair.fibres_per_metre, hair.shadow_log2);
#endif
  return shadeFull(hair, tangent, source.direction, ray.to_eye, light * source.radiance, source.ambient);
}

vec3 radianceLow(HairConstants hair, FrameLight source, vec3 tangent, PixelRay ray, float depth) {
  float light = 1.0;
#ifdef FLK_BIND_SHADOW
  light = shadowLow(shadow_map, ray.shadow_origin + depth * ray.shadow_step, source.size,
                    shadowBias(tangent, source.direction, source.texel), source.range,
                    hair.fibres_per_metre, hair.shadow_log2);
#endif
  return shadeLow(hair, tangent, source.direction, light * source.radiance, source.ambient);
}

#endif
