// Compute kernels of the study's own, on the device that is measured. SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>

namespace forelock::study {

#define FORELOCK_BENCH_FUNCTIONS(X)                                                                                        \
  X(vkCreateBuffer)                                                                                                        \
  X(vkDestroyBuffer) X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) X(vkAllocateMemory) X(vkFreeMemory)            \
      X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout)      \
          X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) X(vkCreateComputePipelines) X(vkDestroyPipeline)            \
              X(vkCreateSampler) X(vkDestroySampler) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool) X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets)   \
                  X(vkCmdBindPipeline) X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch) X(vkCmdCopyBuffer) \
                      X(vkCmdFillBuffer) X(vkCmdUpdateBuffer) X(vkCmdPipelineBarrier2) X(vkGetBufferDeviceAddress)

struct BenchFunctions {
#define FORELOCK_BENCH_DECLARE(name) PFN_##name name = nullptr;
  FORELOCK_BENCH_FUNCTIONS(FORELOCK_BENCH_DECLARE)
#undef FORELOCK_BENCH_DECLARE
};

// One pipeline, one descriptor set and up to three buffers. Owns what it made, which goes with it, also after a throw.
class ComputeBench {
public:
  explicit ComputeBench(samples::HeadlessHost& host);
  ~ComputeBench();
  ComputeBench(const ComputeBench&) = delete;
  ComputeBench& operator=(const ComputeBench&) = delete;

protected:
  struct Binding {
    uint32_t index;
    VkBuffer buffer;    // or
    VkImageView image;  // in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, read as nearest, clamped to the edge
    bool uniform = false;  // the buffer is bound as a uniform buffer
  };
  // Device memory.
  VkBuffer makeBuffer(VkDeviceSize size);
  VkDeviceAddress addressOf(VkBuffer buffer) const;
  void write(VkBuffer buffer, std::span<const std::byte> bytes);
  void makePipeline(std::span<const uint32_t> code, uint32_t push_bytes, std::initializer_list<Binding> bindings,
                    const VkSpecializationInfo* constants = nullptr);
  void dispatch(VkCommandBuffer cmd, const void* push, uint32_t groups_x, uint32_t groups_y = 1) const;
  // All that came before, for all that follows.
  void barrier(VkCommandBuffer cmd) const;
  // Wall clock of one submission.
  double seconds(const std::function<void(VkCommandBuffer)>& record);
  // Of one run of `work`, the least of `attempts`: so many runs a submission that its own cost does not count, within bounds.
  double secondsOfOne(const std::function<void(VkCommandBuffer)>& work, int attempts);
  bool onProcessor() const { return host_.deviceType() == VK_PHYSICAL_DEVICE_TYPE_CPU; }

  samples::HeadlessHost& host_;
  BenchFunctions fn_;

private:
  static VkDescriptorType typeOf(const Binding& binding);

  VkDevice device_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkBuffer buffers_[3] = {};
  VkDeviceMemory memories_[3] = {};
  uint32_t buffer_count_ = 0, push_bytes_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkShaderModule module_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace forelock::study
