// Opacity modifiers of a frame (docs/methods.md section 2; after Schollmeyer, Babanin, Froehlich 2015).
#ifndef FORELOCK_LIB_MODIFIERS
#define FORELOCK_LIB_MODIFIERS
#include "../shared/frame.h"

// kind: a constant, so that what is not there costs nothing. pixel: its centre, from the target's corner.
float opacityModifier(uint kind, OpacityModifier m, vec2 pixel, float depth) {
  if (kind == FLK_MODIFIER_FADE) return clamp((depth - m.start) * m.inverse_ramp, 0.0, 1.0);
  if (kind == FLK_MODIFIER_LENS) {
    float q = clamp((distance(pixel, m.center) - m.start) * m.inverse_ramp, 0.0, 1.0);
    return m.inside + (1.0 - m.inside) * q * q * (3.0 - 2.0 * q);
  }
  return 1.0;
}

#endif
