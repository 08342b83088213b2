// SPDX-License-Identifier: MIT
#include "strand_diff.h"

#include "strand_match.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {
namespace {

constexpr uint32_t kNone = UINT32_MAX;
constexpr double kPartner = 0.05;  // of the mean length: how far partners may be apart

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

// Of every strand of B its partner in A, one to one: the nearest pairs first; of equally near ones that of the same number.
std::vector<uint32_t> partners(const StrandShapes& a, const StrandShapes& b, const StrandRelation& relation, const RootTree& tree,
                               const std::function<void(uint64_t, uint64_t)>& progress) {
  struct Candidate {
    double distance;
    bool other_number;
    uint32_t a, b;
  };
  std::vector<Candidate> candidates;
  const double most = kPartner * a.mean_length;
  for (uint32_t strand = 0; strand < b.shapes.size(); ++strand) {
    if (progress && strand % 1024 == 0) progress(strand, b.shapes.size());
    const StrandShapes::Shape shape = applied(relation, b.shapes[strand]);
    const RootTree::Found found = tree.nearest(shape[0], most);
    const auto add = [&](uint32_t other) {
      const double apart = shapeDistance(shape, a.shapes[other]);
      if (apart <= most) candidates.push_back({apart, other != strand, other, strand});
    };
    if (strand < a.shapes.size()) add(strand);
    for (size_t i = 0; i < found.count; ++i)
      if (found.strand[i] != strand) add(found.strand[i]);
  }
  // Copies are equally near, and rounding must not decide between them.
  const double step = 1e-7 * a.mean_length;
  const auto rounded = [&](const Candidate& candidate) { return std::floor(candidate.distance / step); };
  std::sort(candidates.begin(), candidates.end(), [&](const Candidate& x, const Candidate& y) {
    const double near_x = rounded(x), near_y = rounded(y);
    if (near_x != near_y) return near_x < near_y;
    if (x.other_number != y.other_number) return y.other_number;
    return x.b != y.b ? x.b < y.b : x.a < y.a;
  });
  std::vector<uint32_t> partner(b.shapes.size(), kNone);
  std::vector<bool> taken(a.shapes.size());
  for (const Candidate& candidate : candidates) {
    if (partner[candidate.b] != kNone || taken[candidate.a]) continue;
    partner[candidate.b] = candidate.a;
    taken[candidate.a] = true;
  }
  return partner;
}

struct Sides {
  const FlkStrands& a;
  const FlkStrands& b;
  const StrandRelation& relation;

  uint32_t count(const FlkStrands& of, uint32_t strand) const { return of.first_vertex[strand + 1] - of.first_vertex[strand]; }
  // Vertex of B that lies where vertex `i` of A does.
  uint32_t vertexB(uint32_t strand, uint32_t i) const {
    return relation.reversed ? b.first_vertex[strand + 1] - 1 - i : b.first_vertex[strand] + i;
  }
};

struct Measure {
  double max = 0, sum = 0, squares = 0;
  uint64_t count = 0;

