// SPDX-License-Identifier: MIT
#include "strand_multiply.h"

#include "root_triangles.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace forelock::samples {
namespace {

constexpr double kWidestGap = 4;
constexpr double kPartingCosine = 0.5;  // 60 degrees

glm::dvec3 vertexOf(const EditableStrands& strands, size_t vertex) {
  const float* p = &strands.positions[3 * vertex];
  return {p[0], p[1], p[2]};
}

glm::dvec3 normalizeOrZero(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0 ? v / length : glm::dvec3(0);
}

// Share of the strand's length before each of its vertices.
std::vector<double> fractionsOf(const EditableStrands& strands, uint32_t strand) {
  std::vector<double> along = lengthsAlong(strands, strand);
  const double length = along.back();
  for (double& way : along) way = length > 0 ? way / length : 0;
  return along;
}

// Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
double nextOf(uint64_t& state) {
  state += 0x9E3779B97F4A7C15;
  uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  z ^= z >> 31;
  return double(z >> 11) / 9007199254740992.0;
}

void refuseTooMany(uint64_t strands, uint64_t vertices) {
  if (strands > kMostStrands || vertices > kMostVertices)
    throw std::length_error("that makes " + std::to_string(strands) + " strands of " + std::to_string(vertices) + " vertices, at most " +
                            std::to_string(kMostStrands) + " of " + std::to_string(kMostVertices) + " are possible");
}

// Values along a guide at any share of its length.
class GuideReader {
public:
  GuideReader(const EditableStrands& strands, uint32_t strand)
      : strands_(strands), begin_(strands.first_vertex[strand]), fractions_(fractionsOf(strands, strand)) {}

  const std::vector<double>& fractions() const { return fractions_; }

  void seek(double fraction) {
    segment_ = size_t(std::upper_bound(fractions_.begin(), fractions_.end(), fraction) - fractions_.begin());
    segment_ = std::clamp<size_t>(segment_, 1, fractions_.size() - 1) - 1;
    const double span = fractions_[segment_ + 1] - fractions_[segment_];
    t_ = span > 0 ? std::clamp((fraction - fractions_[segment_]) / span, 0.0, 1.0) : 0;
  }
  double read(const std::vector<float>& values, size_t size, size_t component) const {
    const size_t a = (begin_ + segment_) * size + component;
    return double(values[a]) + (double(values[a + size]) - double(values[a])) * t_;
  }
  glm::dvec3 position() const { return {read(strands_.positions, 3, 0), read(strands_.positions, 3, 1), read(strands_.positions, 3, 2)}; }
  float nearest(const std::vector<float>& values) const { return values[begin_ + segment_ + (t_ < 0.5 ? 0 : 1)]; }

private:
  const EditableStrands& strands_;
  size_t begin_;
  std::vector<double> fractions_;
  size_t segment_ = 0;
  double t_ = 0;
};

}  // namespace

void addFollowStrands(EditableStrands& strands, uint32_t count, double radius, double spread_tip, uint32_t seed) {
  if (count > 1023) throw std::length_error("more than 1,023 follow strands beside each");  // their seeds repeat
  refuseTooMany(uint64_t{strands.strands()} * (count + 1), uint64_t{strands.vertices()} * (count + 1));
  EditableStrands all;
  all.first_vertex.push_back(0);
  for (uint32_t guide = 0; guide < strands.strands(); ++guide) {
    const size_t begin = strands.first_vertex[guide], end = strands.first_vertex[guide + 1];
    const std::vector<double> fractions = fractionsOf(strands, guide);
    const glm::dvec3 t = normalizeOrZero(vertexOf(strands, begin + 1) - vertexOf(strands, begin));
    // Square to t: the world axis with the smallest share of it, the first of equals, without its part along t.
    int smallest = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (std::abs(t[axis]) < std::abs(t[smallest])) smallest = axis;
    glm::dvec3 x(0);
    x[smallest] = 1;
    x = normalizeOrZero(x - t[smallest] * t);
    const glm::dvec3 y = glm::cross(t, x);
    for (uint32_t j = 0; j <= count; ++j) {
      glm::dvec3 offset(0);
      if (j > 0) {
        uint64_t state = seed + (uint64_t{guide} * 1024 + j) * 2 * 0x9E3779B97F4A7C15;
        const double u1 = nextOf(state), angle = 2 * std::numbers::pi * nextOf(state);
        offset = radius * std::sqrt(u1) * (std::cos(angle) * x + std::sin(angle) * y);
      }
      appendStrand(all, strands, guide);
      for (size_t v = begin, to = all.positions.size() - 3 * (end - begin); v < end; ++v, to += 3) {
        const glm::dvec3 p = vertexOf(strands, v) + (1 + (spread_tip - 1) * fractions[v - begin]) * offset;
        for (int axis = 0; axis < 3; ++axis) all.positions[to + size_t(axis)] = float(p[axis]);
      }
    }
  }
  strands = std::move(all);
}

