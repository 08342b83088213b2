// An opaque head with neck and shoulders, ray-cast on the CPU: what hair hides behind and in front of.
// SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"
#include "image.h"

#include <glm/vec3.hpp>

#include <array>
#include <functional>
#include <vector>

namespace forelock::samples {

struct BustLight {
  glm::vec3 color{2.2f, 2.1f, 2.0f};        // radiance leaving a white surface that faces it, times pi; at one metre if placed
  glm::vec3 to_light{0.45f, 0.65f, 0.62f};  // of a placed light with a cone: against its axis
  bool placed = false;                      // shines from `position`: docs/methods.md section 4, point and spot
  glm::vec3 position{0.0f};                 // (m)
  float range = 0.0f;                       // (m) 0: no end
  float source_radius = 0.01f;              // (m)
  float cos_inner = -1.0f, cos_outer = -1.0f;  // of the cone; both -1: none
  // Share of the light that hair lets through to a point (world, m) [0, 1]; none: all of it. Called from any thread.
  std::function<float(const glm::vec3& point)> light_through_hair;
};

struct BustLook {
  glm::vec3 albedo{0.46f, 0.36f, 0.31f};  // linear
  std::vector<BustLight> lights{BustLight{}};
  glm::vec3 ambient{0.16f, 0.17f, 0.19f};
  // Radiance over directions, added to it: nine coefficients in the order of FlkFrame.ambient_sh.
  std::array<glm::vec3, 9> ambient_sh{};
};

struct BustImage {
  Image color;               // alpha 1 on the bust, 0 elsewhere
  std::vector<float> depth;  // linear view depth (m) along the view axis, row 0 at the top; infinity off the bust
};

BustImage drawBust(const Camera& camera, uint32_t width, uint32_t height, const BustLook& look);

// Box around the bust's head and shoulders (m), for framing together with hair.
void bustBounds(float min_bounds[3], float max_bounds[3]);

// Box around the head alone, crown to chin (m).
void headBounds(float min_bounds[3], float max_bounds[3]);

}  // namespace forelock::samples
