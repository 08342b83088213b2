// SPDX-License-Identifier: MIT
#include "strand_pick.h"

#include "parallel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace forelock::samples {

namespace {

constexpr uint32_t kParallelVertices = 1'000'000;

// A vertex as the picture has it: (x, y) / w are pixels from the origin that the projector was made for.
struct Projected {
  double x, y, depth, w;
};

Projected between(const Projected& a, const Projected& b, double share) {
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share, a.depth + (b.depth - a.depth) * share, a.w + (b.w - a.w) * share};
}

class Projector {
 public:
  Projector(const StrandView& view, const glm::dvec2& origin_px) {
    const CameraBasis basis = cameraBasis(view.camera);
    const double* m = view.world_from_hair;
    const glm::dvec3 columns[3] = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
    const glm::dvec3 shift = glm::dvec3(m[12], m[13], m[14]) - view.camera.eye;
    const double half = view.camera.orthographic ? 0.5 * view.camera.view_height : std::tan(0.5 * view.camera.vertical_fov);
    focal_px_ = 0.5 * view.height_px / half;
    flat_ = view.camera.orthographic;
    const auto row = [&](const glm::dvec3& axis, double factor) {
      return std::array<double, 4>{factor * glm::dot(axis, columns[0]), factor * glm::dot(axis, columns[1]),
                                   factor * glm::dot(axis, columns[2]), factor * glm::dot(axis, shift)};
    };
    depth_ = row(basis.back, -1.0);
    const std::array<double, 4> w = flat_ ? std::array<double, 4>{0.0, 0.0, 0.0, 1.0} : depth_;
    x_ = row(basis.right, focal_px_);
    y_ = row(basis.up, -focal_px_);
    for (size_t i = 0; i < 4; ++i) {
      x_[i] += (0.5 * view.width_px - origin_px.x) * w[i];
      y_[i] += (0.5 * view.height_px - origin_px.y) * w[i];
    }
    // A radius of the hair in pixels times w.
    radius_px_ = focal_px_ * glm::length(columns[0]) * view.width_scale;
  }

  Projected at(const float* p) const {
    const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]), z = static_cast<double>(p[2]);
    const auto apply = [&](const std::array<double, 4>& row) { return row[0] * x + row[1] * y + row[2] * z + row[3]; };
    const double depth = apply(depth_);
    return {apply(x_), apply(y_), depth, flat_ ? 1.0 : depth};
  }

  double radiusPx() const { return radius_px_; }

 private:
  std::array<double, 4> x_, y_, depth_;
  double focal_px_ = 0.0, radius_px_ = 0.0;
  bool flat_ = false;
};

struct Best {
  double depth = std::numeric_limits<double>::infinity();
  double along = 0.0, distance_px = 0.0;
  uint32_t strand = 0, vertex = 0;
};

class Picker {
 public:
  Picker(const StrandView& view, const glm::dvec2& pixel, const OpaqueDepth& opaque)
      : view_(view), pixel_(pixel), opaque_(opaque), projector_(view, pixel) {}

  void look(uint32_t begin, uint32_t end, Best& best) const {
    const FlkStrands& s = view_.strands;
    for (uint32_t strand = begin; strand < end; ++strand) {
      const uint32_t first = s.first_vertex[strand], last = s.first_vertex[strand + 1];
      Side before = sideOf(first);
      for (uint32_t v = first + 1; v < last; ++v) {
        const Side now = sideOf(v);
        // Both ends beyond the same side of the square around the pixel, or of a plane: which needs no division.
        if ((before.beyond & now.beyond) == 0) {
          lookAt(strand, v - 1, before, now, best);
        }
        before = now;
      }
    }
  }

 private:
  struct Side {
    Projected at;
    double radius_px;  // times w
    uint32_t beyond;   // bits: left, right, above, below, near, far
  };

  Side sideOf(uint32_t vertex) const {
    const FlkStrands& s = view_.strands;
    const Projected p = projector_.at(s.positions + size_t{3} * vertex);
    const double radius = s.radii ? static_cast<double>(s.radii[vertex]) * projector_.radiusPx() : 0.0;
    const bool in_front = p.depth >= view_.camera.near_m;
    // Behind the eye sides are exchanged: only in front may they rule out.
    const double reach = in_front ? std::max(kPickPx * p.w, radius) : std::numeric_limits<double>::infinity();
    const uint32_t beyond = uint32_t{p.x < -reach} | uint32_t{p.x > reach} << 1 | uint32_t{p.y < -reach} << 2 |
                            uint32_t{p.y > reach} << 3 | uint32_t{!in_front} << 4 | uint32_t{p.depth > view_.camera.far_m} << 5;
    return {p, radius, beyond};
  }

