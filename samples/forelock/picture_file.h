// Pictures into files. SPDX-License-Identifier: MIT
#pragma once

#include "image.h"

#include <cstdint>
#include <string>

namespace forelock::samples {

// Through a file beside it, so that who reads it meanwhile sees a whole picture. Throws AssetError.
void savePicture(const std::string& path, const Image& image);

// "turn.png", 7: "turn-007.png".
std::string numberedPath(const std::string& path, uint32_t number);

}  // namespace forelock::samples
