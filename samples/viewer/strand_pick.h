// Which strand is under a pixel, and where a strand is in the picture. SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"

#include <forelock/asset.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace forelock::samples {

// How strands come into a picture. Pixels count from the upper left corner, y down.
struct StrandView {
  const FlkStrands& strands;
  const double* world_from_hair;  // 16, column major; keeps shapes: a turn, a uniform scale, a shift
  Camera camera;
  double width_px = 1.0, height_px = 1.0;
  double width_scale = 1.0;       // of the radii, as FlkMaterial.width_scale
};

struct StrandHit {
  uint32_t strand = 0, vertex = 0;  // the vertex of the strand from which the segment goes on, 0 is the root
  double along = 0.0;               // in the segment [0, 1]
  double depth_m = 0.0;             // along the view
  double distance_px = 0.0;         // from the pixel
  glm::dvec3 world{0.0};
};

// View depth (m) of what is opaque in a pixel; infinity: nothing. Called from several threads.
using OpaqueDepth = std::function<double(const glm::dvec2& pixel)>;

inline constexpr double kPickPx = 4.0;

// Of the segments that pass within kPickPx of the pixel, or cover it, between the near and far planes and not behind anything opaque
// (looked up where the segment is nearest to the pixel): the one least in depth, of equal ones the first. Follow strands are none.
// Cost: all segments, over the machine's cores above a million.
std::optional<StrandHit> pickStrand(const StrandView& view, const glm::dvec2& pixel, const OpaqueDepth& opaque = {});

// The strand as lines in pixels: one, or several where it passes behind the near plane.
std::vector<std::vector<glm::vec2>> projectStrand(const StrandView& view, uint32_t strand);

}  // namespace forelock::samples
