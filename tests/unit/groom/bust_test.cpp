// The bust's surface as triangles. SPDX-License-Identifier: MIT
#include "bust.h"
#include "bust_shape.h"
#include "opaque_mesh.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace forelock::samples {
namespace {

const OpaqueMesh& bust() {
  static const OpaqueMesh mesh = bustMesh();
  return mesh;
}

glm::dvec3 at(const std::vector<float>& values, uint32_t vertex) {
  const float* v = &values[size_t{3} * vertex];
  return {v[0], v[1], v[2]};
}

TEST(Bust, IsClosedAndOrientedOneWay) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  const auto& indices = bust().indices;
  ASSERT_GT(indices.size(), 0u);
  for (size_t i = 0; i < indices.size(); i += 3) {
    for (size_t corner = 0; corner < 3; ++corner) {
      ASSERT_LT(indices[i + corner], bust().vertices());
      ++edges[{indices[i + corner], indices[i + (corner + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << edge.first << " " << edge.second;
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << "an edge with a triangle on one side only";
  }
}

// A cell's longest diagonal is sqrt(3.9^2 + 4.1^2 + 3.3^2) = 6.6 mm; over it a circle of 12 mm, about the least of radii outside of the face
// (ears), where cells are that large, falls 0.45 mm from its chord. In the face diagonals are 2.4 mm and radii 1.5 mm or more: 0.48 mm.
constexpr double kChord = 0.5e-3;

TEST(Bust, LiesOnTheField) {
  double sum = 0.0;
  for (uint32_t v = 0; v < bust().vertices(); ++v) {
    const glm::dvec3 p = at(bust().positions, v), n = at(bust().normals, v);
    const double off = std::fabs(shape::bust<double>(p));
    EXPECT_LT(off, 0.1e-3) << p.x << " " << p.y << " " << p.z;
    sum += off;
    EXPECT_NEAR(glm::length(n), 1.0, 1e-5);
    EXPECT_GE(bust().openness[v], 0.0f);
    EXPECT_LE(bust().openness[v], 1.0f);
  }
  EXPECT_LT(sum / static_cast<double>(bust().vertices()), 1e-6) << "a few vertices in creases apart they are on it";
  const auto& indices = bust().indices;
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = at(bust().positions, indices[i]), b = at(bust().positions, indices[i + 1]), c = at(bust().positions, indices[i + 2]);
    EXPECT_LT(std::fabs(shape::bust<double>((a + b + c) / 3.0)), kChord);
    const glm::dvec3 normals = at(bust().normals, indices[i]) + at(bust().normals, indices[i + 1]) + at(bust().normals, indices[i + 2]);
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), normals), 0.0) << "counterclockwise from outside";
  }
}

TEST(Bust, FillsItsBox) {
  float low[3], high[3];
  bustBounds(low, high);
  for (uint32_t v = 0; v < bust().vertices(); ++v) {
    const glm::dvec3 p = at(bust().positions, v);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(p[axis], static_cast<double>(low[axis]) - 0.012) << "the box is for framing: to about a centimetre";
      EXPECT_LE(p[axis], static_cast<double>(high[axis]) + 0.012);
    }
  }
}

TEST(Bust, IsTheSameEachTime) {
  const OpaqueMesh again = bustMesh();
  EXPECT_EQ(again.positions, bust().positions);
  EXPECT_EQ(again.normals, bust().normals);
  EXPECT_EQ(again.openness, bust().openness);
  EXPECT_EQ(again.indices, bust().indices);
}

}  // namespace
}  // namespace forelock::samples
