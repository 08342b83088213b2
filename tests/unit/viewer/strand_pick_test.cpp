// Which strand is under a pixel.
#include "strand_pick.h"

#include "asset_source.h"
#include "strand_edit.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

using namespace forelock::samples;

namespace {

constexpr double kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// Strands of two vertices and more, of one radius.
struct Hair {
  EditableStrands held;
  Hair() { held.first_vertex = {0}; }
  void add(const std::vector<glm::vec3>& points, float radius = 1e-5f) {
    for (const glm::vec3& p : points) held.positions.insert(held.positions.end(), {p.x, p.y, p.z});
    held.radii.insert(held.radii.end(), points.size(), radius);
    held.first_vertex.push_back(held.first_vertex.back() + uint32_t(points.size()));
  }
};

// At (0, 0, 2), looking along -z; a metre at the origin is 200 pixels.
Camera camera() {
  Camera camera;
  camera.eye = {0, 0, 2};
  camera.target = {0, 0, 0};
  camera.vertical_fov = 2 * std::atan(0.5);
  camera.near_m = 0.1;
  camera.far_m = 10;
  return camera;
}

StrandView viewOf(const FlkStrands& strands, const Camera& seen, const double* matrix = kIdentity) {
  return {strands, matrix, seen, 600, 400};
}

}  // namespace

TEST(StrandPick, NearestInDepthWithinFourPixels) {
  Hair hair;
  hair.add({{-1, 0, 0}, {1, 0, 0}});
  hair.add({{0, -1, 0.5f}, {0, 1, 0.5f}});
  hair.add({{-1, 0.5f, -1}, {1, 0.5f, -1}});
  const FlkStrands strands = hair.held.view();
  const StrandView view = viewOf(strands, camera());
  auto hit = pickStrand(view, {300, 200});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->strand, 1u);
  EXPECT_NEAR(hit->depth_m, 1.5, 1e-12);
  EXPECT_NEAR(hit->along, 0.5, 1e-9);
  EXPECT_NEAR(hit->distance_px, 0.0, 1e-9);
  hit = pickStrand(view, {400, 203.5});  // 0.5 m to the right at the origin's depth, 3.5 px below
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->strand, 0u);
  EXPECT_EQ(hit->vertex, 0u);
  EXPECT_NEAR(hit->along, 0.75, 1e-9);
  EXPECT_NEAR(hit->distance_px, 3.5, 1e-9);
  EXPECT_NEAR(glm::length(hit->world - glm::dvec3(0.5, 0, 0)), 0.0, 1e-9);
  EXPECT_FALSE(pickStrand(view, {400, 204.5}));
  EXPECT_FALSE(pickStrand(view, {510, 200})) << "10 px beyond the end of strand 0";
  EXPECT_TRUE(pickStrand(view, {503, 200}));
}

TEST(StrandPick, WideStrandsAreHitWhereTheyCover) {
  Hair hair;
  hair.add({{-1, 0, 0}, {1, 0, 0}}, 0.05f);  // 10 px at 2 m
  const FlkStrands strands = hair.held.view();
  StrandView view = viewOf(strands, camera());
  EXPECT_TRUE(pickStrand(view, {300, 209.9}));
  EXPECT_FALSE(pickStrand(view, {300, 210.1}));
  view.width_scale = 2.0;
  EXPECT_TRUE(pickStrand(view, {300, 219.9}));
  EXPECT_FALSE(pickStrand(view, {300, 220.1}));
}

TEST(StrandPick, ClipsAtTheNearPlane) {
  Hair hair;
  hair.add({{0.0f, 0.01f, 5}, {0.0f, 0.01f, -5}});  // from behind the eye, along the view
  hair.add({{0.5f, 0, 1.95f}, {-0.5f, 0, 1.95f}});  // between the eye and the near plane
  hair.add({{0, 0.4f, 3}, {0, 0.5f, 2.5f}});        // behind
  const FlkStrands strands = hair.held.view();
  const auto hit = pickStrand(viewOf(strands, camera()), {300, 198});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->strand, 0u);
  EXPECT_NEAR(hit->depth_m, 2.0, 1e-6) << "0.01 m is 2 px at 2 m";
  EXPECT_NEAR(hit->along, 0.5, 1e-6);
  EXPECT_FALSE(pickStrand(viewOf(strands, camera()), {400, 200}));
  const auto close = pickStrand(viewOf(strands, camera()), {300, 160});  // 0.01 m is 40 px at the near plane
  ASSERT_TRUE(close);
  EXPECT_NEAR(close->depth_m, 0.1, 1e-9);
}

