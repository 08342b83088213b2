// The plan: what a frame needs, decided on the CPU from facts alone. Everything that "leave out what the scene does not need"
// means is decided here, once; the GPU room allocates and records what is listed, nothing else.
#pragma once

#include "plan/camera.h"
#include "plan/methods.h"

#include <array>
#include <cstdint>
#include <span>

namespace forelock {

inline constexpr uint32_t kMaxHairs = 63;
inline constexpr uint64_t kNodeBytes = 12;
inline constexpr uint64_t kMaxNodes = (1u << 26) - 1;

// ---- Asked ----

struct HairFacts {
  uint64_t segments = 0;
  Box bounds;                  // of its vertices, hair space
  Mat4 world_from_hair = kIdentity;
  double radius = 0;           // largest, metre in the world
  double length = 0;           // of all strands, metre in the world
};

struct LightFacts {
  bool casts_shadow = false;
  uint32_t shadow_size = 1024;
};

struct FrameFacts {
  Camera camera;
  std::span<const HairFacts> hairs;
  std::span<const LightFacts> lights;  // [0, 1]
  uint32_t method = 0;                 // index of kMethods
  uint32_t display = 0;                // FLK_DISPLAY_...
  uint32_t payload = 0;
  uint32_t k = 8, k_sort = 8;
  bool has_depth = false;
  bool timestamps = false;
};

// ---- Needed ----

enum class PassId : uint8_t { clear, shadow, capture, resolve };

struct Pass {
  PassId id{};
  const char* name = "";
  uint32_t groups[3] = {0, 0, 0};  // of a compute pass
  uint64_t indices = 0;            // of a raster pass
};

enum class ResourceId : uint8_t { constants, heads, nodes, counters, read_back, shadow_map };

struct Resource {
  ResourceId id{};
  const char* name = "";
  uint64_t bytes = 0;
  bool transient = true;
  const char* why = "";
};

template <class T, std::size_t N> struct FixedList {
  std::array<T, N> items{};
  std::size_t count = 0;
  void add(const T& item) { items[count++] = item; }
  const T* begin() const { return items.data(); }
  const T* end() const { return items.data() + count; }
};

struct FramePlan {
  FixedList<Pass, 8> passes;
  FixedList<Resource, 12> resources;
  FixedList<const char*, 12> omissions;
  const Method* method = nullptr;
  Rect rect;                 // of the hair on screen
  uint64_t visible = 0;      // bit i: hair i touches the screen
  double nearest = 0, farthest = 0;  // view depths of the visible hairs
  uint64_t segments = 0;     // captured
  uint64_t estimate = 0;     // upper estimate of fragments
  uint64_t node_capacity = 0;
  uint32_t shadow_size = 0;  // 0: no shadow pass
  uint32_t k = 0, k_sort = 0, payload = 0, display = 0;
  bool one_hair = false;     // fragments need no slot to be told apart
  bool has_depth = false;
  bool timestamps = false;

  bool has(PassId id) const;
  uint64_t bytes(ResourceId id) const;
  uint64_t transientBytes() const;
};

// Pure: no allocation, no Vulkan. `node_capacity` is decided apart (pool.h), because it looks at past frames.
FramePlan planFrame(const FrameFacts& facts, uint64_t node_capacity);

// The upper estimate of fragments alone, for choosing the capacity.
uint64_t estimateFragments(const FrameFacts& facts);

}  // namespace forelock
