// Descriptor and pipeline layouts, and pipelines by recipe, compiled when a plan first needs them.
#pragma once

#include "gpu/device.h"
#include "passes/recipe.h"

#include <memory_resource>
#include <vector>

namespace forelock {

// Set 0: the view's; set 1: a hair's. shaders/passes/bindings.glsl.
enum Binding : uint32_t { kBindFrame, kBindHeads, kBindCounters, kBindHostDepth, kBindShadowMap, kBindTarget };

class Pipelines {
public:
  explicit Pipelines(std::pmr::memory_resource* memory) : cache_(memory) {}

  FlkResult init(Device& device);
  void destroy(Device& device);

  // Compiles if need be. `pipeline` stays valid until destroy().
  FlkResult get(Device& device, const Recipe& recipe, VkPipeline& pipeline);

  VkDescriptorSetLayout view_set = VK_NULL_HANDLE;
  VkDescriptorSetLayout hair_set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;

private:
  struct Entry {
    Recipe recipe;
    VkPipeline pipeline;
  };
  std::pmr::vector<Entry> cache_;
};

}  // namespace forelock
