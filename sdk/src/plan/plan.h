// The plan: what a frame needs, decided on the CPU from facts alone. Everything that "leave out what the scene does not need"
// means is decided here, once; the GPU room allocates and records what is listed, nothing else.
#pragma once

#include "plan/facts.h"
#include "plan/shadow_maps.h"

namespace forelock {

inline constexpr uint32_t kMaxHairs = 63;
inline constexpr uint32_t kMaxLights = 4096;
inline constexpr uint64_t kNodeBytes = 12;
inline constexpr uint64_t kColorNodeBytes = 16;
inline constexpr uint64_t kMaxNodes = (1u << 26) - 1;

enum class PassId : uint8_t { clear, prepare, shadow, count, capture, hard_depth, hard_payload, resolve, output };

struct Pass {
  PassId id{};
  const char* name = "";
  uint32_t groups[3] = {0, 0, 0};  // of a pass of one dispatch
  uint64_t indices = 0;            // of a raster pass
  uint64_t segments = 0;           // of a shadow or capture pass by compute
  uint32_t output = 0;             // of an output pass: FLK_OUTPUT_...
};

enum class ResourceId : uint8_t { constants, lights, heads, nodes, aggregates, counters, read_back, shadow_map };

struct Resource {
  ResourceId id{};
  const char* name = "";
  uint64_t bytes = 0;
  bool transient = true;
  const char* why = "";
};

// Bits of what a pass may be bound to beyond its own memory: a shader is compiled for each set of them.
enum Images : uint8_t { kImageDepth = 1, kImageShadow = 2, kImageHostLight = 4 };

struct FramePlan {
  const char* fault = nullptr;  // why the frame cannot be had; then nothing else holds
  FixedList<Pass, 16> passes;
  FixedList<Resource, 12> resources;
  FixedList<const char*, 32> omissions;
  const Method* method = nullptr;
  Rect rect;                 // of the hair on screen
  uint64_t visible = 0;      // bit i: hair i touches the screen
  double nearest = 0, farthest = 0;  // view depths of the visible hairs
  uint64_t segments = 0;     // captured
  uint64_t estimate = 0;     // upper estimate of fragments
  uint64_t node_capacity = 0;
  bool node_shares = false;  // nodes come in shares (shared/node.h)
  bool lockstep = false;     // lanes leave a loop together (passes/light.glsl)
  bool long_first = false;   // tiles with long lists are resolved before the others
  ShadowLayout shadow;
  uint32_t k = 0, k_sort = 0, payload = 0, display = 0;
  bool one_hair = false;     // fragments need no slot to be told apart
  bool has_depth = false;
  uint32_t timestamps = 0;   // FLK_TIMESTAMPS_...
  bool compute = false;
  bool count_only = false;
  bool count_work = false;
  bool colors = false;       // nodes carry the fibre's colour
  bool fibre_colors = false; // strands have colours that vary
  bool aggregate = false;
  bool ambient_sh = false;
  uint32_t tail = 0;         // FLK_TAIL_KIND_...
  uint32_t full_taps = 0, low_taps = 0;  // shadow map reads of a shade
  uint32_t low_shade = 0;    // FLK_LOW_SHADE_...
  uint32_t light_mode = 0;   // FLK_LIGHTS_...
  uint32_t light_count = 0;
  uint32_t light_kinds = 0;  // bits of LightKind
  uint32_t face_kinds = 0;   // FLK_FACES_...
  bool cover_width = false;  // a shadow map is covered by width
  uint32_t host_light = 0;   // FLK_HOST_...
  uint32_t modifiers = 0;
  uint32_t outputs = 0;

  bool has(PassId id) const;
  bool hasShadow() const { return shadow.faces.count != 0; }
  uint64_t bytes(ResourceId id) const;
  uint64_t transientBytes() const;
};

// Pure: no allocation, no Vulkan. `node_capacity` is decided apart (pool.h), because it looks at past frames.
FramePlan planFrame(const FrameFacts& facts, uint64_t node_capacity);

// The upper estimate of fragments alone, for choosing the capacity.
uint64_t estimateFragments(const FrameFacts& facts);
// Bytes a fragment takes in the frame's lists.
uint64_t nodeBytes(const FrameFacts& facts);

}  // namespace forelock
