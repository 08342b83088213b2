// SPDX-License-Identifier: MIT
#include "root_triangles.h"

#include "parallel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace forelock::samples {
namespace {

constexpr size_t kNeighbours = 16;  // a Delaunay star has six on average

// Roots in cubes of a grid, for the nearest ones of each.
class RootGrid {
public:
  explicit RootGrid(const std::vector<float>& roots) : roots_(roots) {
    glm::dvec3 low(1e300), high(-1e300);
    const size_t count = roots.size() / 3;
    for (size_t i = 0; i < count; ++i) low = glm::min(low, root(i)), high = glm::max(high, root(i));
    low_ = low;
    // A scalp is a surface: about two roots a cube if it were a square of that size.
    cell_ = std::max(glm::length(high - low) * std::sqrt(2.0 / double(count)), 1e-30);
    for (size_t i = 0; i < count; ++i) cells_[place(root(i))].push_back(uint32_t(i));
    rings_ = int(std::ceil(glm::length(high - low) / cell_)) + 1;
  }

  glm::dvec3 root(size_t i) const { return {roots_[3 * i], roots_[3 * i + 1], roots_[3 * i + 2]}; }

  // The nearest ones, nearest first; roots in the same place as `of` are none.
  std::vector<uint32_t> nearest(uint32_t of, size_t wanted) const {
    const Place at = place(root(of));
    std::vector<std::pair<double, uint32_t>> found;
    for (int ring = 0; ring <= rings_; ++ring) {
      for (int x = -ring; x <= ring; ++x)
        for (int y = -ring; y <= ring; ++y)
          for (int z = -ring; z <= ring; ++z) {
            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) != ring) continue;
            const auto cell = cells_.find({at[0] + x, at[1] + y, at[2] + z});
            if (cell == cells_.end()) continue;
            for (const uint32_t other : cell->second) {
              const glm::dvec3 away = root(other) - root(of);
              if (glm::dot(away, away) > 0) found.emplace_back(glm::dot(away, away), other);
            }
          }
      std::sort(found.begin(), found.end());
      // What has not been looked at is at least `ring` cubes away.
      if (found.size() >= wanted && found[wanted - 1].first <= ring * cell_ * ring * cell_) break;
      if (ring > 24 && found.size() >= 3) break;  // a lone root far from the others
    }
    std::vector<uint32_t> roots;
    for (size_t i = 0; i < std::min(wanted, found.size()); ++i) roots.push_back(found[i].second);
    return roots;
  }

private:
  using Place = std::array<int, 3>;
  Place place(const glm::dvec3& p) const {
    const glm::dvec3 q = (p - low_) / cell_;
    return {int(q.x), int(q.y), int(q.z)};
  }

  const std::vector<float>& roots_;
  glm::dvec3 low_{};
  double cell_ = 1;
  int rings_ = 1;
  std::map<Place, std::vector<uint32_t>> cells_;
};

// The direction in which points about the origin are spread least, by power iteration on (trace - covariance).
glm::dvec3 leastSpread(const std::vector<glm::dvec3>& points) {
  glm::dmat3 covariance(0);
  for (const glm::dvec3& p : points) covariance += glm::outerProduct(p, p);
  const double trace = covariance[0][0] + covariance[1][1] + covariance[2][2];
  const glm::dmat3 flipped = glm::dmat3(trace) - covariance;
  glm::dvec3 axis = glm::normalize(glm::dvec3(0.36, 0.48, 0.8));
  for (int i = 0; i < 64; ++i) {
    const glm::dvec3 next = flipped * axis;
    if (!(glm::length(next) > 0)) break;
    axis = glm::normalize(next);
  }
  return axis;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Delaunay neighbours of the origin, counterclockwise: the corners of the hull of the inverted points p / |p|^2 (a circle through the origin
// becomes a line, and an empty one a line with nothing beyond). -1 stands where the origin is itself a corner: there the star is open.
std::vector<int> starOfOrigin(const std::vector<glm::dvec2>& points) {
  struct Inverted {
    glm::dvec2 at;
    int index;
  };
  std::vector<Inverted> sorted{{glm::dvec2(0), -1}};
  for (size_t i = 0; i < points.size(); ++i)
    if (glm::dot(points[i], points[i]) > 0) sorted.push_back({points[i] / glm::dot(points[i], points[i]), int(i)});
  std::sort(sorted.begin(), sorted.end(), [](const Inverted& a, const Inverted& b) { return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y; });
  std::vector<Inverted> hull;
  for (int side = 0; side < 2; ++side) {  // lower chain, then upper chain
    const size_t base = hull.size();
    for (const Inverted& p : sorted) {
      while (hull.size() >= base + 2 && cross(hull.back().at - hull[hull.size() - 2].at, p.at - hull.back().at) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  std::vector<int> star;
  for (const Inverted& p : hull) star.push_back(p.index);
  return star;
}

}  // namespace

std::vector<RootTriangle> rootTriangles(const std::vector<float>& roots, double widest_gap) {
  const size_t count = roots.size() / 3;
  if (count < 3) return {};
  const RootGrid grid(roots);
  std::vector<std::vector<RootTriangle>> stars(count);
  std::vector<double> nearest(count, 0);
  parallelFor(count, 64, [&](size_t i) {
    const std::vector<uint32_t> around = grid.nearest(uint32_t(i), kNeighbours);
    if (around.size() < 2) return;
    std::vector<glm::dvec3> away;
    for (const uint32_t other : around) away.push_back(grid.root(other) - grid.root(i));
    nearest[i] = glm::length(away[0]);
    const glm::dvec3 normal = leastSpread(away);
    const glm::dvec3 x = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(normal, x);
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& a : away) flat.emplace_back(glm::dot(a, x), glm::dot(a, y));
    const std::vector<int> star = starOfOrigin(flat);
    for (size_t k = 0; k < star.size(); ++k) {
      const int a = star[k], b = star[(k + 1) % star.size()];
      if (a < 0 || b < 0) continue;
      RootTriangle triangle{{uint32_t(i), around[size_t(a)], around[size_t(b)]}};
      std::sort(triangle.roots.begin(), triangle.roots.end());
      triangle.area = 0.5 * glm::length(glm::cross(away[size_t(a)], away[size_t(b)]));
      stars[i].push_back(triangle);
    }
  });
  std::vector<double> usual;
  for (const double distance : nearest)
    if (distance > 0) usual.push_back(distance);
  if (usual.empty()) return {};
  std::nth_element(usual.begin(), usual.begin() + std::ptrdiff_t(usual.size() / 2), usual.end());
  // Neighbours are some 1.5 times as far as the nearest one, for roots at random.
  const double longest = widest_gap * 1.5 * usual[usual.size() / 2];
  std::vector<RootTriangle> triangles;
  for (const std::vector<RootTriangle>& star : stars)
    for (const RootTriangle& t : star) {
      const glm::dvec3 a = grid.root(t.roots[0]), b = grid.root(t.roots[1]), c = grid.root(t.roots[2]);
      if (std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}) <= longest && t.area > 0) triangles.push_back(t);
    }
  std::sort(triangles.begin(), triangles.end(), [](const RootTriangle& a, const RootTriangle& b) { return a.roots < b.roots; });
  triangles.erase(std::unique(triangles.begin(), triangles.end(), [](const RootTriangle& a, const RootTriangle& b) { return a.roots == b.roots; }),
                  triangles.end());
  return triangles;
}

}  // namespace forelock::samples
