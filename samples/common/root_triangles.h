// Which roots are neighbours on a scalp that is known by its roots alone. SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace forelock::samples {

struct RootTriangle {
  std::array<uint32_t, 3> roots;  // rising
  double area = 0;
};

// Triangles of neighbouring roots (3 floats each): about every root, its Delaunay neighbours in the plane that fits its surroundings.
// Triangles with an edge longer than `widest_gap` times the median distance of neighbours are left out.
std::vector<RootTriangle> rootTriangles(const std::vector<float>& roots, double widest_gap);

}  // namespace forelock::samples
