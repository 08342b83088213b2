// Strands that somebody should look at, and strands astray.
#include "strand_faults.h"

#include "strand_edit.h"
#include "stray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::samples {
namespace {

using Points = std::vector<std::array<float, 3>>;

void add(EditableStrands& s, const Points& points, float radius = 0.001f) {
  if (s.first_vertex.empty()) s.first_vertex = {0};
  for (const auto& p : points) s.positions.insert(s.positions.end(), p.begin(), p.end());
  s.radii.insert(s.radii.end(), points.size(), radius);
  s.first_vertex.push_back(s.first_vertex.back() + uint32_t(points.size()));
}

// `count` strands of length 1 side by side.
EditableStrands comb(int count) {
  EditableStrands s;
  for (int i = 0; i < count; ++i) add(s, {{float(i) * 0.01f, 0, 0}, {float(i) * 0.01f, -0.5f, 0.1f}, {float(i) * 0.01f, -1, 0}});
  return s;
}

int strays(const std::vector<uint8_t>& found) { return int(std::count(found.begin(), found.end(), uint8_t{1})); }

}  // namespace

TEST(StrandFaults, NoneOfAComb) {
  const EditableStrands s = comb(20);
  const StrandFaults faults = findStrandFaults(s.view());
  EXPECT_EQ(faults.strands, 0u);
  EXPECT_EQ(describeFaults(faults), "none");
}

TEST(StrandFaults, EachKindInItsStrandAndInNoOther) {
  EditableStrands s = comb(20);
  add(s, {{0, 0, 0}, {0.00009f, 0, 0}});                                // 20: 0.9e-4 of the median's 1.02
  add(s, {{0, 0, 0}, {0, -1, 0}, {0, -1, 0}, {0, -1.1f, 0}});           // 21
  add(s, {{0.5f, 0, 0}, {0.5f, -1, 0}, {0.5f, -0.55f, 0.2f}});          // 22: turns by 156 degrees
  add(s, {{0.03f, 0, 0}, {0.03f, -0.5f, 0.1f}, {0.03f, -1, 0}});        // 23: as strand 3
  add(s, {{0.7f, 0, 0}, {0.7f, -1, 0}}, 0.0f);                          // 24
  add(s, {{0.8f, 0, 0}, {0.8f, -1, 0}, {0.8f, -1, 0}, {0.8f, 0.5f, 0}});// 25: back through a doubled vertex: two kinds
  add(s, {{0.9f, 0, 0}, {0.9f, -1, 0}, {1.8f, -0.6f, 0}});              // 26: turns by 114 degrees, which is allowed
  add(s, {{0.6f, 0, 0}, {0.6f, -1, 0}});                                // 27
  s.root_uvs.assign(2 * size_t{s.strands()}, 0.5f);
  s.root_uvs[2 * 27] = -0.25f;
  const StrandFaults faults = findStrandFaults(s.view());
  for (uint32_t i = 0; i < 20; ++i) EXPECT_EQ(faults.of[i], 0) << i;
  EXPECT_EQ(faults.of[20], 1 << kFaultMicro);
  EXPECT_EQ(faults.of[21], 1 << kFaultSegment);
  EXPECT_EQ(faults.of[22], 1 << kFaultTurn);
  EXPECT_EQ(faults.of[23], 1 << kFaultDuplicate);
  EXPECT_EQ(faults.of[24], 1 << kFaultWidth);
  EXPECT_EQ(faults.of[25], 1 << kFaultSegment | 1 << kFaultTurn);
  EXPECT_EQ(faults.of[26], 0);
  EXPECT_EQ(faults.of[27], 1 << kFaultRootUv);
  EXPECT_EQ(faults.strands, 7u);
  EXPECT_EQ(faults.counts[kFaultSegment], 2u);
  EXPECT_EQ(describeFaults(faults).rfind("7 strands: 1 shorter than", 0), 0u) << describeFaults(faults);
}

TEST(StrandFaults, AllOfThemNotTheFirstEight) {
  EditableStrands s = comb(100);
  for (int i = 0; i < 40; ++i) add(s, {{0, 0, 0}, {1e-6f * float(i + 1), 0, 0}});
  EXPECT_EQ(findStrandFaults(s.view()).counts[kFaultMicro], 40u);
}

TEST(StrandFaults, RootUvsOfTilesAreNone) {
  EditableStrands s = comb(10);
  s.root_uvs.assign(20, 1.5f);
  EXPECT_EQ(findStrandFaults(s.view()).strands, 0u);
}

TEST(Stray, OneFarOffIsFound) {
  EditableStrands s = comb(100);
  EXPECT_TRUE(findStrayStrands(s.view()).empty());
  add(s, {{1e5f, 0, 0}, {1e5f, -1, 0}});
  const std::vector<uint8_t> found = findStrayStrands(s.view());
  EXPECT_EQ(strays(found), 1);
  EXPECT_EQ(found.at(100), 1);
}

TEST(Stray, OneVertexFarOffIsEnough) {
  EditableStrands s = comb(50);
  s.positions[3 * 31 + 1] = -40;
  EXPECT_EQ(strays(findStrayStrands(s.view())), 1);
}

TEST(Stray, TwoFarApartAreBothWanted) {
  EditableStrands s;
  add(s, {{0, 0, 0}, {0, -1, 0}});
  add(s, {{1e5f, 0, 0}, {1e5f, -1, 0}});
  EXPECT_TRUE(findStrayStrands(s.view()).empty());
}

TEST(Stray, OfThreeOneVeryFarOff) {
  EditableStrands s = comb(2);
  add(s, {{1e5f, 0, 0}, {1e5f, -1, 0}});
  EXPECT_EQ(strays(findStrayStrands(s.view())), 1);
}

TEST(Stray, ALongTailIsPartOfTheHair) {
  EditableStrands s = comb(100);
  for (int i = 1; i <= 8; ++i) add(s, {{0, 0, 0}, {0, -1.5f * float(i), 0}});  // each longer, the last 12 times as long as the hair
  EXPECT_TRUE(findStrayStrands(s.view()).empty());
}

TEST(Stray, APlaitOfATenthIsPartOfTheHair) {
  EditableStrands s = comb(100);
  for (int i = 0; i < 20; ++i) add(s, {{0, -5, 0.01f * float(i)}, {0, -8, 0}});
  EXPECT_TRUE(findStrayStrands(s.view()).empty());
}

}  // namespace forelock::samples
