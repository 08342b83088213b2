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

// All lights, directional and with a hair shadow map each: a condition of n lights has the first n, which are scaled together.
// The second fills from the right at half the strength, the third shines from behind above, where hair is lit through.
struct ConditionLight {
  double to_light[3];  // view space
  double strength;     // of the key light's radiance, white
};
inline constexpr unsigned kConditionLightCount = 3;
inline constexpr ConditionLight kConditionLights[kConditionLightCount] = {
    {{kConditionLight[0], kConditionLight[1], kConditionLight[2]}, 1.0},
    {{0.77, 0.24, 0.59}, 0.5},
    {{0.28, 0.48, -0.83}, 0.8}};

}  // namespace forelock::samples