TEST(StrandPick, OpaqueThingsHide) {
  Hair hair;
  hair.add({{-1, 0, 0}, {1, 0, 0}});
  const FlkStrands strands = hair.held.view();
  const StrandView view = viewOf(strands, camera());
  const auto wall = [](double depth) { return [depth](const glm::dvec2& p) { return p.x < 350 ? depth : 1e30; }; };
  EXPECT_FALSE(pickStrand(view, {300, 200}, wall(1.5)));
  EXPECT_TRUE(pickStrand(view, {300, 200}, wall(2.5)));
  EXPECT_TRUE(pickStrand(view, {400, 200}, wall(1.5)));
}

// Against dense points along every segment, which know nothing of clipping or perspective. Points are 1e-4 of a segment apart, so
// that depths differ by some 1e-3.
TEST(StrandPick, AgreesWithPointsAlongTheStrands) {
  std::mt19937 dice(11);
  const auto real = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  int hits = 0;
  for (int round = 0; round < 300; ++round) {
    Hair hair;
    for (int i = 0; i < 8; ++i) {
      std::vector<glm::vec3> points;
      for (int v = 0; v < 3; ++v) points.emplace_back(real(-1, 1), real(-1, 1), real(-2, 3));
      hair.add(points, i % 2 ? 0.02f : 1e-5f);
    }
    const double c = std::cos(0.3 * round), s = std::sin(0.3 * round);
    const double matrix[16] = {0.7 * c, 0, -0.7 * s, 0, 0, 0.7, 0, 0, 0.7 * s, 0, 0.7 * c, 0, 0.1, -0.05, 0.02, 1};
    Camera seen = camera();
    if (round % 3 == 0) seen.orthographic = true, seen.view_height = 2.0;
    const FlkStrands strands = hair.held.view();
    const StrandView view = viewOf(strands, seen, matrix);
    const glm::dvec2 pixel(real(200, 400), real(100, 300));
    const auto hit = pickStrand(view, pixel);
    // Of each segment the point nearest to the pixel, as the definition has it.
    double best = 1e30;
    uint32_t strand = 0;
    for (uint32_t i = 0; i < strands.strand_count; ++i) {
      for (uint32_t v = strands.first_vertex[i]; v + 1 < strands.first_vertex[i + 1]; ++v) {
        double nearest = 1e30, depth_there = 0, reach = 0;
        for (int n = 0; n <= 10000; ++n) {
          double h[3], w[3];
          for (int a = 0; a < 3; ++a) {
            const double from = double(strands.positions[3 * v + a]);
            h[a] = from + (double(strands.positions[3 * v + 3 + a]) - from) * n * 1e-4;
          }
          for (int a = 0; a < 3; ++a) w[a] = matrix[a] * h[0] + matrix[4 + a] * h[1] + matrix[8 + a] * h[2] + matrix[12 + a];
          const double depth = 2 - w[2];
          if (depth < seen.near_m) continue;
          const double focal = seen.orthographic ? 200 : 400 / depth;
          const double distance = std::hypot(300 + focal * w[0] - pixel.x, 200 - focal * w[1] - pixel.y);
          if (distance < nearest) nearest = distance, depth_there = depth, reach = std::max(4.0, 0.7 * double(strands.radii[v]) * focal);
        }
        if (nearest <= reach && depth_there < best) best = depth_there, strand = i;
      }
    }
    ASSERT_EQ(hit.has_value(), best < 1e30) << round;
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(hit->strand, strand) << round;
    EXPECT_NEAR(hit->depth_m, best, 2e-3) << round;
    EXPECT_NEAR(2 - hit->world.z, hit->depth_m, 1e-9);
  }
  EXPECT_GT(hits, 20);
}

