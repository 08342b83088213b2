// Where the scene of a glTF file puts its meshes. SPDX-License-Identifier: MIT
#pragma once

#include "tinygltf_import.h"

#include <array>
#include <string>
#include <vector>

namespace forelock::samples {

struct GltfPlacement {
  int mesh = 0;
  std::string name;                    // of the node, or of the mesh
  std::array<double, 12> world{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // three rows of four
  bool moves = false;                  // world is not the identity
};

// In the order in which the scene names them, children after their node. The scene is the one that the file names, or its
// first; without scenes it is all nodes; without nodes each mesh is placed once. Throws GltfRefusal where a node is reached twice.
std::vector<GltfPlacement> placeGltfMeshes(const tinygltf::Model& model);

}  // namespace forelock::samples
