// SPDX-License-Identifier: MIT
#include "compute_bench.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::study {
namespace {

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string("compute: ") + what + " failed (" + std::to_string(result) + ")");
}

template <class T>
T make(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

using Clock = std::chrono::steady_clock;

}  // namespace

ComputeBench::ComputeBench(samples::HeadlessHost& host) : host_(host) {
  const samples::HeadlessHost::Device shared = host.device();
  device_ = shared.device;
  const auto get = [&](const char* name) { return shared.get_instance_proc_addr(shared.instance, name); };
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get("vkGetDeviceProcAddr"));
#define FORELOCK_BENCH_LOAD(name) fn_.name = reinterpret_cast<PFN_##name>(get_device(device_, #name));
  FORELOCK_BENCH_FUNCTIONS(FORELOCK_BENCH_LOAD)
#undef FORELOCK_BENCH_LOAD
  reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(get("vkGetPhysicalDeviceMemoryProperties"))(shared.physical_device, &memory_);
}

ComputeBench::~ComputeBench() {
  fn_.vkDestroyDescriptorPool(device_, pool_, nullptr);
  fn_.vkDestroySampler(device_, sampler_, nullptr);
  fn_.vkDestroyPipeline(device_, pipeline_, nullptr);
  fn_.vkDestroyShaderModule(device_, module_, nullptr);
  fn_.vkDestroyPipelineLayout(device_, layout_, nullptr);
  fn_.vkDestroyDescriptorSetLayout(device_, set_layout_, nullptr);
  for (uint32_t i = 0; i < buffer_count_; ++i) {
    fn_.vkDestroyBuffer(device_, buffers_[i], nullptr);
    fn_.vkFreeMemory(device_, memories_[i], nullptr);
  }
}

VkBuffer ComputeBench::makeBuffer(VkDeviceSize size) {
  const uint32_t at = buffer_count_++;
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
               VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
  check(fn_.vkCreateBuffer(device_, &info, nullptr, &buffers_[at]), "vkCreateBuffer");
  VkMemoryRequirements requirements{};
  fn_.vkGetBufferMemoryRequirements(device_, buffers_[at], &requirements);
  auto allocate = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  allocate.allocationSize = requirements.size;
  auto flags = make<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  allocate.pNext = &flags;
  for (uint32_t i = memory_.memoryTypeCount; i-- > 0;)
    if ((requirements.memoryTypeBits >> i & 1) && (memory_.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT))
      allocate.memoryTypeIndex = i;
  check(fn_.vkAllocateMemory(device_, &allocate, nullptr, &memories_[at]), "vkAllocateMemory");
  check(fn_.vkBindBufferMemory(device_, buffers_[at], memories_[at], 0), "vkBindBufferMemory");
  return buffers_[at];
}

VkDeviceAddress ComputeBench::addressOf(VkBuffer buffer) const {
  auto info = make<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
  info.buffer = buffer;
  return fn_.vkGetBufferDeviceAddress(device_, &info);
}

// By commands, a few megabytes a submission: no second buffer, and the bytes are the device's own.
void ComputeBench::write(VkBuffer buffer, std::span<const std::byte> bytes) {
  constexpr std::size_t kMostUpdate = 65536, kUpdates = 64;
  for (std::size_t begin = 0; begin < bytes.size(); begin += kMostUpdate * kUpdates)
    seconds([&](VkCommandBuffer cmd) {
      const std::size_t end = std::min(bytes.size(), begin + kMostUpdate * kUpdates);
      for (std::size_t at = begin; at < end; at += kMostUpdate)
        fn_.vkCmdUpdateBuffer(cmd, buffer, at, std::min(kMostUpdate, end - at), bytes.data() + at);
      barrier(cmd);
    });
}

VkDescriptorType ComputeBench::typeOf(const Binding& binding) {
  return !binding.buffer ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                         : binding.uniform ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
}

