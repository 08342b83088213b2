// How hair is drawn: what two sides of a comparison may differ in. SPDX-License-Identifier: MIT
#pragma once

#include "scene_file.h"

#include <string>

namespace forelock::samples {

struct MethodChoice {
  uint32_t method = FLK_METHOD_CORE_TAIL;
  uint32_t k = 0, k_sort = 0;  // as in FlkFrame
  uint32_t payload = FLK_PAYLOAD_DEFAULT;
  uint32_t tail = FLK_TAIL_DEFAULT;
  uint32_t core_taps = 0;
  uint32_t low_shade = FLK_LOW_SHADE_DEFAULT;
  uint32_t capture = FLK_CAPTURE_DEFAULT;

  bool operator==(const MethodChoice&) const = default;
  bool hasCore() const { return method == FLK_METHOD_CORE_TAIL || method == FLK_METHOD_CORE_ONLY; }
  bool hasTail() const { return method == FLK_METHOD_CORE_TAIL || method == FLK_METHOD_ALL_LOW; }
  bool sorts() const { return hasCore() || hasTail() || method == FLK_METHOD_FORWARD; }
};

inline MethodChoice methodOf(const Scene& scene) {
  return {scene.method, scene.k, scene.k_sort, scene.payload, scene.tail, scene.core_taps, scene.low_shade, scene.capture};
}

// Target: Scene or FlkFrame, which call these alike.
template <class Target>
void applyMethod(const MethodChoice& choice, Target& target) {
  target.method = choice.method;
  target.k = choice.k;
  target.k_sort = choice.k_sort;
  target.payload = choice.payload;
  target.tail = choice.tail;
  target.core_taps = choice.core_taps;
  target.low_shade = choice.low_shade;
  target.capture = choice.capture;
}

}  // namespace forelock::samples
