// What asset.h promises of every asset, checked through the public functions only. Shared by unit tests and fuzzing.
#pragma once

#include "forelock/asset.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace asset_test {

// Whether all of `text` decodes as UTF-8 without control characters: sentences are shown to people and written into JSON.
inline bool isSentence(const char* text) {
  for (const auto* at = reinterpret_cast<const unsigned char*>(text); *at;) {
    const int more = *at < 0x80 ? 0 : *at >> 5 == 6 ? 1 : *at >> 4 == 14 ? 2 : *at >> 3 == 30 ? 3 : -1;
    if (more < 0 || *at < 0x20) return false;
    uint32_t character = more == 0 ? *at : *at & (0x3fu >> more);
    for (int i = 1; i <= more; ++i) {
      if (at[i] >> 6 != 2) return false;
      character = character << 6 | (at[i] & 0x3fu);
    }
    constexpr uint32_t least[] = {0, 0x80, 0x800, 0x10000};
    if (character < least[more] || character > 0x10ffff || (character >= 0xd800 && character < 0xe000)) return false;
    at += more + 1;
  }
  return true;
}

// The first promise that is broken; nullptr if none is.
inline const char* brokenPromise(FlkAsset asset) {
  FlkAssetInfo info;
  FlkStrands strands;
  if (flkAssetGetInfo(asset, &info) != FLK_SUCCESS || flkAssetGetStrands(asset, &strands) != FLK_SUCCESS)
    return "info and strands can be asked for";
  if (strands.type != FLK_TYPE_STRANDS || strands.next) return "strands carry their tag";
  if (strands.strand_count == 0 || strands.strand_count > info.strands_in_source) return "strands are left";
  if (info.strand_count != strands.strand_count || info.vertex_count != strands.vertex_count) return "counts agree";
  if (!strands.radii) return "radii are never NULL";
  if ((strands.root_uvs != nullptr) != (info.has_root_uvs != 0)) return "has_root_uvs";
  if ((strands.inverse_masses != nullptr) != (info.has_inverse_masses != 0)) return "has_inverse_masses";
  if ((strands.colors != nullptr) != (info.has_colors != 0)) return "has_colors";
  if (strands.first_vertex[0] != 0 || strands.first_vertex[strands.strand_count] != strands.vertex_count)
    return "first_vertex spans all vertices";

  for (uint32_t strand = 0; strand < strands.strand_count; ++strand) {
    const uint32_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    if (end < begin || end > strands.vertex_count || end - begin < 2) return "two or more vertices a strand";
    if (end - begin < info.min_vertices_per_strand || end - begin > info.max_vertices_per_strand)
      return "vertices per strand within the announced range";
    double longest = 0;
    for (uint32_t vertex = begin; vertex < end; ++vertex) {
      for (int axis = 0; axis < 3; ++axis) {
        const float value = strands.positions[size_t{vertex} * 3 + axis];
        if (!(std::fabs(value) <= 1e6f)) return "positions finite and within 1e6";
        if (value < info.min_bounds[axis] || value > info.max_bounds[axis]) return "positions within the bounds";
        if (vertex > begin)
          longest = std::fmax(longest, std::fabs(double{value} - strands.positions[(size_t{vertex} - 1) * 3 + axis]));
      }
      const float radius = strands.radii[vertex];
      if (!(radius >= 0) || !std::isfinite(radius)) return "radii finite and not negative";
      if (radius < info.min_radius || radius > info.max_radius) return "radii within the announced range";
      if (strands.inverse_masses && !(strands.inverse_masses[vertex] >= 0 && std::isfinite(strands.inverse_masses[vertex])))
        return "inverse masses finite and not negative";
      for (int i = 0; i < 3 && strands.colors; ++i)
        if (const float value = strands.colors[size_t{vertex} * 3 + i]; !(value >= 0 && value <= 1)) return "colours within 0..1";
    }
    if (!(longest > 0)) return "no strand of zero length";
    for (int i = 0; i < 2 && strands.root_uvs; ++i)
      if (!std::isfinite(strands.root_uvs[size_t{strand} * 2 + i])) return "root UVs finite";
  }
  if (!(info.min_length > 0 && info.min_length <= info.mean_length * 1.0001f && info.mean_length <= info.max_length * 1.0001f))
    return "lengths are positive and ordered";

  for (uint32_t i = 0; i < info.finding_count; ++i) {
    FlkFinding finding;
    if (flkAssetGetFinding(asset, i, &finding) != FLK_SUCCESS) return "findings can be asked for";
    if (!finding.code || !*finding.code || !finding.text || !*finding.text) return "findings have a code and a sentence";
    if (finding.count == 0 || finding.strands_listed > 8) return "findings count";
    for (uint32_t j = 0; j < finding.strands_listed; ++j)
      if (finding.strands[j] >= info.strands_in_source) return "findings number strands as in the source";
  }
  FlkFinding none;
  if (flkAssetGetFinding(asset, info.finding_count, &none) == FLK_SUCCESS) return "no finding past the last";
  return nullptr;
}