  void lookAt(uint32_t strand, uint32_t vertex, const Side& from, const Side& to, Best& best) const {
    Projected a = from.at, b = to.at;
    double low = 0.0, high = 1.0;  // what is left of the segment between the planes
    for (const auto& [depth, sign] : {std::pair{view_.camera.near_m, 1.0}, std::pair{view_.camera.far_m, -1.0}}) {
      const double in_a = sign * (from.at.depth - depth), in_b = sign * (to.at.depth - depth);
      if (in_a < 0.0) low = std::max(low, in_a / (in_a - in_b));
      if (in_b < 0.0) high = std::min(high, in_a / (in_a - in_b));
    }
    if (low > high) {
      return;
    }
    if (low > 0.0) a = between(from.at, to.at, low);
    if (high < 1.0) b = between(from.at, to.at, high);
    const glm::dvec2 start(a.x / a.w, a.y / a.w), way = glm::dvec2(b.x / b.w, b.y / b.w) - start;
    const double square = glm::dot(way, way);
    const double seen = square > 0.0 ? std::clamp(-glm::dot(start, way) / square, 0.0, 1.0) : 0.0;
    const double distance = glm::length(start + way * seen);
    // Steps that are even in the picture are not in the world: Heckbert, Fundamentals of Texture Mapping, 1989, section 2.3.4.
    const double clipped = seen * a.w / ((1.0 - seen) * b.w + seen * a.w);
    const double depth = a.depth + (b.depth - a.depth) * clipped;
    if (depth >= best.depth) {
      return;
    }
    const double along = low + (high - low) * clipped, w = a.w + (b.w - a.w) * clipped;
    const double radius = (from.radius_px + (to.radius_px - from.radius_px) * along) / w;
    if (distance > std::max(kPickPx, radius) || (opaque_ && depth > opaque_(pixel_ + start + way * seen))) {
      return;
    }
    best = {depth, along, distance, strand, vertex};
  }

  const StrandView& view_;
  glm::dvec2 pixel_;
  const OpaqueDepth& opaque_;
  Projector projector_;
};

}  // namespace

std::optional<StrandHit> pickStrand(const StrandView& view, const glm::dvec2& pixel, const OpaqueDepth& opaque) {
  const FlkStrands& s = view.strands;
  const Picker picker(view, pixel, opaque);
  Best best;
  if (s.vertex_count - s.strand_count <= kParallelVertices) {
    picker.look(0, s.strand_count, best);
  } else {
    constexpr uint32_t pieces = 64;
    std::array<Best, pieces> found;
    const auto edge = [&](size_t piece) { return static_cast<uint32_t>(uint64_t{s.strand_count} * piece / pieces); };
    parallelFor(pieces, 1, [&](size_t piece) { picker.look(edge(piece), edge(piece + 1), found[piece]); });
    best = *std::min_element(found.begin(), found.end(), [](const Best& a, const Best& b) { return a.depth < b.depth; });
  }
  if (std::isinf(best.depth)) {
    return std::nullopt;
  }
  const float* p = s.positions + size_t{3} * best.vertex;
  glm::dvec3 hair;
  for (int axis = 0; axis < 3; ++axis) {
    const double from = static_cast<double>(p[axis]), to = static_cast<double>(p[3 + axis]);
    hair[axis] = from + (to - from) * best.along;
  }
  const double* m = view.world_from_hair;
  StrandHit hit{best.strand, best.vertex - s.first_vertex[best.strand], best.along, best.depth, best.distance_px, {}};
  for (int axis = 0; axis < 3; ++axis) {
    hit.world[axis] = m[axis] * hair.x + m[4 + axis] * hair.y + m[8 + axis] * hair.z + m[12 + axis];
  }
  return hit;
}

std::vector<std::vector<glm::vec2>> projectStrand(const StrandView& view, uint32_t strand) {
  const Projector projector(view, {0.0, 0.0});
  const FlkStrands& s = view.strands;
  const double near_m = view.camera.near_m;
  const auto pixel = [](const Projected& p) { return glm::vec2(glm::dvec2(p.x / p.w, p.y / p.w)); };
  std::vector<std::vector<glm::vec2>> lines;
  bool open = false;  // the last vertex is the end of the last line
  Projected before = projector.at(s.positions + size_t{3} * s.first_vertex[strand]);
  for (uint32_t v = s.first_vertex[strand] + 1; v < s.first_vertex[strand + 1]; ++v) {
    const Projected now = projector.at(s.positions + size_t{3} * v);
    const bool from_in = before.depth >= near_m, to_in = now.depth >= near_m;
    if (from_in || to_in) {
      const auto cut = [&] { return between(before, now, (near_m - before.depth) / (now.depth - before.depth)); };
      if (!open) {
        lines.push_back({pixel(from_in ? before : cut())});
      }
      lines.back().push_back(pixel(to_in ? now : cut()));
    }
    open = to_in;
    before = now;
  }
  return lines;
}

}  // namespace forelock::samples
