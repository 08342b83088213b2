// SPDX-License-Identifier: MIT
#include "gpu_resources.h"

#include <type_traits>

namespace forelock::samples {

void GpuResources::load(PFN_vkGetInstanceProcAddr get, VkInstance instance, VkPhysicalDevice physical_device, VkDevice device) {
  device_ = device;
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get(instance, "vkGetDeviceProcAddr"));
  const auto load = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(get_device(device, name));
  };
  load(create_image_, "vkCreateImage");
  load(destroy_image_, "vkDestroyImage");
  load(create_view_, "vkCreateImageView");
  load(destroy_view_, "vkDestroyImageView");
  load(image_needs_, "vkGetImageMemoryRequirements");
  load(bind_image_, "vkBindImageMemory");
  load(create_buffer_, "vkCreateBuffer");
  load(destroy_buffer_, "vkDestroyBuffer");
  load(buffer_needs_, "vkGetBufferMemoryRequirements");
  load(bind_buffer_, "vkBindBufferMemory");
  load(allocate_, "vkAllocateMemory");
  load(free_, "vkFreeMemory");
  load(map_, "vkMapMemory");
  load(buffer_address_, "vkGetBufferDeviceAddress");
  load(barrier_, "vkCmdPipelineBarrier2");
  reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(get(instance, "vkGetPhysicalDeviceMemoryProperties"))(physical_device, &memory_);
}

uint32_t GpuResources::memoryType(uint32_t bits, VkMemoryPropertyFlags flags) const {
  for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    if ((bits >> i & 1) && (memory_.memoryTypes[i].propertyFlags & flags) == flags) {
      return i;
    }
  }
  return 0;
}

bool GpuResources::createImage(const GpuImageShape& shape, GpuImage& image) const {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = shape.format;
  info.extent = {shape.width, shape.height, 1};
  info.mipLevels = 1;
  info.arrayLayers = shape.layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = shape.usage;
  image = {};
  image.format = shape.format;
  image.width = shape.width;
  image.height = shape.height;
  image.range = {shape.aspect, 0, 1, 0, shape.layers};
  if (create_image_(device_, &info, nullptr, &image.image) != VK_SUCCESS) {
    image = {};
    return false;
  }
  VkMemoryRequirements needs{};
  image_needs_(device_, image.image, &needs);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkImageViewCreateInfo view{};
  view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  view.image = image.image;
  view.viewType = shape.view_type;
  view.format = shape.format;
  view.subresourceRange = image.range;
  if (allocate_(device_, &allocate, nullptr, &image.memory) != VK_SUCCESS || bind_image_(device_, image.image, image.memory, 0) != VK_SUCCESS ||
      create_view_(device_, &view, nullptr, &image.view) != VK_SUCCESS) {
    destroy(image);
    return false;
  }
  return true;
}

void GpuResources::destroy(GpuImage& image) const {
  if (image.view) {
    destroy_view_(device_, image.view, nullptr);
  }
  if (image.image) {
    destroy_image_(device_, image.image, nullptr);
  }
  if (image.memory) {
    free_(device_, image.memory, nullptr);
  }
  image = {};
}

bool GpuResources::createBuffer(VkDeviceSize size, VkBufferUsageFlags usage, GpuBuffer& buffer) const {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  buffer = {};
  if (create_buffer_(device_, &info, nullptr, &buffer.buffer) != VK_SUCCESS) {
    buffer = {};
    return false;
  }
  VkMemoryRequirements needs{};
  buffer_needs_(device_, buffer.buffer, &needs);
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.pNext = usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT ? &flags : nullptr;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = memoryType(needs.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  buffer.size = size;
  if (allocate_(device_, &allocate, nullptr, &buffer.memory) != VK_SUCCESS || bind_buffer_(device_, buffer.buffer, buffer.memory, 0) != VK_SUCCESS ||
      map_(device_, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped) != VK_SUCCESS) {
    destroy(buffer);
    return false;
  }
  return true;
}

void GpuResources::destroy(GpuBuffer& buffer) const {
  if (buffer.buffer) {
    destroy_buffer_(device_, buffer.buffer, nullptr);
  }
  if (buffer.memory) {
    free_(device_, buffer.memory, nullptr);
  }
  buffer = {};
}

VkDeviceAddress GpuResources::address(const GpuBuffer& buffer) const {
  VkBufferDeviceAddressInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  info.buffer = buffer.buffer;
  return buffer_address_(device_, &info);
}

void GpuResources::transition(VkCommandBuffer cmd, VkImage image, const VkImageSubresourceRange& range, VkImageLayout from,
                              VkImageLayout to) const {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = range;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  barrier_(cmd, &info);
}

void GpuResources::transition(VkCommandBuffer cmd, const GpuImage& image, VkImageLayout from, VkImageLayout to) const {
  transition(cmd, image.image, image.range, from, to);
}

}  // namespace forelock::samples
