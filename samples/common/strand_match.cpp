// SPDX-License-Identifier: MIT
#include "strand_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {
namespace {

double squaredDistance(const Point& a, const Point& b) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Units that grooms come in, as factors between two of them: metre, centimetre, millimetre, decimetre, inch, foot.
std::vector<double> unitFactors() {
  std::vector<double> factors{1};
  constexpr double units[] = {1, 0.01, 0.001, 0.1, 0.0254, 0.3048};
  for (const double from : units)
    for (const double to : units)
      if (std::none_of(factors.begin(), factors.end(), [&](double known) { return std::abs(known * to / from - 1) < 1e-9; })) factors.push_back(from / to);
  return factors;
}

// Factors that may make `to` of `from`: units near to what lengths and bounds say, then what they say themselves.
std::vector<double> scaleCandidates(const StrandShapes& from, const StrandShapes& to) {
  const auto diagonal = [](const StrandShapes& set) { return std::sqrt(squaredDistance(set.low, set.high)); };
  const double measured[] = {to.median_length / from.median_length, to.mean_length / from.mean_length, diagonal(to) / diagonal(from)};
  std::vector<double> candidates;
  const auto add = [&](double scale) {
    const bool known = std::any_of(candidates.begin(), candidates.end(), [&](double held) { return std::abs(held / scale - 1) < 1e-6; });
    if (std::isfinite(scale) && scale > 0 && !known) candidates.push_back(scale);
  };
  for (const double unit : unitFactors())
    if (std::any_of(std::begin(measured), std::end(measured), [&](double scale) { return std::abs(std::log(scale / unit)) < 0.3; })) add(unit);
  for (const double scale : measured) add(scale);
  return candidates;
}

// All signed permutations: as they are first, then turns, then mirrorings.
std::vector<AxisMap> axisCandidates() {
  std::vector<AxisMap> maps;
  for (const bool mirrored : {false, true})
    for (const std::array<int, 3>& from : {std::array<int, 3>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
      for (int signs = 0; signs < 8; ++signs) {
        const AxisMap map{from, {signs & 1 ? -1.0f : 1.0f, signs & 2 ? -1.0f : 1.0f, signs & 4 ? -1.0f : 1.0f}};
        if (map.mirrors() == mirrored) maps.push_back(map);
      }
  return maps;
}

Point mapped(const AxisMap& map, const Point& point) {
  Point result;
  for (size_t axis = 0; axis < 3; ++axis) result[axis] = double(map.sign[axis]) * point[size_t(map.from[axis])];
  return result;
}

Point shiftBetween(const StrandRelation& relation, const Point& from, const Point& to) {
  const Point moved = mapped(relation.axes, from);
  Point shift;
  for (size_t axis = 0; axis < 3; ++axis) shift[axis] = to[axis] - relation.scale * moved[axis];
  return shift;
}

struct Nearest {
  uint32_t strand = 0;
  double distance = std::numeric_limits<double>::max();
};

Nearest nearestShape(const StrandShapes::Shape& shape, const StrandShapes& to, const RootTree& tree) {
  const RootTree::Found found = tree.nearest(shape[0], to.mean_length);
  Nearest best;
  for (size_t i = 0; i < found.count; ++i) {
    const double distance = shapeDistance(shape, to.shapes[found.strand[i]]);
    if (distance < best.distance) best = {found.strand[i], distance};
  }
  return best;
}

// Mean distance of sampled strands to their nearest ones, each at most a mean length, of the better half: the others may have no partner.
double costOf(const StrandRelation& relation, const StrandShapes& from, const StrandShapes& to, const RootTree& tree, size_t samples) {
  samples = std::min(samples, from.shapes.size());
  std::vector<double> costs;
  for (size_t i = 0; i < samples; ++i)
    costs.push_back(std::min(1.0, nearestShape(applied(relation, from.shapes[i * from.shapes.size() / samples]), to, tree).distance / to.mean_length));
  std::sort(costs.begin(), costs.end());
  costs.resize((costs.size() + 1) / 2);
  double sum = 0;
  for (const double cost : costs) sum += cost;
  return sum / double(costs.size());
}

// Least squares for scale and shift over sampled pairs, of which the further half is left out.
StrandRelation refined(StrandRelation relation, const StrandShapes& from, const StrandShapes& to, const RootTree& tree) {
  const size_t samples = std::min<size_t>(2000, from.shapes.size());
  std::vector<std::pair<Nearest, size_t>> pairs;
  for (size_t i = 0; i < samples; ++i) {
    const size_t strand = i * from.shapes.size() / samples;
    const Nearest near = nearestShape(applied(relation, from.shapes[strand]), to, tree);
    if (near.distance < to.mean_length) pairs.emplace_back(near, strand);
  }
  if (pairs.empty()) return relation;
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.first.distance != b.first.distance ? a.first.distance < b.first.distance : a.second < b.second; });
  pairs.resize((pairs.size() + 1) / 2);
  Point mean_from{}, mean_to{};
  const double count = double(pairs.size() * StrandShapes::kPoints);
  const auto source = [&](size_t strand, size_t point) { return mapped(relation.axes, from.shapes[strand][relation.reversed ? StrandShapes::kPoints - 1 - point : point]); };
  for (const auto& [near, strand] : pairs)
    for (size_t point = 0; point < StrandShapes::kPoints; ++point)
      for (size_t axis = 0; axis < 3; ++axis) {
        mean_from[axis] += source(strand, point)[axis] / count;
        mean_to[axis] += to.shapes[near.strand][point][axis] / count;
      }
  double product = 0, square = 0;
  for (const auto& [near, strand] : pairs)
    for (size_t point = 0; point < StrandShapes::kPoints; ++point)
      for (size_t axis = 0; axis < 3; ++axis) {
        const double x = source(strand, point)[axis] - mean_from[axis];
        product += x * (to.shapes[near.strand][point][axis] - mean_to[axis]);
        square += x * x;
      }
  if (!(product > 0 && square > 0)) return relation;
  relation.scale = product / square;
  for (size_t axis = 0; axis < 3; ++axis) relation.shift[axis] = mean_to[axis] - relation.scale * mean_from[axis];
  return relation;
}

}  // namespace

