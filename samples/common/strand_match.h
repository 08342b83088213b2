// Strands as a few points, and the search for what turns one set into another. SPDX-License-Identifier: MIT
#pragma once

#include "strand_diff.h"

#include <array>
#include <cstdint>
#include <vector>

namespace forelock::samples {

using Point = std::array<double, 3>;

// Five points a strand, evenly along it from root to tip.
struct StrandShapes {
  static constexpr size_t kPoints = 5;
  using Shape = std::array<Point, kPoints>;

  explicit StrandShapes(const FlkStrands& strands);

  std::vector<Shape> shapes;
  double mean_length = 0, median_length = 0;
  Point low{}, high{}, centre{}, median{};  // bounds of all points, their mean, their medians
};

// Point at `share` [0, 1] of the length of vertices first .. last.
class ArcWalk {
 public:
  ArcWalk(const FlkStrands& strands, uint32_t strand);
  Point at(double share) const;
  double length() const { return along_.back(); }

 private:
  const float* positions_;
  std::vector<double> along_;
};

// Finds strands of a set by where their roots are: a k-d tree.
class RootTree {
 public:
  explicit RootTree(const StrandShapes& shapes);

  static constexpr size_t kNearest = 8;
  struct Found {
    uint32_t strand[kNearest];
    double squared[kNearest];
    size_t count = 0;
  };
  // Those within `limit`, the nearest first.
  Found nearest(const Point& at, double limit) const;

 private:
  void build(size_t begin, size_t end, int axis);
  void search(size_t begin, size_t end, int axis, const Point& at, double limit_squared, Found& found) const;

  const StrandShapes& shapes_;
  std::vector<uint32_t> order_;
};

// Greatest distance between points of two shapes.
double shapeDistance(const StrandShapes::Shape& a, const StrandShapes::Shape& b);

StrandShapes::Shape applied(const StrandRelation& relation, const StrandShapes::Shape& shape);

// The relation that makes `to` of `from`, of which there should be no more strands: the simplest of those that fit best.
// `progress` may be empty.
StrandRelation findRelation(const StrandShapes& from, const StrandShapes& to, const RootTree& tree,
                            const std::function<void(uint64_t done, uint64_t total)>& progress);

// What makes `from` of `to`.
StrandRelation inverse(const StrandRelation& relation);

}  // namespace forelock::samples
