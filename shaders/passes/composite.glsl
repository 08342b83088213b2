// Hair over the host's colour, premultiplied.
#ifndef FORELOCK_PASSES_COMPOSITE
#define FORELOCK_PASSES_COMPOSITE

void compositePixel(uvec2 pixel, vec3 color, float transmittance) {
  ivec2 p = ivec2(pixel + frame.rect.xy);
  // 65504, the largest fp16: an infinite sun behind opaque hair must not become 0 x inf, nor a sum overflow and spread in the
  // host's filters.
  vec4 background = clamp(imageLoad(target, p), vec4(-65504.0), vec4(65504.0));
  vec4 result = vec4(color + transmittance * background.rgb, 1.0 - transmittance + transmittance * background.a);
  imageStore(target, p, clamp(result, vec4(-65504.0), vec4(65504.0)));
}

// Once a pixel with hair, after all its shades.
#ifdef FORELOCK_PASSES_LIGHT
void countPixel() {
  if (!kCountWork) return;
  atomicAdd(counters[FLK_COUNTER_PIXELS], 1u);
  addWork();
}
#endif

#endif
