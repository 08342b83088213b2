// SPDX-License-Identifier: MIT
#include "views.h"

#include <algorithm>
#include <cmath>

namespace forelock::study {

Matrices matricesOf(const samples::Camera& camera, uint32_t width, uint32_t height) {
  Matrices m;
  samples::viewMatrix(camera, m.view_from_world);
  samples::projectionMatrix(camera, double(width) / double(height), m.clip_from_view);
  m.reversed_depth = camera.reversed_depth;
  return m;
}

namespace {

// Rows 0 and 1 of clip space become row * scale + w * offset.
template <class Value>
void changeClip(Value clip[16], double scale_x, double offset_x, double scale_y, double offset_y) {
  for (int column = 0; column < 4; ++column) {
    const double w = double(clip[4 * column + 3]);
    clip[4 * column] = Value(double(clip[4 * column]) * scale_x + w * offset_x);
    clip[4 * column + 1] = Value(double(clip[4 * column + 1]) * scale_y + w * offset_y);
  }
}

template <class Value>
void cropClip(Value clip[16], uint32_t width, uint32_t height, const Rect& r) {
  changeClip(clip, double(width) / r.width, (double(width) - 2.0 * r.x) / r.width - 1.0, double(height) / r.height,
             (double(height) - 2.0 * r.y) / r.height - 1.0);
}

}  // namespace

Matrices cropped(const Matrices& matrices, uint32_t width, uint32_t height, const Rect& rect) {
  Matrices m = matrices;
  cropClip(m.clip_from_view, width, height, rect);
  return m;
}

Matrices shifted(const Matrices& matrices, uint32_t width, uint32_t height, double right_px, double down_px) {
  Matrices m = matrices;
  changeClip(m.clip_from_view, 1.0, 2.0 * right_px / width, 1.0, 2.0 * down_px / height);
  return m;
}

reference::Camera referenceCamera(const Matrices& matrices, uint32_t width, uint32_t height, const Rect& rect) {
  reference::Camera camera;
  std::copy(matrices.view_from_world, matrices.view_from_world + 16, camera.view_from_world);
  for (int i = 0; i < 16; ++i) camera.clip_from_view[i] = double(matrices.clip_from_view[i]);
  cropClip(camera.clip_from_view, width, height, rect);
  camera.width = int(rect.width), camera.height = int(rect.height);
  return camera;
}

ZoomFound findZoom(double wanted, double tolerance, double low, double high, double guess,
                   const std::function<double(double tan_half)>& count) {
  ZoomFound best;
  double error = 1e300;
  const auto attempt = [&](double tan_half) {
    const double pixels = count(tan_half);
    const double off = std::fabs(pixels - wanted);
    if (off < error) error = off, best = {tan_half, pixels, off <= tolerance * wanted};
    return pixels;
  };
  // Pixels go with the inverse square of the tangent while all hair is seen, so a step is taken by that rule; brackets keep it
  // safe where it is not so, and halve (of the logarithm) where it does not help.
  double tan_half = std::clamp(guess, low, high);
  for (int step = 0; step < 24 && !best.reached && low < high * (1 - 1e-9); ++step) {
    const double pixels = attempt(tan_half);
    (pixels > wanted ? low : high) = tan_half;
    if (step == 0 && pixels <= 0) {
      tan_half = std::sqrt(low * high);
      continue;
    }
    const double next = pixels > 0 ? tan_half * std::sqrt(pixels / wanted) : 0;
    const double margin = std::pow(high / low, 0.05);
    tan_half = step < 12 && next > low * margin && next < high / margin ? next : std::sqrt(low * high);
    if (step < 3 && next >= low && next <= high) tan_half = next;
  }
  return best;
}

Rect hairRect(const std::vector<float>& rgba, uint32_t width, uint32_t height, uint32_t pad, uint64_t& pixels) {
  uint32_t x0 = width, y0 = height, x1 = 0, y1 = 0;
  pixels = 0;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      if (!(rgba[(std::size_t(y) * width + x) * 4 + 3] > 0)) continue;
      ++pixels;
      x0 = std::min(x0, x), x1 = std::max(x1, x + 1), y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
    }
  if (pixels == 0) return {};
  x0 -= std::min(x0, pad), y0 -= std::min(y0, pad);
  x1 = std::min(width, x1 + pad), y1 = std::min(height, y1 + pad);
  return {x0, y0, x1 - x0, y1 - y0};
}

}  // namespace forelock::study
