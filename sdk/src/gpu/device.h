// The host's device as Forelock uses it: function table, memory, buffers, images. The only room that calls Vulkan.
#pragma once

#include "host/memory.h"

#include "forelock/render.h"

#include <cstdint>

namespace forelock {

#define FLK_INSTANCE_FUNCTIONS(X)        \
  X(vkGetDeviceProcAddr)                 \
  X(vkGetPhysicalDeviceProperties2)      \
  X(vkGetPhysicalDeviceFeatures2)        \
  X(vkGetPhysicalDeviceMemoryProperties) \
  X(vkGetPhysicalDeviceQueueFamilyProperties)

#define FLK_DEVICE_FUNCTIONS(X)   \
  X(vkAllocateDescriptorSets)     \
  X(vkAllocateMemory)             \
  X(vkBindBufferMemory)           \
  X(vkBindImageMemory)            \
  X(vkCmdBeginRendering)          \
  X(vkCmdBindDescriptorSets)      \
  X(vkCmdBindIndexBuffer)         \
  X(vkCmdBindPipeline)            \
  X(vkCmdCopyBuffer)              \
  X(vkCmdDispatch)                \
  X(vkCmdDrawIndexed)             \
  X(vkCmdEndRendering)            \
  X(vkCmdFillBuffer)              \
  X(vkCmdPipelineBarrier2)        \
  X(vkCmdPushConstants)           \
  X(vkCmdResetQueryPool)          \
  X(vkCmdSetScissor)              \
  X(vkCmdSetViewport)             \
  X(vkCmdUpdateBuffer)            \
  X(vkCmdWriteTimestamp2)         \
  X(vkCreateBuffer)               \
  X(vkCreateComputePipelines)     \
  X(vkCreateDescriptorPool)       \
  X(vkCreateDescriptorSetLayout)  \
  X(vkCreateGraphicsPipelines)    \
  X(vkCreateImage)                \
  X(vkCreateImageView)            \
  X(vkCreatePipelineLayout)       \
  X(vkCreateQueryPool)            \
  X(vkCreateSampler)              \
  X(vkCreateShaderModule)         \
  X(vkDestroyBuffer)              \
  X(vkDestroyDescriptorPool)      \
  X(vkDestroyDescriptorSetLayout) \
  X(vkDestroyImage)               \
  X(vkDestroyImageView)           \
  X(vkDestroyPipeline)            \
  X(vkDestroyPipelineLayout)      \
  X(vkDestroyQueryPool)           \
  X(vkDestroySampler)             \
  X(vkDestroyShaderModule)        \
  X(vkFreeDescriptorSets)         \
  X(vkFreeMemory)                 \
  X(vkGetBufferDeviceAddress)     \
  X(vkGetBufferMemoryRequirements)\
  X(vkGetImageMemoryRequirements) \
  X(vkGetQueryPoolResults)        \
  X(vkMapMemory)                  \
  X(vkUpdateDescriptorSets)

struct Functions {
#define FLK_DECLARE(name) PFN_##name name = nullptr;
  FLK_INSTANCE_FUNCTIONS(FLK_DECLARE)
  FLK_DEVICE_FUNCTIONS(FLK_DECLARE)
#undef FLK_DECLARE
};

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  FlkDeviceAllocation memory{};
  uint64_t size = 0;
  VkDeviceAddress address = 0;  // where its usage asks for one
};

struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  FlkDeviceAllocation memory{};
  VkImageView store_view = VK_NULL_HANDLE;  // R32_UINT, of one that compute shaders write
  uint32_t width = 0, height = 0;
  bool computed = false;  // written by compute shaders: R32, else D32_SFLOAT
};

FlkResult toResult(VkResult result);

// Without a VkDevice (planning) nothing is created and create... succeed with empty handles.
class Device {
public:
  Device() = default;
  // FLK_ERROR_UNSUPPORTED_DEVICE: said which requirement fails.
  FlkResult init(const FlkContextDesc& desc, const Messages& messages);

  bool planning() const { return device == VK_NULL_HANDLE; }

  // host_visible: mapped for as long as the buffer lives, coherent.
  FlkResult createBuffer(uint64_t size, VkBufferUsageFlags usage, bool host_visible, const char* name, Buffer& buffer);
  FlkResult createMapImage(uint32_t width, uint32_t height, bool computed, const char* name, Image& image);
  void destroy(Buffer& buffer);
  void destroy(Image& image);

  Functions fn;
  VkDevice device = VK_NULL_HANDLE;
  VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
  VkPhysicalDeviceLimits limits{};
  uint32_t timestamp_bits = 0;
  bool graphics = true;  // the queue rasterises
  bool cpu = false;      // its processors are those of the host
  Messages messages;

private:
  FlkResult allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted, VkMemoryPropertyFlags preferred,
                     bool address, const char* name, FlkDeviceAllocation& allocation);
  void release(FlkDeviceAllocation& allocation);

  VkPhysicalDeviceMemoryProperties memory_{};
  FlkDeviceAllocator allocator_{};
  bool host_allocates_ = false;
};

}  // namespace forelock
