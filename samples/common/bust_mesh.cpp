// The bust's field as triangles: surface nets in a narrow band (Gibson, Constrained Elastic Surface Nets, 1998), each vertex moved onto the
// surface. SPDX-License-Identifier: MIT
#include "bust_shape.h"
#include "opaque_mesh.h"
#include "parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace forelock::samples {
namespace {

constexpr int kBlock = 4;  // cells a side that are looked at together
constexpr float kUnknown = 1e30f;

// Cells along an axis: finer where eyes, nose and lips are, whose ends have radii of about a millimetre.
struct Stretch {
  float from;  // (m)
  int cells;   // a multiple of kBlock
};
constexpr Stretch kAlongX[] = {{0.0f, 24}, {0.030f, 60}, {0.260f, 0}};  // the half with x >= 0; the other half is its mirror
constexpr Stretch kAlongY[] = {{-0.442f, 88}, {-0.088f, 72}, {0.020f, 32}, {0.118f, 0}};
constexpr Stretch kAlongZ[] = {{-0.152f, 64}, {0.056f, 40}, {0.116f, 4}, {0.128f, 0}};

template <size_t N>
constexpr int cellsOf(const Stretch (&along)[N]) {
  int cells = 0;
  for (const Stretch& stretch : along) {
    cells += stretch.cells;
  }
  return cells;
}
constexpr int kX = cellsOf(kAlongX), kY = cellsOf(kAlongY), kZ = cellsOf(kAlongZ);

struct Grid {
  std::array<float, kX + 1> x;
  std::array<float, kY + 1> y;
  std::array<float, kZ + 1> z;
};

template <size_t N, size_t M>
constexpr void place(const Stretch (&along)[N], std::array<float, M>& points) {
  size_t at = 0;
  for (size_t i = 0; i + 1 < N; ++i) {
    for (int cell = 0; cell < along[i].cells; ++cell) {
      points[at++] = along[i].from + (along[i + 1].from - along[i].from) * static_cast<float>(cell) / static_cast<float>(along[i].cells);
    }
  }
  points[at] = along[N - 1].from;
}

constexpr Grid kGrid = [] {
  Grid grid{};
  place(kAlongX, grid.x);
  place(kAlongY, grid.y);
  place(kAlongZ, grid.z);
  return grid;
}();

size_t pointAt(int x, int y, int z) { return (static_cast<size_t>(z) * (kY + 1) + static_cast<size_t>(y)) * (kX + 1) + static_cast<size_t>(x); }
size_t cellAt(int x, int y, int z) { return (static_cast<size_t>(z) * kY + static_cast<size_t>(y)) * kX + static_cast<size_t>(x); }
glm::vec3 placeOf(int x, int y, int z) {
  return {kGrid.x[static_cast<size_t>(x)], kGrid.y[static_cast<size_t>(y)], kGrid.z[static_cast<size_t>(z)]};
}

struct Vertex {
  glm::vec3 position, normal;
  float openness;
};

struct Slab {  // kBlock cells thick in z
  std::vector<float> values;  // of its points: kBlock + 1 planes
  std::vector<Vertex> vertices;
  std::vector<uint32_t> cells;  // where they are
};

// The field at all corners of cells that may hold the surface; kUnknown elsewhere.
void sampleField(int slab, std::vector<float>& values) {
  values.assign(size_t{kX + 1} * (kY + 1) * (kBlock + 1), kUnknown);
  const int z0 = slab * kBlock;
  const auto sample = [&](int x0, int y0, int z_low, int size) {
    for (int z = z_low; z <= z_low + size; ++z) {
      for (int y = y0; y <= y0 + size; ++y) {
        for (int x = x0; x <= x0 + size; ++x) {
          float& value = values[pointAt(x, y, z - z0)];
          value = value == kUnknown ? shape::bust<float>(placeOf(x, y, z)) : value;
        }
      }
    }
  };
  // The field may overestimate where ellipsoids are slender: 0.7 of it is trusted.
  const auto mayHold = [](int x, int y, int z, int size) {
    const glm::vec3 low = placeOf(x, y, z), high = placeOf(x + size, y + size, z + size);
    return 0.7f * std::fabs(shape::bust<float>(0.5f * (low + high))) <= 0.5f * glm::length(high - low);
  };
  for (int y = 0; y < kY; y += kBlock) {
    for (int x = 0; x < kX; x += kBlock) {
      if (!mayHold(x, y, z0, kBlock)) {
        continue;
      }
      for (int part = 0; part < 8; ++part) {
        const int half = kBlock / 2;
        const int px = x + half * (part & 1), py = y + half * (part >> 1 & 1), pz = z0 + half * (part >> 2);
        if (mayHold(px, py, pz, half)) {
          sample(px, py, pz, half);
        }
      }
    }
  }
}

// From near the surface onto it, along the gradient. Its length is 1 to some percent, so that each step leaves as much of the distance.
Vertex settle(glm::vec3 p) {
  Vertex vertex;
  glm::vec3 normal = shape::bustNormal<float>(p);
  for (int step = 0; step < 3; ++step) {
    const float d = shape::bust<float>(p);
    p -= normal * d;
    if (std::fabs(d) < 2e-6f) {
      break;
    }
  }
  normal = shape::bustNormal<float>(p);
  // Two samples of the field along the normal darken eye sockets and the neck under the chin.
  const float near_gap = shape::bust<float>(p + normal * 0.012f) / 0.012f;
  const float far_gap = shape::bust<float>(p + normal * 0.045f) / 0.045f;
  vertex.position = p;
  vertex.normal = normal;
  vertex.openness = std::clamp(0.35f + 0.30f * near_gap + 0.35f * far_gap, 0.0f, 1.0f);
  return vertex;
}

void findVertices(int index, Slab& slab) {
  const auto value = [&](int x, int y, int z) { return slab.values[pointAt(x, y, z)]; };
  for (int z = 0; z < kBlock; ++z) {
    for (int y = 0; y < kY; ++y) {
      for (int x = 0; x < kX; ++x) {
        float corner[8];
        int inside = 0;
        bool known = true;
        for (int i = 0; i < 8 && known; ++i) {
          corner[i] = value(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
          inside += corner[i] < 0.0f ? 1 : 0;
          known = corner[i] != kUnknown;
        }
        if (!known || inside == 0 || inside == 8) {
          continue;
        }
        glm::vec3 sum(0.0f);
        float crossings = 0.0f;
        for (int i = 0; i < 8; ++i) {
          for (int axis = 0; axis < 3; ++axis) {
            const int j = i | 1 << axis;
            if (j == i || (corner[i] < 0.0f) == (corner[j] < 0.0f)) {
              continue;
            }
            glm::vec3 at(i & 1, i >> 1 & 1, i >> 2);
            at[axis] = corner[i] / (corner[i] - corner[j]);
            sum += at;
            crossings += 1.0f;
          }
        }
        const int z_all = index * kBlock + z;
        slab.cells.push_back(static_cast<uint32_t>(cellAt(x, y, z_all)));
        const glm::vec3 low = placeOf(x, y, z_all), size = placeOf(x + 1, y + 1, z_all + 1) - low;
        slab.vertices.push_back(settle(low + size * (sum / crossings)));
      }
    }
  }
}

}  // namespace

OpaqueMesh bustMesh() {
  constexpr int slab_count = kZ / kBlock;
  std::vector<Slab> slabs(slab_count);
  parallelFor(slab_count, 1, [&](size_t i) {
    sampleField(static_cast<int>(i), slabs[i].values);
    findVertices(static_cast<int>(i), slabs[i]);
  });

  OpaqueMesh mesh;
  mesh.label = "bust";
  constexpr uint32_t none = UINT32_MAX;
  std::vector<uint32_t> vertex_of(size_t{kX} * kY * kZ, none);
  size_t half = 0;
  for (const Slab& slab : slabs) {
    for (size_t i = 0; i < slab.cells.size(); ++i) {
      vertex_of[slab.cells[i]] = static_cast<uint32_t>(half + i);
    }
    half += slab.cells.size();
  }
  mesh.positions.reserve(6 * half);
  mesh.normals.reserve(6 * half);
  mesh.openness.reserve(2 * half);
  for (const float side : {1.0f, -1.0f}) {
    for (const Slab& slab : slabs) {
      for (const Vertex& v : slab.vertices) {
        mesh.positions.insert(mesh.positions.end(), {side * v.position.x, v.position.y, v.position.z});
        mesh.normals.insert(mesh.normals.end(), {side * v.normal.x, v.normal.y, v.normal.z});
        mesh.openness.push_back(v.openness);
      }
    }
  }

  // Each edge of the grid that the surface crosses makes a quad of the four cells around it. Cells with x < 0 are mirrors.
  const auto vertexIn = [&](int x, int y, int z) {
    return x >= 0 ? vertex_of[cellAt(x, y, z)] : vertex_of[cellAt(-1 - x, y, z)] + static_cast<uint32_t>(half);
  };
  const auto squared = [&](uint32_t a, uint32_t b) {
    float sum = 0.0f;
    for (size_t i = 0; i < 3; ++i) {
      const float d = mesh.positions[size_t{3} * a + i] - mesh.positions[size_t{3} * b + i];
      sum += d * d;
    }
    return sum;
  };
  const auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool turned) {  // around the edge
    if (turned) {
      std::swap(b, d);
    }
    const bool across = squared(a, c) <= squared(b, d);  // the shorter diagonal
    for (const uint32_t v : {a, b, across ? c : d, across ? a : b, c, d}) {
      mesh.indices.push_back(v);
    }
  };
  const auto mirrored = [&](uint32_t v) { return v < half ? v + static_cast<uint32_t>(half) : v - static_cast<uint32_t>(half); };
  for (int slab = 0; slab < slab_count; ++slab) {
    const std::vector<float>& values = slabs[static_cast<size_t>(slab)].values;
    for (const uint32_t cell : slabs[static_cast<size_t>(slab)].cells) {
      const int x = static_cast<int>(cell % kX), y = static_cast<int>(cell / kX % kY), z = static_cast<int>(cell / (kX * kY));
      const float here = values[pointAt(x, y, z - slab * kBlock)];
      for (int axis = 0; axis < 3; ++axis) {
        const float there = values[pointAt(x + (axis == 0), y + (axis == 1), z - slab * kBlock + (axis == 2))];
        if ((here < 0.0f) == (there < 0.0f)) {
          continue;
        }
        const uint32_t around[4] = {
            vertexIn(x, y, z),
            axis == 0 ? vertexIn(x, y - 1, z) : axis == 1 ? vertexIn(x, y, z - 1) : vertexIn(x - 1, y, z),
            axis == 0 ? vertexIn(x, y - 1, z - 1) : axis == 1 ? vertexIn(x - 1, y, z - 1) : vertexIn(x - 1, y - 1, z),
            axis == 0 ? vertexIn(x, y, z - 1) : axis == 1 ? vertexIn(x - 1, y, z) : vertexIn(x, y - 1, z)};
        const bool outwards = here < 0.0f;  // the surface faces along the axis
        quad(around[0], around[1], around[2], around[3], !outwards);
        if (axis == 0 || x > 0) {
          quad(mirrored(around[0]), mirrored(around[1]), mirrored(around[2]), mirrored(around[3]), outwards);
        }
      }
    }
  }
  return mesh;
}

}  // namespace forelock::samples
