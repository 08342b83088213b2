// SPDX-License-Identifier: MIT
#include "strand_faults.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

namespace forelock::samples {

namespace {

constexpr double kVanishing = 1e-18;  // as the library: the square of less vanishes in 32-bit floats
constexpr double kMicroShare = 1e-4;
constexpr double kSharpCosine = -0.5;  // of 120 degrees

void lookAlong(const FlkStrands& strands, uint32_t s, uint8_t& found, double& length) {
  glm::dvec3 before(0.0);
  length = 0.0;
  bool widths = false;
  for (uint32_t v = strands.first_vertex[s]; v < strands.first_vertex[s + 1]; ++v) {
    widths = widths || !strands.radii || strands.radii[v] > 0.0f;
    if (v + 1 == strands.first_vertex[s + 1]) {
      break;
    }
    const float* p = strands.positions + size_t{3} * v;
    const glm::dvec3 segment(double{p[3]} - double{p[0]}, double{p[4]} - double{p[1]}, double{p[5]} - double{p[2]});
    const double size = glm::length(segment);
    length += size;
    if (size <= kVanishing) {
      found |= 1u << kFaultSegment;
      continue;
    }
    const glm::dvec3 direction = segment / size;
    if (glm::dot(before, direction) < kSharpCosine) {
      found |= 1u << kFaultTurn;
    }
    before = direction;
  }
  if (!widths) {
    found |= 1u << kFaultWidth;
  }
}

void lookForDuplicates(const FlkStrands& strands, StrandFaults& faults) {
  const auto bytesOf = [&](uint32_t s) {
    const uint32_t begin = strands.first_vertex[s], count = strands.first_vertex[s + 1] - begin;
    return std::string_view(reinterpret_cast<const char*>(strands.positions + size_t{3} * begin), sizeof(float) * 3 * count);
  };
  std::unordered_map<std::string_view, uint32_t> first;
  first.reserve(strands.strand_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    if (!first.emplace(bytesOf(s), s).second) {
      faults.of[s] |= 1u << kFaultDuplicate;
    }
  }
}

void lookAtRoots(const FlkStrands& strands, StrandFaults& faults) {
  const auto outside = [&](uint32_t s) {
    const float u = strands.root_uvs[2 * size_t{s}], v = strands.root_uvs[2 * size_t{s} + 1];
    return u < 0.0f || u > 1.0f || v < 0.0f || v > 1.0f;
  };
  uint64_t count = 0;
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    count += outside(s) ? 1 : 0;
  }
  for (uint32_t s = 0; 2 * count < strands.strand_count && s < strands.strand_count; ++s) {
    if (outside(s)) {
      faults.of[s] |= 1u << kFaultRootUv;
    }
  }
}

}  // namespace

StrandFaults findStrandFaults(const FlkStrands& strands) {
  StrandFaults faults;
  faults.of.resize(strands.strand_count);
  std::vector<double> lengths(strands.strand_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    lookAlong(strands, s, faults.of[s], lengths[s]);
  }
  std::vector<double> sorted(lengths);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    if (lengths[s] < kMicroShare * *middle) {
      faults.of[s] |= 1u << kFaultMicro;
    }
  }
  lookForDuplicates(strands, faults);
  if (strands.root_uvs) {
    lookAtRoots(strands, faults);
  }
  for (const uint8_t found : faults.of) {
    faults.strands += found != 0 ? 1 : 0;
    for (uint32_t kind = 0; kind < kStrandFaultCount; ++kind) {
      faults.counts[kind] += found >> kind & 1u;
    }
  }
  return faults;
}

const char* faultWord(StrandFault kind) {
  static constexpr const char* words[kStrandFaultCount] = {
      "shorter than 1/10,000 of the median", "with equal consecutive vertices", "with a turn of more than 120 degrees",
      "the same as an earlier one",          "of width 0",                      "with a root UV outside 0..1"};
  return words[kind];
}

std::string describeFaults(const StrandFaults& faults) {
  if (faults.strands == 0) {
    return "none";
  }
  std::string text = std::to_string(faults.strands) + (faults.strands == 1 ? " strand" : " strands");
  const char* before = ": ";
  for (uint32_t kind = 0; kind < kStrandFaultCount; ++kind) {
    if (faults.counts[kind] > 0) {
      text += before + std::to_string(faults.counts[kind]) + " " + faultWord(static_cast<StrandFault>(kind));
      before = ", ";
    }
  }
  return text;
}

}  // namespace forelock::samples
