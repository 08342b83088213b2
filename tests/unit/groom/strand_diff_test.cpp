// The same groom in another guise is recognised, whatever was done to it; another groom is not.
#include "groom.h"
#include "strand_diff.h"
#include "strand_edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace forelock::samples {
namespace {

// Mean length 0.18 m; coordinates are below 0.5.
EditableStrands hair(uint64_t seed = 1, uint32_t strands = 700) {
  Recipe recipe = parseRecipe(R"({"length": {"mean": 0.18}})", "test");
  recipe.strands = strands;
  recipe.vertices = 12;
  recipe.seed = seed;
  const Groom groom = makeGroom(recipe);
  return editableStrands(describeGroom(groom), true);
}

StrandDiff compare(const EditableStrands& a, const EditableStrands& b, const StrandDiffOptions& options = {}) {
  return diffStrands(a.view(), !a.radii.empty(), b.view(), !b.radii.empty(), options);
}

// Where the strands of `order` are, in that order.
EditableStrands chosen(const EditableStrands& from, const std::vector<uint32_t>& order) {
  EditableStrands to;
  to.first_vertex.push_back(0);
  for (const uint32_t strand : order) {
    const auto begin = std::ptrdiff_t(from.first_vertex[strand]), end = std::ptrdiff_t(from.first_vertex[strand + 1]);
    to.positions.insert(to.positions.end(), from.positions.begin() + 3 * begin, from.positions.begin() + 3 * end);
    to.radii.insert(to.radii.end(), from.radii.begin() + begin, from.radii.begin() + end);
    to.root_uvs.insert(to.root_uvs.end(), from.root_uvs.begin() + 2 * std::ptrdiff_t(strand), from.root_uvs.begin() + 2 * std::ptrdiff_t(strand) + 2);
    to.first_vertex.push_back(to.first_vertex.back() + uint32_t(end - begin));
  }
  return to;
}

std::vector<uint32_t> numbers(uint32_t count, const std::vector<uint32_t>& without = {}) {
  std::vector<uint32_t> list;
  for (uint32_t i = 0; i < count; ++i)
    if (std::find(without.begin(), without.end(), i) == without.end()) list.push_back(i);
  return list;
}

// Two roundings of 32-bit floats of coordinates below 0.5 m: 2^-25 each and axis, with the square root of 3.
constexpr double kRounding = 2 * 3e-8 * 1.75;

}  // namespace

TEST(StrandDiff, ItselfIsTheSame) {
  const EditableStrands a = hair();
  const StrandDiff diff = compare(a, a);
  ASSERT_TRUE(diff.related);
  EXPECT_TRUE(diff.relation.isNone());
  EXPECT_EQ(diff.matched, a.strands());
  EXPECT_EQ(diff.max_distance, 0.0);
  EXPECT_FALSE(diff.reordered);
  EXPECT_EQ(diff.differing + diff.resampled + diff.respaced, 0u);
  EXPECT_EQ(diff.uvs, UvRelation::same);
  EXPECT_EQ(diff.width_ratio, 1.0);
  EXPECT_TRUE(diff.only_a.empty() && diff.only_b.empty() && diff.first.empty());
}

TEST(StrandDiff, CentimetresZUpVFlipped) {
  const EditableStrands a = hair();
  EditableStrands b = a;
  mapAxes(b, parseAxes("x,-z,y"));
  scaleStrands(b, 100);
  flipV(b);
  const StrandDiff diff = compare(a, b);
  ASSERT_TRUE(diff.related);
  EXPECT_EQ(diff.relation.scale, 0.01);
  EXPECT_EQ(diff.relation.axes.from, (std::array<int, 3>{0, 2, 1}));
  EXPECT_EQ(diff.relation.axes.sign, (std::array<float, 3>{1, 1, -1}));
  EXPECT_EQ(diff.relation.shift, (std::array<double, 3>{}));
  EXPECT_FALSE(diff.relation.reversed);
  EXPECT_EQ(diff.uvs, UvRelation::flipped_v);
  EXPECT_EQ(diff.matched, a.strands());
  EXPECT_LT(diff.max_distance, kRounding);
  EXPECT_NEAR(diff.width_ratio, 1, 1e-6) << "widths went along";
  EXPECT_EQ(diff.differing, 0u);
  // From the other side.
  const StrandDiff back = compare(b, a);
  ASSERT_TRUE(back.related);
  EXPECT_EQ(back.relation.scale, 100.0);
  EXPECT_EQ(back.relation.axes.from, (std::array<int, 3>{0, 2, 1}));
  EXPECT_EQ(back.relation.axes.sign, (std::array<float, 3>{1, -1, 1}));
}

TEST(StrandDiff, UnitsAreFound) {
  const EditableStrands a = hair();
  for (const double factor : {0.01, 1000.0, 1 / 0.0254, 0.3048, 1.7}) {
    EditableStrands b = a;
    scaleStrands(b, factor);
    const StrandDiff diff = compare(a, b);
    ASSERT_TRUE(diff.related) << factor;
    EXPECT_NEAR(diff.relation.scale * factor, 1, 1e-6) << factor;
    EXPECT_LT(diff.max_distance, 1e-6) << "a factor off by 1e-6 in addition, over 0.5";
  }
}

