#include "run_items.h"

#include "scene.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

namespace forelock::test {
namespace {

#define NUMERICS_FUNCTIONS(X)                                                                                         \
  X(vkCreateImage)                                                                                                    \
  X(vkDestroyImage) X(vkCreateImageView) X(vkDestroyImageView) X(vkCreateSampler) X(vkDestroySampler) X(vkGetImageMemoryRequirements) X(vkBindImageMemory)   \
      X(vkCreateBuffer) X(vkDestroyBuffer) X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) X(vkAllocateMemory) \
          X(vkFreeMemory) X(vkMapMemory) X(vkCmdPipelineBarrier2) X(vkCmdCopyBufferToImage) X(vkCreateShaderModule)   \
              X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout)                 \
                  X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) X(vkCreateComputePipelines)                    \
                      X(vkDestroyPipeline) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool)                       \
                          X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets) X(vkCmdBindPipeline)                  \
                              X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch)

#define NUMERICS_DECLARE(f) PFN_##f f = nullptr;
struct Functions {
  NUMERICS_FUNCTIONS(NUMERICS_DECLARE)
};
#undef NUMERICS_DECLARE

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed: " + std::to_string(result));
}

template <class T>
T make(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};

struct Device {
  Functions fn;
  VkDevice device = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory{};

  Device();
  VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags flags) const;
  Buffer makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const;
  void destroyBuffer(const Buffer& buffer) const;
  void uploadMap(VkCommandBuffer cmd, VkImage image, VkBuffer from, uint32_t size) const;
};

Device::Device() {
  const samples::HeadlessHost::Device shared = host().device();
  device = shared.device;
  const auto get = [&](const char* name) { return shared.get_instance_proc_addr(shared.instance, name); };
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get("vkGetDeviceProcAddr"));
#define NUMERICS_LOAD(f) fn.f = reinterpret_cast<PFN_##f>(get_device(device, #f));
  NUMERICS_FUNCTIONS(NUMERICS_LOAD)
#undef NUMERICS_LOAD
  reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(get("vkGetPhysicalDeviceMemoryProperties"))(
      shared.physical_device, &memory);
}

VkDeviceMemory Device::allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags flags) const {
  auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = requirements.size;
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if (!(requirements.memoryTypeBits >> i & 1) || (memory.memoryTypes[i].propertyFlags & flags) != flags) continue;
    info.memoryTypeIndex = i;
    break;
  }
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  check(fn.vkAllocateMemory(device, &info, nullptr, &allocated), "vkAllocateMemory");
  return allocated;
}

