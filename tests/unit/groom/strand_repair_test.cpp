// What repairs change, and that they change nothing else; and the numbers that inspect gives.
#include "strand_repair.h"
#include "strand_statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace forelock::samples {
namespace {

// A right angle of 1 and 3, a copy of it, a strand with a vertex twice, a micro strand.
EditableStrands fourStrands() {
  EditableStrands s;
  s.first_vertex = {0, 3, 6, 10, 12};
  s.positions = {0, 0, 0, 1, 0, 0, 1, 3, 0, 0, 0, 0, 1, 0, 0, 1, 3, 0, 5, 0, 0, 5, 1, 0, 5, 1, 0, 5, 2, 0, 9, 0, 0, 9, 1e-5f, 0};
  for (int i = 0; i < 12; ++i) s.radii.push_back(0.001f * float(i + 1)), s.inverse_masses.push_back(float(i)), s.colors.insert(s.colors.end(), {float(i) / 16, 0, 1});
  s.root_uvs = {0, 0, 0.25f, 0.25f, 0.5f, 1.5f, 1, 1};
  return s;
}

std::vector<Repair> repair(EditableStrands& s, const std::vector<std::string>& codes, const std::vector<std::string>& found) {
  std::vector<AssetFinding> findings;
  for (const std::string& code : found) findings.push_back({code, "", FLK_SEVERITY_WARNING, false, 1, {}, UINT64_MAX});
  return repairStrands(s, {}, findings, codes);
}

}  // namespace

TEST(StrandRepair, TakesAwayCopiesMicroStrandsAndRepeatedVertices) {
  EditableStrands s = fourStrands();
  const std::vector<std::string> codes = {"STRAND_DUPLICATE", "STRAND_MICRO", "SEGMENT_ZERO_LENGTH"};
  const std::vector<Repair> repairs = repair(s, codes, codes);
  ASSERT_EQ(repairs.size(), 3u);
  EXPECT_EQ(repairs[0].code, "STRAND_MICRO");
  for (const Repair& done : repairs) EXPECT_EQ(done.count, 1u) << done.code;
  EXPECT_EQ(s.first_vertex, (std::vector<uint32_t>{0, 3, 6}));
  EXPECT_EQ(s.positions, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 3, 0, 5, 0, 0, 5, 1, 0, 5, 2, 0}));
  EXPECT_EQ(s.inverse_masses, (std::vector<float>{0, 1, 2, 6, 7, 9})) << "the first of equal vertices stays, with what it carries";
  EXPECT_EQ(s.root_uvs, (std::vector<float>{0, 0, 0.5f, 1.5f}));
  EXPECT_EQ(s.colors[3 * 5], 9.0f / 16);
}

TEST(StrandRepair, ChangesOnlyWhatIsBothAskedForAndFound) {
  EditableStrands s = fourStrands();
  EXPECT_TRUE(repair(s, {"STRAND_DUPLICATE"}, {"STRAND_MICRO"}).empty());
  EXPECT_TRUE(repair(s, {}, {"STRAND_MICRO", "ROOT_AT_TIP"}).empty());
  EXPECT_EQ(s.positions, fourStrands().positions);
  EXPECT_THROW(repair(s, {"UGLY"}, {}), std::invalid_argument);
}

TEST(StrandRepair, OnRequest) {
  EditableStrands s = fourStrands();
  const std::vector<Repair> repairs = repair(s, {"ROOT_AT_TIP", "ROOT_UV_OUTSIDE_UNIT", "INVERSE_MASS_ALL_ZERO"}, {"ROOT_AT_TIP", "ROOT_UV_OUTSIDE_UNIT", "INVERSE_MASS_ALL_ZERO"});
  ASSERT_EQ(repairs.size(), 3u);
  EXPECT_EQ(repairs[0].count, 4u);
  EXPECT_EQ(s.positions[1], 3.0f);
  EXPECT_EQ(repairs[1].count, 1u);
  EXPECT_EQ(s.root_uvs[5], 1.0f);
  EXPECT_TRUE(s.inverse_masses.empty());
}

