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

// Places of roots, each once, in a k-d tree: halves of the widest axis, whatever stray roots there are.
class ScalpTree {
public:
  explicit ScalpTree(const std::vector<float>& roots) : roots_(roots) {
    std::map<std::array<float, 3>, uint32_t> first;
    for (uint32_t i = 0; i < roots.size() / 3; ++i) {
      const std::array<float, 3> place{roots[3 * size_t{i}], roots[3 * size_t{i} + 1], roots[3 * size_t{i} + 2]};
      if (first.emplace(place, i).second) places_.push_back(i);
    }
    axes_.resize(places_.size());
    build(0, places_.size());
  }

  // One root a place.
  const std::vector<uint32_t>& places() const { return places_; }
  glm::dvec3 root(size_t i) const { return {roots_[3 * i], roots_[3 * i + 1], roots_[3 * i + 2]}; }

  // The nearest ones in other places, nearest first.
  std::vector<uint32_t> nearest(uint32_t of, size_t wanted) const {
    std::vector<std::pair<double, uint32_t>> found;  // a heap, the farthest on top
    search(0, places_.size(), of, wanted, found);
    std::sort_heap(found.begin(), found.end());
    std::vector<uint32_t> roots;
    for (const auto& [square, root] : found) roots.push_back(root);
    return roots;
  }

private:
  void build(size_t begin, size_t end) {
    if (end - begin < 2) return;
    glm::dvec3 low(1e300), high(-1e300);
    for (size_t i = begin; i < end; ++i) low = glm::min(low, root(places_[i])), high = glm::max(high, root(places_[i]));
    const glm::dvec3 side = high - low;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    const size_t middle = begin + (end - begin) / 2;
    axes_[middle] = uint8_t(axis);
    std::nth_element(places_.begin() + std::ptrdiff_t(begin), places_.begin() + std::ptrdiff_t(middle), places_.begin() + std::ptrdiff_t(end),
                     [&](uint32_t a, uint32_t b) { return root(a)[axis] != root(b)[axis] ? root(a)[axis] < root(b)[axis] : a < b; });
    build(begin, middle);
    build(middle + 1, end);
  }

  void search(size_t begin, size_t end, uint32_t of, size_t wanted, std::vector<std::pair<double, uint32_t>>& found) const {
    if (begin >= end) return;
    const size_t middle = begin + (end - begin) / 2;
    const uint32_t at = places_[middle];
    const glm::dvec3 away = root(at) - root(of);
    if (at != of) {
      found.emplace_back(glm::dot(away, away), at);
      std::push_heap(found.begin(), found.end());
      if (found.size() > wanted) std::pop_heap(found.begin(), found.end()), found.pop_back();
    }
    if (end - begin == 1) return;
    const double beyond = -away[axes_[middle]];  // how far the root lies past the dividing plane
    const bool right = beyond > 0;
    right ? search(middle + 1, end, of, wanted, found) : search(begin, middle, of, wanted, found);
    if (found.size() < wanted || beyond * beyond < found.front().first) right ? search(begin, middle, of, wanted, found) : search(middle + 1, end, of, wanted, found);
  }

  const std::vector<float>& roots_;
  std::vector<uint32_t> places_;
  std::vector<uint8_t> axes_;  // of the plane through each place
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
  const ScalpTree tree(roots);
  std::vector<std::vector<RootTriangle>> stars(tree.places().size());
  std::vector<double> nearest(stars.size(), 0);
  parallelFor(stars.size(), 64, [&](size_t place) {
    const uint32_t i = tree.places()[place];
    const std::vector<uint32_t> around = tree.nearest(i, kNeighbours);
    if (around.size() < 2) return;
    std::vector<glm::dvec3> away;
    for (const uint32_t other : around) away.push_back(tree.root(other) - tree.root(i));
    nearest[place] = glm::length(away[0]);
    const glm::dvec3 normal = leastSpread(away);
    const glm::dvec3 x = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 y = glm::cross(normal, x);
    std::vector<glm::dvec2> flat;
    for (const glm::dvec3& a : away) flat.emplace_back(glm::dot(a, x), glm::dot(a, y));
    const std::vector<int> star = starOfOrigin(flat);
    for (size_t k = 0; k < star.size(); ++k) {
      const int a = star[k], b = star[(k + 1) % star.size()];
      if (a < 0 || b < 0) continue;
      RootTriangle triangle{{i, around[size_t(a)], around[size_t(b)]}};
      std::sort(triangle.roots.begin(), triangle.roots.end());
      triangle.area = 0.5 * glm::length(glm::cross(away[size_t(a)], away[size_t(b)]));
      stars[place].push_back(triangle);
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
      const glm::dvec3 a = tree.root(t.roots[0]), b = tree.root(t.roots[1]), c = tree.root(t.roots[2]);
      if (std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}) <= longest && t.area > 0) triangles.push_back(t);
    }
  std::sort(triangles.begin(), triangles.end(), [](const RootTriangle& a, const RootTriangle& b) { return a.roots < b.roots; });
  triangles.erase(std::unique(triangles.begin(), triangles.end(), [](const RootTriangle& a, const RootTriangle& b) { return a.roots == b.roots; }),
                  triangles.end());
  return triangles;
}

}  // namespace forelock::samples
