// SPDX-License-Identifier: MIT
#include "orbit.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr double kPi = 3.14159265358979323846;

double wrapped(double angle) { return std::remainder(angle, 2.0 * kPi); }

double clampedElevation(double elevation) { return std::clamp(elevation, -kMostElevation, kMostElevation); }

// From the target to the eye.
glm::dvec3 directionOf(const Orbit& orbit) {
  const double flat = std::cos(orbit.elevation);
  const glm::dvec3 from(flat * std::sin(orbit.azimuth), std::sin(orbit.elevation), flat * std::cos(orbit.azimuth));
  return orbit.up == UpAxis::Z ? glm::dvec3(from.x, -from.z, from.y) : from;
}

Camera placed(const Orbit& orbit) {
  Camera camera;
  camera.target = orbit.target;
  camera.eye = orbit.target + directionOf(orbit) * orbit.distance;
  camera.up = orbit.up == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  camera.vertical_fov = orbit.vertical_fov;
  return camera;
}

CameraBasis basisOf(const Orbit& orbit) {
  Orbit unit = orbit;  // the difference of eye and target keeps its digits
  unit.target = glm::dvec3(0.0);
  unit.distance = 1.0;
  return cameraBasis(placed(unit));
}

// At the target's depth.
double metresPerPixel(const Orbit& orbit, double height_px) {
  return 2.0 * orbit.distance * std::tan(0.5 * orbit.vertical_fov) / std::max(height_px, 1.0);
}

}  // namespace

double Bounds::size() const { return glm::length(high - low); }

void Orbit::turn(double dx_px, double dy_px, double height_px) {
  const double radians = kPi / std::max(height_px, 1.0);
  azimuth = wrapped(azimuth - dx_px * radians);
  elevation = clampedElevation(elevation + dy_px * radians);
}

void Orbit::pan(double dx_px, double dy_px, double height_px) {
  const CameraBasis basis = basisOf(*this);
  target += (basis.up * dy_px - basis.right * dx_px) * metresPerPixel(*this, height_px);
}

void Orbit::zoom(double steps, const glm::dvec2& cursor, double height_px, double scene_size) {
  const double size = scene_size > 0.0 ? scene_size : distance;
  const double nearer = std::clamp(distance * std::exp2(-steps / 5.2), kLeastDistance * size, kMostDistance * size);
  const CameraBasis basis = basisOf(*this);
  const double step = metresPerPixel(*this, height_px) * (1.0 - nearer / distance);
  target += (basis.right * cursor.x - basis.up * cursor.y) * step;
  distance = nearer;
}

void Orbit::frame(const std::vector<glm::vec3>& points, double radius, double aspect, double margin) {
  if (points.empty()) {
    return;
  }
  glm::vec3 low = points[0], high = points[0];
  for (const glm::vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  // framePoints keeps lengths of its own (0.1 mm) from what it frames: powers of two make everything about 1 m without rounding.
  const double size = std::max(static_cast<double>(glm::length(high - low)) + 2.0 * radius, 1e-30);
  const int exponent = std::ilogb(size);
  std::vector<glm::vec3> scaled(points);
  for (glm::vec3& point : scaled) {
    point *= std::ldexp(1.0f, -exponent);
  }
  const Camera camera =
      framePoints({scaled, std::ldexp(radius, -exponent)}, azimuth, elevation, up, vertical_fov, aspect, margin, 1);
  const double unit = std::ldexp(1.0, exponent);
  target = camera.target * unit;
  distance = glm::length(camera.eye - camera.target) * unit;
}

void Orbit::frame(const Bounds& bounds, double aspect, double margin) {
  std::vector<glm::vec3> corners;
  for (int corner = 0; corner < 8; ++corner) {
    corners.emplace_back((corner & 1) ? bounds.high.x : bounds.low.x, (corner & 2) ? bounds.high.y : bounds.low.y,
                         (corner & 4) ? bounds.high.z : bounds.low.z);
  }
  frame(corners, 0.0, aspect, margin);
}

Orbit orbitOf(const Camera& camera, UpAxis up) {
  Orbit orbit;
  orbit.up = up;
  orbit.target = camera.target;
  orbit.vertical_fov = camera.vertical_fov;
  glm::dvec3 from = camera.eye - camera.target;
  orbit.distance = glm::length(from);
  if (up == UpAxis::Z) {
    from = glm::dvec3(from.x, from.z, -from.y);
  }
  const double flat = std::hypot(from.x, from.z);
  orbit.azimuth = flat > 0.0 ? std::atan2(from.x, from.z) : 0.0;
  orbit.elevation = clampedElevation(std::atan2(from.y, flat));
  if (camera.orthographic) {
    orbit.distance = 0.5 * camera.view_height / std::tan(0.5 * camera.vertical_fov);
  }
  return orbit;
}

Camera cameraOf(const Orbit& orbit, const Bounds& bounds) {
  Camera camera = placed(orbit);
  const glm::dvec3 back = basisOf(orbit).back;
  double nearest = 1e300, farthest = -1e300;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p((corner & 1) ? bounds.high.x : bounds.low.x, (corner & 2) ? bounds.high.y : bounds.low.y,
                       (corner & 4) ? bounds.high.z : bounds.low.z);
    const double depth = orbit.distance - glm::dot(p - orbit.target, back);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const double room = 0.02 * bounds.size();
  // All of it may lie behind the eye: then planes around the target do.
  camera.far_m = farthest + room > 0.0 ? farthest + room : 2.0 * orbit.distance;
  camera.near_m = std::max(nearest - room, camera.far_m / 1e5);
  camera.near_m = std::min(camera.near_m, 0.99 * camera.far_m);  // from afar the planes would be one in 32-bit floats
  return camera;
}

Orbit approach(const Orbit& from, const Orbit& to, double seconds) {
  if (seconds >= kApproachSeconds) {
    return to;
  }
  const double rest = 1.0 - std::max(seconds, 0.0) / kApproachSeconds;
  const double share = 1.0 - rest * rest * rest;
  const auto between = [share](double a, double b) { return a + (b - a) * share; };
  Orbit orbit = to;
  orbit.target = from.target + (to.target - from.target) * share;
  orbit.distance = from.distance * std::pow(to.distance / from.distance, share);
  orbit.elevation = between(from.elevation, to.elevation);
  orbit.vertical_fov = between(from.vertical_fov, to.vertical_fov);
  orbit.azimuth = wrapped(from.azimuth + wrapped(to.azimuth - from.azimuth) * share);
  return orbit;
}

}  // namespace forelock::samples
