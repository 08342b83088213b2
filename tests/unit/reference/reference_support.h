// Scenes measured in pixels for the tests of the reference.
#pragma once

#include "reference.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>
#include <random>

namespace forelock::reference {

struct Point {
  double x, y;
};

// An orthographic camera before which one metre is one pixel; pixel_aspect stretches x only.
inline Camera pixelCamera(int width, int height, double pixel_aspect = 1) {
  Projection projection;
  projection.orthographic = true;
  projection.tan_half_y = height / 2.0;
  projection.far_plane = 1e4;
  projection.pixel_aspect = pixel_aspect;
  return makeCamera({0, 0, 100}, {0, 0, 0}, {0, 1, 0}, projection, width, height);
}

// The world point at z that pixelCamera(width, height, 1) shows at that pixel position.
inline Vec3 atPixel(const Camera& camera, Point pixel, double z = 0) {
  return {pixel.x - camera.width / 2.0, camera.height / 2.0 - pixel.y, z};
}

inline void addLine(Hair& hair, const Camera& camera, std::span<const Point> points, double width_px, double z = 0) {
  std::vector<Vec3> positions;
  for (const Point& p : points) positions.push_back(atPixel(camera, p, z));
  addStrand(hair.strands, positions, width_px / 2);
}

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// A strand of `count` segments of length l that turns by `bend` at each joint: one way, or to and fro.
inline std::vector<Point> bentLine(double l, int count, double bend, bool alternate, double heading) {
  std::vector<Point> points{{0, 0}};
  for (int i = 0; i < count; ++i) {
    points.push_back({points.back().x + l * std::cos(heading), points.back().y + l * std::sin(heading)});
    heading += alternate && i % 2 ? -bend : bend;
  }
  return points;
}

}  // namespace forelock::reference
