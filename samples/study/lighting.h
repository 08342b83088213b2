// The lights of a view, and how bright they are. SPDX-License-Identifier: MIT
#pragma once

#include "subject.h"

#include <array>
#include <vector>

namespace forelock::study {

struct Lighting {
  std::vector<FlkLight> lights;
  float ambient[3] = {0, 0, 0};
  std::array<float, 27> ambient_sh{};
  bool has_sh = false;

  // All light times a factor: pictures are linear in it.
  void scale(double factor);
};

// The condition's first `count` lights, or all of the scene's, for that camera and at unit strength.
Lighting makeLighting(const Subject& subject, const samples::Camera& camera, uint32_t count);

// Texels a side of a light's map unless a row says otherwise.
inline constexpr uint32_t kDefaultShadowSize = 1024;

// What stands in the column: the first shadow map's.
uint32_t shadowSizeOf(const Lighting& lighting);

}  // namespace forelock::study
