// Files read and written whole. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace forelock::samples {

// Throws AssetError, which begins with the path: not there, a directory, no regular file, longer than `largest`.
std::vector<unsigned char> readWholeFile(const std::string& path, uint64_t largest);

// Writes each through a temporary file beside it and renames them, in this order, when all are written: a failure leaves
// files that were there as they were. Throws AssetError.
void writeWholeFiles(const std::vector<std::pair<std::string, std::span<const unsigned char>>>& files);

}  // namespace forelock::samples