TEST(StrandDiff, EveryTurnAndMirror) {
  const EditableStrands a = hair(3, 200);
  for (const char* axes : {"y,z,x", "z,x,y", "-x,-y,z", "z,y,-x", "-x,y,z", "y,x,z", "-z,-y,-x"}) {
    EditableStrands b = a;
    const AxisMap map = parseAxes(axes);
    mapAxes(b, map);
    const StrandDiff diff = compare(a, b);
    ASSERT_TRUE(diff.related) << axes;
    EXPECT_EQ(diff.max_distance, 0.0) << axes;
    EXPECT_EQ(diff.relation.axes.mirrors(), map.mirrors()) << axes;
  }
}

TEST(StrandDiff, FewStrandsRemovedMovedAndTurnedAround) {
  const EditableStrands a = hair();
  const std::vector<uint32_t> gone = {0, 17, 350, 699};
  EditableStrands b = chosen(a, numbers(a.strands(), gone));
  recentreStrands(b);
  scaleStrands(b, 100);
  reverseStrands(b);
  const StrandDiff diff = compare(a, b);
  ASSERT_TRUE(diff.related);
  EXPECT_EQ(diff.relation.scale, 0.01);
  EXPECT_TRUE(diff.relation.reversed);
  EXPECT_EQ(diff.only_a, gone);
  EXPECT_TRUE(diff.only_b.empty());
  EXPECT_FALSE(diff.reordered);
  EXPECT_LT(diff.max_distance, 2e-7) << "another rounding, of the shift";
  EXPECT_EQ(compare(b, a).only_b, gone);
}

// Half of the strands in an odd unit, moved: neither bounds, means nor medians are those of the whole any more.
TEST(StrandDiff, RefinesWhatTheSetsDoNotTell) {
  const EditableStrands a = hair();
  std::vector<uint32_t> half;
  for (uint32_t i = 0; i < a.strands(); ++i)
    if (a.positions[3 * size_t(a.first_vertex[i])] > -0.06f) half.push_back(i);
  ASSERT_LT(half.size(), a.strands());
  EditableStrands b = chosen(a, half);
  scaleStrands(b, 1.01);
  recentreStrands(b);
  const StrandDiff diff = compare(a, b);
  ASSERT_TRUE(diff.related);
  EXPECT_NEAR(diff.relation.scale * 1.01, 1, 1e-5);
  EXPECT_LT(diff.rms_distance, 1e-5);
  EXPECT_EQ(diff.matched, half.size());
}

TEST(StrandDiff, ReorderedAndResampled) {
  const EditableStrands a = hair();
  std::vector<uint32_t> order = numbers(a.strands());
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  EditableStrands b = chosen(a, order);
  const StrandDiff shuffled = compare(a, b);
  ASSERT_TRUE(shuffled.related);
  EXPECT_TRUE(shuffled.reordered);
  EXPECT_EQ(shuffled.max_distance, 0.0);
  EXPECT_EQ(shuffled.uvs, UvRelation::same);
  resampleStrands(b, 50);
  const StrandDiff resampled = compare(a, b);
  ASSERT_TRUE(resampled.related);
  EXPECT_EQ(resampled.resampled, a.strands());
  EXPECT_EQ(resampled.compared_vertices, 0u);
  EXPECT_LT(resampled.mean_distance, 1e-4) << "corners of 4 steps a segment are cut";
  EXPECT_GT(resampled.max_distance, 0.0);
}

TEST(StrandDiff, SaysWhatDiffers) {
  const EditableStrands a = hair();
  EditableStrands b = a;
  b.positions[3 * size_t(b.first_vertex[5]) + 3 * 7 + 1] += 0.002f;
  b.positions[3 * size_t(b.first_vertex[90]) + 3 * 11] += 0.004f;
  b.radii[30] += 0.0005f;
  b.root_uvs[8] += 0.25f;
  const StrandDiff diff = compare(a, b);
  ASSERT_TRUE(diff.related);
  EXPECT_TRUE(diff.relation.isNone());
  EXPECT_EQ(diff.differing, 2u);
  ASSERT_EQ(diff.first.size(), 2u);
  EXPECT_EQ(diff.first[0].a, 5u);
  EXPECT_EQ(diff.worst[0].a, 90u);
  EXPECT_NEAR(diff.max_distance, 0.004, 1e-7);
  EXPECT_NEAR(diff.max_width_difference, 0.001, 1e-7);
  EXPECT_EQ(diff.uvs, UvRelation::different);
  EXPECT_NEAR(diff.max_uv_difference, 0.25, 1e-6);
  StrandDiffOptions coarse;
  coarse.tolerance = 0.003;
  EXPECT_EQ(compare(a, b, coarse).differing, 1u);
  // Widths that a change of unit forgot.
  EditableStrands c = a;
  scaleStrands(c, 100);
  for (float& radius : c.radii) radius *= 0.01f;
  EXPECT_NEAR(compare(a, c).width_ratio, 100, 1e-3);
}

TEST(StrandDiff, OtherGroomsAreUnrelated) {
  EXPECT_FALSE(compare(hair(1), hair(2)).related) << "another seed: another head of the same style";
  EditableStrands b = hair(1);
  std::mt19937 random(9);
  std::uniform_real_distribution<float> noise(-0.1f, 0.1f);
  for (float& value : b.positions) value += noise(random);
  EXPECT_FALSE(compare(hair(1), b).related);
  EditableStrands one;
  one.first_vertex = {0, 2};
  one.positions = {0, 0, 0, 0, 1, 0};
  EXPECT_TRUE(compare(one, one).related) << "a single straight strand is itself";
}

}  // namespace forelock::samples
