// The mock's instance and device functions: memory, resources, pipelines, descriptors, queries.
#include "mock_vulkan.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace mock {
namespace {

VkDeviceSize roundUp(VkDeviceSize size, VkDeviceSize unit) { return (size + unit - 1) / unit * unit; }

bool isDepth(VkFormat format) { return format >= VK_FORMAT_D16_UNORM && format <= VK_FORMAT_D32_SFLOAT_S8_UINT; }

// ---- Instance and physical device ----

VKAPI_ATTR VkResult VKAPI_CALL EnumerateInstanceVersion(uint32_t* version) {
  *version = Driver::current().claims.instance_version;
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties(VkPhysicalDevice, VkPhysicalDeviceProperties* properties) {
  Driver::current().enter("vkGetPhysicalDeviceProperties");
  *properties = Driver::current().claims.properties;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFeatures(VkPhysicalDevice, VkPhysicalDeviceFeatures* features) {
  Driver::current().enter("vkGetPhysicalDeviceFeatures");
  *features = Driver::current().claims.features;
}

template <class T> void answer(VkBaseOutStructure* asked, T claimed) {
  claimed.sType = asked->sType;
  claimed.pNext = asked->pNext;
  std::memcpy(static_cast<void*>(asked), &claimed, sizeof claimed);
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceProperties2(VkPhysicalDevice, VkPhysicalDeviceProperties2* properties) {
  Driver& driver = Driver::current();
  driver.enter("vkGetPhysicalDeviceProperties2");
  properties->properties = driver.claims.properties;
  for (auto* asked = static_cast<VkBaseOutStructure*>(properties->pNext); asked; asked = asked->pNext) {
    if (asked->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES)
      answer(asked, driver.claims.properties11);
    else
      driver.breach("vkGetPhysicalDeviceProperties2 with a struct the mock does not answer: " + std::to_string(asked->sType));
  }
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFeatures2(VkPhysicalDevice, VkPhysicalDeviceFeatures2* features) {
  Driver& driver = Driver::current();
  driver.enter("vkGetPhysicalDeviceFeatures2");
  features->features = driver.claims.features;
  // A device of an older version does not know the structs of newer ones and leaves them alone.
  const uint32_t version = driver.claims.properties.apiVersion;
  for (auto* asked = static_cast<VkBaseOutStructure*>(features->pNext); asked; asked = asked->pNext) {
    if (asked->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES && version >= VK_API_VERSION_1_2)
      answer(asked, driver.claims.features12);
    else if (asked->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES && version >= VK_API_VERSION_1_3)
      answer(asked, driver.claims.features13);
    else if (version >= VK_API_VERSION_1_3)
      driver.breach("vkGetPhysicalDeviceFeatures2 with a struct the mock does not answer: " +
                    std::to_string(asked->sType));
  }
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceMemoryProperties(VkPhysicalDevice,
                                                             VkPhysicalDeviceMemoryProperties* memory) {
  Driver::current().enter("vkGetPhysicalDeviceMemoryProperties");
  *memory = Driver::current().claims.memory;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceMemoryProperties2(VkPhysicalDevice,
                                                              VkPhysicalDeviceMemoryProperties2* memory) {
  Driver::current().enter("vkGetPhysicalDeviceMemoryProperties2");
  memory->memoryProperties = Driver::current().claims.memory;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceQueueFamilyProperties(VkPhysicalDevice, uint32_t* count,
                                                                  VkQueueFamilyProperties* families) {
  Driver& driver = Driver::current();
  driver.enter("vkGetPhysicalDeviceQueueFamilyProperties");
  const auto available = static_cast<uint32_t>(driver.claims.queue_families.size());
  if (families) std::copy_n(driver.claims.queue_families.begin(), std::min(*count, available), families);
  *count = families ? std::min(*count, available) : available;
}

VkFormatFeatureFlags formatFeatures(VkFormat format) {
  const auto& claimed = Driver::current().claims.formats;
  if (auto found = claimed.find(format); found != claimed.end()) return found->second;
  if (isDepth(format)) return VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
  return VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT |
         VK_FORMAT_FEATURE_STORAGE_IMAGE_ATOMIC_BIT | VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFormatProperties(VkPhysicalDevice, VkFormat format,
                                                             VkFormatProperties* properties) {
  Driver::current().enter("vkGetPhysicalDeviceFormatProperties");
  *properties = {0, formatFeatures(format), 0};
}

VKAPI_ATTR void VKAPI_CALL GetPhysicalDeviceFormatProperties2(VkPhysicalDevice, VkFormat format,
                                                              VkFormatProperties2* properties) {
  Driver::current().enter("vkGetPhysicalDeviceFormatProperties2");
  properties->formatProperties = {0, formatFeatures(format), 0};
}

// ---- Device: memory and resources ----

VKAPI_ATTR VkResult VKAPI_CALL AllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                              const VkAllocationCallbacks*, VkDeviceMemory* memory) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkAllocateMemory");
  VkResult result;
  *memory = VK_NULL_HANDLE;
  if (driver.refuse("vkAllocateMemory", &result)) return result;
  if (info->memoryTypeIndex >= driver.claims.memory.memoryTypeCount || info->allocationSize == 0) {
    driver.breach("vkAllocateMemory: memory type or size out of range");
    return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  }
  const uint32_t heap = driver.claims.memory.memoryTypes[info->memoryTypeIndex].heapIndex;
  if (info->allocationSize > driver.claims.memory.memoryHeaps[heap].size) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  Object* object = driver.make(Kind::Memory);
  object->size = info->allocationSize;
  object->memory_type = info->memoryTypeIndex;
  for (auto* more = static_cast<const VkBaseInStructure*>(info->pNext); more; more = more->pNext)
    if (more->sType == VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO)
      object->addressable = reinterpret_cast<const VkMemoryAllocateFlagsInfo*>(more)->flags &
                            VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  // Zeroed on first touch, so that a large pool costs nothing here.
  object->bytes = std::calloc(1, info->allocationSize);
  *memory = handleOf<VkDeviceMemory>(object);
  return object->bytes ? VK_SUCCESS : VK_ERROR_OUT_OF_DEVICE_MEMORY;
}

VKAPI_ATTR void VKAPI_CALL FreeMemory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks*) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkFreeMemory");
  driver.destroy(memory, Kind::Memory, "vkFreeMemory");
}

VKAPI_ATTR VkResult VKAPI_CALL MapMemory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                                         VkMemoryMapFlags, void** data) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkMapMemory");
  VkResult result;
  if (driver.refuse("vkMapMemory", &result)) return result;
  Object* object = driver.known(memory, Kind::Memory, "vkMapMemory");
  if (!object) return VK_ERROR_MEMORY_MAP_FAILED;
  const VkFlags flags = driver.claims.memory.memoryTypes[object->memory_type].propertyFlags;
  if (!(flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) driver.breach("vkMapMemory: memory is not host visible");
  if (object->mapped) driver.breach("vkMapMemory: memory is mapped already");
  if (offset >= object->size || (size != VK_WHOLE_SIZE && offset + size > object->size))
    driver.breach("vkMapMemory: range past the end");
  object->mapped = true;
  *data = static_cast<std::byte*>(object->bytes) + offset;
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL UnmapMemory(VkDevice device, VkDeviceMemory memory) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkUnmapMemory");
  Object* object = driver.known(memory, Kind::Memory, "vkUnmapMemory");
  if (!object) return;
  if (!object->mapped) driver.breach("vkUnmapMemory: memory is not mapped");
  object->mapped = false;
}

VKAPI_ATTR VkResult VKAPI_CALL FlushMappedMemoryRanges(VkDevice, uint32_t, const VkMappedMemoryRange*) {
  VkResult result;
  return Driver::current().refuse("vkFlushMappedMemoryRanges", &result) ? result : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL InvalidateMappedMemoryRanges(VkDevice, uint32_t, const VkMappedMemoryRange*) {
  VkResult result;
  return Driver::current().refuse("vkInvalidateMappedMemoryRanges", &result) ? result : VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateBuffer(VkDevice device, const VkBufferCreateInfo* info,
                                            const VkAllocationCallbacks*, VkBuffer* buffer) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkCreateBuffer");
  VkResult result;
  *buffer = VK_NULL_HANDLE;
  if (driver.refuse("vkCreateBuffer", &result)) return result;
  if (info->size == 0 || info->usage == 0) driver.breach("vkCreateBuffer: no size or no usage");
  Object* object = driver.make(Kind::Buffer);
  object->size = info->size;
  object->usage = info->usage;
  *buffer = handleOf<VkBuffer>(object);
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateImage(VkDevice device, const VkImageCreateInfo* info, const VkAllocationCallbacks*,
                                           VkImage* image) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkCreateImage");
  VkResult result;
  *image = VK_NULL_HANDLE;
  if (driver.refuse("vkCreateImage", &result)) return result;
  const uint32_t limit = driver.claims.properties.limits.maxImageDimension2D;
  if (info->extent.width == 0 || info->extent.height == 0 || info->extent.width > limit || info->extent.height > limit)
    driver.breach("vkCreateImage: extent out of range");
  Object* object = driver.make(Kind::Image);
  if (info->usage == 0) driver.breach("vkCreateImage: no usage");
  constexpr VkDeviceSize kTexel = 4;  // all that the SDK makes
  if (info->format != VK_FORMAT_D32_SFLOAT && info->format != VK_FORMAT_R32_UINT) driver.breach("vkCreateImage: a format that is not modelled");
  object->size = kTexel * info->extent.width * info->extent.height * info->extent.depth * info->arrayLayers;
  object->usage = info->usage;
  object->format = info->format;
  object->mutable_format = info->flags & VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
  *image = handleOf<VkImage>(object);
  return VK_SUCCESS;
}

void memoryNeeds(const Object* object, VkMemoryRequirements* needs) {
  const Claims& claims = Driver::current().claims;
  *needs = {object ? roundUp(object->size, 256) : 256, 256, (1u << claims.memory.memoryTypeCount) - 1};
}

VKAPI_ATTR void VKAPI_CALL GetBufferMemoryRequirements(VkDevice, VkBuffer buffer, VkMemoryRequirements* needs) {
  Driver::current().enter("vkGetBufferMemoryRequirements");
  memoryNeeds(Driver::current().known(buffer, Kind::Buffer, "vkGetBufferMemoryRequirements"), needs);
}

VKAPI_ATTR void VKAPI_CALL GetImageMemoryRequirements(VkDevice, VkImage image, VkMemoryRequirements* needs) {
  Driver::current().enter("vkGetImageMemoryRequirements");
  memoryNeeds(Driver::current().known(image, Kind::Image, "vkGetImageMemoryRequirements"), needs);
}

VKAPI_ATTR void VKAPI_CALL GetBufferMemoryRequirements2(VkDevice device, const VkBufferMemoryRequirementsInfo2* info,
                                                        VkMemoryRequirements2* needs) {
  GetBufferMemoryRequirements(device, info->buffer, &needs->memoryRequirements);
}

VKAPI_ATTR void VKAPI_CALL GetImageMemoryRequirements2(VkDevice device, const VkImageMemoryRequirementsInfo2* info,
                                                       VkMemoryRequirements2* needs) {
  GetImageMemoryRequirements(device, info->image, &needs->memoryRequirements);
}

VkResult bind(const void* resource, Kind kind, VkDeviceMemory memory, VkDeviceSize offset, const char* name) {
  Driver& driver = Driver::current();
  VkResult result;
  if (driver.refuse(name, &result)) return result;
  Object* object = driver.known(resource, kind, name);
  Object* block = driver.known(memory, Kind::Memory, name);
  if (!object || !block) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  if (object->memory) driver.breach(std::string(name) + ": bound already");
  VkMemoryRequirements needs;
  memoryNeeds(object, &needs);
  if (offset % needs.alignment != 0 || offset + needs.size > block->size)
    driver.breach(std::string(name) + ": misaligned or past the end of the memory");
  object->memory = block;
  object->memory_offset = offset;
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL BindBufferMemory(VkDevice, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset) {
  return bind(buffer, Kind::Buffer, memory, offset, "vkBindBufferMemory");
}

VKAPI_ATTR VkResult VKAPI_CALL BindImageMemory(VkDevice, VkImage image, VkDeviceMemory memory, VkDeviceSize offset) {
  return bind(image, Kind::Image, memory, offset, "vkBindImageMemory");
}

VKAPI_ATTR VkDeviceAddress VKAPI_CALL GetBufferDeviceAddress(VkDevice device, const VkBufferDeviceAddressInfo* info) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkGetBufferDeviceAddress");
  Object* buffer = driver.known(info->buffer, Kind::Buffer, "vkGetBufferDeviceAddress");
  if (!buffer) return 0;
  if (!(buffer->usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) || !buffer->memory ||
      !(buffer->memory->addressable || buffer->memory->of_host))
    driver.breach("vkGetBufferDeviceAddress: the buffer or its memory was not made for that");
  return driver.giveAddress(buffer);
}

VKAPI_ATTR VkResult VKAPI_CALL CreateImageView(VkDevice device, const VkImageViewCreateInfo* info,
                                               const VkAllocationCallbacks*, VkImageView* view) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkCreateImageView");
  VkResult result;
  *view = VK_NULL_HANDLE;
  if (driver.refuse("vkCreateImageView", &result)) return result;
  Object* image = driver.known(info->image, Kind::Image, "vkCreateImageView");
  if (image && !image->memory && !image->of_host) driver.breach("vkCreateImageView: the image has no memory");
  Object* object = driver.make(Kind::ImageView);
  object->uses = {image};
  object->format = info->format;
  object->usage = image ? image->usage : 0;
  for (auto* more = static_cast<const VkBaseInStructure*>(info->pNext); more; more = more->pNext)
    if (more->sType == VK_STRUCTURE_TYPE_IMAGE_VIEW_USAGE_CREATE_INFO)
      object->usage = reinterpret_cast<const VkImageViewUsageCreateInfo*>(more)->usage;
  if (image && !image->of_host) {
    if (object->usage == 0 || (object->usage & ~image->usage))
      driver.breach("vkCreateImageView: a usage that the image was not made for");
    if (info->format != image->format && !image->mutable_format)
      driver.breach("vkCreateImageView: another format than the image's");
    const VkImageAspectFlags aspect = isDepth(image->format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
    if (info->subresourceRange.aspectMask != aspect) driver.breach("vkCreateImageView: wrong aspect");
  }
  *view = handleOf<VkImageView>(object);
  return VK_SUCCESS;
}

// ---- Device: shaders, pipelines, descriptors ----

template <Kind kind, class Info, class Handle>
VkResult createPlain(VkDevice device, const Info*, Handle* handle, const char* name) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, name);
  VkResult result;
  *handle = VK_NULL_HANDLE;
  if (driver.refuse(name, &result)) return result;
  *handle = handleOf<Handle>(driver.make(kind));
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateSampler(VkDevice device, const VkSamplerCreateInfo* info,
                                             const VkAllocationCallbacks*, VkSampler* sampler) {
  return createPlain<Kind::Sampler>(device, info, sampler, "vkCreateSampler");
}

// (set, binding) of every resource that a SPIR-V module declares.
std::set<std::pair<uint32_t, uint32_t>> bindingsOf(const uint32_t* code, size_t words) {
  constexpr uint32_t kOpDecorate = 71, kBinding = 33, kDescriptorSet = 34;
  std::map<uint32_t, uint32_t> sets, bindings;
  for (size_t at = 5; at < words && code[at] >> 16 != 0; at += code[at] >> 16) {
    if ((code[at] & 0xFFFF) != kOpDecorate || at + 3 >= words) continue;
    if (code[at + 2] == kBinding) bindings[code[at + 1]] = code[at + 3];
    if (code[at + 2] == kDescriptorSet) sets[code[at + 1]] = code[at + 3];
  }
  std::set<std::pair<uint32_t, uint32_t>> found;
  for (const auto& [id, binding] : bindings) found.insert({sets[id], binding});
  return found;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                                  const VkAllocationCallbacks*, VkShaderModule* module) {
  const VkResult result = createPlain<Kind::ShaderModule>(device, info, module, "vkCreateShaderModule");
  if (result != VK_SUCCESS) return result;
  const size_t words = info->codeSize / 4;
  if (words < 5 || info->codeSize % 4 != 0 || info->pCode[0] != 0x07230203u) {
    Driver::current().breach("vkCreateShaderModule: not SPIR-V");
    return result;
  }
  reinterpret_cast<Object*>(*module)->reads = bindingsOf(info->pCode, words);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineCache(VkDevice device, const VkPipelineCacheCreateInfo* info,
                                                   const VkAllocationCallbacks*, VkPipelineCache* cache) {
  return createPlain<Kind::PipelineCache>(device, info, cache, "vkCreatePipelineCache");
}

VKAPI_ATTR VkResult VKAPI_CALL CreateDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                                                         const VkAllocationCallbacks*, VkDescriptorSetLayout* layout) {
  const VkResult result = createPlain<Kind::SetLayout>(device, info, layout, "vkCreateDescriptorSetLayout");
  if (result == VK_SUCCESS)
    reinterpret_cast<Object*>(*layout)->layout.assign(info->pBindings, info->pBindings + info->bindingCount);
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL CreatePipelineLayout(VkDevice device, const VkPipelineLayoutCreateInfo* info,
                                                    const VkAllocationCallbacks*, VkPipelineLayout* layout) {
  Driver& driver = Driver::current();
  for (uint32_t i = 0; i < info->setLayoutCount; ++i)
    driver.known(info->pSetLayouts[i], Kind::SetLayout, "vkCreatePipelineLayout");
  for (uint32_t i = 0; i < info->pushConstantRangeCount; ++i) {
    const VkPushConstantRange& range = info->pPushConstantRanges[i];
    if (range.size == 0 || range.offset + range.size > 128) driver.breach("vkCreatePipelineLayout: more push constants than every device has");
    driver.push_bytes = range.offset + range.size;
    driver.push_stages = range.stageFlags;
  }
  return createPlain<Kind::PipelineLayout>(device, info, layout, "vkCreatePipelineLayout");
}

VkResult makePipeline(VkPipelineLayout layout, const VkPipelineShaderStageCreateInfo* stages, uint32_t stage_count,
                      VkPipelineBindPoint bind_point, VkPipeline* pipeline, const char* name) {
  Driver& driver = Driver::current();
  VkResult result;
  *pipeline = VK_NULL_HANDLE;
  if (driver.refuse(name, &result)) return result;
  Object* layout_object = driver.known(layout, Kind::PipelineLayout, name);
  Object* object = driver.make(Kind::Pipeline);
  for (uint32_t i = 0; i < stage_count; ++i)
    if (const Object* module = driver.known(stages[i].module, Kind::ShaderModule, name))
      object->reads.insert(module->reads.begin(), module->reads.end());
  object->bind_point = bind_point;
  object->uses = {layout_object};
  *pipeline = handleOf<VkPipeline>(object);
  return VK_SUCCESS;
}

// A refused pipeline is VK_NULL_HANDLE; the others of the same call are made all the same, as the specification has it.
VKAPI_ATTR VkResult VKAPI_CALL CreateGraphicsPipelines(VkDevice device, VkPipelineCache, uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks*, VkPipeline* pipelines) {
  Driver::current().checkDevice(device, "vkCreateGraphicsPipelines");
  VkResult worst = VK_SUCCESS;
  for (uint32_t i = 0; i < count; ++i) {
    const VkResult result = makePipeline(infos[i].layout, infos[i].pStages, infos[i].stageCount,
                                         VK_PIPELINE_BIND_POINT_GRAPHICS, &pipelines[i], "vkCreateGraphicsPipelines");
    if (result != VK_SUCCESS) worst = result;
  }
  return worst;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateComputePipelines(VkDevice device, VkPipelineCache, uint32_t count,
                                                      const VkComputePipelineCreateInfo* infos,
                                                      const VkAllocationCallbacks*, VkPipeline* pipelines) {
  Driver::current().checkDevice(device, "vkCreateComputePipelines");
  VkResult worst = VK_SUCCESS;
  for (uint32_t i = 0; i < count; ++i) {
    const VkResult result = makePipeline(infos[i].layout, &infos[i].stage, 1, VK_PIPELINE_BIND_POINT_COMPUTE,
                                         &pipelines[i], "vkCreateComputePipelines");
    if (result != VK_SUCCESS) worst = result;
  }
  return worst;
}

VKAPI_ATTR VkResult VKAPI_CALL CreateDescriptorPool(VkDevice device, const VkDescriptorPoolCreateInfo* info,
                                                    const VkAllocationCallbacks*, VkDescriptorPool* pool) {
  const VkResult result = createPlain<Kind::DescriptorPool>(device, info, pool, "vkCreateDescriptorPool");
  if (result != VK_SUCCESS) return result;
  auto* object = reinterpret_cast<Object*>(*pool);
  object->sets_left = info->maxSets;
  object->usage = info->flags;
  for (uint32_t i = 0; i < info->poolSizeCount; ++i)
    object->room[info->pPoolSizes[i].type] += info->pPoolSizes[i].descriptorCount;
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL AllocateDescriptorSets(VkDevice device, const VkDescriptorSetAllocateInfo* info,
                                                      VkDescriptorSet* sets) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkAllocateDescriptorSets");
  std::fill_n(sets, info->descriptorSetCount, VkDescriptorSet{});
  VkResult result;
  if (driver.refuse("vkAllocateDescriptorSets", &result)) return result;
  Object* pool = driver.known(info->descriptorPool, Kind::DescriptorPool, "vkAllocateDescriptorSets");
  if (!pool) return VK_ERROR_OUT_OF_POOL_MEMORY;
  std::map<VkDescriptorType, uint32_t> room = pool->room;
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) {
    Object* layout = driver.known(info->pSetLayouts[i], Kind::SetLayout, "vkAllocateDescriptorSets");
    if (!layout) return VK_ERROR_OUT_OF_POOL_MEMORY;
    for (const VkDescriptorSetLayoutBinding& binding : layout->layout) {
      if (room[binding.descriptorType] < binding.descriptorCount) return VK_ERROR_OUT_OF_POOL_MEMORY;
      room[binding.descriptorType] -= binding.descriptorCount;
    }
  }
  if (pool->sets_left < info->descriptorSetCount) return VK_ERROR_OUT_OF_POOL_MEMORY;
  pool->sets_left -= info->descriptorSetCount;
  pool->room = room;
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) {
    Object* set = driver.make(Kind::DescriptorSet);
    set->layout = reinterpret_cast<Object*>(info->pSetLayouts[i])->layout;
    pool->uses.push_back(set);
    sets[i] = handleOf<VkDescriptorSet>(set);
  }
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL FreeDescriptorSets(VkDevice device, VkDescriptorPool pool, uint32_t count,
                                                  const VkDescriptorSet* sets) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkFreeDescriptorSets");
  Object* object = driver.known(pool, Kind::DescriptorPool, "vkFreeDescriptorSets");
  if (!object) return VK_SUCCESS;
  if (!(object->usage & VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT))
    driver.breach("vkFreeDescriptorSets: not from such a pool");
  for (uint32_t i = 0; i < count; ++i)
    if (sets[i])
      if (Object* set = driver.known(sets[i], Kind::DescriptorSet, "vkFreeDescriptorSets"))
        driver.dropSet(object, set, "vkFreeDescriptorSets");
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL ResetDescriptorPool(VkDevice device, VkDescriptorPool pool, VkDescriptorPoolResetFlags) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkResetDescriptorPool");
  if (Object* object = driver.known(pool, Kind::DescriptorPool, "vkResetDescriptorPool")) {
    for (Object* set : object->uses) driver.dropSet(object, set, "vkResetDescriptorPool");
    object->uses.clear();
  }
  return VK_SUCCESS;
}

bool isBufferType(VkDescriptorType type) {
  return type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER || type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
         type == VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC || type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
}

Object* writtenBuffer(const VkWriteDescriptorSet& write, const VkDescriptorBufferInfo& info) {
  Driver& driver = Driver::current();
  Object* buffer = driver.known(info.buffer, Kind::Buffer, "vkUpdateDescriptorSets");
  if (!buffer) return nullptr;
  const VkPhysicalDeviceLimits& limits = driver.claims.properties.limits;
  const bool uniform = write.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ||
                       write.descriptorType == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC;
  const VkDeviceSize range = info.range == VK_WHOLE_SIZE ? buffer->size - info.offset : info.range;
  if (info.offset + range > buffer->size) driver.breach("vkUpdateDescriptorSets: range past the end of the buffer");
  if (range > (uniform ? limits.maxUniformBufferRange : limits.maxStorageBufferRange))
    driver.breach("vkUpdateDescriptorSets: range of " + std::to_string(range) + " bytes beyond the device's limit");
  if (info.offset % (uniform ? limits.minUniformBufferOffsetAlignment : limits.minStorageBufferOffsetAlignment) != 0)
    driver.breach("vkUpdateDescriptorSets: misaligned offset");
  if (!(buffer->usage & (uniform ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT)))
    driver.breach("vkUpdateDescriptorSets: the buffer was not made for that");
  return buffer;
}

Object* writtenImage(const VkWriteDescriptorSet& write, const VkDescriptorImageInfo& info) {
  Driver& driver = Driver::current();
  Object* view = driver.known(info.imageView, Kind::ImageView, "vkUpdateDescriptorSets");
  if (!view) return nullptr;
  const bool storage = write.descriptorType == VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  if (!(view->usage & (storage ? VK_IMAGE_USAGE_STORAGE_BIT : VK_IMAGE_USAGE_SAMPLED_BIT)))
    driver.breach("vkUpdateDescriptorSets: the image was not made for that");
  if (storage ? info.imageLayout != VK_IMAGE_LAYOUT_GENERAL : info.imageLayout == VK_IMAGE_LAYOUT_UNDEFINED)
    driver.breach("vkUpdateDescriptorSets: a layout in which the image cannot be used");
  return view;
}

VKAPI_ATTR void VKAPI_CALL UpdateDescriptorSets(VkDevice device, uint32_t write_count,
                                                const VkWriteDescriptorSet* writes, uint32_t copy_count,
                                                const VkCopyDescriptorSet*) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkUpdateDescriptorSets");
  if (copy_count) driver.breach("vkUpdateDescriptorSets: copies are not modelled");
  for (uint32_t w = 0; w < write_count; ++w) {
    const VkWriteDescriptorSet& write = writes[w];
    Object* set = driver.known(write.dstSet, Kind::DescriptorSet, "vkUpdateDescriptorSets");
    if (!set) continue;
    if (driver.busy(set)) driver.breach("vkUpdateDescriptorSets: a set of a frame in flight");
    const bool fits = std::any_of(set->layout.begin(), set->layout.end(), [&](const VkDescriptorSetLayoutBinding& b) {
      return b.binding == write.dstBinding && b.descriptorType == write.descriptorType &&
             write.dstArrayElement + write.descriptorCount <= b.descriptorCount;
    });
    if (!fits)
      driver.breach("vkUpdateDescriptorSets: binding " + std::to_string(write.dstBinding) + " is not in the layout");
    for (uint32_t i = 0; i < write.descriptorCount; ++i) {
      Object* resource = nullptr;
      if (isBufferType(write.descriptorType))
        resource = writtenBuffer(write, write.pBufferInfo[i]);
      else if (write.pImageInfo && write.descriptorType != VK_DESCRIPTOR_TYPE_SAMPLER)
        resource = writtenImage(write, write.pImageInfo[i]);
      if (resource) set->bindings[{write.dstBinding, write.dstArrayElement + i}] = resource;
    }
  }
}

// ---- Device: queries ----

VKAPI_ATTR VkResult VKAPI_CALL CreateQueryPool(VkDevice device, const VkQueryPoolCreateInfo* info,
                                               const VkAllocationCallbacks*, VkQueryPool* pool) {
  const VkResult result = createPlain<Kind::QueryPool>(device, info, pool, "vkCreateQueryPool");
  if (result != VK_SUCCESS) return result;
  auto* object = reinterpret_cast<Object*>(*pool);
  object->query_states.assign(info->queryCount, 0);
  object->query_values.assign(info->queryCount, 0);
  return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL GetQueryPoolResults(VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count,
                                                   size_t size, void* data, VkDeviceSize stride,
                                                   VkQueryResultFlags flags) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkGetQueryPoolResults");
  if (flags & VK_QUERY_RESULT_WAIT_BIT) driver.breach("vkGetQueryPoolResults waits");
  VkResult result;
  if (driver.refuse("vkGetQueryPoolResults", &result)) return result;
  Object* object = driver.known(pool, Kind::QueryPool, "vkGetQueryPoolResults");
  if (!object || first + count > object->query_states.size()) {
    driver.breach("vkGetQueryPoolResults: queries past the end");
    return VK_NOT_READY;
  }
  const bool wide = flags & VK_QUERY_RESULT_64_BIT, availability = flags & VK_QUERY_RESULT_WITH_AVAILABILITY_BIT;
  const size_t word = wide ? 8 : 4;
  result = VK_SUCCESS;
  for (uint32_t i = 0; i < count; ++i) {
    const bool ready = object->query_states[first + i] == 2;
    if (!ready) result = VK_NOT_READY;
    if (stride * i + word * (availability ? 2 : 1) > size) {
      driver.breach("vkGetQueryPoolResults: the answer does not fit");
      return result;
    }
    auto* out = static_cast<std::byte*>(data) + stride * i;
    const uint64_t values[2] = {object->query_values[first + i], ready ? 1u : 0u};
    if (ready) std::memcpy(out, &values[0], word);
    if (availability) std::memcpy(out + word, &values[1], word);
  }
  return result;
}

VKAPI_ATTR void VKAPI_CALL ResetQueryPool(VkDevice device, VkQueryPool pool, uint32_t first, uint32_t count) {
  Driver& driver = Driver::current();
  driver.checkDevice(device, "vkResetQueryPool");
  if (!driver.claims.features12.hostQueryReset)
    driver.breach("vkResetQueryPool: the feature is not among the requirements");
  Object* object = driver.known(pool, Kind::QueryPool, "vkResetQueryPool");
  if (object && driver.busy(object)) driver.breach("vkResetQueryPool: queries of a frame in flight");
  for (uint32_t i = 0; object && i < count; ++i) object->query_states.at(first + i) = 1;
}

#define MOCK_DESTROY(Type, Handle)                                                                    \
  VKAPI_ATTR void VKAPI_CALL Destroy##Type(VkDevice device, Handle handle, const VkAllocationCallbacks*) { \
    Driver::current().checkDevice(device, "vkDestroy" #Type);                                         \
    Driver::current().destroy(handle, destroyedKind(handle), "vkDestroy" #Type);                      \
  }
constexpr Kind destroyedKind(VkBuffer) { return Kind::Buffer; }
constexpr Kind destroyedKind(VkImage) { return Kind::Image; }
constexpr Kind destroyedKind(VkImageView) { return Kind::ImageView; }
constexpr Kind destroyedKind(VkSampler) { return Kind::Sampler; }
constexpr Kind destroyedKind(VkShaderModule) { return Kind::ShaderModule; }
constexpr Kind destroyedKind(VkDescriptorSetLayout) { return Kind::SetLayout; }
constexpr Kind destroyedKind(VkPipelineLayout) { return Kind::PipelineLayout; }
constexpr Kind destroyedKind(VkPipeline) { return Kind::Pipeline; }
constexpr Kind destroyedKind(VkDescriptorPool) { return Kind::DescriptorPool; }
constexpr Kind destroyedKind(VkQueryPool) { return Kind::QueryPool; }
constexpr Kind destroyedKind(VkPipelineCache) { return Kind::PipelineCache; }
MOCK_DESTROY(Buffer, VkBuffer)
MOCK_DESTROY(Image, VkImage)
MOCK_DESTROY(ImageView, VkImageView)
MOCK_DESTROY(Sampler, VkSampler)
MOCK_DESTROY(ShaderModule, VkShaderModule)
MOCK_DESTROY(DescriptorSetLayout, VkDescriptorSetLayout)
MOCK_DESTROY(PipelineLayout, VkPipelineLayout)
MOCK_DESTROY(Pipeline, VkPipeline)
MOCK_DESTROY(DescriptorPool, VkDescriptorPool)
MOCK_DESTROY(QueryPool, VkQueryPool)
MOCK_DESTROY(PipelineCache, VkPipelineCache)
#undef MOCK_DESTROY

}  // namespace

const FunctionTable& deviceFunctions() {
#define MOCK(Name) {"vk" #Name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##Name>(Name))}
  static const FunctionTable table = {
      MOCK(EnumerateInstanceVersion), MOCK(GetPhysicalDeviceProperties),
      MOCK(GetPhysicalDeviceProperties2), MOCK(GetPhysicalDeviceFeatures), MOCK(GetPhysicalDeviceFeatures2),
      MOCK(GetPhysicalDeviceMemoryProperties), MOCK(GetPhysicalDeviceMemoryProperties2),
      MOCK(GetPhysicalDeviceQueueFamilyProperties), MOCK(GetPhysicalDeviceFormatProperties),
      MOCK(GetPhysicalDeviceFormatProperties2), MOCK(AllocateMemory), MOCK(FreeMemory), MOCK(MapMemory),
      MOCK(UnmapMemory), MOCK(FlushMappedMemoryRanges), MOCK(InvalidateMappedMemoryRanges), MOCK(CreateBuffer),
      MOCK(DestroyBuffer), MOCK(CreateImage), MOCK(DestroyImage), MOCK(GetBufferMemoryRequirements),
      MOCK(GetImageMemoryRequirements), MOCK(GetBufferMemoryRequirements2), MOCK(GetImageMemoryRequirements2),
      MOCK(GetBufferDeviceAddress), MOCK(BindBufferMemory), MOCK(BindImageMemory), MOCK(CreateImageView), MOCK(DestroyImageView),
      MOCK(CreateSampler), MOCK(DestroySampler), MOCK(CreateShaderModule), MOCK(DestroyShaderModule),
      MOCK(CreatePipelineCache), MOCK(DestroyPipelineCache), MOCK(CreateDescriptorSetLayout),
      MOCK(DestroyDescriptorSetLayout), MOCK(CreatePipelineLayout), MOCK(DestroyPipelineLayout),
      MOCK(CreateGraphicsPipelines), MOCK(CreateComputePipelines), MOCK(DestroyPipeline), MOCK(CreateDescriptorPool),
      MOCK(DestroyDescriptorPool), MOCK(ResetDescriptorPool), MOCK(AllocateDescriptorSets), MOCK(FreeDescriptorSets),
      MOCK(UpdateDescriptorSets), MOCK(CreateQueryPool), MOCK(DestroyQueryPool), MOCK(GetQueryPoolResults),
      MOCK(ResetQueryPool)};
#undef MOCK
  return table;
}

}  // namespace mock
