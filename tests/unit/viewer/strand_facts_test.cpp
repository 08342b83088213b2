// What is said of one strand.
#include "strand_facts.h"

#include "strand_edit.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace forelock::samples;

namespace {

EditableStrands twoStrands() {
  EditableStrands s;
  s.first_vertex = {0, 2, 6};
  s.positions = {0, 0, 0, 0, 0, 5, /* three sides of a square */ 1, 0, 0, 1, 2, 0, 3, 2, 0, 3, 1, 0};
  s.radii = {1, 1, 0.02f, 0.03f, 0.02f, 0.01f};
  s.root_uvs = {0, 0, 0.25f, 0.75f};
  s.inverse_masses = {0, 1, 0, 0, 1, 1};
  s.colors = {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
  return s;
}

std::string lineOf(const StrandFacts& facts, const std::string& name) {
  for (const auto& [key, value] : facts.lines)
    if (key == name) return value;
  return "none";
}

}  // namespace

TEST(StrandFacts, AreThoseOfTheStrandAlone) {
  OpenedAsset opened = assetOf(twoStrands().view(), "two");
  opened.groups = {0, 1};
  opened.group_names = {"left", "fringe"};
  FlkStrands strands{};
  flkAssetGetStrands(opened.asset.get(), &strands);
  const StrandFaults faults = findStrandFaults(strands);
  const StrandFacts facts = strandFacts(opened, 1, {&faults, 3, 2.0});
  EXPECT_EQ(facts.vertices, 4u);
  EXPECT_DOUBLE_EQ(facts.length, 5.0);
  EXPECT_NEAR(facts.root_to_tip, std::sqrt(5.0), 1e-12);
  EXPECT_EQ(facts.min_segment, 1.0);
  EXPECT_EQ(facts.max_segment, 2.0);
  EXPECT_NEAR(facts.mean_segment, 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(facts.max_turn_deg, 90.0, 1e-4);
  EXPECT_NEAR(facts.max_curvature, 1.57079633 / 1.5, 1e-6);
  EXPECT_EQ(lineOf(facts, "strand"), "1 of 2");
  EXPECT_EQ(lineOf(facts, "group"), "fringe");
  EXPECT_EQ(lineOf(facts, "root"), "1, 0, 0");
  EXPECT_EQ(lineOf(facts, "tip"), "3, 1, 0");
  EXPECT_EQ(lineOf(facts, "width"), "0.04 to 0.02");
  EXPECT_EQ(lineOf(facts, "as drawn"), "0.08 to 0.04");
  EXPECT_EQ(lineOf(facts, "root UV"), "0.25, 0.75");
  EXPECT_EQ(lineOf(facts, "colour"), "#ff0000 to #0000ff");
  EXPECT_EQ(lineOf(facts, "pinned"), "2 vertices");
  EXPECT_EQ(lineOf(facts, "guide"), "of 3 follow strands");
  EXPECT_EQ(lineOf(facts, "faults"), "none");
}

TEST(StrandFacts, FaultsInWords) {
  EXPECT_EQ(faultWords(0), "");
  EXPECT_EQ(faultWords(1 << kFaultSegment | 1 << kFaultTurn), "with equal consecutive vertices, with a turn of more than 120 degrees");
  EditableStrands s = twoStrands();
  s.radii.assign(6, 0.0f);
  const OpenedAsset opened = assetOf(s.view(), "two");
  FlkStrands strands{};
  flkAssetGetStrands(opened.asset.get(), &strands);
  const StrandFaults faults = findStrandFaults(strands);
  EXPECT_EQ(lineOf(strandFacts(opened, 0, {&faults}), "faults"), "of width 0");
}

TEST(StrandFacts, SayWhatIsNotOfTheSource) {
  EditableStrands s = twoStrands();
  s.radii.clear();
  s.root_uvs.clear();
  s.colors.clear();
  s.inverse_masses.clear();
  s.positions[5] = 0;  // strand 0 has no length
  const OpenedAsset opened = assetOf(s.view(), "one is left");
  const StrandFacts facts = strandFacts(opened, 0);
  EXPECT_EQ(lineOf(facts, "strand"), "0 of 1 (1 in the source)");
  EXPECT_NE(lineOf(facts, "width").find("a default"), std::string::npos);
  for (const char* absent : {"root UV", "colour", "pinned", "guide", "faults", "group"}) EXPECT_EQ(lineOf(facts, absent), "none") << absent;
}

TEST(VertexRows, GoFromRootToTip) {
  const EditableStrands s = twoStrands();
  const std::vector<VertexRow> rows = vertexRows(s.view(), 1);
  ASSERT_EQ(rows.size(), 4u);
  const double along[] = {0, 2, 4, 5};
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rows[i].index, i);
    EXPECT_DOUBLE_EQ(rows[i].along, along[i]);
    EXPECT_EQ(rows[i].radius, s.radii[2 + i]);
  }
  EXPECT_EQ(rows[3].position, glm::vec3(3, 1, 0));
  ASSERT_TRUE(rows[3].color);
  EXPECT_EQ(*rows[3].color, glm::vec3(0, 0, 1));
  FlkStrands bare = s.view();
  bare.colors = nullptr;
  bare.radii = nullptr;
  EXPECT_FALSE(vertexRows(bare, 0)[0].color);
  EXPECT_EQ(vertexRows(bare, 0)[1].along, 5.0);
}
