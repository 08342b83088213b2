// A glTF or GLB file, taken apart: its structure by tinygltf, after every field was checked, and its buffers.
// SPDX-License-Identifier: MIT
#pragma once

#include "tinygltf_import.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

struct GltfDocument {
  tinygltf::Model model;  // without images, materials, animations and skins; its buffers are as long as byteLength says
  bool deforms = false;   // there are skins or morph targets
  std::optional<std::array<float, 3>> base_color;  // of the first material (linear)
  uint64_t bytes_unused = 0;  // after what a GLB file counts, or in chunks of a kind that is not known
};

// `bytes`: the file. `folder`: where files that it names lie; empty: such files are refused. Throws GltfRefusal.
GltfDocument readGltfDocument(std::vector<unsigned char> bytes, const std::filesystem::path& folder);

}  // namespace forelock::samples
