#include "gpu/device.h"

#include <algorithm>
#include <cinttypes>

namespace forelock {
namespace {

// vkAllocateMemory by ourselves, where the host does not want to.
uint32_t findMemoryType(const VkPhysicalDeviceMemoryProperties& memory, uint32_t bits, VkMemoryPropertyFlags flags) {
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i)
    if ((bits >> i & 1) && (memory.memoryTypes[i].propertyFlags & flags) == flags) return i;
  return UINT32_MAX;
}

}  // namespace

FlkResult toResult(VkResult result) {
  switch (result) {
    case VK_SUCCESS: return FLK_SUCCESS;
    case VK_ERROR_OUT_OF_HOST_MEMORY: return FLK_ERROR_OUT_OF_HOST_MEMORY;
    case VK_ERROR_DEVICE_LOST: return FLK_ERROR_DEVICE_LOST;
    default: return FLK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
}

FlkResult Device::init(const FlkContextDesc& desc, const Messages& context_messages) {
  messages = context_messages;
  if (desc.device == VK_NULL_HANDLE) {
    limits.maxStorageBufferRange = 1u << 27;  // the least that Vulkan promises of a device that is not there yet
    return FLK_SUCCESS;
  }

  auto missing = [&](const char* name) {
    messages.say(FLK_SEVERITY_ERROR, "DEVICE_FUNCTION_MISSING",
                 "get_instance_proc_addr gives no %s: instance and device must be of Vulkan 1.3", name);
    return FLK_ERROR_UNSUPPORTED_DEVICE;
  };
#define FLK_LOAD(name)                                                                       \
  fn.name = reinterpret_cast<PFN_##name>(desc.get_instance_proc_addr(desc.instance, #name)); \
  if (!fn.name) return missing(#name);
  FLK_INSTANCE_FUNCTIONS(FLK_LOAD)
#undef FLK_LOAD

  VkPhysicalDeviceVulkan11Properties properties11{};
  properties11.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES;
  VkPhysicalDeviceProperties2 properties2{};
  properties2.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties2.pNext = &properties11;
  fn.vkGetPhysicalDeviceProperties2(desc.physical_device, &properties2);
  const VkPhysicalDeviceProperties& properties = properties2.properties;
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    messages.say(FLK_SEVERITY_ERROR, "DEVICE_VERSION", "device %.200s offers Vulkan %u.%u, 1.3 is needed",
                 properties.deviceName, VK_API_VERSION_MAJOR(properties.apiVersion),
                 VK_API_VERSION_MINOR(properties.apiVersion));
    return FLK_ERROR_UNSUPPORTED_DEVICE;
  }
    VkPhysicalDeviceVulkan13Features features13{};
    features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
    VkPhysicalDeviceVulkan12Features features12{};
    features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    features12.pNext = &features13;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &features12;
    fn.vkGetPhysicalDeviceFeatures2(desc.physical_device, &features);
    const struct {
      VkBool32 has;
      const char* name;
    } needs[] = {
        {features.features.fragmentStoresAndAtomics, "fragmentStoresAndAtomics"},
        {features12.scalarBlockLayout, "scalarBlockLayout"},
        {features12.bufferDeviceAddress, "bufferDeviceAddress"},
        {features13.dynamicRendering, "dynamicRendering"},
        {features13.synchronization2, "synchronization2"},
    };
    for (const auto& need : needs)
      if (!need.has) {
        messages.say(FLK_SEVERITY_ERROR, "DEVICE_FEATURE_MISSING", "device %.200s lacks the feature %s",
                     properties.deviceName, need.name);
        return FLK_ERROR_UNSUPPORTED_DEVICE;
      }

    uint32_t family_count = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(desc.physical_device, &family_count, nullptr);
    constexpr uint32_t kMaxFamilies = 32;
    VkQueueFamilyProperties families[kMaxFamilies]{};
    family_count = std::min(family_count, kMaxFamilies);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(desc.physical_device, &family_count, families);
    const VkQueueFlags queue = desc.queue_family < family_count ? families[desc.queue_family].queueFlags : 0;
    if (!(queue & VK_QUEUE_COMPUTE_BIT)) {
      messages.say(FLK_SEVERITY_ERROR, "DEVICE_QUEUE", "queue family %u of device %.200s does not offer compute",
                   desc.queue_family, properties.deviceName);
      return FLK_ERROR_UNSUPPORTED_DEVICE;
    }
    graphics = queue & VK_QUEUE_GRAPHICS_BIT;
    constexpr VkSubgroupFeatureFlags kSubgroup = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
    const VkShaderStageFlags stages =
        VK_SHADER_STAGE_COMPUTE_BIT | (graphics ? VkShaderStageFlags(VK_SHADER_STAGE_FRAGMENT_BIT) : 0u);
    if ((properties11.subgroupSupportedOperations & kSubgroup) != kSubgroup ||
        (properties11.subgroupSupportedStages & stages) != stages) {
      messages.say(FLK_SEVERITY_ERROR, "DEVICE_SUBGROUP",
                   "device %.200s lacks ballots over subgroups in compute%s shaders", properties.deviceName,
                   graphics ? " or fragment" : "");
      return FLK_ERROR_UNSUPPORTED_DEVICE;
    }
    timestamp_bits = families[desc.queue_family].timestampValidBits;

#define FLK_LOAD(name)                                                                \
  fn.name = reinterpret_cast<PFN_##name>(fn.vkGetDeviceProcAddr(desc.device, #name)); \
  if (!fn.name) return missing(#name);
    FLK_DEVICE_FUNCTIONS(FLK_LOAD)
#undef FLK_LOAD

      fn.vkGetPhysicalDeviceMemoryProperties(desc.physical_device, &memory_);
      limits = properties.limits;
      cpu = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
      pipeline_cache = desc.pipeline_cache;
      if (desc.device_allocator) allocator_ = *desc.device_allocator, host_allocates_ = true;
      device = desc.device;
      return FLK_SUCCESS;
}

FlkResult Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags wanted,
                           VkMemoryPropertyFlags preferred, bool address, const char* name,
                           FlkDeviceAllocation& allocation) {
  allocation = {};
  if (host_allocates_) {
    const VkResult result = allocator_.allocate(allocator_.user, &requirements, wanted, name, &allocation);
    if (result == VK_SUCCESS && ((wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0 || allocation.mapped))
      return FLK_SUCCESS;
    if (result == VK_SUCCESS) {
      allocator_.free(allocator_.user, &allocation);
      allocation = {};
      messages.say(FLK_SEVERITY_ERROR, "DEVICE_MEMORY_NOT_MAPPED",
                   "the host's device allocator left FlkDeviceAllocation.mapped NULL for %s", name);
      return FLK_ERROR_OUT_OF_DEVICE_MEMORY;
    }
    allocation = {};
    messages.say(FLK_SEVERITY_ERROR, "DEVICE_MEMORY", "the host's device allocator refused %" PRIu64 " bytes for %s",
                 requirements.size, name);
    return toResult(result);
  }
  uint32_t type = findMemoryType(memory_, requirements.memoryTypeBits, wanted | preferred);
  if (type == UINT32_MAX) type = findMemoryType(memory_, requirements.memoryTypeBits, wanted);
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  if (address) info.pNext = &flags;
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = type;
  VkResult result = type == UINT32_MAX ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                                       : fn.vkAllocateMemory(device, &info, nullptr, &allocation.memory);
  if (result == VK_SUCCESS && (wanted & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) {
    result = fn.vkMapMemory(device, allocation.memory, 0, VK_WHOLE_SIZE, 0, &allocation.mapped);
    if (result != VK_SUCCESS) fn.vkFreeMemory(device, allocation.memory, nullptr), allocation = {};
  }
  if (result == VK_SUCCESS) return FLK_SUCCESS;
  allocation = {};
  messages.say(FLK_SEVERITY_ERROR, "DEVICE_MEMORY", "no device memory for %s (%" PRIu64 " bytes)", name,
               requirements.size);
  return toResult(result);
}

void Device::release(FlkDeviceAllocation& allocation) {
  if (host_allocates_) {
    if (allocation.memory) allocator_.free(allocator_.user, &allocation);
  } else if (allocation.memory) {
    fn.vkFreeMemory(device, allocation.memory, nullptr);  // unmaps
  }
  allocation = {};
}

FlkResult Device::createBuffer(uint64_t size, VkBufferUsageFlags usage, bool host_visible, const char* name,
                               Buffer& buffer) {
  buffer = {};
  buffer.size = size;
  if (planning()) return FLK_SUCCESS;
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = size;
  info.usage = usage;
  VkResult result = fn.vkCreateBuffer(device, &info, nullptr, &buffer.handle);
  if (result != VK_SUCCESS) return buffer = {}, toResult(result);
  VkMemoryRequirements requirements{};
  fn.vkGetBufferMemoryRequirements(device, buffer.handle, &requirements);
  constexpr VkMemoryPropertyFlags kHost = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  const bool address = usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  // What the device reads every frame should be near it, also where the host writes it once.
  const bool near = !host_visible || (usage & VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  FlkResult flk = allocate(requirements, host_visible ? kHost : kLocal, near ? kLocal : VkMemoryPropertyFlags(0),
                           address, name, buffer.memory);
  if (flk == FLK_SUCCESS)
    flk = toResult(fn.vkBindBufferMemory(device, buffer.handle, buffer.memory.memory, buffer.memory.offset));
  if (flk != FLK_SUCCESS) return destroy(buffer), flk;
  if (address) {
    VkBufferDeviceAddressInfo where{};
    where.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
    where.buffer = buffer.handle;
    buffer.address = fn.vkGetBufferDeviceAddress(device, &where);
  }
  return flk;
}

FlkResult Device::createMapImage(uint32_t width, uint32_t height, bool computed, const char* name, Image& image) {
  image = {};
  image.width = width, image.height = height, image.computed = computed;
  if (planning()) return FLK_SUCCESS;
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  // Depth by integer atomics on R32_UINT, read as the R32_SFLOAT whose bits they are.
  info.flags = computed ? VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT : 0;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = computed ? VK_FORMAT_R32_UINT : VK_FORMAT_D32_SFLOAT;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = (computed ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) |
               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  VkResult result = fn.vkCreateImage(device, &info, nullptr, &image.handle);
  if (result != VK_SUCCESS) return image = {}, toResult(result);
  VkMemoryRequirements requirements{};
  fn.vkGetImageMemoryRequirements(device, image.handle, &requirements);
  FlkResult flk = allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0, false, name, image.memory);
  if (flk == FLK_SUCCESS)
    flk = toResult(fn.vkBindImageMemory(device, image.handle, image.memory.memory, image.memory.offset));
  const VkImageAspectFlags aspect = computed ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
  auto createView = [&](VkFormat format, VkImageUsageFlags usage, VkImageView& view) {
    if (flk != FLK_SUCCESS) return;
    VkImageViewUsageCreateInfo used{};
    used.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO;
    used.usage = usage;
    VkImageViewCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    create.pNext = &used;
    create.image = image.handle;
    create.viewType = VK_IMAGE_VIEW_TYPE_2D;
    create.format = format;
    create.subresourceRange = {aspect, 0, 1, 0, 1};
    flk = toResult(fn.vkCreateImageView(device, &create, nullptr, &view));
    if (flk != FLK_SUCCESS) view = VK_NULL_HANDLE;
  };
  createView(computed ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_D32_SFLOAT,
             computed ? VkImageUsageFlags(VK_IMAGE_USAGE_SAMPLED_BIT)
                      : VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
             image.view);
  if (computed) createView(VK_FORMAT_R32_UINT, VK_IMAGE_USAGE_STORAGE_BIT, image.store_view);
  if (flk != FLK_SUCCESS) destroy(image);
  return flk;
}

void Device::destroy(Buffer& buffer) {
  if (buffer.handle) fn.vkDestroyBuffer(device, buffer.handle, nullptr);
  if (!planning()) release(buffer.memory);
  buffer = {};
}

void Device::destroy(Image& image) {
  if (image.store_view) fn.vkDestroyImageView(device, image.store_view, nullptr);
  if (image.view) fn.vkDestroyImageView(device, image.view, nullptr);
  if (image.handle) fn.vkDestroyImage(device, image.handle, nullptr);
  if (!planning()) release(image.memory);
  image = {};
}

}  // namespace forelock
