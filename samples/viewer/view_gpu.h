// Functions of the viewer's own on the device that it shares with Forelock. SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"

#include <string>

namespace forelock::samples {

#define FORELOCK_VIEW_FUNCTIONS(X)                                                                                             \
  X(vkCreateSwapchainKHR)                                                                                                      \
  X(vkDestroySwapchainKHR) X(vkGetSwapchainImagesKHR) X(vkAcquireNextImageKHR) X(vkQueuePresentKHR) X(vkQueueSubmit2)          \
      X(vkCreateSemaphore) X(vkDestroySemaphore) X(vkCreateFence) X(vkDestroyFence) X(vkWaitForFences) X(vkResetFences)        \
          X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkResetCommandPool) X(vkAllocateCommandBuffers)                     \
              X(vkBeginCommandBuffer) X(vkEndCommandBuffer) X(vkCreateRenderPass) X(vkDestroyRenderPass)                       \
                  X(vkCreateFramebuffer) X(vkDestroyFramebuffer) X(vkCreateImageView) X(vkDestroyImageView)                    \
                      X(vkCmdBeginRenderPass) X(vkCmdEndRenderPass) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool)       \
                          X(vkDeviceWaitIdle) X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout)  \
                              X(vkDestroyDescriptorSetLayout) X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout)             \
                                  X(vkCreateGraphicsPipelines) X(vkDestroyPipeline) X(vkCreateSampler) X(vkDestroySampler)     \
                                      X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets) X(vkCmdBindPipeline)               \
                                          X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDraw) X(vkCmdSetViewport)    \
                                              X(vkCmdSetScissor) X(vkCmdClearColorImage) X(vkCmdCopyImageToBuffer)

struct ViewGpu {
#define FORELOCK_VIEW_DECLARE(name) PFN_##name name = nullptr;
  FORELOCK_VIEW_FUNCTIONS(FORELOCK_VIEW_DECLARE)
#undef FORELOCK_VIEW_DECLARE
  HeadlessHost::Device shared{};
  VkDevice device = VK_NULL_HANDLE;

  void load(const HeadlessHost& host);
};

}  // namespace forelock::samples
