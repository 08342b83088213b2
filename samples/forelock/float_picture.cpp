// SPDX-License-Identifier: MIT
#include "float_picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace forelock::samples {

FloatPicture readPfm(const std::string& path) {
  std::error_code error;
  const uintmax_t bytes = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) {
    throw std::runtime_error("cannot be read");
  }
  std::string kind;
  int64_t width = 0, height = 0;
  double scale = 0.0;  // its sign tells the byte order
  file >> kind >> width >> height >> scale;
  if (!file || (kind != "PF" && kind != "Pf") || !std::isfinite(scale) || scale == 0.0) {
    throw std::runtime_error("is no PFM picture");
  }
  if (width < 1 || height < 1 || width > 16384 || height > 16384) {
    throw std::runtime_error("is " + std::to_string(width) + " x " + std::to_string(height) + ", sides must lie in [1, 16384]");
  }
  file.get();  // the one white space after the scale
  FloatPicture picture;
  picture.width = static_cast<uint32_t>(width);
  picture.height = static_cast<uint32_t>(height);
  picture.channels = kind == "PF" ? 3 : 1;
  const size_t row = size_t{picture.width} * picture.channels;
  // Before memory is asked for: a header may claim anything.
  if (bytes != static_cast<uintmax_t>(file.tellg()) + row * picture.height * sizeof(float)) {
    throw std::runtime_error("has another size than its header says (was the study stopped?)");
  }
  picture.values.resize(row * picture.height);
  for (uint32_t y = picture.height; y-- > 0;) {  // PFM starts at the bottom
    file.read(reinterpret_cast<char*>(&picture.values[y * row]), static_cast<std::streamsize>(row * sizeof(float)));
  }
  if (!file) {
    throw std::runtime_error("cannot be read to its end");
  }
  const bool swapped = (scale < 0.0) != (std::endian::native == std::endian::little);
  for (float& value : picture.values) {
    if (swapped) {
      uint32_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      bits = (bits >> 24) | ((bits >> 8) & 0xff00u) | ((bits << 8) & 0xff0000u) | (bits << 24);
      std::memcpy(&value, &bits, sizeof bits);
    }
    if (!std::isfinite(value)) {
      value = 0.0f;
      ++picture.not_finite;
    }
  }
  return picture;
}

}  // namespace forelock::samples
