// What rows on whole frames share: the ways to draw one, and layers that fill the picture.
#pragma once

#include "numerics_kit.h"
#include "scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

namespace forelock::test {

struct CaptureWay {
  uint32_t capture;
  const char* name;
};
inline constexpr CaptureWay kCaptures[] = {{FLK_CAPTURE_RASTER, "raster"}, {FLK_CAPTURE_COMPUTE, "compute"}};

struct MethodWay {
  const char* name;
  uint32_t method, tail;
  reference::Method twin;
  reference::TailOrder order;
};
// The first four give the same bits whatever the order of arrival.
inline constexpr MethodWay kMethodWays[] = {
    {"exact", FLK_METHOD_EXACT, FLK_TAIL_DEFAULT, reference::Method::exact, reference::TailOrder::list},
    {"core_tail", FLK_METHOD_CORE_TAIL, FLK_TAIL_DETERMINISTIC, reference::Method::core_tail,
     reference::TailOrder::deterministic},
    {"core_only", FLK_METHOD_CORE_ONLY, FLK_TAIL_DETERMINISTIC, reference::Method::core_only,
     reference::TailOrder::deterministic},
    {"all_low", FLK_METHOD_ALL_LOW, FLK_TAIL_DETERMINISTIC, reference::Method::all_low,
     reference::TailOrder::deterministic},
    {"core_tail, list", FLK_METHOD_CORE_TAIL, FLK_TAIL_LIST, reference::Method::core_tail, reference::TailOrder::list},
    {"forward", FLK_METHOD_FORWARD, FLK_TAIL_DEFAULT, reference::Method::forward, reference::TailOrder::list}};
inline constexpr std::size_t kDeterministic = 4;

inline FlkFrame frameOf(const MethodWay& way, uint32_t capture = FLK_CAPTURE_DEFAULT) {
  FlkFrame frame{};
  frame.method = way.method, frame.tail = way.tail, frame.capture = capture;
  return frame;
}

// An orthographic view of 1 m across its height, 2 m before the origin.
inline ViewSpec flatView(int width, int height) {
  ViewSpec view;
  view.width = width, view.height = height;
  view.eye = {0, 0, 2};
  view.projection.orthographic = true;
  view.projection.tan_half_y = 0.5;
  return view;
}
// The world point of a pixel position in it.
inline std::array<float, 3> flatPoint(const ViewSpec& view, double x, double y, double z = 0) {
  return {float((x - view.width / 2.0) / view.height), float((view.height / 2.0 - y) / view.height), float(z)};
}

// Colours and weights that keep radiance under a light of 1 in [0, 1].
inline FlkMaterial plainMaterial(float opacity_root, float opacity_tip) {
  FlkMaterial m;
  flkMaterialDefault(&m);
  m.color[0] = 0.9f, m.color[1] = 0.6f, m.color[2] = 0.3f;
  m.opacity_root = opacity_root, m.opacity_tip = opacity_tip;
  m.diffuse = 1, m.specular_r = m.specular_trt = 0;
  return m;
}

// `count` strands across the whole of a flat view, in a fixed random order of depth, at random angles (upright: from left to
// right, so that the fraction of a strand is that of the picture's width).
inline StrandArrays layers(const ViewSpec& view, uint32_t count, bool upright, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<uint32_t> order(count);
  for (uint32_t i = 0; i < count; ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  StrandArrays strands;
  for (const uint32_t i : order) {
    const double z = 0.5 - double(i) / count, w = view.width, h = view.height;
    if (upright) {
      strands.add({flatPoint(view, -2, h / 2, z), flatPoint(view, w + 2, h / 2, z)}, 2);
      continue;
    }
    // Ends at random distances: what fraction of the strand a pixel sees differs from layer to layer.
    const double angle = 2 * std::numbers::pi * uniform(random), dx = w * std::cos(angle), dy = w * std::sin(angle);
    const double before = 1.5 + 2 * uniform(random), after = 1.5 + 2 * uniform(random);
    strands.add({flatPoint(view, w / 2 - before * dx, h / 2 - before * dy, z),
                 flatPoint(view, w / 2 + after * dx, h / 2 + after * dy, z)},
                4);
  }
  return strands;
}

// A code of section 3 with that many steps, as the device would round it.
inline double rootCoded(double alpha, double steps) {
  return std::pow(std::floor(std::sqrt(alpha) * steps + 0.5) / steps, 2);
}
// Whether rounding in fp32 may choose the code beside.
inline bool nearTie(double alpha, double steps) {
  const double q = std::sqrt(alpha) * steps;
  return std::fabs(q - std::floor(q) - 0.5) < 2e-3;
}

// lavapipe (Mesa 22.3.6 and later: LP_MAX_TGSI_LOOP_ITERATIONS) silently ends what loops remain after 65,535 rounds of all loops of an
// invocation. Rows that need more are not held there.
inline bool loopsAreLimited() { return host().deviceName().find("llvmpipe") != std::string::npos; }

// Appends to a list in words.
inline void enlist(std::string& list, const std::string& item) {
  if (!list.empty()) list += ", ";
  list += item;
}

inline std::size_t notFinite(const std::vector<float>& image) {
  return std::size_t(std::count_if(image.begin(), image.end(), [](float v) { return !std::isfinite(v); }));
}

inline double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  Worst worst;
  for (std::size_t i = 0; i < a.size(); ++i) worst.see(std::fabs(double(a[i]) - double(b[i])));
  return worst.value();
}

}  // namespace forelock::test
