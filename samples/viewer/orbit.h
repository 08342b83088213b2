// A camera that turns around what it looks at, as a mouse moves it. SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace forelock::samples {

struct Bounds {
  glm::dvec3 low, high;  // world (m)
  double size() const;   // of the diagonal
};

inline constexpr double kMostElevation = 89.0 * (3.14159265358979323846 / 180.0);
inline constexpr double kLeastDistance = 1e-6, kMostDistance = 1e6;  // times the size of the scene

// Pixels are those of the window, x to the right and y down; `height_px` is the height of the picture.
struct Orbit {
  glm::dvec3 target{0.0};    // world (m)
  double distance = 1.0;     // of the eye from it (m)
  double azimuth = 0.0;      // (rad) [-pi, pi], as frameBounds has it
  double elevation = 0.0;    // (rad) within +-kMostElevation
  UpAxis up = UpAxis::Y;
  double vertical_fov = 24.0 * (3.14159265358979323846 / 180.0);  // (rad)

  // What faces the eye goes with the mouse; half a turn over the height of the picture.
  void turn(double dx_px, double dy_px, double height_px);
  // What is at the target's depth goes with the mouse.
  void pan(double dx_px, double dy_px, double height_px);
  // Nearer where steps are above 0, an eighth a step. What is at the target's depth under the cursor stays there.
  void zoom(double steps, const glm::dvec2& cursor_px_from_centre, double height_px, double scene_size);
  // As near as `margin` allows with all points in view; the direction of view stays. `radius` (m) is how far each reaches around.
  void frame(const std::vector<glm::vec3>& points, double radius, double aspect, double margin = 1.06);
  void frame(const Bounds& bounds, double aspect, double margin = 1.06);
};

// A roll around the view is left out; of an orthographic camera the distance is that from which the target looks as large.
Orbit orbitOf(const Camera& camera, UpAxis up);

// near and far enclose the bounds; near is at least far / 1e5, so that depth keeps its digits when the eye is amid hair.
Camera cameraOf(const Orbit& orbit, const Bounds& bounds);

// On the way from one to another: at 0 seconds `from`, from kApproachSeconds on exactly `to`, slower towards the end.
inline constexpr double kApproachSeconds = 0.25;
Orbit approach(const Orbit& from, const Orbit& to, double seconds);

}  // namespace forelock::samples