TEST(StrandPick, AMillionSegmentsAreSharedOutWithTheSameResult) {
  Hair hair;
  std::mt19937 dice(2);
  std::uniform_real_distribution<float> real(-1, 1);
  for (int i = 0; i < 55'000; ++i) {
    std::vector<glm::vec3> points;
    for (int v = 0; v < 21; ++v) points.emplace_back(real(dice), real(dice), real(dice));
    hair.add(points);
  }
  const FlkStrands all = hair.held.view();
  const StrandView view = viewOf(all, camera());
  for (const glm::dvec2 pixel : {glm::dvec2(300, 200), glm::dvec2(250.5, 111), glm::dvec2(390, 222)}) {
    const auto hit = pickStrand(view, pixel);
    ASSERT_TRUE(hit);
    FlkStrands half = all;  // below a million, by one thread
    half.strand_count = 27'500;
    half.vertex_count = 27'500 * 21;
    auto expected = pickStrand(viewOf(half, camera()), pixel);
    half.first_vertex = all.first_vertex + 27'500;
    half.vertex_count = 27'500 * 21;
    const auto second = pickStrand(viewOf(half, camera()), pixel);
    ASSERT_TRUE(expected && second);
    const bool later = second->depth_m < expected->depth_m;
    EXPECT_EQ(hit->strand, later ? second->strand + 27'500 : expected->strand);
    EXPECT_EQ(hit->depth_m, later ? second->depth_m : expected->depth_m);
  }
}

TEST(StrandPick, IsQuickOnFur) {
  const char* named = std::getenv("FORELOCK_HAIRDATA");
  const std::filesystem::path path = std::filesystem::path(named ? named : FORELOCK_HAIRDATA) / "fur.hair";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "NOT TESTED: no " << path;
  const OpenedAsset opened = openAsset(path.string());
  FlkAssetInfo info{};
  flkAssetGetInfo(opened.asset.get(), &info);
  FlkStrands strands{};
  flkAssetGetStrands(opened.asset.get(), &strands);
  const StrandView view = viewOf(strands, frameBounds(info.min_bounds, info.max_bounds, 0.5, 0.2, UpAxis::Y, 0.5, 1.5, 1.0));
  double least = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(pickStrand(view, {300, 200}));
    least = std::min(least, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::printf("%u strands, %u vertices: %.2f ms\n", strands.strand_count, strands.vertex_count, least);
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__)
  EXPECT_LT(least, 30.0);
#endif
}

TEST(StrandProject, LinesAreInPixels) {
  Hair hair;
  hair.add({{-1, 0, 0}, {0, 0.5f, 0}, {1, 0, 1}});
  const FlkStrands strands = hair.held.view();
  const auto lines = projectStrand(viewOf(strands, camera()), 0);
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].size(), 3u);
  EXPECT_NEAR(glm::length(lines[0][0] - glm::vec2(100, 200)), 0, 1e-3);
  EXPECT_NEAR(glm::length(lines[0][1] - glm::vec2(300, 100)), 0, 1e-3);
  EXPECT_NEAR(glm::length(lines[0][2] - glm::vec2(700, 200)), 0, 1e-3);
}

TEST(StrandProject, IsCutAtTheNearPlane) {
  Hair hair;
  hair.add({{0, 0, 0}, {0.1f, 0, 4}, {0.2f, 0, 5}, {0.1f, 0.1f, 0}, {0, 0.1f, 0}});  // in front, behind, behind, in front twice
  hair.add({{0, 0, 3}, {0, 1, 3}});
  const FlkStrands strands = hair.held.view();
  const auto lines = projectStrand(viewOf(strands, camera()), 0);
  ASSERT_EQ(lines.size(), 2u);
  ASSERT_EQ(lines[0].size(), 2u);
  EXPECT_EQ(lines[1].size(), 3u);
  // At z = 1.9 the first segment is at x = 0.0475, 4000 px a metre.
  EXPECT_NEAR(lines[0][1].x, 300 + 0.0475 * 4000, 1e-2);
  EXPECT_TRUE(projectStrand(viewOf(strands, camera()), 1).empty());
}
