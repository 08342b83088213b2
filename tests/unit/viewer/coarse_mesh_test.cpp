// Meshes of fewer triangles, for while the view moves.
#include "coarse_mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace forelock::samples;

namespace {

constexpr double kPi = 3.14159265358979323846;

// A sphere of radius 1, with `around` vertices a circle.
OpaqueMesh sphere(uint32_t around) {
  OpaqueMesh mesh;
  const uint32_t rows = around / 2 + 1;
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t i = 0; i < around; ++i) {
      const double polar = kPi * row / (rows - 1), turn = 2.0 * kPi * i / around;
      const glm::vec3 p(std::sin(polar) * std::cos(turn), std::cos(polar), std::sin(polar) * std::sin(turn));
      mesh.positions.insert(mesh.positions.end(), {p.x, p.y, p.z});
      mesh.normals.insert(mesh.normals.end(), {p.x, p.y, p.z});
      mesh.openness.push_back(0.5f + 0.5f * p.y);
      if (row + 1 < rows) {
        const uint32_t a = row * around + i, b = row * around + (i + 1) % around;
        mesh.indices.insert(mesh.indices.end(), {a, b, a + around, b, b + around, a + around});
      }
    }
  }
  mesh.albedo = glm::vec3(0.1f, 0.2f, 0.3f);
  mesh.label = "sphere";
  return mesh;
}

}  // namespace

TEST(CoarseMesh, KeepsASmallMesh) {
  const OpaqueMesh whole = sphere(100), coarse = coarseMesh(whole);
  ASSERT_LE(whole.indices.size() / 3, kCoarseTriangles);
  EXPECT_EQ(coarse.indices, whole.indices);
  EXPECT_EQ(coarse.positions, whole.positions);
}

TEST(CoarseMesh, StaysOnTheSurfaceWithFewerTriangles) {
  const OpaqueMesh whole = sphere(800), coarse = coarseMesh(whole, 40);
  EXPECT_LT(coarse.indices.size(), whole.indices.size() / 10);
  EXPECT_EQ(coarse.normals.size(), coarse.positions.size());
  EXPECT_EQ(coarse.openness.size(), coarse.vertices());
  EXPECT_EQ(coarse.albedo, whole.albedo);
  EXPECT_EQ(coarse.label, whole.label);
  // Means of points of a sphere within a cell of 2/40: inside it by at most the sagitta of the cell's diagonal, (2/40)^2 3 / 8.
  const float sagitta = 0.05f * 0.05f * 3.0f / 8.0f;
  for (size_t v = 0; v < coarse.vertices(); ++v) {
    const glm::vec3 p(coarse.positions[3 * v], coarse.positions[3 * v + 1], coarse.positions[3 * v + 2]);
    const glm::vec3 n(coarse.normals[3 * v], coarse.normals[3 * v + 1], coarse.normals[3 * v + 2]);
    EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
    EXPECT_LE(glm::length(p), 1.0f + 1e-5f);
    EXPECT_GE(glm::length(p), 1.0f - sagitta);
    EXPECT_GT(glm::dot(glm::normalize(p), n), 0.999f);
  }
  for (size_t t = 0; t < coarse.indices.size(); t += 3) {
    ASSERT_LT(*std::max_element(&coarse.indices[t], &coarse.indices[t] + 3), coarse.vertices());
    EXPECT_NE(coarse.indices[t], coarse.indices[t + 1]);
    EXPECT_NE(coarse.indices[t + 1], coarse.indices[t + 2]);
    EXPECT_NE(coarse.indices[t + 2], coarse.indices[t]);
  }
}

TEST(CoarseMesh, OfNothingOrAPointIsTheMesh) {
  EXPECT_TRUE(coarseMesh(OpaqueMesh()).indices.empty());
  OpaqueMesh point = sphere(300);
  std::fill(point.positions.begin(), point.positions.end(), 7.0f);
  EXPECT_EQ(coarseMesh(point).indices, point.indices);  // rather than nothing at all
}
