// Small rigs: what unit tests damage and fuzz targets start from.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace asset_test {

// Three bones, "root", "neck" and "ns:jaw": the count of strands is byte 45, the first of three records byte 49.
inline std::vector<unsigned char> smallTfxbone() {
  std::vector<unsigned char> bytes;
  const auto u32 = [&](uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
  };
  const auto f32 = [&](float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, 4);
    u32(bits);
  };
  u32(3);
  uint32_t number = 0;
  for (const char* name : {"root", "neck", "ns:jaw"}) {
    u32(number++);
    u32(static_cast<uint32_t>(std::strlen(name) + 1));
    bytes.insert(bytes.end(), name, name + std::strlen(name) + 1);
  }
  const float weights[3][4] = {{1, 0, 0, 0}, {0.5f, 0.25f, 0.25f, 0}, {0.75f, 0.25f, 0, 0}};
  const uint32_t bones[3][4] = {{0, 0, 0, 0}, {1, 2, 0, 0}, {2, 1, 0, 0}};
  u32(3);
  for (uint32_t strand = 0; strand < 3; ++strand) {
    u32(strand);
    for (int i = 0; i < 4; ++i) u32(bones[strand][i]), f32(weights[strand][i]);
  }
  return bytes;
}

// Two bones, four vertices, two triangles.
inline std::string smallTfxmesh() {
  return "# a square\nnumOfBones 2\n# number, name\n0 root\n1 upper arm\n\nnumOfVertices 4\n"
         "0 0 0 0 0 0 1 0 0 0 0 1 0 0 0\n1 1 0 0 0 0 1 0 1 0 0 0.5 0.5 0 0\n2 1 1 0 0 0 1 1 0 0 0 1.0 0.0 0.0 0.0\n"
         "3 0 1e0 0 0 0 1 1 -1 -1 -1 1 0 0 0\nnumOfTriangles 2\n0 0 1 2\n1 0 2 3\n";
}

}  // namespace asset_test
