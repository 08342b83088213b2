// Follow strands: section 7.
#include "reference_follow.h"

#include "reference_vector.h"

#include <numbers>

namespace forelock::reference {
namespace {

constexpr uint64_t golden_gamma = 0x9E3779B97F4A7C15;  // SplitMix64's increment

// Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators (2014).
struct SplitMix64 {
  uint64_t state;

  double next() {
    state += golden_gamma;
    uint64_t z = state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    z ^= z >> 31;
    return double(z >> 11) / 9007199254740992.0;  // 2^53
  }
};

Vec3 rootDirection(const Strands& strands, size_t strand) {
  const size_t begin = strands.first_vertex[strand];
  if (strands.first_vertex[strand + 1] < begin + 2) return {};
  return normalizeOrZero(strands.positions[begin + 1] - strands.positions[begin]);
}

// Square to t: the world axis with the smallest |e.t|, the first of equals, without its part along t.
Vec3 squareAxis(Vec3 t) {
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 e = axes[0];
  for (const Vec3& axis : axes) {
    if (std::fabs(dot(axis, t)) < std::fabs(dot(e, t))) e = axis;
  }
  return normalizeOrZero(e - dot(e, t) * t);
}

// The shortest rotation that takes one unit vector to another, applied to v. Straight back there is no shortest: half
// a turn about `square`. Nothing turns where either has no direction.
Vec3 rotateBetween(Vec3 from, Vec3 to, Vec3 square, Vec3 v) {
  if (isZero(from) || isZero(to)) return v;
  const Vec3 axis = cross(from, to);
  const double cosine = dot(from, to);
  if (cosine < -1 + 1e-12) return 2 * dot(square, v) * square - v;
  // Rodrigues' formula with the sine in the axis: (1 - cos) / sin^2 = 1 / (1 + cos).
  return cosine * v + cross(axis, v) + dot(axis, v) / (1 + cosine) * axis;
}

}  // namespace

Strands followStrands(const Strands& guides, uint32_t n, double radius, double spread_tip, uint64_t seed) {
  return followStrands(guides, guides, n, radius, spread_tip, seed);
}

Strands followStrands(const Strands& rest, const Strands& current, uint32_t n, double radius, double spread_tip,
                      uint64_t seed) {
  Strands out;
  for (size_t guide = 0; guide < rest.count(); ++guide) {
    const Vec3 t = rootDirection(rest, guide), now = rootDirection(current, guide);
    const Vec3 x = squareAxis(t), y = cross(t, x);
    for (uint64_t j = 0; j <= n; ++j) {
      Vec3 offset{};
      if (j > 0) {
        SplitMix64 random{seed + (guide * 1024 + j) * 2 * golden_gamma};
        const double u1 = random.next(), u2 = random.next(), angle = 2 * std::numbers::pi * u2;
        offset = radius * std::sqrt(u1) * (std::cos(angle) * x + std::sin(angle) * y);
        offset = rotateBetween(t, now, x, offset);
      }
      for (size_t v = rest.first_vertex[guide]; v < rest.first_vertex[guide + 1]; ++v) {
        const double f = rest.fraction[v];
        out.positions.push_back(current.positions[v] + mix(1, spread_tip, f) * offset);
        out.radii.push_back(current.radii[v]);
        out.fraction.push_back(f);
        if (!current.colors.empty()) out.colors.push_back(current.colors[v]);
      }
      out.first_vertex.push_back(uint32_t(out.positions.size()));
    }
  }
  return out;
}

}  // namespace forelock::reference
