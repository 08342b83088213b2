// SPDX-License-Identifier: MIT
#include "strand_repair.h"

#include "strand_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace forelock::samples {
namespace {

// Keeps the vertices for which `keep(strand, vertex)` holds, and no strand of fewer than two.
template <class Keep> uint64_t keepVertices(EditableStrands& strands, const Keep& keep) {
  EditableStrands kept;
  kept.first_vertex.push_back(0);
  const auto append = [](std::vector<float>& to, const std::vector<float>& from, size_t record, size_t size) {
    if (!from.empty()) to.insert(to.end(), from.begin() + std::ptrdiff_t(record * size), from.begin() + std::ptrdiff_t((record + 1) * size));
  };
  std::vector<uint32_t> chosen;
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    chosen.clear();
    for (uint32_t v = strands.first_vertex[strand]; v < strands.first_vertex[strand + 1]; ++v)
      if (keep(strand, v)) chosen.push_back(v);
    if (chosen.size() < 2) continue;
    for (const uint32_t v : chosen) {
      append(kept.positions, strands.positions, v, 3);
      append(kept.radii, strands.radii, v, 1);
      append(kept.inverse_masses, strands.inverse_masses, v, 1);
      append(kept.colors, strands.colors, v, 3);
    }
    append(kept.root_uvs, strands.root_uvs, strand, 2);
    kept.first_vertex.push_back(kept.first_vertex.back() + uint32_t(chosen.size()));
  }
  const uint64_t removed = strands.vertices() - kept.vertices();
  strands = std::move(kept);
  return removed;
}

uint64_t removeStrands(EditableStrands& strands, const std::vector<bool>& gone) {
  keepVertices(strands, [&](uint32_t strand, uint32_t) { return !gone[strand]; });
  return uint64_t(std::count(gone.begin(), gone.end(), true));
}

uint64_t removeMicro(EditableStrands& strands) {
  std::vector<double> lengths;
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    double length = 0;
    for (uint32_t v = strands.first_vertex[strand]; v + 1 < strands.first_vertex[strand + 1]; ++v) {
      const float* p = &strands.positions[3 * size_t(v)];
      length += std::hypot(double(p[3]) - double(p[0]), double(p[4]) - double(p[1]), double(p[5]) - double(p[2]));
    }
    lengths.push_back(length);
  }
  std::vector<double> sorted = lengths;
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  std::vector<bool> gone;
  for (const double length : lengths) gone.push_back(length < 1e-4 * *middle);  // the bound of STRAND_MICRO
  return removeStrands(strands, gone);
}

uint64_t removeCopies(EditableStrands& strands) {
  const std::vector<uint32_t> first = firstOfEqualStrands(strands.view());
  std::vector<bool> gone;
  for (uint32_t strand = 0; strand < first.size(); ++strand) gone.push_back(first[strand] != strand);
  return removeStrands(strands, gone);
}

// The first of equal vertices stays, so that root and masses do.
uint64_t removeRepeatedVertices(EditableStrands& strands) {
  return keepVertices(strands, [&](uint32_t strand, uint32_t v) {
    if (v == strands.first_vertex[strand]) return true;
    const float* p = &strands.positions[3 * size_t(v)];
    return std::hypot(double(p[0]) - double(p[-3]), double(p[1]) - double(p[-2]), double(p[2]) - double(p[-1])) > 1e-18;  // the bound of SEGMENT_ZERO_LENGTH
  });
}

uint64_t clampUvs(EditableStrands& strands) {
  uint64_t count = 0;
  for (size_t i = 0; i < strands.root_uvs.size(); i += 2) {
    float* uv = &strands.root_uvs[i];
    const float clamped[2] = {std::clamp(uv[0], 0.0f, 1.0f), std::clamp(uv[1], 0.0f, 1.0f)};
    count += std::memcmp(uv, clamped, sizeof clamped) != 0;
    std::memcpy(uv, clamped, sizeof clamped);
  }
  return count;
}

