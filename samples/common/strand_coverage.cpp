// SPDX-License-Identifier: MIT
#include "strand_coverage.h"

#include "parallel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace forelock::samples {
namespace {

// The three axes and three of the cube's diagonals, none of which has an opposite among them.
constexpr double kDirections[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, -1, 1}, {-1, 1, 1}};
constexpr size_t kDirectionCount = std::size(kDirections);

// A value in [0, 1) that depends on the cell alone (Weyl sequences in both coordinates).
double jitter(uint32_t x, uint32_t y, double a, double b) { return std::fmod(0.5 + x * a + y * b, 1.0); }

}  // namespace

CoverageMeter::CoverageMeter(const EditableStrands& strands, double opacity, uint32_t points) : opacity_(opacity), points_(points) {
  for (size_t axis = 0; axis < 3; ++axis) {
    low_[axis] = 1e300, high_[axis] = -1e300;
    for (size_t i = axis; i < strands.positions.size(); i += 3)
      low_[axis] = std::min(low_[axis], double(strands.positions[i])), high_[axis] = std::max(high_[axis], double(strands.positions[i]));
  }
}

double CoverageMeter::measure(const EditableStrands& strands, double widening) const {
  if (strands.radii.empty()) throw std::invalid_argument("strands without widths cover nothing");
  const glm::dvec3 middle = 0.5 * glm::dvec3(low_[0] + high_[0], low_[1] + high_[1], low_[2] + high_[2]);
  const double half = std::max(0.5 * glm::length(glm::dvec3(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2])), 1e-30);
  const double cell = 2 * half / points_;
  double sums[kDirectionCount] = {};
  parallelFor(kDirectionCount, 1, [&](size_t d) {
    const glm::dvec3 z = glm::normalize(glm::dvec3(kDirections[d][0], kDirections[d][1], kDirections[d][2]));
    const glm::dvec3 x = glm::normalize(glm::cross(z, std::abs(z.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))), y = glm::cross(z, x);
    std::vector<float> clear(size_t{points_} * points_, 1.0f);
    std::vector<uint32_t> last(clear.size(), UINT32_MAX);  // a strand covers a point once
    const float left = float(1 - opacity_);
    for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
      glm::dvec2 before{};
      double radius_before = 0;
      for (size_t v = strands.first_vertex[strand]; v < strands.first_vertex[strand + 1]; ++v) {
        const glm::dvec3 p = glm::dvec3(strands.positions[3 * v], strands.positions[3 * v + 1], strands.positions[3 * v + 2]) - middle;
        const glm::dvec2 at{(glm::dot(p, x) + half) / cell, (glm::dot(p, y) + half) / cell};
        const double radius = widening * double(strands.radii[v]) / cell;
        if (v > strands.first_vertex[strand]) {
          const double most = std::max(radius, radius_before);
          const auto from = [&](double value) { return int(std::min(std::max(0.0, std::floor(value)), points_ - 1.0)); };  // NaN: 0
          const glm::dvec2 along = at - before;
          const double square = glm::dot(along, along);
          for (int j = from(std::min(at.y, before.y) - most); j <= from(std::max(at.y, before.y) + most); ++j)
            for (int i = from(std::min(at.x, before.x) - most); i <= from(std::max(at.x, before.x) + most); ++i) {
              const size_t point = size_t(j) * points_ + size_t(i);
              if (last[point] == strand) continue;
              const glm::dvec2 q{i + jitter(uint32_t(i), uint32_t(j), 0.7548776662466927, 0.3247179572447460),
                                 j + jitter(uint32_t(i), uint32_t(j), 0.1673039782614187, 0.5698402909980532)};
              const double t = square > 0 ? std::clamp(glm::dot(q - before, along) / square, 0.0, 1.0) : 0;
              const glm::dvec2 away = q - (before + t * along);
              const double reach = radius_before + (radius - radius_before) * t;
              if (glm::dot(away, away) > reach * reach) continue;
              last[point] = strand;
              clear[point] *= left;
            }
        }
        before = at, radius_before = radius;
      }
    }
    for (const float c : clear) sums[d] += 1 - double(c);
  });
  double sum = 0;
  for (const double s : sums) sum += s;
  return sum / double(kDirectionCount) / (double(points_) * points_);
}

}  // namespace forelock::samples