ArcWalk::ArcWalk(const FlkStrands& strands, uint32_t strand) : positions_(strands.positions + 3 * size_t(strands.first_vertex[strand])) {
  const uint32_t count = strands.first_vertex[strand + 1] - strands.first_vertex[strand];
  along_.push_back(0);
  for (uint32_t v = 1; v < count; ++v) {
    const float *a = positions_ + 3 * size_t(v) - 3, *b = a + 3;
    along_.push_back(along_.back() + std::hypot(double(b[0]) - double(a[0]), double(b[1]) - double(a[1]), double(b[2]) - double(a[2])));
  }
}

Point ArcWalk::at(double share) const {
  const double wanted = share * along_.back();
  const size_t after = size_t(std::clamp<std::ptrdiff_t>(std::upper_bound(along_.begin(), along_.end(), wanted) - along_.begin(), 1, std::ptrdiff_t(along_.size()) - 1));
  const double span = along_[after] - along_[after - 1], t = span > 0 ? std::clamp((wanted - along_[after - 1]) / span, 0.0, 1.0) : 0;
  Point point;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double a = double(positions_[3 * (after - 1) + axis]), b = double(positions_[3 * after + axis]);
    point[axis] = t == 1 ? b : a + (b - a) * t;
  }
  return point;
}

StrandShapes::StrandShapes(const FlkStrands& strands) : shapes(strands.strand_count) {
  std::vector<double> lengths;
  low.fill(std::numeric_limits<double>::max());
  high.fill(-std::numeric_limits<double>::max());
  std::array<std::vector<double>, 3> coordinates;
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    const ArcWalk walk(strands, strand);
    lengths.push_back(walk.length());
    mean_length += walk.length() / strands.strand_count;
    for (size_t point = 0; point < kPoints; ++point) {
      const Point at = shapes[strand][point] = walk.at(double(point) / (kPoints - 1));
      for (size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], at[axis]);
        high[axis] = std::max(high[axis], at[axis]);
        centre[axis] += at[axis] / (double(strands.strand_count) * kPoints);
        coordinates[axis].push_back(at[axis]);
      }
    }
  }
  median_length = medianOf(lengths);
  for (size_t axis = 0; axis < 3; ++axis) median[axis] = medianOf(coordinates[axis]);
}

RootTree::RootTree(const StrandShapes& shapes) : shapes_(shapes), order_(shapes.shapes.size()) {
  for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  build(0, order_.size(), 0);
}

// The middle of a range is its node; what is less along the axis is before it.
void RootTree::build(size_t begin, size_t end, int axis) {
  if (end - begin < 2) return;
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [&](size_t i) { return order_.begin() + std::ptrdiff_t(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](uint32_t a, uint32_t b) {
    const double x = shapes_.shapes[a][0][size_t(axis)], y = shapes_.shapes[b][0][size_t(axis)];
    return x != y ? x < y : a < b;
  });
  build(begin, middle, (axis + 1) % 3);
  build(middle + 1, end, (axis + 1) % 3);
}

