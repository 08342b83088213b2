// Cameras as the SDK takes them: view and projection matrices, and framing. SPDX-License-Identifier: MIT
//
// Right handed; the camera looks along its own -z. Matrices are column major. Projections give Vulkan clip space: y down
// in the framebuffer, depth 0..1, or 1..0 where reversed.
#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace forelock::samples {

struct RecipeCamera;

struct Camera {
  glm::dvec3 eye{0.0, 0.0, 1.0};     // world (m)
  glm::dvec3 target{0.0, 0.0, 0.0};  // looked at; must differ from eye
  glm::dvec3 up{0.0, 1.0, 0.0};      // need not be perpendicular
  bool orthographic = false;
  double vertical_fov = 0.5;  // perspective (rad)
  double view_height = 1.0;   // orthographic (m)
  double near_m = 0.1;
  double far_m = 10.0;
  bool reversed_depth = false;
};

struct CameraBasis {
  glm::dvec3 right, up, back;  // unit
};

// Where up is parallel to the view another axis takes its place.
CameraBasis cameraBasis(const Camera& camera);

void viewMatrix(const Camera& camera, double view[16]);

// `aspect` is width / height.
void projectionMatrix(const Camera& camera, double aspect, float projection[16]);

// Depth along the view (m) of a value that projectionMatrix's depths have; infinity where it is that of the far plane, or beyond.
double viewDepth(const Camera& camera, double value);

enum class UpAxis { Y, Z };

// A perspective camera that sees all of the box, seen from `azimuth` (rad; 0 is the front: +z where y is up, -y where z
// is up; positive towards the left of who faces the camera, +x) and `elevation` (rad, positive from above). near and far
// enclose the box with room to spare. `margin` 1.05 leaves 5 % around.
Camera frameBounds(const float min_bounds[3], const float max_bounds[3], double azimuth, double elevation,
                   UpAxis up_axis, double vertical_fov, double aspect, double margin);

// Points that a camera is to see, and how far each reaches around (m).
struct FramedPoints {
  const std::vector<glm::vec3>& points;
  double radius;
};

// Like frameBounds, but as close as the points themselves allow and centred on what is seen. With `turns` above 1 the
// camera is the first of that many around the up axis through the middle of the points, all at the same distance and
// height, and each sees all points.
Camera framePoints(const FramedPoints& framed, double azimuth, double elevation, UpAxis up_axis, double vertical_fov,
                   double aspect, double margin, uint32_t turns);

Camera fromRecipeCamera(const RecipeCamera& stored);

}  // namespace forelock::samples
