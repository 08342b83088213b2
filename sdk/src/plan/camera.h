// The host's camera, checked and taken apart. docs/conventions.md.
#pragma once

#include "plan/linear.h"

#include <cstdint>

namespace forelock {

struct Rect {
  uint32_t x = 0, y = 0, width = 0, height = 0;
  bool empty() const { return width == 0 || height == 0; }
};

struct Camera {
  Mat4 view_from_world = kIdentity;
  double scale[2] = {1, 1};   // P00, P11
  double offset[2] = {0, 0};  // P20, P21 (perspective); P30, P31 (orthographic)
  double depth[2] = {0, 0};   // P22, P32
  bool orthographic = false;
  double near_plane = 0;      // metre; least view depth drawn
  uint32_t width = 0, height = 0;

  double pixelsPerMetre(double view_depth) const;  // along the axis with more pixels
};

// Box in hair space under a transform.
struct Box {
  Vec3 min{}, max{};
};

// Null if it is usable, else what is wrong with it, as a sentence.
const char* makeCamera(const double view_from_world[16], const float clip_from_view[16], bool reversed_depth, uint32_t width,
                       uint32_t height, Camera& camera);

// Pixels that quads of strands inside a box could touch, whose corners lie up to `margin` metres and some pixels beside the
// strands; empty when out of view. `nearest` and `farthest`:
// its view depths.
Rect screenRect(const Camera& camera, const Mat4& world_from_box, const Box& box, double margin, double& nearest, double& farthest);

Rect unite(const Rect& a, const Rect& b);

}  // namespace forelock
