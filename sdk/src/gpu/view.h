// A view: memory that follows the plan, a ring of frames in flight, and what completed frames counted.
#pragma once

#include "gpu/context.h"
#include "gpu/hair.h"
#include "plan/plan.h"
#include "plan/pool.h"
#include "shared/frame.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace forelock {

inline constexpr uint32_t kMaxFramesInFlight = 8;
inline constexpr uint32_t kTimestamps = FLK_STAGE_COUNT + 1;

class View;

// A frame that is planned: everything flkCmdRender needs.
struct Frame {
  View* view = nullptr;
  uint32_t slot = 0;    // in the ring
  uint64_t number = 0;  // 0: never used
  FramePlan plan;
  std::array<Hair*, kMaxHairs> hairs{};
  uint32_t hair_count = 0;
  uint64_t bytes_persistent = 0;  // a plan may be asked after its hairs are gone
  VkPipeline shadow = VK_NULL_HANDLE, capture = VK_NULL_HANDLE, resolve = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  bool set_has_depth = false, set_has_shadow = false;  // what has been written to it
  FlkColorTarget target{};
  FlkDepthSource depth{};
  // The view's memory as of this plan; a later plan may have replaced it.
  VkBuffer constants = VK_NULL_HANDLE, heads = VK_NULL_HANDLE, counters = VK_NULL_HANDLE;
  VkDeviceAddress node_address = 0;
  Image shadow_map;
  Mat4 texels_from_world = kIdentity;
  float shadow_range = 0, shadow_texel = 0;
  gpu::FrameConstants values{};
  bool recorded = false;
};

class View {
public:
  explicit View(Context& context) : context_(context), frames_(&context.memory()), retired_(&context.memory()) {}

  FlkResult init(const FlkViewDesc& desc);
  void destroy();

  // `hairs`: those of the frame, in order.
  FlkResult plan(const FlkFrame& asked, Hair* const* hairs, Frame*& planned);
  void record(VkCommandBuffer cmd, Frame& frame);
  FlkResult statistics(uint64_t completed, FlkStatistics& statistics);
  FlkResult shadowMap(FlkShadowMap& map) const;
  Context& context() const { return context_; }

private:
  struct Retired {
    Buffer buffer;
    Image image;
    uint64_t last_frame;
  };

  uint64_t nodeLimit() const;
  Frame* freeSlot(uint64_t completed);
  void learn(uint64_t completed);  // from counts of completed frames
  void freeRetired(uint64_t completed);
  FlkResult replace(Buffer& buffer, uint64_t bytes, const char* name);
  FlkResult ensureMemory(const FramePlan& plan);
  FlkResult ensureRing(bool timestamps);
  FlkResult ensureSet(Frame& frame, const FramePlan& plan);
  void writeSet(Frame& frame);
  void recordShadow(VkCommandBuffer cmd, const Frame& frame);
  void recordCapture(VkCommandBuffer cmd, const Frame& frame);
  void drawHair(VkCommandBuffer cmd, const Frame& frame, uint32_t index);
  void readStatistics(const Frame& frame);

  Context& context_;
  uint64_t pool_budget_ = 0;
  uint64_t last_number_ = 0, last_completed_ = 0, learnt_ = 0;
  PoolState pool_;
  uint32_t small_heads_ = 0;  // consecutive plans that needed less than half of the heads
  FlkStatistics latest_{};  // of frame learnt_
  std::pmr::vector<Frame> frames_;  // as many as may be in flight; never resized, plans point into it
  std::pmr::vector<Retired> retired_;

  Buffer constants_, heads_, nodes_, counters_, read_back_;
  Image shadow_map_;
  VkDescriptorPool set_pool_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
};

// Camera, light and materials as the shaders read them; also the shadow map's axes into `frame`.
void fillConstants(Frame& frame, const FlkFrame& asked, const Camera& camera, const HairFacts* facts);

}  // namespace forelock
