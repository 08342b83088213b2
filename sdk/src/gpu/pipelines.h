// Descriptor and pipeline layouts, and pipelines by recipe, compiled when a plan first needs them.
#pragma once

#include "gpu/device.h"
#include "passes/recipe.h"

#include <memory_resource>
#include <vector>

namespace forelock {

// shaders/passes/bindings.glsl.
enum Binding : uint32_t {
  kBindFrame,
  kBindHeads,
  kBindCounters,
  kBindHostDepth,
  kBindShadowMap,
  kBindTarget,
  kBindHostShadowMaps,
  kBindHostVisibility,
  kBindShadowStore,
  kBindFrameStored,  // of kBindFrame's buffer
  kBindingCount
};
VkDescriptorType bindingType(uint32_t binding);

// Push constants of any pass lie in the first bytes.
inline constexpr uint32_t kPushBytes = 64;
inline constexpr VkShaderStageFlags kPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;

class Pipelines {
public:
  explicit Pipelines(std::pmr::memory_resource* memory) : cache_(memory) {}

  FlkResult init(Device& device);
  void destroy(Device& device);

  // Compiles if need be. `pipeline` stays valid until destroy(). FLK_ERROR_NOT_BUILT: this build lacks the shader.
  FlkResult get(Device& device, const Recipe& recipe, VkPipeline& pipeline, uint64_t& hash);

  VkDescriptorSetLayout view_set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;

private:
  struct Entry {
    Recipe recipe;
    VkPipeline pipeline;
    uint64_t hash;
  };
  std::pmr::vector<Entry> cache_;
  VkSampler shadow_sampler_ = VK_NULL_HANDLE;  // nearest, clamped to the edge; a part of the set layout
};

}  // namespace forelock
