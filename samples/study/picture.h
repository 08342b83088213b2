// Pictures of a view's rectangle: what is compared, cached and written. SPDX-License-Identifier: MIT
#pragma once

#include "reference.h"
#include "views.h"

#include <string>
#include <vector>

namespace forelock::study {

// Linear, hair over black.
struct Picture {
  uint32_t width = 0, height = 0;
  std::vector<float> rgb;            // 3 a pixel
  std::vector<float> transmittance;
  std::vector<uint32_t> fragments;   // of the reference; of the device 1 where alpha is above 0

  std::size_t pixels() const { return std::size_t(width) * height; }
  bool isHair(std::size_t pixel) const { return fragments[pixel] != 0; }
  void scale(double factor);
};

// The rectangle of a frame that was read back.
Picture fromDevice(const std::vector<float>& rgba, uint32_t width, const Rect& rect);
Picture fromReference(const reference::Image& image);

bool isFinite(const Picture& picture);
bool sameBits(const Picture& a, const Picture& b);

// .pfm of three channels, or of one. False: not written.
bool writePfm(const std::string& path, const Picture& picture);
bool writePfm(const std::string& path, const std::vector<float>& gray, uint32_t width, uint32_t height);

}  // namespace forelock::study
