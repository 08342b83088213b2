// What a frame is asked for, as facts without a device.
#pragma once

#include "plan/camera.h"
#include "plan/methods.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace forelock {

template <class T, std::size_t N> struct FixedList {
  std::array<T, N> items{};
  std::size_t count = 0;
  void add(const T& item) { items[count++] = item; }
  const T* begin() const { return items.data(); }
  const T* end() const { return items.data() + count; }
  T* begin() { return items.data(); }
  T* end() { return items.data() + count; }
};

struct HairFacts {
  uint64_t segments = 0;
  uint64_t strands = 0;
  Box bounds;                  // of its vertices, hair space
  Mat4 world_from_hair = kIdentity;
  double radius = 0;           // largest, metre in the world
  double length = 0;           // of all strands, metre in the world
  bool host_positions = false; // read from the host every frame
  bool colors = false;         // vary along or between its strands
};

enum class LightKind : uint8_t { directional, point, spot };

struct LightFacts {
  bool casts_shadow = false;
  uint32_t shadow_size = 1024;
  bool cover_width = false;    // its maps are covered by width
  LightKind kind = LightKind::directional;
  Vec3 direction{0, 0, 1};     // unit, to the light (directional), against the axis (spot); world
  Vec3 position{};             // world
  double outer_angle = 0;      // radian
  bool host_shadow = false, host_visibility = false;
};

struct FrameFacts {
  Camera camera;
  std::span<const HairFacts> hairs;
  std::span<const LightFacts> lights;
  uint32_t method = 0;                 // index of kMethods
  uint32_t display = 0;                // FLK_DISPLAY_...
  uint32_t payload = 0;
  uint32_t tail = 0;                   // FLK_TAIL_...
  uint32_t k = 8, k_sort = 8;
  uint32_t core_taps = kFullTaps;
  uint32_t low_shade = 0;              // FLK_LOW_SHADE_...
  bool compute = false;                // capture and shadow maps without a rasteriser
  bool cpu = false;                    // the device's processors are those of the host
  bool drop_overflow = false;
  bool count_only = false;
  bool count_work = false;
  bool ambient_sh = false;
  bool light_tiles = false;
  uint32_t modifiers = 0;              // 2 bits each: FLK_OPACITY_...
  uint32_t outputs = 0;                // bit FLK_OUTPUT_...
  bool has_depth = false;
  uint32_t timestamps = 0;  // FLK_TIMESTAMPS_...
  uint32_t frames_in_flight = 3;       // whose counts are read back
  uint32_t image_limit = 16384;        // texels a side
};

}  // namespace forelock