void RootTree::search(size_t begin, size_t end, int axis, const Point& at, double limit_squared, Found& found) const {
  if (begin >= end) return;
  const size_t middle = begin + (end - begin) / 2;
  const Point& root = shapes_.shapes[order_[middle]][0];
  const double squared = squaredDistance(root, at);
  const auto bound = [&] { return found.count < kNearest ? limit_squared : found.squared[found.count - 1]; };
  if (squared < bound() || (squared == limit_squared && found.count < kNearest)) {
    size_t slot = found.count < kNearest ? found.count++ : found.count - 1;
    for (; slot > 0 && squared < found.squared[slot - 1]; --slot) found.squared[slot] = found.squared[slot - 1], found.strand[slot] = found.strand[slot - 1];
    found.squared[slot] = squared;
    found.strand[slot] = order_[middle];
  }
  const double beyond = at[size_t(axis)] - root[size_t(axis)];
  const bool right = beyond > 0;
  search(right ? middle + 1 : begin, right ? end : middle, (axis + 1) % 3, at, limit_squared, found);
  if (beyond * beyond < bound() || (found.count < kNearest && beyond * beyond <= bound())) search(right ? begin : middle + 1, right ? middle : end, (axis + 1) % 3, at, limit_squared, found);
}

RootTree::Found RootTree::nearest(const Point& at, double limit) const {
  Found found;
  search(0, order_.size(), 0, at, limit * limit, found);
  return found;
}

double shapeDistance(const StrandShapes::Shape& a, const StrandShapes::Shape& b) {
  double greatest = 0;
  for (size_t point = 0; point < StrandShapes::kPoints; ++point) greatest = std::max(greatest, squaredDistance(a[point], b[point]));
  return std::sqrt(greatest);
}

StrandShapes::Shape applied(const StrandRelation& relation, const StrandShapes::Shape& shape) {
  StrandShapes::Shape result;
  for (size_t point = 0; point < StrandShapes::kPoints; ++point) {
    const Point moved = mapped(relation.axes, shape[relation.reversed ? StrandShapes::kPoints - 1 - point : point]);
    for (size_t axis = 0; axis < 3; ++axis) result[point][axis] = relation.scale * moved[axis] + relation.shift[axis];
  }
  return result;
}

StrandRelation findRelation(const StrandShapes& from, const StrandShapes& to, const RootTree& tree,
                            const std::function<void(uint64_t, uint64_t)>& progress) {
  // A later candidate has to be better by more than half, so that of equals the simplest is taken; costs below this are all exact.
  constexpr double exact = 1e-6;
  constexpr size_t samples = 24, more_samples = 400;
  StrandRelation best;
  double best_cost = std::numeric_limits<double>::max();
  const std::vector<double> scales = scaleCandidates(from, to);
  const std::vector<AxisMap> maps = axisCandidates();
  uint64_t tried = 0;
  for (const double scale : scales)
    for (const AxisMap& axes : maps) {
      if (progress) progress(tried++, scales.size() * maps.size());
      for (const bool reversed : {false, true}) {
        StrandRelation relation{scale, axes, {}, reversed};
        const Point middle_from{0.5 * (from.low[0] + from.high[0]), 0.5 * (from.low[1] + from.high[1]), 0.5 * (from.low[2] + from.high[2])};
        const Point middle_to{0.5 * (to.low[0] + to.high[0]), 0.5 * (to.low[1] + to.high[1]), 0.5 * (to.low[2] + to.high[2])};
        for (const Point& shift : {Point{}, shiftBetween(relation, middle_from, middle_to), shiftBetween(relation, from.centre, to.centre), shiftBetween(relation, from.median, to.median)}) {
          relation.shift = shift;
          const double cost = costOf(relation, from, to, tree, samples);
          if (std::max(cost, exact) < 0.5 * std::max(best_cost, exact)) best = relation, best_cost = cost;
          if (best_cost <= exact) return best;
        }
      }
    }
  // Scale and shift were those of the sets, which differ where strands are missing.
  double cost = costOf(best, from, to, tree, more_samples);
  StrandRelation next = best;
  for (int i = 0; i < 12; ++i) next = refined(next, from, to, tree);
  if (costOf(next, from, to, tree, more_samples) < 0.5 * cost) {
    for (const double unit : unitFactors())
      if (std::abs(next.scale / unit - 1) < 1e-5) next.scale = unit;
    best = next;
  }
  return best;
}

StrandRelation inverse(const StrandRelation& relation) {
  StrandRelation back;
  back.scale = 1 / relation.scale;
  back.reversed = relation.reversed;
  for (size_t axis = 0; axis < 3; ++axis) {
    back.axes.from[size_t(relation.axes.from[axis])] = int(axis);
    back.axes.sign[size_t(relation.axes.from[axis])] = relation.axes.sign[axis];
  }
  const Point shift = mapped(back.axes, relation.shift);
  for (size_t axis = 0; axis < 3; ++axis) back.shift[axis] = shift[axis] == 0 ? 0 : -back.scale * shift[axis];
  return back;
}

}  // namespace forelock::samples
