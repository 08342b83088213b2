// glTF files as assets. SPDX-License-Identifier: MIT
#include "gltf_reader.h"

#include "whole_file.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace forelock::samples {
namespace {

// The library drops strands that no asset may hold and keeps the order and the bits of the others, and no strand that it drops
// equals one that it keeps.
std::vector<uint32_t> groupsOfKept(const GltfStrands& read, FlkAsset asset) {
  FlkStrands kept{};
  flkAssetGetStrands(asset, &kept);
  std::vector<uint32_t> groups;
  const auto& first = read.strands.first_vertex;
  for (uint32_t strand = 0; strand < read.strands.strands() && groups.size() < kept.strand_count; ++strand) {
    const uint32_t at = kept.first_vertex[groups.size()], count = kept.first_vertex[groups.size() + 1] - at;
    const bool same = first[strand + 1] - first[strand] == count &&
                      std::memcmp(&read.strands.positions[3 * size_t(first[strand])], kept.positions + 3 * size_t(at), 12 * size_t(count)) == 0;
    if (same) groups.push_back(read.groups[strand]);
  }
  return groups;
}

}  // namespace

GltfStrands readGltfFile(const std::string& path, const GltfLimits& limits) {
  // What vertices within the limits can take: 16 floats, and two indices.
  const uint64_t largest = uint64_t(limits.vertices) * (64 + 8) + (uint64_t{256} << 20);
  std::vector<unsigned char> bytes;
  try {
    bytes = readWholeFile(path, largest);
  } catch (const std::bad_alloc&) {
    throw GltfError(FLK_ERROR_OUT_OF_HOST_MEMORY, "OUT_OF_HOST_MEMORY", path + ": there is not enough memory to read it: close programs or split the file");
  }
  std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return readGltf(std::move(bytes), path, folder.empty() ? "." : folder, limits);
}

OpenedAsset openGltf(const std::string& path) {
  GltfStrands read = readGltfFile(path);
  OpenedAsset opened = assetOf(read.strands.view(), path);
  opened.format = "gltf";
  opened.groups = groupsOfKept(read, opened.asset.get());
  opened.group_names = std::move(read.group_names);
  std::vector<AssetMessage> warnings;
  for (const AssetFinding& finding : read.findings)
    if (finding.severity != FLK_SEVERITY_INFO) warnings.push_back({finding.severity, finding.code, path + ": " + finding.text});
  opened.messages->insert(opened.messages->begin(), warnings.begin(), warnings.end());
  opened.source_findings = std::move(read.findings);
  return opened;
}

}  // namespace forelock::samples
