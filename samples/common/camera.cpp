// SPDX-License-Identifier: MIT
#include "camera.h"

#include "groom_recipe.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {

CameraBasis cameraBasis(const Camera& camera) {
  CameraBasis basis;
  basis.back = glm::normalize(camera.eye - camera.target);
  glm::dvec3 right = glm::cross(camera.up, basis.back);
  if (glm::dot(right, right) < 1e-12) {
    right = glm::cross(std::fabs(basis.back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1), basis.back);
  }
  basis.right = glm::normalize(right);
  basis.up = glm::cross(basis.back, basis.right);
  return basis;
}

void viewMatrix(const Camera& camera, double view[16]) {
  const CameraBasis basis = cameraBasis(camera);
  const glm::dvec3 rows[3] = {basis.right, basis.up, basis.back};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      view[4 * column + row] = rows[row][column];
    }
    view[12 + row] = -glm::dot(rows[row], camera.eye);
    view[4 * row + 3] = 0.0;
  }
  view[15] = 1.0;
}

namespace {

// Clip z = scale * view z + offset.
struct DepthRow {
  double scale, offset;
};

DepthRow depthRow(const Camera& camera) {
  const double n = camera.near_m, f = camera.far_m;
  if (camera.orthographic) {
    return camera.reversed_depth ? DepthRow{1.0 / (f - n), f / (f - n)} : DepthRow{-1.0 / (f - n), -n / (f - n)};
  }
  return camera.reversed_depth ? DepthRow{n / (f - n), n * f / (f - n)} : DepthRow{-f / (f - n), -n * f / (f - n)};
}

}  // namespace

void projectionMatrix(const Camera& camera, double aspect, float projection[16]) {
  std::fill(projection, projection + 16, 0.0f);
  if (camera.orthographic) {
    projection[0] = static_cast<float>(2.0 / (camera.view_height * aspect));
    projection[5] = static_cast<float>(-2.0 / camera.view_height);
    projection[15] = 1.0f;
  } else {
    const double focal = 1.0 / std::tan(0.5 * camera.vertical_fov);
    projection[0] = static_cast<float>(focal / aspect);
    projection[5] = static_cast<float>(-focal);
    projection[11] = -1.0f;
  }
  const DepthRow row = depthRow(camera);
  projection[10] = static_cast<float>(row.scale);
  projection[14] = static_cast<float>(row.offset);
}

double viewDepth(const Camera& camera, double value) {
  if (camera.reversed_depth ? value <= 0.0 : value >= 1.0) {
    return std::numeric_limits<double>::infinity();
  }
  const DepthRow row = depthRow(camera);
  return camera.orthographic ? (row.offset - value) / row.scale : row.offset / (value + row.scale);
}

Camera frameBounds(const float min_bounds[3], const float max_bounds[3], double azimuth, double elevation,
                   UpAxis up_axis, double vertical_fov, double aspect, double margin) {
  const glm::dvec3 low(min_bounds[0], min_bounds[1], min_bounds[2]);
  const glm::dvec3 high(max_bounds[0], max_bounds[1], max_bounds[2]);
  const double flat = std::cos(elevation);
  glm::dvec3 from(flat * std::sin(azimuth), std::sin(elevation), flat * std::cos(azimuth));
  Camera camera;
  if (up_axis == UpAxis::Z) {
    from = glm::dvec3(from.x, -from.z, from.y);
    camera.up = glm::dvec3(0.0, 0.0, 1.0);
  }
  if (flat < 1e-6) {  // from straight above or below the front points up in the image
    camera.up = (up_axis == UpAxis::Z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1)) * (elevation > 0.0 ? 1.0 : -1.0);
  }
  camera.vertical_fov = vertical_fov;
  camera.target = (low + high) * 0.5;
  camera.eye = camera.target + from;

  const CameraBasis basis = cameraBasis(camera);
  const double tan_y = std::tan(0.5 * vertical_fov) / margin;
  const double tan_x = tan_y * aspect;
  double distance = 0.0;
  double reach = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) ? high.x : low.x, (corner & 2) ? high.y : low.y, (corner & 4) ? high.z : low.z);
    const glm::dvec3 d = p - camera.target;
    const double forward = glm::dot(d, basis.back);
    distance = std::max(distance, forward + std::fabs(glm::dot(d, basis.right)) / tan_x);
    distance = std::max(distance, forward + std::fabs(glm::dot(d, basis.up)) / tan_y);
    reach = std::max(reach, std::fabs(forward));
  }
  // A single straight strand seen end on has no extent in the picture: keep some distance to it.
  const double size = glm::length(high - low);
  distance = std::max(distance, reach + std::max(0.05 * size, 1e-4));
  camera.eye = camera.target + from * distance;
  camera.near_m = std::max(distance - 1.2 * reach - 0.05 * size, 0.01 * distance);
  camera.far_m = distance + 1.2 * reach + 0.05 * size + 1e-4;
  return camera;
}

