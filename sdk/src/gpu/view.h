// A view: memory that follows the plan, a ring of frames in flight, and what completed frames counted.
#pragma once

#include "gpu/context.h"
#include "gpu/hair.h"
#include "plan/plan.h"
#include "plan/pool.h"
#include "shared/frame.h"
#include "shared/light.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace forelock {

inline constexpr uint32_t kMaxFramesInFlight = 8;
inline constexpr uint32_t kTimestamps = FLK_STAGE_COUNT + 1;
// Stages in the order in which they run.
inline constexpr uint32_t kStageOrder[FLK_STAGE_COUNT] = {FLK_STAGE_CLEAR,   FLK_STAGE_PREPARE, FLK_STAGE_SHADOW,
                                                          FLK_STAGE_CAPTURE, FLK_STAGE_RESOLVE, FLK_STAGE_OUTPUT};
uint32_t stageOf(PassId id);

class View;

// What a host moves, as of a plan.
struct MovedHair {
  bool moved = false;
  VkDeviceAddress address = 0;
  uint32_t stride = 0;  // floats
  VkPipelineStageFlags2 entry_stages = 0;
  VkAccessFlags2 entry_access = 0;
};

// A descriptor set and the bindings that have been written to it.
struct BoundSet {
  VkDescriptorSet set = VK_NULL_HANDLE;
  uint32_t written = 0;
};

// A frame that is planned: everything flkCmdRender needs.
struct Frame {
  explicit Frame(std::pmr::memory_resource* memory) : light_values(memory) {}

  View* view = nullptr;
  uint32_t slot = 0;    // in the ring
  uint64_t number = 0;  // 0: never used
  FramePlan plan;
  std::array<Hair*, kMaxHairs> hairs{};
  std::array<MovedHair, kMaxHairs> moved{};
  std::array<Mat4, kMaxHairs> world_from_hair{};
  uint32_t hair_count = 0;
  uint64_t bytes_persistent = 0;  // a plan may be asked after its hairs are gone
  std::array<VkPipeline, 16> pipelines{};  // by pass of the plan
  std::array<uint64_t, 16> hashes{};
  BoundSet bound;                            // of all passes but outputs
  std::array<BoundSet, FLK_OUTPUT_COUNT> output_bound;  // whose target is the output
  FlkColorTarget target{};
  FlkDepthSource depth{};
  FlkSampledImage host_shadow_maps{}, host_visibility{};
  FlkLightTiles light_tiles{};
  FlkOutputImage outputs[FLK_OUTPUT_COUNT]{};
  // The view's memory as of this plan; a later plan may have replaced it.
  VkBuffer constants = VK_NULL_HANDLE, lights = VK_NULL_HANDLE, heads = VK_NULL_HANDLE, counters = VK_NULL_HANDLE,
           aggregates = VK_NULL_HANDLE;
  VkDeviceAddress node_address = 0, aggregate_address = 0, light_address = 0;
  Image shadow_map;
  gpu::FrameConstants values{};
  std::pmr::vector<std::byte> light_values;  // lights, faces, motion of hairs
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
  FlkResult shadowMap(uint32_t light, uint32_t face, FlkShadowMap& map) const;
  Context& context() const { return context_; }

private:
  struct Retired {
    Buffer buffer;
    Image image;
    uint64_t last_frame;
  };

  uint64_t nodeLimit(uint64_t node_bytes) const;
  Frame* freeSlot(uint64_t completed);
  void learn(uint64_t completed);  // from counts of completed frames
  void freeRetired(uint64_t completed);
  FlkResult replace(Buffer& buffer, uint64_t bytes, VkBufferUsageFlags usage, const char* name);
  FlkResult follow(Buffer& buffer, uint32_t& small_frames, uint64_t bytes, VkBufferUsageFlags usage, const char* name);
  FlkResult ensureMemory(const FramePlan& plan);
  FlkResult ensureRing(const FramePlan& plan);
  FlkResult ensureSet(VkDescriptorPool pool, BoundSet& bound, uint32_t needed);
  FlkResult ensureSets(Frame& frame, const FramePlan& plan);
  void writeSet(Frame& frame, BoundSet& bound, VkImageView storage, uint32_t needed);
  void recordClear(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline);
  void recordPrepare(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline);
  void recordShadow(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline);
  VkImageMemoryBarrier2 shadowDone(const Frame& frame) const;
  void recordCapture(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline);
  void recordOutput(VkCommandBuffer cmd, const Frame& frame, const Pass& pass, VkPipeline pipeline);
  void drawHair(VkCommandBuffer cmd, const Frame& frame, uint32_t index, const ShadowFace* face, uint32_t face_index);
  bool drawable(const Frame& frame, uint32_t index) const;
  void readStatistics(const Frame& frame);

  Context& context_;
  uint64_t pool_budget_ = 0;
  uint64_t last_number_ = 0, last_completed_ = 0, learnt_ = 0;
  PoolState pool_;
  uint32_t small_heads_ = 0, small_aggregates_ = 0;  // consecutive plans that needed less than half
  FlkStatistics latest_{};  // of frame learnt_
  std::pmr::vector<Frame> frames_;  // as many as may be in flight; never resized, plans point into it
  std::pmr::vector<Retired> retired_;

  Buffer constants_, lights_, heads_, nodes_, aggregates_, counters_, read_back_;
  Image shadow_map_;
  VkDescriptorPool set_pool_ = VK_NULL_HANDLE, output_pool_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
};

// Camera and materials as the shaders read them.
void fillConstants(Frame& frame, const FlkFrame& asked, const Camera& camera, const HairFacts* facts);
// Lights, their shadow maps and what moved.
void fillLights(Frame& frame, const FlkFrame& asked, const Camera& camera, std::span<const LightFacts> lights);

}  // namespace forelock
