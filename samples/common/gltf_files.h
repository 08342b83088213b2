// Files that a glTF file names: only such as lie in its folder. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace forelock::samples {

// The bytes of a buffer: of a file inside `folder` (an empty path: there is no folder, no file is read) or of a data: URI.
// `where` names the field. Throws GltfRefusal; reads nothing beyond `bytes`, and allocates only what is there.
std::vector<unsigned char> readGltfBuffer(const std::string& uri, uint64_t bytes, const std::filesystem::path& folder, const std::string& where);

}  // namespace forelock::samples
