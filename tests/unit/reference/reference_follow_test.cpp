// Follow strands: their places, their spread, and how they turn.
#include "reference_follow.h"
#include "reference_support.h"
#include "reference_vector.h"

namespace forelock::reference {
namespace {

Strands someGuides(int count) {
  std::mt19937 random(60);
  std::normal_distribution<double> normal;
  Strands guides;
  for (int i = 0; i < count; ++i) {
    std::vector<Vec3> points{{normal(random), normal(random), normal(random)}};
    for (int v = 0; v < 4; ++v)
      points.push_back(points.back() + 0.1 * Vec3{normal(random), normal(random), normal(random)});
    addStrand(guides, points, 1e-3 * (i + 1));
  }
  return guides;
}

// The published first outputs of SplitMix64 for the seed 1234567, top 53 bits.
TEST(ReferenceFollow, NumbersAreSplitMix64) {
  const double u1 = double(6457827717110365317ull >> 11) / 9007199254740992.0;
  const double u2 = double(3203168211198807973ull >> 11) / 9007199254740992.0;
  Strands guide;
  const Vec3 points[2] = {{0, 0, 0}, {0, 0, 1}};
  addStrand(guide, points, 1e-3);
  const Strands all = followStrands(guide, 1, 2.0, 1, 1234567 - 2 * 0x9E3779B97F4A7C15ull);
  // t = z: X = x, Y = y.
  EXPECT_NEAR(all.positions[2].x, 2 * std::sqrt(u1) * std::cos(2 * std::numbers::pi * u2), 1e-15);
  EXPECT_NEAR(all.positions[2].y, 2 * std::sqrt(u1) * std::sin(2 * std::numbers::pi * u2), 1e-15);
  EXPECT_EQ(all.positions[2].z, 0);
}

TEST(ReferenceFollow, OffsetsLieInTheDisc) {
  const Strands guides = someGuides(40);
  const uint32_t n = 50;
  const double radius = 0.02, spread = 0.25;
  const Strands all = followStrands(guides, n, radius, spread, 7);
  ASSERT_EQ(all.count(), 40u * (n + 1));
  double squares = 0, longest = 0;
  Vec3 sum{};
  for (size_t i = 0; i < 40; ++i) {
    const size_t g = guides.first_vertex[i];
    const Vec3 t = normalizeOrZero(guides.positions[g + 1] - guides.positions[g]);
    for (uint32_t j = 0; j <= n; ++j) {
      const size_t f = all.first_vertex[i * (n + 1) + j];
      const Vec3 o = all.positions[f] - guides.positions[g];
      EXPECT_LE(length(o), j == 0 ? 0 : radius);
      EXPECT_NEAR(dot(o, t), 0, 1e-15);
      for (size_t v = 0; v < 5; ++v) {
        const Vec3 at = all.positions[f + v] - guides.positions[g + v];
        EXPECT_NEAR(length(at - mix(1, spread, guides.fraction[g + v]) * o), 0, 1e-15);
        EXPECT_EQ(all.fraction[f + v], guides.fraction[g + v]);
        EXPECT_EQ(all.radii[f + v], guides.radii[g + v]);
      }
      squares += dot(o, o);
      longest = std::max(longest, length(o));
      sum = sum + o;
    }
  }
  // Uniform in the disc: the mean square is half the radius's, within 3 of its deviations 1 / sqrt(12 * 2000).
  EXPECT_NEAR(squares / (40 * n) / (radius * radius), 0.5, 3 / std::sqrt(12.0 * 40 * n));
  EXPECT_GT(longest, 0.99 * radius);
  EXPECT_LT(length(sum) / (40 * n), 0.1 * radius);
  // The seed matters, and the same seed gives the same.
  EXPECT_EQ(followStrands(guides, n, radius, spread, 7).positions[7].x, all.positions[7].x);
  EXPECT_NE(followStrands(guides, n, radius, spread, 8).positions[7].x, all.positions[7].x);
}

TEST(ReferenceFollow, OffsetsTurnWithTheRoot) {
  const Strands rest = someGuides(20);
  const Strands at_rest = followStrands(rest, 5, 0.02, 0.5, 9);
  // Bent behind the first segment: nothing turns.
  Strands bent = rest;
  for (size_t i = 0; i < 20; ++i) bent.positions[rest.first_vertex[i] + 3].y += 0.3;
  const Strands follow_bent = followStrands(rest, bent, 5, 0.02, 0.5, 9);
  // The hair turned as a whole about the axis square to a guide's root: each of its own. Then follow = turned follow.
  for (size_t i = 0; i < 20; ++i) {
    const size_t g = rest.first_vertex[i];
    const Vec3 t = normalizeOrZero(rest.positions[g + 1] - rest.positions[g]);
    const Vec3 axis = normalizeOrZero(cross(t, Vec3{0.3, 0.5, 0.8}));
    const double angle = 0.3 + 0.14 * double(i);  // up to 3 rad
    auto turned = [&](Vec3 v) {
      return std::cos(angle) * v + std::sin(angle) * cross(axis, v) + (1 - std::cos(angle)) * dot(axis, v) * axis;
    };
    Strands moved = rest;
    for (Vec3& p : moved.positions) p = turned(p);
    const Strands follow = followStrands(rest, moved, 5, 0.02, 0.5, 9);
    for (uint32_t j = 0; j <= 5; ++j) {
      for (size_t v = 0; v < 5; ++v) {
        const size_t at = at_rest.first_vertex[i * 6 + j] + v;
        EXPECT_NEAR(length(follow.positions[at] - turned(at_rest.positions[at])), 0, 1e-14);
        EXPECT_NEAR(length(follow_bent.positions[at] - at_rest.positions[at]), v == 3 ? 0.3 : 0, 1e-14);
      }
    }
  }
}

TEST(ReferenceFollow, Degenerate) {
  Strands guides;
  const Vec3 up[3] = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}}, down[3] = {{0, 0, 0}, {0, 0, -1}, {0, 0, -2}};
  const Vec3 point[2] = {{1, 1, 1}, {1, 1, 1}};
  addStrand(guides, up, 1e-3);
  addStrand(guides, point, 1e-3);
  Strands moved;
  addStrand(moved, down, 1e-3);
  addStrand(moved, point, 1e-3);
  const Strands follow = followStrands(guides, moved, 3, 0.1, 1, 1);
  for (const Vec3& p : follow.positions) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  EXPECT_GT(length(follow.positions[3]), 0);  // still square to the root, as long as before
  EXPECT_EQ(follow.positions[3].z, 0);
  EXPECT_EQ(followStrands(guides, 0, 0.1, 1, 1).count(), 2u);
  guides.colors.assign(5, {1, 0, 0});
  EXPECT_EQ(followStrands(guides, 2, 0.1, 1, 1).colors.size(), 15u);
}

}  // namespace
}  // namespace forelock::reference