inline std::vector<unsigned char> saved(FlkAsset asset, uint32_t format, FlkResult& result) {
  std::vector<unsigned char> bytes;
  size_t size = 0;
  result = flkAssetSaveMemory(asset, format, nullptr, &size);
  if (result != FLK_SUCCESS) return bytes;
  bytes.resize(size);
  result = flkAssetSaveMemory(asset, format, bytes.data(), &size);
  return bytes;
}

// Saves in every format that can hold the asset, loads that again and compares what the format keeps.
inline const char* brokenRoundTrip(FlkAsset asset) {
  FlkStrands before;
  flkAssetGetStrands(asset, &before);
  FlkAssetInfo info;
  flkAssetGetInfo(asset, &info);
  for (const uint32_t format : {uint32_t{FLK_FORMAT_TFX}, uint32_t{FLK_FORMAT_HAIR}, uint32_t{FLK_FORMAT_PLY}, uint32_t{FLK_FORMAT_COOKED}}) {
    FlkResult result;
    const std::vector<unsigned char> bytes = saved(asset, format, result);
    if (result == FLK_ERROR_LIMIT) continue;
    if (result != FLK_SUCCESS) return "an asset can be saved";
    FlkAsset again = nullptr;
    if (flkAssetLoadMemory(bytes.data(), bytes.size(), nullptr, &again) != FLK_SUCCESS) return "what is saved can be loaded";
    FlkStrands after;
    flkAssetGetStrands(again, &after);
    const char* broken = nullptr;
    const size_t vertices = before.vertex_count;
    if (after.strand_count != before.strand_count || after.vertex_count != before.vertex_count)
      broken = "a round trip keeps the counts";
    else if (std::memcmp(after.first_vertex, before.first_vertex, (size_t{before.strand_count} + 1) * 4) != 0)
      broken = "a round trip keeps the strands";
    else if (std::memcmp(after.positions, before.positions, vertices * 12) != 0)
      broken = "a round trip keeps every bit of the positions";
    else if (format != FLK_FORMAT_HAIR && before.inverse_masses &&
             std::memcmp(after.inverse_masses, before.inverse_masses, vertices * 4) != 0)
      broken = "a .tfx or PLY round trip keeps the inverse masses";
    else if (format != FLK_FORMAT_HAIR && before.root_uvs &&
             std::memcmp(after.root_uvs, before.root_uvs, size_t{before.strand_count} * 8) != 0)
      broken = "a .tfx or PLY round trip keeps the root UVs";
    else if (format != FLK_FORMAT_TFX && info.has_radii && std::memcmp(after.radii, before.radii, vertices * 4) != 0)
      broken = "a .hair or PLY round trip keeps the radii";
    else if (format != FLK_FORMAT_TFX &&
             (before.colors ? !after.colors || std::memcmp(after.colors, before.colors, vertices * 12) != 0 : after.colors != nullptr))
      broken = "a .hair or PLY round trip keeps the colours";
    else if (format == FLK_FORMAT_COOKED && std::memcmp(after.radii, before.radii, vertices * 4) != 0)
      broken = "a cooked round trip keeps default widths";
    else if (saved(again, format, result) != bytes)
      broken = "equal assets give equal bytes";
    flkAssetDestroy(again);
    if (broken) return broken;
  }
  return nullptr;
}

}  // namespace asset_test
