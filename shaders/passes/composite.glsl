// Hair over the host's colour, premultiplied.
#ifndef FORELOCK_PASSES_COMPOSITE
#define FORELOCK_PASSES_COMPOSITE

void compositePixel(uvec2 pixel, vec3 color, float transmittance) {
  ivec2 p = ivec2(pixel + frame.rect.xy);
  vec4 background = imageLoad(target, p);
  vec4 result = vec4(color + transmittance * background.rgb, 1.0 - transmittance + transmittance * background.a);
  imageStore(target, p, min(result, vec4(65504.0)));  // the largest fp16: an overflow would spread in the host's filters
}

#endif