InterpolationReport interpolateGuides(EditableStrands& strands, uint32_t total) {
  InterpolationReport report;
  const uint32_t guides = strands.strands();
  std::vector<float> roots;
  std::vector<double> lengths(guides);
  std::vector<glm::dvec3> directions(guides);
  for (uint32_t i = 0; i < guides; ++i) {
    const glm::dvec3 root = vertexOf(strands, strands.first_vertex[i]);
    roots.insert(roots.end(), {float(root.x), float(root.y), float(root.z)});
    lengths[i] = lengthsAlong(strands, i).back();
    report.mean_guide_length += lengths[i] / guides;
    directions[i] = normalizeOrZero(vertexOf(strands, strands.first_vertex[i + 1] - 1) - root);
  }
  const std::vector<RootTriangle> triangles = rootTriangles(roots, kWidestGap);
  report.triangles = uint32_t(triangles.size());
  if (total <= guides) return report;
  if (triangles.empty()) throw std::invalid_argument("no three strands are neighbours, between which others could grow");
  refuseTooMany(total, uint64_t{strands.vertices()} / guides * total);

  double area = 0;
  for (const RootTriangle& triangle : triangles) area += triangle.area;
  const uint32_t wanted = total - guides;
  double before = 0;
  uint32_t made = 0;
  for (const RootTriangle& triangle : triangles) {
    // Even by area: strand i stands at (i + 1/2) / wanted of it.
    const double after = before + triangle.area / area;
    for (uint32_t within = 1; made < wanted && ((made + 0.5) / wanted < after || &triangle == &triangles.back()); ++within, ++made) {
      // Evenly within the triangle too: the additive sequence of Roberts (2018), whose ratios are powers of the plastic number's inverse.
      double u = std::fmod(0.5 + within * 0.7548776662466927 + triangle.roots[0] * 0.6180339887, 1.0);
      double v = std::fmod(0.5 + within * 0.5698402909980532 + triangle.roots[1] * 0.6180339887, 1.0);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const std::array<double, 3> share{1 - u - v, u, v};
      const size_t heaviest = size_t(std::max_element(share.begin(), share.end()) - share.begin());
      std::array<double, 3> weight = share;
      for (size_t i = 0; i < 3; ++i)
        if (glm::dot(directions[triangle.roots[i]], directions[triangle.roots[heaviest]]) < kPartingCosine) weight = {0, 0, 0};
      if (weight[heaviest] == 0) weight[heaviest] = 1, ++report.parted;

      std::array<GuideReader, 3> readers{GuideReader(strands, triangle.roots[0]), GuideReader(strands, triangle.roots[1]), GuideReader(strands, triangle.roots[2])};
      glm::dvec3 at(0);
      std::array<double, 2> uv{};
      for (size_t i = 0; i < 3; ++i) {
        at += share[i] * vertexOf(strands, strands.first_vertex[triangle.roots[i]]);
        for (size_t c = 0; c < 2 && !strands.root_uvs.empty(); ++c) uv[c] += share[i] * double(strands.root_uvs[2 * size_t{triangle.roots[i]} + c]);
      }
      if (!strands.root_uvs.empty()) {
        // Across a seam of the texture the mean of two coordinates is nowhere near either.
        for (size_t c = 0; c < 2; ++c) {
          const double own = double(strands.root_uvs[2 * size_t{triangle.roots[heaviest]} + c]);
          for (size_t i = 0; i < 3; ++i)
            if (std::abs(double(strands.root_uvs[2 * size_t{triangle.roots[i]} + c]) - own) > 0.5) uv[c] = own;
        }
        strands.root_uvs.insert(strands.root_uvs.end(), {float(uv[0]), float(uv[1])});
      }

      const std::vector<double> fractions = readers[heaviest].fractions();
      std::array<glm::dvec3, 3> last;
      double length = 0;
      for (size_t k = 0; k < fractions.size(); ++k) {
        glm::dvec3 step(0);
        double step_length = 0, radius = 0;
        glm::dvec3 color(0);
        for (size_t i = 0; i < 3; ++i) {
          readers[i].seek(fractions[k]);
          const glm::dvec3 here = readers[i].position();
          if (k > 0) {
            step += weight[i] * (here - last[i]);
            step_length += weight[i] * (fractions[k] - fractions[k - 1]) * lengths[triangle.roots[i]];
          }
          last[i] = here;
          if (!strands.radii.empty()) radius += weight[i] * readers[i].read(strands.radii, 1, 0);
          for (int c = 0; c < 3 && !strands.colors.empty(); ++c) color[c] += weight[i] * readers[i].read(strands.colors, 3, size_t(c));
        }
        // Averaged segments are shorter than segments are on average: their direction counts, and the averaged length.
        if (k > 0) at += step_length * normalizeOrZero(step), length += step_length;
        strands.positions.insert(strands.positions.end(), {float(at.x), float(at.y), float(at.z)});
        if (!strands.radii.empty()) strands.radii.push_back(float(radius));
        if (!strands.inverse_masses.empty()) strands.inverse_masses.push_back(readers[heaviest].nearest(strands.inverse_masses));
        if (!strands.colors.empty()) strands.colors.insert(strands.colors.end(), {float(color.x), float(color.y), float(color.z)});
      }
      report.mean_length += length / wanted;
      strands.first_vertex.push_back(strands.first_vertex.back() + uint32_t(fractions.size()));
      refuseTooMany(strands.strands(), strands.first_vertex.back());
    }
    before = after;
  }
  report.added = made;
  return report;
}

}  // namespace forelock::samples
