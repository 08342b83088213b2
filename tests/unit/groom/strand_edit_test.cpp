// Operations on strands.
#include "strand_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace forelock::samples {
namespace {

// A right angle of lengths 1 and 3, and a straight strand of length 0.5.
EditableStrands twoStrands() {
  EditableStrands s;
  s.first_vertex = {0, 3, 5};
  s.positions = {0, 0, 0, 1, 0, 0, 1, 3, 0, 0, 0, 1, 0, 0, 1.5f};
  s.radii = {1, 2, 4, 1, 1};
  s.root_uvs = {0.25f, 0.125f, 0.5f, 1};
  s.inverse_masses = {0, 0, 1, 0, 1};
  s.colors = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1};
  return s;
}

}  // namespace

TEST(StrandEdit, ScaleTakesWidthsAlong) {
  EditableStrands s = twoStrands();
  scaleStrands(s, 0.01);
  EXPECT_FLOAT_EQ(s.positions[7], 0.03f);
  EXPECT_FLOAT_EQ(s.radii[2], 0.04f);
}

TEST(StrandEdit, Axes) {
  EditableStrands s = twoStrands();
  const AxisMap z_up = parseAxes("x,-z,y");
  EXPECT_FALSE(z_up.mirrors());
  mapAxes(s, z_up);
  EXPECT_EQ(s.positions[6], 1.0f);
  EXPECT_EQ(s.positions[8], 3.0f) << "what was y is z";
  EXPECT_EQ(s.positions[3 * 4 + 1], -1.5f);
  mapAxes(s, parseAxes("x,z,-y"));
  EXPECT_EQ(s.positions, twoStrands().positions) << "and back";
  EXPECT_TRUE(parseAxes("x,z,y").mirrors());
  EXPECT_TRUE(parseAxes("-x,y,z").mirrors());
  EXPECT_FALSE(parseAxes("y,z,x").mirrors());
  EXPECT_FALSE(parseAxes("+x,-y,-z").mirrors());
  for (const char* wrong : {"", "x", "x,y", "x,y,y", "x,y,z,", "x y z", "a,b,c", "x,--y,z", "x,y,"}) EXPECT_THROW(parseAxes(wrong), std::invalid_argument) << wrong;
}

TEST(StrandEdit, FlipReverseRecentre) {
  EditableStrands s = twoStrands();
  flipV(s);
  EXPECT_EQ(s.root_uvs[1], 0.875f);
  EXPECT_EQ(s.root_uvs[0], 0.25f);
  reverseStrands(s);
  EXPECT_EQ(s.positions[1], 3.0f);
  EXPECT_EQ(s.radii[0], 4.0f);
  EXPECT_EQ(s.inverse_masses[0], 1.0f);
  EXPECT_EQ(s.colors[0], 1.0f);
  EXPECT_EQ(s.positions[3 * 3 + 2], 1.5f);
  const std::array<double, 3> shift = recentreStrands(s);
  EXPECT_EQ(shift[1], -1.5);
  EXPECT_EQ(s.positions[1], 1.5f);
}

TEST(StrandEdit, ShortStrandsGo) {
  EditableStrands s = twoStrands();
  EXPECT_EQ(removeShortStrands(s, 0.25), 0u);
  EXPECT_EQ(removeShortStrands(s, 1), 1u);
  EXPECT_EQ(s.strands(), 1u);
  EXPECT_EQ(s.root_uvs.size(), 2u);
  EXPECT_EQ(s.colors.size(), 9u);
}

TEST(StrandEdit, ResampledEvenly) {
  EditableStrands s = twoStrands();
  const ResampleReport exact = resampleStrands(s, 5);  // one lies on the corner
  EXPECT_NEAR(exact.worst_error, 0, 1e-7);
  ASSERT_EQ(s.vertices(), 10u);
  EXPECT_EQ(s.positions[3], 1.0f);
  EXPECT_EQ(s.positions[7], 1.0f);
  EXPECT_EQ(s.positions[13], 3.0f);
  EXPECT_FLOAT_EQ(s.radii[3], 2 + 2 * 2.0f / 3);
  EXPECT_EQ(s.inverse_masses[1], 0.0f) << "the second stays pinned";
  EXPECT_EQ(s.inverse_masses[4], 1.0f);
  EditableStrands cut = twoStrands();
  const ResampleReport report = resampleStrands(cut, 2);
  EXPECT_NEAR(report.worst_error, 1 - std::sqrt(10.0) / 4, 1e-7) << "the corner is cut";
  EXPECT_EQ(report.worst_strand, 0u);
  EXPECT_NEAR(report.mean_error, report.worst_error / 2, 1e-7);
}

// A circle of radius 1 with n points loses (pi / n)^2 / 6 of its length, and so does what is resampled from a finer one.
TEST(StrandEdit, LengthErrorOfACircle) {
  EditableStrands s;
  constexpr int fine = 4000;
  s.first_vertex = {0, fine + 1};
  for (int i = 0; i <= fine; ++i) {
    const double angle = 2 * std::numbers::pi * i / fine;
    s.positions.insert(s.positions.end(), {float(std::cos(angle)), float(std::sin(angle)), 0});
  }
  const ResampleReport report = resampleStrands(s, 33);
  EXPECT_NEAR(report.worst_error, std::pow(std::numbers::pi / 32, 2) / 6, 2e-5);
}

}  // namespace forelock::samples
