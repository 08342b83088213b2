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

// The surface of bust_shape.h, closed: vertices lie on it to a tenth of a millimetre, normals are its own, openness is how
// far the surface falls away around. The same bits whatever the number of threads.
OpaqueMesh bustMesh();

// What one mesh file may hold.
struct MeshLimits {
  uint32_t vertices = 1u << 24, triangles = 1u << 25;
};

// The triangles (TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN) of all meshes of the default scene of a glTF or GLB file, placed by their nodes.
// Where a primitive has no normals they are made, smooth over the vertices that triangles share. The albedo is the first material's base
// colour factor, if it says one. Throws AssetError; what it allocates is proven against the file's bytes, or within the limits.
OpaqueMesh readMesh(const std::string& path, const ProgressFunction& progress = {}, const MeshLimits& limits = {});

}  // namespace forelock::samples
