// Follow strands, strands between guides, levels of detail, widths and colours.
#include "asset_source.h"
#include "root_triangles.h"
#include "strand_coverage.h"
#include "strand_lod.h"
#include "strand_look.h"
#include "strand_multiply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

namespace forelock::samples {
namespace {

// Guides on a square lattice of the plane y = 0, straight up, `points` vertices each.
EditableStrands lattice(uint32_t side, uint32_t points, float height = 1) {
  EditableStrands s;
  s.first_vertex = {0};
  for (uint32_t i = 0; i < side * side; ++i) {
    const float x = float(i % side), z = float(i / side);
    for (uint32_t k = 0; k < points; ++k) s.positions.insert(s.positions.end(), {x, height * float(k) / float(points - 1), z});
    s.root_uvs.insert(s.root_uvs.end(), {x / float(side - 1), z / float(side - 1)});
    s.first_vertex.push_back(s.first_vertex.back() + points);
  }
  return s;
}

EditableStrands groomStrands(const char* name) {
  const OpenedAsset opened = openAsset(std::string("groom:") + name);
  FlkStrands held{};
  flkAssetGetStrands(opened.asset.get(), &held);
  return editableStrands(held, true);
}

}  // namespace

TEST(FollowStrands, KeepTheirOffset) {
  EditableStrands s = lattice(3, 4);
  s.radii.assign(s.vertices(), 0.01f);
  addFollowStrands(s, 5, 0.25, 2, 7);
  ASSERT_EQ(s.strands(), 9u * 6);
  EXPECT_EQ(s.radii.size(), size_t{s.vertices()});
  EXPECT_EQ(s.root_uvs.size(), 2u * s.strands());
  double farthest = 0;
  for (uint32_t strand = 0; strand < s.strands(); ++strand) {
    const uint32_t guide = strand / 6 * 6;
    const float *root = &s.positions[3 * size_t{s.first_vertex[strand]}], *of = &s.positions[3 * size_t{s.first_vertex[guide]}];
    const float *tip = &s.positions[3 * (size_t{s.first_vertex[strand + 1]} - 1)], *tip_of = &s.positions[3 * (size_t{s.first_vertex[guide + 1]} - 1)];
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(tip[axis] - tip_of[axis], 2 * (root[axis] - of[axis]), 1e-6) << strand;
    EXPECT_NEAR(root[1], 0, 1e-7) << "square to the guide";
    farthest = std::max(farthest, double(std::hypot(root[0] - of[0], root[2] - of[2])));
  }
  EXPECT_LE(farthest, 0.25 + 1e-6);
  EXPECT_GT(farthest, 0.2) << "45 of them: the farthest is below 0.2 once in 5e8";
}

TEST(RootTriangles, CoverALattice) {
  // A lattice has no unique triangulation; moved a little at random it has one.
  std::vector<float> roots;
  for (int i = 0; i < 400; ++i)
    roots.insert(roots.end(), {float(i % 20) + 0.2f * float(std::sin(i * 12.9898)), 0.05f * float(std::sin(i * 3.7)), float(i / 20) + 0.2f * float(std::sin(i * 78.233))});
  const std::vector<RootTriangle> triangles = rootTriangles(roots, 4);
  double area = 0;
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (const RootTriangle& t : triangles) {
    area += t.area;
    ++edges[{t.roots[0], t.roots[1]}], ++edges[{t.roots[1], t.roots[2]}], ++edges[{t.roots[0], t.roots[2]}];
  }
  EXPECT_NEAR(area, 19 * 19, 0.05 * 19 * 19) << "the rim's triangles may be missing, the bumps add";
  int crowded = 0;
  for (const auto& [edge, count] : edges) crowded += count > 2;
  EXPECT_LE(crowded, 12) << "nearly a manifold: stars are found one by one, in planes of their own";
}

TEST(RootTriangles, GapsStayOpen) {
  std::vector<float> roots;
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 100; ++i) roots.insert(roots.end(), {float(i % 10) + 60 * float(side), 0, float(i / 10) + 0.1f * float(std::sin(i))});
  for (const RootTriangle& t : rootTriangles(roots, 4)) EXPECT_EQ(t.roots[0] / 100, t.roots[2] / 100);
  EXPECT_TRUE(rootTriangles({0, 0, 0, 1, 0, 0}, 4).empty());
  EXPECT_TRUE(rootTriangles({0, 0, 0, 0, 0, 0, 0, 0, 0}, 4).empty()) << "one place";
  EXPECT_TRUE(rootTriangles({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, 4).empty()) << "one line";
}

TEST(Interpolation, BetweenStraightGuides) {
  EditableStrands s = lattice(10, 6, 2);
  const EditableStrands before = s;
  s.radii.assign(s.vertices(), 0.5f), s.colors.assign(3 * size_t{s.vertices()}, 0.25f), s.inverse_masses.assign(s.vertices(), 1);
  for (uint32_t i = 0; i < s.strands(); ++i) s.inverse_masses[s.first_vertex[i]] = 0;
  const InterpolationReport report = interpolateGuides(s, 2000);
  EXPECT_EQ(s.strands(), 2000u);
  EXPECT_EQ(report.added, 1900u);
  EXPECT_EQ(report.parted, 0u);
  EXPECT_NEAR(report.mean_length, 2, 1e-5);
  EXPECT_TRUE(std::equal(before.positions.begin(), before.positions.end(), s.positions.begin())) << "the guides stay as they are";
  int cells[9][9] = {};
  for (uint32_t i = 100; i < s.strands(); ++i) {
    const float *root = &s.positions[3 * size_t{s.first_vertex[i]}], *tip = &s.positions[3 * (size_t{s.first_vertex[i + 1]} - 1)];
    EXPECT_NEAR(root[1], 0, 1e-6);
    EXPECT_NEAR(tip[1], 2, 1e-5);
    EXPECT_NEAR(tip[0], root[0], 1e-5);
    EXPECT_NEAR(s.root_uvs[2 * size_t{i}], root[0] / 9, 1e-6) << "root UVs follow the root";
    EXPECT_EQ(s.inverse_masses[s.first_vertex[i]], 0.0f);
    EXPECT_EQ(s.inverse_masses[s.first_vertex[i] + 1], 1.0f);
    EXPECT_FLOAT_EQ(s.radii[s.first_vertex[i]], 0.5f);
    EXPECT_FLOAT_EQ(s.colors[3 * size_t{s.first_vertex[i]}], 0.25f);
    if (root[0] > 0 && root[0] < 9 && root[2] > 0 && root[2] < 9) ++cells[int(root[0])][int(root[2])];
  }
  // A lattice's squares are cut along both diagonals or one; each has as much area as its neighbours.
  for (auto& row : cells)
    for (const int count : row) EXPECT_NEAR(count, 1900 / 81.0, 0.35 * 1900 / 81.0);
}

TEST(Interpolation, BentGuidesKeepTheirLength) {
  // Quarter circles of radius 1 that turn in different directions, 50 degrees apart at most.
  EditableStrands s;
  s.first_vertex = {0};
  for (const double turn : {-0.4, 0.0, 0.4}) {
    for (int k = 0; k <= 16; ++k) {
      const double a = k / 16.0 * 1.5707963267948966, out = 1 - std::cos(a), up = std::sin(a);
      s.positions.insert(s.positions.end(), {float(0.1 * turn + out * std::sin(turn)), float(up), float(turn * turn * 0.1 + out * std::cos(turn))});
    }
    s.first_vertex.push_back(s.first_vertex.back() + 17);
  }
  const InterpolationReport report = interpolateGuides(s, 103);
  EXPECT_EQ(report.parted, 0u);
  EXPECT_NEAR(report.mean_length, report.mean_guide_length, 1e-5 * report.mean_guide_length);
}

TEST(Interpolation, PartingAndRefusals) {
  EditableStrands s;
  s.first_vertex = {0, 2, 4, 6};
  s.positions = {0, 0, 0, -1, 0, 0, 1, 0, 0, 2, 0, 0, 0.5f, 0, 1, 0.5f, 0, 2};  // away from each other
  EXPECT_EQ(interpolateGuides(s, 13).parted, 10u);
  for (uint32_t i = 3; i < s.strands(); ++i) EXPECT_NEAR(std::hypot(s.positions[6 * size_t{i} + 3] - s.positions[6 * size_t{i}], s.positions[6 * size_t{i} + 5] - s.positions[6 * size_t{i} + 2]), 1, 1e-5);
  EditableStrands two;
  two.first_vertex = {0, 2, 4};
  two.positions = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  EXPECT_THROW(interpolateGuides(two, 10), std::invalid_argument);
  EXPECT_EQ(interpolateGuides(two, 2).added, 0u);
  EXPECT_THROW(addFollowStrands(s = lattice(70, 64), 1023, 1, 1, 0), std::length_error);
}

// Of every prefix: no eighth of the scalp has more than its share by much. Random order is off by the square root of the number.
TEST(Lod, PrefixesAreEvenAndNested) {
  EditableStrands s = lattice(32, 2);
  const std::vector<uint32_t> order = evenOrder(s);
  EXPECT_EQ(std::set<uint32_t>(order.begin(), order.end()).size(), 1024u) << "each once";
  for (const uint32_t n : {16u, 64u, 100u, 256u, 777u}) {
    int counts[16] = {};
    for (uint32_t i = 0; i < n; ++i) ++counts[order[i] % 32 / 8 + order[i] / 32 / 8 * 4];
    for (const int count : counts) EXPECT_NEAR(count, n / 16.0, 1.01) << n;
  }
  orderStrands(s, order);
  EXPECT_EQ(s.positions[3 * size_t{s.first_vertex[5]}], float(order[5] % 32));
  EXPECT_EQ(s.root_uvs[11], float(order[5] / 32) / 31);
}

TEST(Lod, CoverageIsKept) {
  for (const char* name : {"paper-load"}) {
    EditableStrands all = groomStrands(name);
    orderStrands(all, evenOrder(all));
    EditableStrands eighth = all;
    const LodReport report = keepFirstStrands(eighth, all.strands() / 8, 0.63);
    std::printf("ROW lod %s: %u of %u strands, %.3f times as wide, coverage %.4f of %.4f\n", name, report.kept, all.strands(), report.widening,
                report.coverage_after, report.coverage_before);
    EXPECT_NEAR(report.coverage_after / report.coverage_before, 1, 1e-3);
    // Measured anew with other points.
    EXPECT_NEAR(CoverageMeter(all, 0.63, 256).measure(eighth, 1) / CoverageMeter(all, 0.63, 256).measure(all, 1), 1, 0.01);
    EXPECT_EQ(eighth.strands(), all.strands() / 8);
  }
  EditableStrands bare = lattice(2, 2);
  EXPECT_THROW(keepFirstStrands(bare, 1, 0.63), std::invalid_argument);
}

// A strand as wide as the picture is high, of opacity 1, over a quarter of the plane: known areas.
TEST(Coverage, KnownAreas) {
  EditableStrands s;
  s.first_vertex = {0, 2};
  s.positions = {0, 0, 0, 1, 0, 0};
  s.radii = {0.05f, 0.05f};
  // Half the diagonal of the bounds is 1/2, so each picture is 1 x 1; seen along x the strand is a disc, along y and z 1 x 0.1, from the corners sqrt(2/3) long with round ends.
  const double disc = 3.14159265 * 0.05 * 0.05, corner = 0.1 * std::sqrt(2.0 / 3) + disc;
  EXPECT_NEAR(CoverageMeter(s, 1, 512).measure(s, 1), (disc + 2 * 0.1 + 3 * corner) / 6, 2e-3);
  EXPECT_NEAR(CoverageMeter(s, 0.5, 512).measure(s, 1), 0.5 * (disc + 2 * 0.1 + 3 * corner) / 6, 1e-3);
}

TEST(Look, WidthProfile) {
  EXPECT_NEAR(parseWidthProfile("0:1,0.5:0.5,1:0").at(0.75), 0.25, 1e-12);
  EXPECT_EQ(parseWidthProfile("0.25:2").at(0), 2);
  for (const char* wrong : {"", "1", "0:1,", "0:1;1:0", "0:1,0:2", "0.5:1,0.25:1", "-0.1:1", "0:-1", "2:1", "0:nan", "0:1e9", "a:b"})
    EXPECT_THROW(parseWidthProfile(wrong), std::invalid_argument) << wrong;
  EditableStrands s = lattice(2, 3);
  EXPECT_THROW(applyWidthProfile(s, parseWidthProfile("0:1"), 0), std::invalid_argument);
  applyWidthProfile(s, parseWidthProfile("0:1,1:0"), 0.5);
  EXPECT_FLOAT_EQ(s.radii[0], 0.25f);
  EXPECT_FLOAT_EQ(s.radii[1], 0.125f);
  EXPECT_FLOAT_EQ(s.radii[2], 0);
}

TEST(Look, RootColors) {
  EditableStrands s = lattice(3, 2);
  s.root_uvs[0] = -2;
  Image image(2, 2);
  image.pixel(0, 0)[0] = 1, image.pixel(1, 0)[1] = 1, image.pixel(0, 1)[2] = 1;
  EXPECT_EQ(colorFromImage(s, image).outside, 1u);
  EXPECT_EQ(s.colors[0], 1.0f) << "v = 0 is the top row";
  EXPECT_EQ(s.colors[6 * 2 + 1], 1.0f);
  EXPECT_EQ(s.colors[6 * 6 + 2], 1.0f);
  EXPECT_FLOAT_EQ(s.colors[6 * 4], 0.25f) << "the mean of all four";
  s.root_uvs.clear();
  EXPECT_THROW(colorFromImage(s, image), std::invalid_argument);
}

}  // namespace forelock::samples
