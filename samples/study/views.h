// Cameras: stored ones, framed ones, crops and shifts of them. SPDX-License-Identifier: MIT
#pragma once

#include "reference_scene.h"
#include "subject.h"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace forelock::study {

// Pixels of a frame.
struct Rect {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};

// What device and reference are given: the same numbers, fp32 where the SDK takes fp32.
struct Matrices {
  double view_from_world[16] = {};
  float clip_from_view[16] = {};
  bool reversed_depth = false;
};

struct View {
  std::string name;
  uint32_t width = 0, height = 0;
  samples::Camera camera;   // of the whole picture, where the view is a crop
  std::string scene_view;   // the view that the scene file draws: its own, of a crop the whole one
  uint32_t scene_width = 0, scene_height = 0;
  Matrices matrices;
  Rect rect;                // hair's rectangle, padded: all that references and images hold
  uint64_t fragments = 0;   // of the device
  uint64_t hair_pixels = 0; // with alpha above 0, of the device
  uint32_t max_overdraw = 0;// of the reference; 0: not known yet
};

Matrices matricesOf(const samples::Camera& camera, uint32_t width, uint32_t height);

// The same pixels, and of them only those of `rect`: pixel (0, 0) is then the rectangle's first.
Matrices cropped(const Matrices& matrices, uint32_t width, uint32_t height, const Rect& rect);

// The picture moved by a part of a pixel, right and down.
Matrices shifted(const Matrices& matrices, uint32_t width, uint32_t height, double right_px, double down_px);

// The reference's camera for a rectangle of the frame.
reference::Camera referenceCamera(const Matrices& matrices, uint32_t width, uint32_t height, const Rect& rect);

// Where the sub-pixel drift leads (pixels, right and down).
inline constexpr std::array<std::array<double, 2>, 3> kDrift = {{{0, 0}, {0.31, 0.17}, {0.62, 0.34}}};

struct ZoomFound {
  double tan_half = 0;  // of the field of view
  double pixels = 0;
  bool reached = false; // within the tolerance
};

// The zoom at which `count` pixels are covered, within `tolerance` (a share of `wanted`). More zoom covers no fewer pixels, up to
// where hair leaves the picture. `guess` lies in [low, high]: tangents of half the angle. Where no zoom does it, the nearest tried.
ZoomFound findZoom(double wanted, double tolerance, double low, double high, double guess,
                   const std::function<double(double tan_half)>& count);

// Smallest rectangle with all pixels of alpha above 0, `pad` wider on each side; empty: no hair.
Rect hairRect(const std::vector<float>& rgba, uint32_t width, uint32_t height, uint32_t pad, uint64_t& pixels);

}  // namespace forelock::study
