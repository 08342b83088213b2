// The methods: a line each. Adding one means a line here, its pass file and its shaders.
#pragma once

#include <cstdint>

namespace forelock {

// What capture writes.
enum class CaptureKind : uint8_t { tangent, color, display, hard };
// What reads it.
enum class ResolveKind : uint8_t { core_tail, colors, exact, layers, hard };
// What lies behind the core; `choice`: the frame says.
enum class TailKind : uint8_t { none, choice, list, opacity };

struct Method {
  const char* name;
  CaptureKind capture;
  ResolveKind resolve;
  TailKind tail;
  bool shaded;           // lights matter
  bool sorts_front_only; // k_sort means something
  bool shades_front;     // k means something
  uint32_t full_taps;    // shadow map reads of a fragment of the core
  uint32_t low_taps;     // and of one behind it; 0: there is no cheap shade

  bool lists() const { return capture != CaptureKind::hard; }
  bool colorsListed() const { return capture == CaptureKind::color || capture == CaptureKind::display; }
};

inline constexpr uint32_t kFullTaps = 25;

inline constexpr Method kMethods[] = {
    {"core_tail", CaptureKind::tangent, ResolveKind::core_tail, TailKind::choice, true, true, true, kFullTaps, 1},
    {"exact", CaptureKind::tangent, ResolveKind::exact, TailKind::none, true, false, false, kFullTaps, 0},
    {"forward", CaptureKind::color, ResolveKind::colors, TailKind::list, true, true, false, kFullTaps, 0},
    {"core_only", CaptureKind::tangent, ResolveKind::core_tail, TailKind::opacity, true, true, true, kFullTaps, 1},
    {"all_low", CaptureKind::tangent, ResolveKind::core_tail, TailKind::choice, true, true, false, 0, 1},
    {"hard", CaptureKind::hard, ResolveKind::hard, TailKind::none, true, false, false, kFullTaps, 0},
};
inline constexpr Method kDisplayMethod = {"display", CaptureKind::display, ResolveKind::colors, TailKind::list, false, true, false, 0, 0};
inline constexpr Method kLayersMethod = {"layers", CaptureKind::tangent, ResolveKind::layers, TailKind::none, false, false, false, 0, 0};

// Values of render.h, which this room does not see because it names Vulkan; api/render_api.cpp holds them equal.
inline constexpr uint32_t kDisplayLayers = 5;
inline constexpr uint32_t kPayloadDefault = 0;
inline constexpr uint32_t kTailList = 2, kTailOnce = 3;
inline constexpr uint32_t kOutputCount = 4;

inline constexpr uint32_t kMaxSort = 32;

}  // namespace forelock