void ComputeBench::makePipeline(std::span<const uint32_t> code, uint32_t push_bytes, std::initializer_list<Binding> bindings,
                                const VkSpecializationInfo* constants) {
  push_bytes_ = push_bytes;
  auto sampler_info = make<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  sampler_info.addressModeU = sampler_info.addressModeV = sampler_info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  check(fn_.vkCreateSampler(device_, &sampler_info, nullptr, &sampler_), "vkCreateSampler");
  std::vector<VkDescriptorSetLayoutBinding> layout;
  for (const Binding& binding : bindings)
    layout.push_back({binding.index, typeOf(binding), 1,
                      VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = uint32_t(layout.size());
  set_info.pBindings = layout.data();
  check(fn_.vkCreateDescriptorSetLayout(device_, &set_info, nullptr, &set_layout_), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  auto layout_info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = layout_info.pushConstantRangeCount = 1;
  layout_info.pSetLayouts = &set_layout_;
  layout_info.pPushConstantRanges = &push;
  check(fn_.vkCreatePipelineLayout(device_, &layout_info, nullptr, &layout_), "vkCreatePipelineLayout");
  auto module_info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = code.size_bytes();
  module_info.pCode = code.data();
  check(fn_.vkCreateShaderModule(device_, &module_info, nullptr, &module_), "vkCreateShaderModule");
  auto pipeline_info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  pipeline_info.stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline_info.stage.module = module_;
  pipeline_info.stage.pName = "main";
  pipeline_info.stage.pSpecializationInfo = constants;
  pipeline_info.layout = layout_;
  check(fn_.vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline_), "vkCreateComputePipelines");
  const VkDescriptorPoolSize sizes[3] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, uint32_t(layout.size())},
                                         {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, uint32_t(layout.size())},
                                         {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, uint32_t(layout.size())}};
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 3;
  pool_info.pPoolSizes = sizes;
  check(fn_.vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool_), "vkCreateDescriptorPool");
  auto allocate = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &set_layout_;
  check(fn_.vkAllocateDescriptorSets(device_, &allocate, &set_), "vkAllocateDescriptorSets");
  for (const Binding& binding : bindings) {
    const VkDescriptorBufferInfo buffer{binding.buffer, 0, VK_WHOLE_SIZE};
    const VkDescriptorImageInfo image{sampler_, binding.image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    auto write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set_;
    write.dstBinding = binding.index;
    write.descriptorCount = 1;
    write.descriptorType = typeOf(binding);
    write.pBufferInfo = &buffer;
    write.pImageInfo = &image;
    fn_.vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
  }
}

void ComputeBench::dispatch(VkCommandBuffer cmd, const void* push, uint32_t groups_x, uint32_t groups_y) const {
  fn_.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  fn_.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
  fn_.vkCmdPushConstants(cmd, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_, push);
  fn_.vkCmdDispatch(cmd, groups_x, groups_y, 1);
}

void ComputeBench::barrier(VkCommandBuffer cmd) const {
  auto memory = make<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  memory.srcStageMask = memory.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  auto info = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &memory;
  fn_.vkCmdPipelineBarrier2(cmd, &info);
}

double ComputeBench::seconds(const std::function<void(VkCommandBuffer)>& record) {
  const Clock::time_point begin = Clock::now();
  if (!host_.submit(record)) throw std::runtime_error("compute: the device is lost");
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double ComputeBench::secondsOfOne(const std::function<void(VkCommandBuffer)>& work, int attempts) {
  double best = seconds(work);
  // A device that was idle may take longer to reach its clock than all attempts together (an H200 once took five times as long to the end), so
  // that what still becomes quicker is not counted. The number of runs follows what was found so far.
  for (int attempt = 0, all = 0; attempt < attempts && all < 16 * attempts; ++attempt, ++all) {
    const int runs = std::clamp(int(0.02 / best), 1, 256);
    const double found = seconds([&](VkCommandBuffer cmd) {
                           for (int i = 0; i < runs; ++i) work(cmd), barrier(cmd);
                         }) / runs;
    if (found < 0.99 * best) attempt = -1;
    best = std::min(best, found);
  }
  return best;
}

}  // namespace forelock::study
