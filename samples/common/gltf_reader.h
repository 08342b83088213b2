// Strands of glTF 2.0 files, .gltf and .glb: primitives of lines become strands. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "strand_edit.h"

#include <filesystem>
#include <span>

namespace forelock::samples {

// The id of docs/findings.md beside the sentence.
struct GltfError : AssetError {
  GltfError(FlkResult why, std::string code, const std::string& text) : AssetError(why, text), id(std::move(code)) {}
  std::string id;
};

struct GltfLimits {
  uint32_t strands = kMostStrands, vertices = kMostVertices;
};

struct GltfStrands {
  EditableStrands strands;  // as the file has them: strands that no asset may hold are still there
  std::vector<AssetFinding> findings;
  std::vector<uint32_t> groups;  // of each strand; a group for each node with lines
  std::vector<std::string> group_names;
};

// Whether a file that begins (and ends) like this is glTF: GLB's magic, or JSON with an object "asset".
bool looksLikeGltf(std::span<const unsigned char> head, std::span<const unsigned char> tail = {});
// The same of a file; false where it cannot be read.
bool isGltfFile(const std::string& path);

// `name`: what messages begin with. `folder`: where files that it names lie; empty: such files are refused.
// Throws GltfError, whatever the bytes; what it allocates is proven against the bytes.
GltfStrands readGltf(std::vector<unsigned char> bytes, const std::string& name, const std::filesystem::path& folder, const GltfLimits& limits = {});

// The same for a file.
GltfStrands readGltfFile(const std::string& path, const GltfLimits& limits = {});

// An asset of such a file, with its findings and groups. Throws GltfError or AssetError.
OpenedAsset openGltf(const std::string& path);

}  // namespace forelock::samples
