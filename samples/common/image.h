// Images as the samples pass them around, and their files. SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

// Linear, premultiplied, row 0 at the top.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> rgba;

  Image() = default;
  Image(uint32_t w, uint32_t h) : width(w), height(h), rgba(size_t{4} * w * h, 0.0f) {}
  float* pixel(uint32_t x, uint32_t y) { return &rgba[4 * (size_t{y} * width + x)]; }
  const float* pixel(uint32_t x, uint32_t y) const { return &rgba[4 * (size_t{y} * width + x)]; }
};

// The curve of sRGB between a linear and a coded channel, both [0, 1]; what is beyond is cut off, NaN becomes 0.
float encodeSrgb(float linear);
float decodeSrgb(float coded);

// The image over an opaque linear colour.
Image over(const Image& image, const float background[3]);

// Writes by the path's extension: .png (8-bit sRGB, alpha not premultiplied), .exr (half floats, linear, premultiplied)
// or .pfm (32-bit floats, linear, three channels, premultiplied: put it over a background first). Throws
// std::runtime_error with what went wrong.
void writeImage(const std::string& path, const Image& image);

// Reads a .png (8 or 16 bit, taken as sRGB unless it says linear) or .exr (linear); one channel becomes grey, no alpha
// becomes 1. Premultiplied. Throws std::runtime_error with what went wrong.
Image readImage(const std::string& path);

// Whether writeImage knows the path's extension.
bool isImagePath(const std::string& path);

}  // namespace forelock::samples
