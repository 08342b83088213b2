// Walks the fragments that strands make in a view, on the CPU: quads with exact area coverage. For counting loads and
// for checks; the pictures come from the SDK. SPDX-License-Identifier: MIT
#pragma once

#include "camera.h"

#include <forelock/asset.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace forelock::samples {

struct WalkedFragment {
  uint32_t x, y;
  uint32_t segment;  // first vertex of the segment
  double along;      // [0, 1] of the segment
  double depth;      // linear view depth (m)
  double coverage;   // (0, 1]
};

// Area of a unit pixel left of a line at signed distance t from its centre, less one half; a >= b are the absolute
// components of the line's unit normal.
inline double areaLeft(double t, double a, double b) {
  const double distance = std::fabs(t);
  if (distance <= 0.5 * (a - b)) {
    return t / a;
  }
  double area = 0.5;
  if (distance < 0.5 * (a + b)) {  // b > 0 here
    const double rest = 0.5 * (a + b) - distance;
    area -= rest * rest / (2.0 * a * b);
  }
  return t < 0.0 ? -area : area;
}

// Calls visit(const WalkedFragment&) for every pixel whose centre lies in a segment's quad and whose coverage is above
// `least`. Consecutive quads are split at the bisector of their joint. Segments that reach before the near plane are
// left out. Single-threaded.
template <typename Visit>
void walkFragments(const FlkStrands& strands, const Camera& camera, uint32_t width, uint32_t height, double least,
                   const Visit& visit) {
  const CameraBasis basis = cameraBasis(camera);
  const double half = camera.orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.vertical_fov);
  const double focal_px = 0.5 * static_cast<double>(height) / half;
  struct Projected {
    double x, y, depth, diameter;  // px, px, m, px
  };
  std::vector<Projected> line;
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    const uint32_t first = strands.first_vertex[strand];
    const uint32_t count = strands.first_vertex[strand + 1] - first;
    line.resize(count);
    for (uint32_t i = 0; i < count; ++i) {
      const float* p = strands.positions + size_t{3} * (first + i);
      const glm::dvec3 d = glm::dvec3(p[0], p[1], p[2]) - camera.eye;
      const double depth = -glm::dot(d, basis.back);
      const double scale = camera.orthographic ? focal_px : focal_px / std::max(depth, 1e-9);
      line[i] = {0.5 * width + glm::dot(d, basis.right) * scale, 0.5 * height - glm::dot(d, basis.up) * scale, depth,
                 2.0 * static_cast<double>(strands.radii[first + i]) * scale};
    }
    const auto direction = [&](uint32_t i, double& ux, double& uy) {  // of segment i; false: no length on screen
      ux = line[i + 1].x - line[i].x;
      uy = line[i + 1].y - line[i].y;
      const double length = std::sqrt(ux * ux + uy * uy);
      if (!(length > 1e-9)) {
        return false;
      }
      ux /= length;
      uy /= length;
      return true;
    };
    for (uint32_t i = 0; i + 1 < count; ++i) {
      const Projected& p0 = line[i];
      const Projected& p1 = line[i + 1];
      double ux, uy;
      if (p0.depth < camera.near_m || p1.depth < camera.near_m || !direction(i, ux, uy)) {
        continue;
      }
      const double length = std::sqrt((p1.x - p0.x) * (p1.x - p0.x) + (p1.y - p0.y) * (p1.y - p0.y));
      // Planes that end the quad: the joint's bisector, or straight across at a strand's end.
      double b0x = ux, b0y = uy, b1x = ux, b1y = uy, vx, vy;
      if (i > 0 && direction(i - 1, vx, vy)) {
        b0x += vx;
        b0y += vy;
      }
      if (i + 2 < count && direction(i + 1, vx, vy)) {
        b1x += vx;
        b1y += vy;
      }
      const double nx = -uy, ny = ux;
      const double a = std::max(std::fabs(nx), std::fabs(ny));
      const double b = std::min(std::fabs(nx), std::fabs(ny));
      const double reach = 0.5 * std::max(p0.diameter, p1.diameter) + 0.5 * (a + b);
      const double low_y = std::min(p0.y, p1.y) - reach, high_y = std::max(p0.y, p1.y) + reach;
      const double low_x = std::min(p0.x, p1.x) - reach, high_x = std::max(p0.x, p1.x) + reach;
      if (high_y < 0.0 || high_x < 0.0 || low_y > height || low_x > width) {
        continue;
      }
      const int64_t y_first = std::max<int64_t>(0, static_cast<int64_t>(std::ceil(low_y - 0.5)));
      const int64_t y_last = std::min<int64_t>(int64_t{height} - 1, static_cast<int64_t>(std::floor(high_y - 0.5)));
      for (int64_t y = y_first; y <= y_last; ++y) {
        const double py = static_cast<double>(y) + 0.5;
        double row_low = low_x, row_high = high_x;
        if (std::fabs(nx) > 1e-6) {  // the pixels of this row within reach of the axis
          const double centre = p0.x - (py - p0.y) * ny / nx;
          row_low = std::max(row_low, centre - reach / std::fabs(nx));
          row_high = std::min(row_high, centre + reach / std::fabs(nx));
        }
        const int64_t x_first = std::max<int64_t>(0, static_cast<int64_t>(std::ceil(row_low - 0.5)));
        const int64_t x_last = std::min<int64_t>(int64_t{width} - 1, static_cast<int64_t>(std::floor(row_high - 0.5)));
        for (int64_t x = x_first; x <= x_last; ++x) {
          const double dx = static_cast<double>(x) + 0.5 - p0.x;
          const double dy = py - p0.y;
          const double ex = dx - (p1.x - p0.x);
          const double ey = dy - (p1.y - p0.y);
          const double along = (dx * ux + dy * uy) / length;
          // The mitre is clamped to half a segment.
          if (dx * b0x + dy * b0y < 0.0 || ex * b1x + ey * b1y >= 0.0 || along < -0.5 || along > 1.5) {
            continue;
          }
          const double t = std::clamp(along, 0.0, 1.0);
          const double diameter = p0.diameter + (p1.diameter - p0.diameter) * t;
          const double offset = dx * nx + dy * ny;
          const double coverage =
              areaLeft(offset + 0.5 * diameter, a, b) - areaLeft(offset - 0.5 * diameter, a, b);
          if (coverage >= least) {
            visit(WalkedFragment{static_cast<uint32_t>(x), static_cast<uint32_t>(y), first + i, t,
                                 p0.depth + (p1.depth - p0.depth) * t, coverage});
          }
        }
      }
    }
  }
}

struct FragmentCounts {
  uint64_t fragments = 0;
  uint64_t hair_pixels = 0;  // with at least one fragment
  uint32_t max_overdraw = 0;
};

// Fragments whose alpha survives 10-bit square-root coding; neither occluder nor depth test.
inline FragmentCounts countFragments(const FlkStrands& strands, const Camera& camera, uint32_t width, uint32_t height,
                                     double opacity) {
  FragmentCounts counts;
  std::vector<uint32_t> layers(size_t{width} * height, 0);
  constexpr double least_alpha = (0.5 / 1023.0) * (0.5 / 1023.0);
  walkFragments(strands, camera, width, height, least_alpha / opacity, [&](const WalkedFragment& fragment) {
    uint32_t& layer = layers[size_t{fragment.y} * width + fragment.x];
    counts.hair_pixels += layer == 0 ? 1 : 0;
    ++counts.fragments;
    counts.max_overdraw = std::max(counts.max_overdraw, ++layer);
  });
  return counts;
}

}  // namespace forelock::samples