TEST(StrandStatistics, OfStrandsByHand) {
  const EditableStrands s = fourStrands();
  const StrandStatistics numbers = measureStrands(s.view(), 2);
  EXPECT_EQ(numbers.vertices.min, 2.0);
  EXPECT_EQ(numbers.vertices.median, 3.0);
  EXPECT_EQ(numbers.vertices.max, 4.0);
  EXPECT_FLOAT_EQ(float(numbers.length.max), 4);
  EXPECT_FLOAT_EQ(float(numbers.length.median), 3) << "between 2 and 4";
  EXPECT_EQ(numbers.segment_length.min, 0.0);
  EXPECT_FLOAT_EQ(float(numbers.turn_degrees.max), 90);
  EXPECT_EQ(numbers.turn_degrees.median, 90.0) << "90, 90 and, over the vertex that is there twice, 0";
  EXPECT_FLOAT_EQ(float(numbers.unevenness.max), 1.5f) << "3 of mean 2, and 1 of mean 2/3";
  EXPECT_FLOAT_EQ(float(numbers.width.max), 0.024f);
  EXPECT_FLOAT_EQ(float(numbers.width.mean), 0.013f);
  EXPECT_EQ(numbers.duplicates, 1u);
  ASSERT_EQ(numbers.longest.size(), 2u);
  EXPECT_EQ(numbers.longest[0].strand, 0u);
  EXPECT_EQ(numbers.longest[1].strand, 1u);
  EXPECT_EQ(numbers.shortest[0].strand, 3u);
  EXPECT_FLOAT_EQ(float(numbers.max_bounds[0]), 9.012f);
  EXPECT_NEAR(numbers.direction[1], 8 / 10.0, 1e-5);
}

TEST(StrandStatistics, Guesses) {
  const auto info = [](float low, float high) {
    FlkAssetInfo made{};
    for (int axis = 0; axis < 3; ++axis) made.min_bounds[axis] = -0.1f, made.max_bounds[axis] = 0.1f;
    made.min_bounds[2] = low, made.max_bounds[2] = high;
    return made;
  };
  EXPECT_EQ(guessUnit(info(1.5f, 1.8f)).value, "m");
  EXPECT_EQ(guessUnit(info(150, 180)).value, "cm");
  EXPECT_EQ(guessUnit(info(1500, 1800)).value, "mm");
  StrandStatistics numbers;
  EXPECT_EQ(guessUpAxis(info(1.5f, 1.8f), numbers).value, "z") << "it stands on the origin";
  EXPECT_EQ(guessUpAxis(info(-0.1f, 0.1f), numbers).value, "");
  numbers.direction = {0.1, -0.8, 0};
  EXPECT_EQ(guessUpAxis(info(-0.1f, 0.1f), numbers).value, "y") << "it hangs";
  numbers.direction = {0.1, 0.2, 0.8};
  EXPECT_EQ(guessUpAxis(info(-0.1f, 0.1f), numbers).value, "z") << "it stands up";
  EXPECT_EQ(guessUpAxis(info(1.5f, 1.8f), numbers).value, "z") << "where it stands says more";
}

// 2,000 strands over 0.5 m would be 5 mm wide by their number, and are 0.5 by the bound: with 9 beside each the number still says as much.
TEST(StrandStatistics, FollowStrandsThinTheDefaultWidthOnceItsBoundAllows) {
  FlkAssetInfo info{};
  info.strand_count = 2000;
  info.max_bounds[0] = 0.5f;
  info.max_radius = 0.5f * 0.0005f;
  EXPECT_EQ(followWidthScale(info, 0), 1.0);
  EXPECT_NEAR(followWidthScale(info, 9), 1, 1e-6);
  EXPECT_NEAR(followWidthScale(info, 19), 0.5, 1e-6) << "40,000 strands: 0.25 mm";
  EXPECT_NEAR(followWidthScale(info, 999), 0.2, 1e-6) << "the width of a hair, 1/5,000";
}

}  // namespace forelock::samples
