// SPDX-License-Identifier: MIT
#include "coarse_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <unordered_map>

namespace forelock::samples {

OpaqueMesh coarseMesh(const OpaqueMesh& mesh, uint32_t cells) {
  const size_t vertices = mesh.positions.size() / 3;
  if (mesh.indices.size() / 3 <= kCoarseTriangles || vertices == 0) {
    return mesh;
  }
  const auto vec = [](const std::vector<float>& values, size_t i) { return glm::vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]); };
  glm::vec3 low = vec(mesh.positions, 0), high = low;
  for (size_t v = 1; v < vertices; ++v) {
    low = glm::min(low, vec(mesh.positions, v));
    high = glm::max(high, vec(mesh.positions, v));
  }
  const glm::vec3 size = high - low;
  const float cell = std::max({size.x, size.y, size.z, 1e-30f}) / static_cast<float>(cells);
  OpaqueMesh coarse;
  coarse.albedo = mesh.albedo;
  coarse.label = mesh.label;
  std::unordered_map<uint64_t, uint32_t> of_cell;
  std::vector<uint32_t> vertex_of(vertices);
  std::vector<float> counts;
  for (size_t v = 0; v < vertices; ++v) {
    const glm::vec3 p = vec(mesh.positions, v), at = (p - low) / cell;
    const uint64_t key = (static_cast<uint64_t>(at.z) << 42) | (static_cast<uint64_t>(at.y) << 21) | static_cast<uint64_t>(at.x);
    const uint32_t index = of_cell.emplace(key, static_cast<uint32_t>(counts.size())).first->second;
    if (index == counts.size()) {
      counts.push_back(0.0f);
      coarse.positions.insert(coarse.positions.end(), 3, 0.0f);
      coarse.normals.insert(coarse.normals.end(), 3, 0.0f);
      if (!mesh.openness.empty()) {
        coarse.openness.push_back(0.0f);
      }
    }
    vertex_of[v] = index;
    counts[index] += 1.0f;
    for (size_t i = 0; i < 3; ++i) {
      coarse.positions[3 * size_t{index} + i] += mesh.positions[3 * v + i];
      coarse.normals[3 * size_t{index} + i] += mesh.normals[3 * v + i];
    }
    if (!mesh.openness.empty()) {
      coarse.openness[index] += mesh.openness[v];
    }
  }
  for (size_t v = 0; v < counts.size(); ++v) {
    const glm::vec3 sum = vec(coarse.normals, v);
    const float length = glm::length(sum);
    const glm::vec3 normal = length > 0.0f ? sum / length : glm::vec3(0.0f, 1.0f, 0.0f);
    for (size_t i = 0; i < 3; ++i) {
      coarse.positions[3 * v + i] /= counts[v];
      coarse.normals[3 * v + i] = normal[static_cast<int>(i)];
    }
    if (!coarse.openness.empty()) {
      coarse.openness[v] /= counts[v];
    }
  }
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const uint32_t a = vertex_of[mesh.indices[t]], b = vertex_of[mesh.indices[t + 1]], c = vertex_of[mesh.indices[t + 2]];
    if (a != b && b != c && c != a) {
      coarse.indices.insert(coarse.indices.end(), {a, b, c});
    }
  }
  return coarse.indices.empty() ? mesh : coarse;
}

}  // namespace forelock::samples
