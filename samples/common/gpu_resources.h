// Images and buffers of a program's own on its device. SPDX-License-Identifier: MIT
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace forelock::samples {

struct GpuImage {
  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkImageSubresourceRange range{};  // all of it
  VkFormat format = VK_FORMAT_UNDEFINED;
  uint32_t width = 0, height = 0;
};

struct GpuBuffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
  VkDeviceSize size = 0;
};

struct GpuImageShape {
  uint32_t width = 1, height = 1, layers = 1;
  VkImageViewType view_type = VK_IMAGE_VIEW_TYPE_2D;
  VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
  VkImageUsageFlags usage = 0;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
};

// Makes and destroys them on one device; owns nothing.
class GpuResources {
public:
  void load(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical_device, VkDevice device);

  // False: no memory, or not the device's; the image is then empty.
  bool createImage(const GpuImageShape& shape, GpuImage& image) const;
  void destroy(GpuImage& image) const;
  // Host visible and mapped. Likewise.
  bool createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, GpuBuffer& buffer) const;
  void destroy(GpuBuffer& buffer) const;
  VkDeviceAddress address(const GpuBuffer& buffer) const;

  // Everything before, everything after: for programs that may wait.
  void transition(VkCommandBuffer cmd, VkImage image, const VkImageSubresourceRange& range, VkImageLayout from, VkImageLayout to) const;
  void transition(VkCommandBuffer cmd, const GpuImage& image, VkImageLayout from, VkImageLayout to) const;

private:
  uint32_t memoryType(uint32_t bits, VkMemoryPropertyFlags flags) const;

  VkDevice device_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  PFN_vkCreateImage create_image_ = nullptr;
  PFN_vkDestroyImage destroy_image_ = nullptr;
  PFN_vkCreateImageView create_view_ = nullptr;
  PFN_vkDestroyImageView destroy_view_ = nullptr;
  PFN_vkGetImageMemoryRequirements image_needs_ = nullptr;
  PFN_vkBindImageMemory bind_image_ = nullptr;
  PFN_vkCreateBuffer create_buffer_ = nullptr;
  PFN_vkDestroyBuffer destroy_buffer_ = nullptr;
  PFN_vkGetBufferMemoryRequirements buffer_needs_ = nullptr;
  PFN_vkBindBufferMemory bind_buffer_ = nullptr;
  PFN_vkAllocateMemory allocate_ = nullptr;
  PFN_vkFreeMemory free_ = nullptr;
  PFN_vkMapMemory map_ = nullptr;
  PFN_vkGetBufferDeviceAddress buffer_address_ = nullptr;
  PFN_vkCmdPipelineBarrier2 barrier_ = nullptr;
};

}  // namespace forelock::samples
