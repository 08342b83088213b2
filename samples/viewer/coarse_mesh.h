// Meshes of fewer triangles, for while the view moves on a slow device. SPDX-License-Identifier: MIT
#pragma once

#include "opaque_mesh.h"

namespace forelock::samples {

inline constexpr size_t kCoarseTriangles = 20'000;  // a mesh that has no more stays as it is

// Vertices in the same cell of a grid of `cells` along the longest side become their mean; triangles that become none go. Positions,
// normals and openness stay a vertex's.
OpaqueMesh coarseMesh(const OpaqueMesh& mesh, uint32_t cells = 100);

}  // namespace forelock::samples