  void add(double apart) { max = std::max(max, apart), sum += apart, squares += apart * apart, ++count; }
};

// At even steps along both, of which neither has less vertices.
Measure measureAlong(const Sides& sides, uint32_t a, uint32_t b) {
  const ArcWalk walk_a(sides.a, a), walk_b(sides.b, b);
  const uint32_t steps = std::max(sides.count(sides.a, a), sides.count(sides.b, b)) - 1;
  Measure measure;
  for (uint32_t i = 0; i <= steps; ++i) {
    const double share = double(i) / steps;
    const Point there = walk_b.at(sides.relation.reversed ? 1 - share : share);
    const float point[3] = {float(there[0]), float(there[1]), float(there[2])};
    measure.add(distance(walk_a.at(share), sides.relation.apply(point)));
  }
  return measure;
}

Measure measureVertices(const Sides& sides, uint32_t a, uint32_t b) {
  Measure measure;
  for (uint32_t i = 0; i < sides.count(sides.a, a); ++i) {
    const float* point = sides.a.positions + 3 * (size_t(sides.a.first_vertex[a]) + i);
    measure.add(distance({double(point[0]), double(point[1]), double(point[2])}, sides.relation.apply(sides.b.positions + 3 * size_t(sides.vertexB(b, i)))));
  }
  return measure;
}

void compareUvs(const Sides& sides, const std::vector<uint32_t>& partner, StrandDiff& diff) {
  if (!sides.a.root_uvs || !sides.b.root_uvs) {
    diff.uvs = sides.a.root_uvs ? UvRelation::only_a : sides.b.root_uvs ? UvRelation::only_b : UvRelation::absent;
    return;
  }
  double same = 0, flipped = 0;
  for (uint32_t b = 0; b < partner.size(); ++b) {
    if (partner[b] == kNone) continue;
    const float *uv_a = sides.a.root_uvs + 2 * size_t(partner[b]), *uv_b = sides.b.root_uvs + 2 * size_t(b);
    const double u = std::abs(double(uv_a[0]) - double(uv_b[0]));
    same = std::max({same, u, std::abs(double(uv_a[1]) - double(uv_b[1]))});
    flipped = std::max({flipped, u, std::abs(double(uv_a[1]) + double(uv_b[1]) - 1)});
  }
  constexpr double step = 1e-4;  // less than half a texel of an image of 4,096
  diff.uvs = same <= step ? UvRelation::same : flipped <= step ? UvRelation::flipped_v : UvRelation::different;
  diff.max_uv_difference = std::min(same, flipped);
}

void compareAttributes(const Sides& sides, const std::vector<uint32_t>& partner, StrandDiff& diff) {
  std::vector<double> ratios;
  const bool widths = diff.has_widths[0] && diff.has_widths[1], masses = diff.has_masses[0] && diff.has_masses[1], colors = diff.has_colors[0] && diff.has_colors[1];
  for (uint32_t strand = 0; strand < partner.size(); ++strand) {
    const uint32_t other = partner[strand];
    if (other == kNone || sides.count(sides.a, other) != sides.count(sides.b, strand)) continue;
    diff.compared_vertices += sides.count(sides.a, other);
    for (uint32_t i = 0; i < sides.count(sides.a, other); ++i) {
      const size_t a = size_t(sides.a.first_vertex[other]) + i, b = sides.vertexB(strand, i);
      if (widths) {
        const double width_a = 2 * double(sides.a.radii[a]), width_b = 2 * double(sides.b.radii[b]) * sides.relation.scale;
        diff.max_width_difference = std::max(diff.max_width_difference, std::abs(width_a - width_b));
        if (width_b > 0) ratios.push_back(width_a / width_b);
      }
      if (masses) diff.differing_masses += sides.a.inverse_masses[a] != sides.b.inverse_masses[b];
      for (size_t c = 0; colors && c < 3; ++c)
        diff.max_color_difference = std::max(diff.max_color_difference, std::abs(double(sides.a.colors[3 * a + c]) - double(sides.b.colors[3 * b + c])));
    }
  }
  if (ratios.empty()) return;
  const auto middle = ratios.begin() + std::ptrdiff_t(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  diff.width_ratio = *middle;
}

}  // namespace

bool StrandRelation::isNone() const {
  return scale == 1 && axes.from == std::array<int, 3>{0, 1, 2} && axes.sign == std::array<float, 3>{1, 1, 1} && shift == std::array<double, 3>{} && !reversed;
}

std::array<double, 3> StrandRelation::apply(const float* b) const {
  std::array<double, 3> result;
  for (size_t axis = 0; axis < 3; ++axis) result[axis] = scale * double(axes.sign[axis]) * double(b[axes.from[axis]]) + shift[axis];
  return result;
}

StrandDiff diffStrands(const FlkStrands& a, bool a_radii, const FlkStrands& b, bool b_radii, const StrandDiffOptions& options) {
  const StrandShapes shapes_a(a), shapes_b(b);
  const RootTree tree(shapes_a);
  StrandDiff diff;
  if (b.strand_count <= a.strand_count) {
    diff.relation = findRelation(shapes_b, shapes_a, tree, options.progress);
  } else {
    diff.relation = inverse(findRelation(shapes_a, shapes_b, RootTree(shapes_b), options.progress));
  }
  const std::vector<uint32_t> partner = partners(shapes_a, shapes_b, diff.relation, tree, options.progress);

  std::vector<uint32_t> partner_of_a(a.strand_count, kNone);
  for (uint32_t strand = 0; strand < b.strand_count; ++strand) {
    if (partner[strand] == kNone) diff.only_b.push_back(strand);
    else partner_of_a[partner[strand]] = strand, ++diff.matched;
  }
  diff.related = diff.matched * 2 >= std::min(a.strand_count, b.strand_count) && diff.matched > 0;
  if (!diff.related) return {};

  const Sides sides{a, b, diff.relation};
  const double tolerance = options.tolerance > 0 ? options.tolerance : 1e-5 * shapes_a.mean_length;
  Measure all;
  uint32_t last = 0;
  std::vector<StrandPair> pairs;
  for (uint32_t strand = 0; strand < a.strand_count; ++strand) {
    const uint32_t other = partner_of_a[strand];
    if (other == kNone) {
      diff.only_a.push_back(strand);
      continue;
    }
    diff.reordered |= other < last;
    last = std::max(last, other);
    const bool equal_counts = sides.count(a, strand) == sides.count(b, other);
    Measure measure = equal_counts ? measureVertices(sides, strand, other) : measureAlong(sides, strand, other);
    diff.resampled += !equal_counts;
    if (equal_counts && measure.max > tolerance) {
      const Measure along = measureAlong(sides, strand, other);
      if (along.max < 0.25 * measure.max) measure = along, ++diff.respaced;
    }
    all.max = std::max(all.max, measure.max), all.sum += measure.sum, all.squares += measure.squares, all.count += measure.count;
    pairs.push_back({strand, other, measure.max});
    if (measure.max <= tolerance) continue;
    ++diff.differing;
    if (diff.first.size() < options.listed) diff.first.push_back(pairs.back());
  }
  diff.max_distance = all.max;
  diff.mean_distance = all.sum / double(all.count);
  diff.rms_distance = std::sqrt(all.squares / double(all.count));
  const size_t listed = std::min(options.listed, pairs.size());
  std::partial_sort(pairs.begin(), pairs.begin() + std::ptrdiff_t(listed), pairs.end(),
                    [](const StrandPair& x, const StrandPair& y) { return x.distance != y.distance ? x.distance > y.distance : x.a < y.a; });
  diff.worst.assign(pairs.begin(), pairs.begin() + std::ptrdiff_t(listed));

  diff.has_widths[0] = a_radii, diff.has_widths[1] = b_radii;
  diff.has_masses[0] = a.inverse_masses, diff.has_masses[1] = b.inverse_masses;
  diff.has_colors[0] = a.colors, diff.has_colors[1] = b.colors;
  compareUvs(sides, partner, diff);
  compareAttributes(sides, partner, diff);
  return diff;
}

}  // namespace forelock::samples
