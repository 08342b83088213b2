// Opaque triangles beside hair: the bust, and meshes of glTF files. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

struct OpaqueMesh {
  std::vector<float> positions;   // 3 a vertex (m)
  std::vector<float> normals;     // 3 a vertex, unit
  std::vector<float> openness;    // 1 a vertex [0, 1]: share of the sky that it sees; empty: 1
  std::vector<uint32_t> indices;  // triangles, counterclockwise from outside
  glm::vec3 albedo{0.46f, 0.36f, 0.31f};  // linear
  std::string label;

  size_t vertices() const { return positions.size() / 3; }
};

// The surface of bust_shape.h, closed: vertices lie on it to a hundredth of a millimetre, normals are its own. The same
// bits whatever the number of threads.
OpaqueMesh bustMesh();

// What one mesh file may hold.
struct MeshLimits {
  uint32_t vertices = 1u << 26, triangles = 1u << 26;
};

// The triangles (TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN) of all meshes of the default scene of a glTF or GLB file, placed by their nodes.
// Normals are made where a primitive has none; the first material's base colour is the albedo. Throws AssetError.
OpaqueMesh readMesh(const std::string& path, const ProgressFunction& progress = {}, const MeshLimits& limits = {});

}  // namespace forelock::samples