namespace {

// The direction from what is looked at to the camera.
glm::dvec3 viewFrom(double azimuth, double elevation, UpAxis up_axis) {
  const double flat = std::cos(elevation);
  const glm::dvec3 from(flat * std::sin(azimuth), std::sin(elevation), flat * std::cos(azimuth));
  return up_axis == UpAxis::Z ? glm::dvec3(from.x, -from.z, from.y) : from;
}

}  // namespace

Camera framePoints(const FramedPoints& framed, double azimuth, double elevation, UpAxis up_axis, double vertical_fov,
                   double aspect, double margin, uint32_t turns) {
  glm::dvec3 low(1e30), high(-1e30);
  for (const glm::vec3& p : framed.points) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  const glm::dvec3 middle = (low + high) * 0.5;
  const double tan_y = std::tan(0.5 * vertical_fov) / margin;
  const double tan_x = tan_y * aspect;
  // A point at (x, y, z), z towards the camera, is seen from (cx, cy, d) where |x - cx| <= tan_x (d - z), likewise y: the
  // most of x + tan_x z and of -x + tan_x z over all points bound d and cx.
  double right = 0.0, left = 0.0, above = 0.0, below = 0.0, nearest = -1e30, farthest = 1e30;
  bool first = true;
  Camera camera;
  CameraBasis basis;
  constexpr double turn = 6.28318530717958648;
  for (uint32_t i = std::max(turns, 1u); i-- > 0;) {  // the first comes last: its basis is kept
    const glm::dvec3 from = viewFrom(azimuth + turn * i / std::max(turns, 1u), elevation, up_axis);
    camera = frameBounds(&glm::vec3(low)[0], &glm::vec3(high)[0], azimuth + turn * i / std::max(turns, 1u), elevation,
                         up_axis, vertical_fov, aspect, margin);
    camera.target = middle;
    camera.eye = middle + from;
    basis = cameraBasis(camera);
    for (const glm::vec3& point : framed.points) {
      const glm::dvec3 p = glm::dvec3(point) - middle;
      const double x = glm::dot(p, basis.right), y = glm::dot(p, basis.up), z = glm::dot(p, basis.back);
      const double reach = framed.radius * (1.0 + tan_x);
      if (first) {
        right = left = above = below = -1e30;
        first = false;
      }
      right = std::max(right, x + tan_x * z + reach);
      left = std::max(left, -x + tan_x * z + reach);
      above = std::max(above, y + tan_y * z + reach);
      below = std::max(below, -y + tan_y * z + reach);
      nearest = std::max(nearest, z);
      farthest = std::min(farthest, z);
    }
  }
  if (turns > 1) {  // the axis stays in the middle of the picture
    right = left = std::max(right, left);
  }
  const double size = glm::length(high - low) + 2.0 * framed.radius;
  const double floor = nearest + std::max(0.05 * size, 1e-4);
  const double distance = std::max({(right + left) / (2.0 * tan_x), (above + below) / (2.0 * tan_y), floor});
  camera.target = middle + basis.right * (0.5 * (right - left)) + basis.up * (0.5 * (above - below));
  camera.eye = camera.target + basis.back * distance;
  camera.near_m = std::max(distance - nearest - 0.1 * size, 0.01 * distance);
  camera.far_m = distance - farthest + 0.1 * size + 1e-4;
  return camera;
}

Camera fromRecipeCamera(const RecipeCamera& stored) {
  Camera camera;
  camera.eye = stored.eye;
  camera.target = stored.target;
  camera.up = stored.up;
  camera.vertical_fov = stored.vertical_fov_deg * (3.14159265358979323846 / 180.0);
  camera.near_m = stored.near_m;
  camera.far_m = stored.far_m;
  return camera;
}

}  // namespace forelock::samples
