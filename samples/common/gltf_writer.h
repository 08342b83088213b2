// Strands as glTF 2.0: lines that any viewer shows. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

namespace forelock::samples {

struct GltfFiles {
  std::vector<unsigned char> main;    // the .glb or .gltf file
  std::vector<unsigned char> buffer;  // the .bin file of a .gltf file; empty for .glb
};

// A mesh of mode LINES, or one for each group; positions, colours, root UVs (on each vertex of a strand) and masses bit for bit, diameters
// as _WIDTH where the asset has widths of its own. The same asset gives the same bytes. `buffer_name`: what a .gltf file calls its
// .bin file; empty: .glb. Throws AssetError where a .glb file would be longer than 4 GiB, beginning with `label`.
GltfFiles writeGltf(const OpenedAsset& opened, const std::string& buffer_name, const std::string& label);

// What writing changes or loses.
std::vector<AssetMessage> gltfLosses(const OpenedAsset& opened, const std::string& label);

// Writes the file, and beside a .gltf file its .bin file; through temporary files. Throws AssetError.
void saveGltf(const OpenedAsset& opened, const std::string& path);

}  // namespace forelock::samples
