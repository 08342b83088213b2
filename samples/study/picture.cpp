// SPDX-License-Identifier: MIT
#include "picture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>

namespace forelock::study {

void Picture::scale(double factor) {
  for (float& c : rgb) c = float(double(c) * factor);
}

Picture fromDevice(const std::vector<float>& rgba, uint32_t width, const Rect& rect) {
  Picture picture;
  picture.width = rect.width, picture.height = rect.height;
  picture.rgb.reserve(picture.pixels() * 3);
  for (uint32_t y = 0; y < rect.height; ++y)
    for (uint32_t x = 0; x < rect.width; ++x) {
      const float* p = &rgba[(std::size_t(rect.y + y) * width + rect.x + x) * 4];
      picture.rgb.insert(picture.rgb.end(), p, p + 3);
      picture.transmittance.push_back(1 - p[3]);
      picture.fragments.push_back(p[3] > 0 ? 1u : 0u);
    }
  return picture;
}

Picture fromReference(const reference::Image& image) {
  Picture picture;
  picture.width = uint32_t(image.width), picture.height = uint32_t(image.height);
  picture.rgb.reserve(picture.pixels() * 3);
  for (const reference::Pixel& pixel : image.pixels) {
    for (const double c : pixel.rgb) picture.rgb.push_back(float(c));
    picture.transmittance.push_back(float(pixel.transmittance));
    picture.fragments.push_back(pixel.fragments);
  }
  return picture;
}

bool isFinite(const Picture& picture) {
  const auto finite = [](float v) { return std::isfinite(v); };
  return std::all_of(picture.rgb.begin(), picture.rgb.end(), finite) &&
         std::all_of(picture.transmittance.begin(), picture.transmittance.end(), finite);
}

bool sameBits(const Picture& a, const Picture& b) {
  return a.rgb.size() == b.rgb.size() && std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0 &&
         std::memcmp(a.transmittance.data(), b.transmittance.data(), a.transmittance.size() * sizeof(float)) == 0;
}

namespace {

bool writeFloats(const std::string& path, const char* magic, const std::vector<float>& values, uint32_t width,
                 uint32_t height, std::size_t channels) {
  static_assert(std::endian::native == std::endian::little);
  std::ofstream file(path, std::ios::binary);
  file << magic << "\n" << width << " " << height << "\n-1.0\n";  // negative: little-endian
  const std::size_t row = std::size_t(width) * channels;
  for (uint32_t y = height; y-- > 0;)  // the bottom row comes first
    file.write(reinterpret_cast<const char*>(values.data() + y * row), std::streamsize(row * sizeof(float)));
  return bool(file.flush());
}

}  // namespace

bool writePfm(const std::string& path, const Picture& picture) {
  return writeFloats(path, "PF", picture.rgb, picture.width, picture.height, 3);
}

bool writePfm(const std::string& path, const std::vector<float>& gray, uint32_t width, uint32_t height) {
  return writeFloats(path, "Pf", gray, width, height, 1);
}

}  // namespace forelock::study
