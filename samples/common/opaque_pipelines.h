// How opaque meshes are drawn: pipelines, barriers, draws. SPDX-License-Identifier: MIT
#pragma once

#include "gpu_resources.h"
#include "headless_host.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <span>
#include <string>
#include <vector>

namespace forelock::samples {

struct OpaqueDraw {
  VkBuffer buffer = VK_NULL_HANDLE;  // positions from 0 on
  VkDeviceSize normals_at = 0, openness_at = 0, indices_at = 0;
  uint32_t index_count = 0;
  glm::vec3 albedo{0.0f};
};

// As opaque_push.glsl has it.
struct OpaquePush {
  glm::mat4 clip_from_world{1.0f};
  glm::vec4 light{0.0f};
  float behind = 0.0f;
  glm::vec3 albedo{0.0f};
  VkDeviceAddress frame = 0, lights = 0, faces = 0;
};
static_assert(sizeof(OpaquePush) == 120);

#define FORELOCK_OPAQUE_FUNCTIONS(X)                                                                                                   \
  X(vkCreateSampler) X(vkDestroySampler) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout) X(vkCreatePipelineLayout)      \
  X(vkDestroyPipelineLayout) X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreateGraphicsPipelines) X(vkDestroyPipeline)        \
  X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool) X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets) X(vkCreateImageView)      \
  X(vkDestroyImageView) X(vkCmdPipelineBarrier2) X(vkCmdBeginRendering) X(vkCmdEndRendering) X(vkCmdBindPipeline)                      \
  X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdSetViewport) X(vkCmdSetScissor) X(vkCmdSetDepthCompareOp)                    \
  X(vkCmdBindVertexBuffers) X(vkCmdBindIndexBuffer) X(vkCmdDrawIndexed)

class OpaquePipelines {
public:
  bool create(const HeadlessHost::Device& device, std::string& error);
  void destroy();

  VkImageView layerView(const GpuImage& image, uint32_t layer) const;
  void destroyView(VkImageView view) const;

  // All layers of a depth image, whatever was in it, to be drawn to; what recordDepth() has drawn to be sampled, and tested against.
  void beforeDepth(VkCommandBuffer cmd, const GpuImage& image) const;
  void afterDepth(VkCommandBuffer cmd, const GpuImage& image, VkImageLayout layout) const;
  void recordDepth(VkCommandBuffer cmd, VkImageView view, VkExtent2D size, bool reversed, const OpaquePush& push, std::span<const OpaqueDraw> draws) const;

  // For the recordColor() that follows; none that was recorded before may be in flight or still to be submitted.
  void bindImages(VkImageView hair_map, VkImageView mesh_maps) const;
  void recordColor(VkCommandBuffer cmd, const GpuImage& target, const GpuImage& depth, const OpaquePush& push, std::span<const OpaqueDraw> draws) const;

private:
  VkPipeline makePipeline(bool color) const;
  void draw(VkCommandBuffer cmd, VkExtent2D size, OpaquePush push, std::span<const OpaqueDraw> draws) const;
  void barrier(VkCommandBuffer cmd, const VkImageMemoryBarrier2& image) const;

#define FORELOCK_OPAQUE_DECLARE(name) PFN_##name name##_ = nullptr;
  FORELOCK_OPAQUE_FUNCTIONS(FORELOCK_OPAQUE_DECLARE)
#undef FORELOCK_OPAQUE_DECLARE
  VkDevice device_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkShaderModule vertex_ = VK_NULL_HANDLE, fragment_ = VK_NULL_HANDLE;
  VkPipeline depth_ = VK_NULL_HANDLE, color_ = VK_NULL_HANDLE;
};

}  // namespace forelock::samples