uint64_t scaleToMetres(EditableStrands& strands, const FlkAssetInfo& info) {
  const std::string unit = guessUnit(info).value;
  const double factor = unit == "cm" ? 0.01 : unit == "mm" ? 0.001 : 1;
  if (factor == 1) return 0;
  scaleStrands(strands, factor);
  return strands.strands();
}

uint64_t drop(std::vector<float>& values, uint64_t count) {
  values.clear();
  return count;
}

}  // namespace

const std::vector<RepairKind>& repairKinds() {
  static const std::vector<RepairKind> kinds = {
      {"STRAND_MICRO", true, "strands removed"},
      {"STRAND_DUPLICATE", true, "copies of strands removed"},
      {"SEGMENT_ZERO_LENGTH", true, "repeated vertices removed"},
      {"ROOT_AT_TIP", false, "strands reversed, with what their vertices carry"},
      {"ROOT_UV_OUTSIDE_UNIT", false, "root UVs clamped to 0..1"},
      {"ROOT_UV_ALL_ZERO", false, "root UVs taken away"},
      {"ROOT_UV_CONSTANT", false, "root UVs taken away"},
      {"RADIUS_ALL_ZERO", false, "widths taken away, so that the default is used"},
      {"INVERSE_MASS_ALL_ZERO", false, "inverse masses taken away"},
      {"UNIT_SUSPECT", false, "strands scaled to metres, from the unit that was guessed"},
      {"FAR_FROM_ORIGIN", false, "strands moved, the middle of their bounds to the origin"},
  };
  return kinds;
}

std::vector<Repair> repairStrands(EditableStrands& strands, const FlkAssetInfo& info, const std::vector<AssetFinding>& findings,
                                  const std::vector<std::string>& codes) {
  for (const std::string& code : codes) {
    std::string known;
    bool found = false;
    for (const RepairKind& kind : repairKinds()) known += std::string(known.empty() ? "" : ", ") + kind.code, found |= code == kind.code;
    if (!found) throw std::invalid_argument(code + " is nothing that can be repaired; there are " + known);
  }
  std::vector<Repair> repairs;
  for (const RepairKind& kind : repairKinds()) {
    const std::string code = kind.code;
    const auto named = [&](const auto& list, const auto& of) { return std::any_of(list.begin(), list.end(), [&](const auto& entry) { return of(entry) == code; }); };
    if (!named(codes, [](const std::string& entry) { return entry; }) || !named(findings, [](const AssetFinding& entry) { return entry.code; })) continue;
    uint64_t count = 0;
    if (code == "STRAND_MICRO") count = removeMicro(strands);
    if (code == "STRAND_DUPLICATE") count = removeCopies(strands);
    if (code == "SEGMENT_ZERO_LENGTH") count = removeRepeatedVertices(strands);
    if (code == "ROOT_AT_TIP") reverseStrands(strands), count = strands.strands();
    if (code == "ROOT_UV_OUTSIDE_UNIT") count = clampUvs(strands);
    if (code == "ROOT_UV_ALL_ZERO" || code == "ROOT_UV_CONSTANT") count = drop(strands.root_uvs, strands.strands());
    if (code == "RADIUS_ALL_ZERO") count = drop(strands.radii, strands.vertices());
    if (code == "INVERSE_MASS_ALL_ZERO") count = drop(strands.inverse_masses, strands.vertices());
    if (code == "UNIT_SUSPECT") count = scaleToMetres(strands, info);
    if (code == "FAR_FROM_ORIGIN") recentreStrands(strands), count = strands.strands();
    if (count != 0) repairs.push_back({code, kind.what, count});
  }
  return repairs;
}

std::vector<Repair> repairsOnLoading(const std::vector<AssetFinding>& findings) {
  std::vector<Repair> repairs;
  for (const AssetFinding& finding : findings) {
    if (!finding.repaired) continue;
    const bool strand = finding.code.rfind("STRAND_", 0) == 0 || finding.code.rfind("POSITION_", 0) == 0;
    const bool clamped = finding.code == "COLOR_OUTSIDE_UNIT";
    repairs.push_back({finding.code, strand ? "strands dropped" : clamped ? "values clamped" : "values replaced", finding.count});
  }
  return repairs;
}

}  // namespace forelock::samples
