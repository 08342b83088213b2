// Values that colours show, and the colours.
#include "strand_color.h"

#include "strand_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace forelock::samples {
namespace {

EditableStrands strandsOf(const std::vector<std::vector<std::array<float, 3>>>& strands) {
  EditableStrands s;
  s.first_vertex = {0};
  for (const auto& strand : strands) {
    for (const auto& p : strand) s.positions.insert(s.positions.end(), p.begin(), p.end());
    s.first_vertex.push_back(s.first_vertex.back() + uint32_t(strand.size()));
  }
  s.radii.assign(s.vertices(), 0.001f);
  return s;
}

std::vector<std::array<float, 3>> circle(double radius, int vertices, double step) {
  std::vector<std::array<float, 3>> points;
  for (int i = 0; i < vertices; ++i)
    points.push_back({float(radius * std::cos(i * step)), float(radius * std::sin(i * step)), 0.25f});
  return points;
}

}  // namespace

TEST(StrandColor, CurvatureOfACircleIsOneOverItsRadius) {
  for (const double radius : {0.01, 0.5, 20.0}) {
    constexpr double step = 0.1;
    const EditableStrands s = strandsOf({circle(radius, 20, step)});
    // An angle t on chords 2 r sin(t/2) gives (1/r) (t/2) / sin(t/2) = (1/r) (1 + t^2/24 + ...). Coordinates are rounded to 2^-24 of
    // the radius: on a chord of a tenth of it an angle is off by 4e-6 at most, of 0.1.
    const double expected = (step / 2) / std::sin(step / 2) / radius;
    for (const float value : strandCurvature(s.view())) EXPECT_NEAR(value * radius, expected * radius, 5e-5) << radius;
  }
}

TEST(StrandColor, CurvatureOfCornersAndDoubledVertices) {
  const EditableStrands s = strandsOf({{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 3, 0}, {1, 6, 0}}, {{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}}});
  const std::vector<float> c = strandCurvature(s.view());
  const float corner = float(std::numbers::pi / 2 / 2);  // over the mean of lengths 1 and 3
  for (const size_t at : {0, 1, 2}) EXPECT_FLOAT_EQ(c[at], corner) << at;
  EXPECT_EQ(c[3], 0.0f);
  EXPECT_EQ(c[4], 0.0f);
  EXPECT_EQ(c[5], 0.0f) << "a single segment does not turn";
  EXPECT_EQ(c[6], 0.0f);
  EXPECT_FLOAT_EQ(c[8], float(std::numbers::pi / 2)) << "straight back: pi over 2";
}

TEST(StrandColor, CurvatureScalesAndTurnsWithTheStrand) {
  EditableStrands s = strandsOf({circle(0.3, 9, 0.4)});
  const std::vector<float> before = strandCurvature(s.view());
  scaleStrands(s, 4.0);
  mapAxes(s, parseAxes("z,-x,y"));
  const std::vector<float> after = strandCurvature(s.view());
  for (size_t i = 0; i < before.size(); ++i) EXPECT_NEAR(after[i] * 4, before[i], 1e-5 * before[i]);
}

TEST(StrandColor, LengthsAndSegments) {
  const EditableStrands s = strandsOf({{{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {1, 3, 8}}, {{0, 0, 0}, {0, 0.5f, 0}}});
  EXPECT_EQ(strandLengths(s.view()), (std::vector<float>{12, 12, 12, 12, 0.5f, 0.5f}));
  // Mean 4: ratios 0.25, 0.75, 2, of which a vertex has the one farther from 1 on a log scale.
  EXPECT_EQ(segmentRatios(s.view()), (std::vector<float>{0.25f, 0.25f, 2, 2, 1, 1}));
  EXPECT_EQ(strandDiameters(s.view())[3], 0.002f);
}

TEST(StrandColor, ScaleHoldsWhatIsUsual) {
  std::vector<float> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(float(i));
  values.push_back(1e30f);  // one outlier moves nothing
  ColorScale scale = usualScale(values, false);
  EXPECT_NEAR(scale.blue, 50, 1e-9);
  EXPECT_NEAR(scale.red, 950, 1e-9);
  values.insert(values.end(), 20, 1e30f);
  EXPECT_NEAR(usualScale(values, false).red, 970, 1e-9) << "969 = 95 % of 1021, rounded up to two digits";
  EXPECT_EQ(usualScale(values, true).blue, 0.0);
  scale = usualScale(std::vector<float>(9, 3.0f), false);
  EXPECT_DOUBLE_EQ(scale.share(3.0), 0.5) << "all alike";
  EXPECT_EQ(usualScale(std::vector<float>(9, 0.0f), true).share(0.0), 0.0);
  EXPECT_EQ(usualScale({}, true).share(0.0), 0.0);
}

TEST(StrandColor, SharesAreCutAndNeverNaN) {
  const ColorScale segments{0.25, 4.0, true};
  EXPECT_NEAR(segments.share(1.0), 0.5, 1e-12);
  EXPECT_NEAR(segments.share(2.0), 0.75, 1e-12);
  EXPECT_EQ(segments.share(0.0), 0.0);
  EXPECT_EQ(segments.share(-1.0), 0.0);
  EXPECT_EQ(segments.share(1e30), 1.0);
  EXPECT_EQ(segments.share(std::nan("")), 0.0);
  EXPECT_GT(scaleColor(0.0).z, scaleColor(0.0).x) << "blue";
  EXPECT_GT(scaleColor(1.0).x, scaleColor(1.0).z) << "red";
  EXPECT_EQ(scaleColor(7.0), scaleColor(1.0));
  EXPECT_EQ(scaleColor(std::nan("")), scaleColor(0.0));
  EXPECT_EQ(scaleColors({0.25f, 4.0f}, segments).size(), 6u);
}

TEST(StrandColor, DistinctColorsAre) {
  for (uint32_t a = 0; a < 12; ++a)
    for (uint32_t b = 0; b < a; ++b) {
      const glm::vec3 d = distinctColor(a) - distinctColor(b);
      EXPECT_GT(std::abs(d.x) + std::abs(d.y) + std::abs(d.z), 0.2f) << a << " " << b;
    }
  EXPECT_EQ(distinctColor(12), distinctColor(0));
}

}  // namespace forelock::samples
