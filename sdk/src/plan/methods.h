// The methods: a line each. Adding one means a line here, its pass file and its shaders.
#pragma once

#include <cstdint>

namespace forelock {

// What capture writes into a node.
enum class CaptureKind : uint8_t { tangent, color, display };
// What reads the lists.
enum class ResolveKind : uint8_t { core_tail, colors, exact, layers };

struct Method {
  const char* name;
  CaptureKind capture;
  ResolveKind resolve;
  bool shaded;           // lights matter
  bool shadow_in_capture;// the shadow map is read by capture, not by resolve
  bool sorts_front_only; // k_sort means something
  bool shades_front;     // k means something
  uint32_t low_taps;     // shadow map reads of a fragment behind the core; 0: there is no cheap shade
};

inline constexpr Method kMethods[] = {
    {"core_tail", CaptureKind::tangent, ResolveKind::core_tail, true, false, true, true, 1},
    {"exact", CaptureKind::tangent, ResolveKind::exact, true, false, false, false, 0},
    {"forward", CaptureKind::color, ResolveKind::colors, true, true, true, false, 0},
};
inline constexpr Method kDisplayMethod = {"display", CaptureKind::display, ResolveKind::colors, false, false, true, false, 0};
inline constexpr Method kLayersMethod = {"layers", CaptureKind::tangent, ResolveKind::layers, false, false, false, false, 0};

// Values of render.h, which this room does not see because it names Vulkan; api/render_api.cpp holds them equal.
inline constexpr uint32_t kDisplayLayers = 5;
inline constexpr uint32_t kPayloadDefault = 0;

inline constexpr uint32_t kFullTaps = 25;
inline constexpr uint32_t kMaxSort = 32;

}  // namespace forelock
