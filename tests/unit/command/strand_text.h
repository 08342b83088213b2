// Strand files by hand, for the tests of the command: PLY as text, which people read.
#pragma once

#include "command_run.h"

#include <array>
#include <string>
#include <vector>

namespace forelock::test {

using Strand = std::vector<std::array<double, 3>>;

// A tuft of 12 strands of 4 vertices of different lengths, 0.1 to 0.2 long.
inline std::vector<Strand> tuft() {
  std::vector<Strand> strands;
  for (int i = 0; i < 12; ++i) {
    Strand strand;
    for (int v = 0; v < 4; ++v)
      strand.push_back({0.02 * i + 0.003 * v * v * (i % 3), 0.03 * v + 0.004 * i * v / 2, 0.01 * (i * 5 % 7) + 0.002 * v * (i % 4)});
    strands.push_back(strand);
  }
  return strands;
}

inline std::string plyText(const std::vector<Strand>& strands) {
  std::string vertices, counts;
  size_t count = 0;
  for (const Strand& strand : strands) {
    for (const auto& vertex : strand) vertices += std::to_string(vertex[0]) + " " + std::to_string(vertex[1]) + " " + std::to_string(vertex[2]) + "\n";
    counts += std::to_string(strand.size() - 1) + "\n";
    count += strand.size();
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\nproperty float x\nproperty float y\nproperty float z\nelement strand " +
         std::to_string(strands.size()) + "\nproperty ushort nsegs\nend_header\n" + vertices + counts;
}

// Of a path as the shell reads it.
inline std::string quoted(const std::string& path) { return "\"" + path + "\""; }

}  // namespace forelock::test
