// The condition of every error figure: materials, fibre spacing and how bright the hair is. RMSE scales with brightness, so
// that a bound without a condition means nothing. docs/methods.md section 8.
#pragma once

#include "forelock/render.h"

namespace forelock::samples {

enum class HairColor { dark, light };

// Mean of R_exact over the hair pixels, of all three channels, linear: lights are scaled until it is this.
inline double conditionMean(HairColor color) { return (color == HairColor::dark ? 64.0 : 128.0) / 255.0; }

// Weights and exponents of flkMaterialDefault for both.
inline FlkMaterial conditionMaterial(HairColor color) {
  FlkMaterial material;
  flkMaterialDefault(&material);
  if (color == HairColor::light) material.color[0] = 0.75f, material.color[1] = 0.58f, material.color[2] = 0.36f;
  return material;
}

// Key light, from the upper left of the camera; view space, to the light.
inline constexpr double kConditionLight[3] = {-0.48, 0.64, 0.6};

}  // namespace forelock::samples