Buffer Device::makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const {
  Buffer made;
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  check(fn.vkCreateBuffer(device, &info, nullptr, &made.buffer), "vkCreateBuffer");
  VkMemoryRequirements requirements{};
  fn.vkGetBufferMemoryRequirements(device, made.buffer, &requirements);
  made.memory = allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(fn.vkBindBufferMemory(device, made.buffer, made.memory, 0), "vkBindBufferMemory");
  check(fn.vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
  return made;
}

void Device::destroyBuffer(const Buffer& buffer) const {
  fn.vkDestroyBuffer(device, buffer.buffer, nullptr);
  fn.vkFreeMemory(device, buffer.memory, nullptr);
}

void Device::uploadMap(VkCommandBuffer cmd, VkImage image, VkBuffer from, uint32_t size) const {
  auto transition = [&](VkImageLayout before, VkImageLayout after) {
    auto barrier = make<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    auto dependency = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    fn.vkCmdPipelineBarrier2(cmd, &dependency);
  };
  transition(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
  region.imageExtent = {size, size, 1};
  fn.vkCmdCopyBufferToImage(cmd, from, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  transition(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace

std::vector<float> runItems(std::span<const uint32_t> spirv, std::span<const float> words, uint32_t in_stride,
                            uint32_t out_stride, const DepthMap* map, std::span<const Constant> constants) try {
  static const Device i;
  const Functions& fn = i.fn;
  const uint32_t items = uint32_t(words.size() / in_stride);
  std::vector<float> results(std::size_t(items) * out_stride);
  const Buffer in = i.makeBuffer(words.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer out = i.makeBuffer(results.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  std::memcpy(in.mapped, words.data(), words.size_bytes());

  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory image_memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkSampler sampler = VK_NULL_HANDLE;
  Buffer texels;
  if (map) {
    auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_D32_SFLOAT;
    info.extent = {map->size, map->size, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    check(fn.vkCreateImage(i.device, &info, nullptr, &image), "vkCreateImage");
    VkMemoryRequirements requirements{};
    fn.vkGetImageMemoryRequirements(i.device, image, &requirements);
    image_memory = i.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(fn.vkBindImageMemory(i.device, image, image_memory, 0), "vkBindImageMemory");
    auto view_info = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = info.format;
    view_info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    check(fn.vkCreateImageView(i.device, &view_info, nullptr, &view), "vkCreateImageView");
    auto sampler_info = make<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    sampler_info.addressModeU = sampler_info.addressModeV = sampler_info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    check(fn.vkCreateSampler(i.device, &sampler_info, nullptr, &sampler), "vkCreateSampler");
    texels = i.makeBuffer(map->texels.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(texels.mapped, map->texels.data(), map->texels.size() * sizeof(float));
  }

  const VkDescriptorSetLayoutBinding bindings[3] = {
      {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = map ? 3 : 2;
  set_info.pBindings = bindings;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  check(fn.vkCreateDescriptorSetLayout(i.device, &set_info, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(uint32_t)};
  auto layout_info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = layout_info.pushConstantRangeCount = 1;
  layout_info.pSetLayouts = &set_layout;
  layout_info.pPushConstantRanges = &push;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(fn.vkCreatePipelineLayout(i.device, &layout_info, nullptr, &layout), "vkCreatePipelineLayout");
  auto module_info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(fn.vkCreateShaderModule(i.device, &module_info, nullptr, &module), "vkCreateShaderModule");
  auto pipeline_info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  pipeline_info.stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline_info.stage.module = module;
  pipeline_info.stage.pName = "main";
  std::vector<VkSpecializationMapEntry> entries;
  for (const Constant& constant : constants) {
    const auto offset = uint32_t(entries.size() * sizeof(Constant) + offsetof(Constant, value));
    entries.push_back({constant.id, offset, sizeof constant.value});
  }
  const VkSpecializationInfo specialization{uint32_t(entries.size()), entries.data(), constants.size_bytes(),
                                            constants.data()};
  pipeline_info.stage.pSpecializationInfo = &specialization;
  pipeline_info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(fn.vkCreateComputePipelines(i.device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline),
        "vkCreateComputePipelines");

  const VkDescriptorPoolSize sizes[2] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}};
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 2;
  pool_info.pPoolSizes = sizes;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  check(fn.vkCreateDescriptorPool(i.device, &pool_info, nullptr, &descriptors), "vkCreateDescriptorPool");
  auto allocate_info = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate_info.descriptorPool = descriptors;
  allocate_info.descriptorSetCount = 1;
  allocate_info.pSetLayouts = &set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(fn.vkAllocateDescriptorSets(i.device, &allocate_info, &set), "vkAllocateDescriptorSets");
  const VkDescriptorBufferInfo buffers[2] = {{in.buffer, 0, VK_WHOLE_SIZE}, {out.buffer, 0, VK_WHOLE_SIZE}};
  const VkDescriptorImageInfo image_info{sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet writes[2] = {};
  for (VkWriteDescriptorSet& write : writes) write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = set;
  writes[0].descriptorCount = 2;
  writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  writes[0].pBufferInfo = buffers;
  writes[1].dstBinding = 2;
  writes[1].descriptorCount = 1;
  writes[1].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  writes[1].pImageInfo = &image_info;
  fn.vkUpdateDescriptorSets(i.device, map ? 2 : 1, writes, 0, nullptr);

  const bool done = host().submit([&](VkCommandBuffer cmd) {
    if (map) i.uploadMap(cmd, image, texels.buffer, map->size);
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
    fn.vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(items), &items);
    fn.vkCmdDispatch(cmd, (items + 63) / 64, 1, 1);
    auto to_host = make<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
    to_host.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    to_host.srcAccessMask = VK_ACCESS_2_SHADER_WRITE_BIT;
    to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    auto dependency = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &to_host;
    fn.vkCmdPipelineBarrier2(cmd, &dependency);
  });
  if (!done) throw std::runtime_error("the device is lost");
  std::memcpy(results.data(), out.mapped, results.size() * sizeof(float));

  fn.vkDestroyDescriptorPool(i.device, descriptors, nullptr);
  fn.vkDestroyPipeline(i.device, pipeline, nullptr);
  fn.vkDestroyShaderModule(i.device, module, nullptr);
  fn.vkDestroyPipelineLayout(i.device, layout, nullptr);
  fn.vkDestroyDescriptorSetLayout(i.device, set_layout, nullptr);
  i.destroyBuffer(in);
  i.destroyBuffer(out);
  if (map) {
    i.destroyBuffer(texels);
    fn.vkDestroySampler(i.device, sampler, nullptr);
    fn.vkDestroyImageView(i.device, view, nullptr);
    fn.vkDestroyImage(i.device, image, nullptr);
    fn.vkFreeMemory(i.device, image_memory, nullptr);
  }
  return results;
} catch (const std::exception& e) {
  // What was made so far is leaked: the device is lost or out of memory, and the test has failed.
  ADD_FAILURE() << e.what();
  return {};
}

}  // namespace forelock::test
