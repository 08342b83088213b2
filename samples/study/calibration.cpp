// SPDX-License-Identifier: MIT
#include "calibration.h"

#include "calibration_spv.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>

namespace forelock::study {
namespace {

#define CALIBRATION_FUNCTIONS(X)                                                                                           \
  X(vkCreateBuffer)                                                                                                        \
  X(vkDestroyBuffer) X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) X(vkAllocateMemory) X(vkFreeMemory)            \
      X(vkCreateShaderModule) X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout)      \
          X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) X(vkCreateComputePipelines) X(vkDestroyPipeline)            \
              X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool) X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets)   \
                  X(vkCmdBindPipeline) X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch) X(vkCmdCopyBuffer) \
                      X(vkCmdFillBuffer) X(vkCmdPipelineBarrier2)

struct Functions {
#define CALIBRATION_DECLARE(name) PFN_##name name = nullptr;
  CALIBRATION_FUNCTIONS(CALIBRATION_DECLARE)
#undef CALIBRATION_DECLARE
};

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string("calibration: ") + what + " failed (" + std::to_string(result) + ")");
}

template <class T>
T make(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

using Clock = std::chrono::steady_clock;

// Owns what it made; members are destroyed in the destructor, also after a throw.
class Bench {
public:
  explicit Bench(samples::HeadlessHost& host);
  ~Bench();
  double bandwidth();
  double laneRate();

private:
  void makeBuffer(VkDeviceSize size, VkBuffer& buffer, VkDeviceMemory& memory);
  double seconds(const std::function<void(VkCommandBuffer)>& record);
  void barrier(VkCommandBuffer cmd) const;
  void makePipeline();
  void dispatch(VkCommandBuffer cmd, uint32_t groups, uint32_t rounds) const;

  samples::HeadlessHost& host_;
  Functions fn_;
  VkDevice device_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkBuffer buffers_[2] = {};
  VkDeviceMemory memories_[2] = {};
  VkDeviceSize size_ = 0;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkShaderModule module_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

Bench::Bench(samples::HeadlessHost& host) : host_(host) {
  const samples::HeadlessHost::Device shared = host.device();
  device_ = shared.device;
  const auto get = [&](const char* name) { return shared.get_instance_proc_addr(shared.instance, name); };
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(get("vkGetDeviceProcAddr"));
#define CALIBRATION_LOAD(name) fn_.name = reinterpret_cast<PFN_##name>(get_device(device_, #name));
  CALIBRATION_FUNCTIONS(CALIBRATION_LOAD)
#undef CALIBRATION_LOAD
  reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties>(get("vkGetPhysicalDeviceMemoryProperties"))(shared.physical_device, &memory_);
  // Far beyond any cache; on a processor as much as is copied in some ten milliseconds.
  size_ = host.deviceType() == VK_PHYSICAL_DEVICE_TYPE_CPU ? VkDeviceSize(128) << 20 : VkDeviceSize(512) << 20;
}

Bench::~Bench() {
  fn_.vkDestroyDescriptorPool(device_, pool_, nullptr);
  fn_.vkDestroyPipeline(device_, pipeline_, nullptr);
  fn_.vkDestroyShaderModule(device_, module_, nullptr);
  fn_.vkDestroyPipelineLayout(device_, layout_, nullptr);
  fn_.vkDestroyDescriptorSetLayout(device_, set_layout_, nullptr);
  for (int i = 0; i < 2; ++i) {
    fn_.vkDestroyBuffer(device_, buffers_[i], nullptr);
    fn_.vkFreeMemory(device_, memories_[i], nullptr);
  }
}

void Bench::makeBuffer(VkDeviceSize size, VkBuffer& buffer, VkDeviceMemory& memory) {
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
  check(fn_.vkCreateBuffer(device_, &info, nullptr, &buffer), "vkCreateBuffer");
  VkMemoryRequirements requirements{};
  fn_.vkGetBufferMemoryRequirements(device_, buffer, &requirements);
  auto allocate = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  allocate.allocationSize = requirements.size;
  for (uint32_t i = memory_.memoryTypeCount; i-- > 0;)
    if ((requirements.memoryTypeBits >> i & 1) && (memory_.memoryTypes[i].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT))
      allocate.memoryTypeIndex = i;
  check(fn_.vkAllocateMemory(device_, &allocate, nullptr, &memory), "vkAllocateMemory");
  check(fn_.vkBindBufferMemory(device_, buffer, memory, 0), "vkBindBufferMemory");
}

double Bench::seconds(const std::function<void(VkCommandBuffer)>& record) {
  const Clock::time_point begin = Clock::now();
  if (!host_.submit(record)) throw std::runtime_error("calibration: the device is lost");
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void Bench::barrier(VkCommandBuffer cmd) const {
  auto memory = make<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  memory.srcStageMask = memory.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  memory.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  auto info = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &memory;
  fn_.vkCmdPipelineBarrier2(cmd, &info);
}

double Bench::bandwidth() {
  for (int i = 0; i < 2; ++i) makeBuffer(size_, buffers_[i], memories_[i]);
  makePipeline();
  seconds([&](VkCommandBuffer cmd) {  // pages that were never written may not exist
    for (const VkBuffer buffer : buffers_) fn_.vkCmdFillBuffer(cmd, buffer, 0, VK_WHOLE_SIZE, 0);
  });
  const VkBufferCopy region{0, 0, size_};
  const bool cpu = host_.deviceType() == VK_PHYSICAL_DEVICE_TYPE_CPU;
  const std::function<void(VkCommandBuffer)> ways[2] = {
      [&](VkCommandBuffer cmd) { fn_.vkCmdCopyBuffer(cmd, buffers_[0], buffers_[1], 1, &region); },
      [&](VkCommandBuffer cmd) { dispatch(cmd, cpu ? 64 : 16384, 0); }};
  double best = 1e300;
  for (const auto& copy : ways) {
    // So many copies a submission that its own cost does not count, within bounds.
    const double once = std::min(seconds(copy), seconds(copy));
    const int copies = std::clamp(int(0.02 / once), 1, 64);
    for (int attempt = 0; attempt < 5; ++attempt)
      best = std::min(best, seconds([&](VkCommandBuffer cmd) {
                              for (int i = 0; i < copies; ++i) {
                                copy(cmd);
                                barrier(cmd);
                              }
                            }) / copies);
  }
  return 2 * double(size_) / best;
}

void Bench::makePipeline() {
  VkDescriptorSetLayoutBinding bindings[2] = {};
  for (uint32_t i = 0; i < 2; ++i) bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = 2;
  set_info.pBindings = bindings;
  check(fn_.vkCreateDescriptorSetLayout(device_, &set_info, nullptr, &set_layout_), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, 2 * sizeof(uint32_t)};
  auto layout_info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = layout_info.pushConstantRangeCount = 1;
  layout_info.pSetLayouts = &set_layout_;
  layout_info.pPushConstantRanges = &push;
  check(fn_.vkCreatePipelineLayout(device_, &layout_info, nullptr, &layout_), "vkCreatePipelineLayout");
  auto module_info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = sizeof calibration_spv;
  module_info.pCode = calibration_spv;
  check(fn_.vkCreateShaderModule(device_, &module_info, nullptr, &module_), "vkCreateShaderModule");
  auto pipeline_info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  pipeline_info.stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline_info.stage.module = module_;
  pipeline_info.stage.pName = "main";
  pipeline_info.layout = layout_;
  check(fn_.vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline_), "vkCreateComputePipelines");
  const VkDescriptorPoolSize sizes{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = pool_info.poolSizeCount = 1;
  pool_info.pPoolSizes = &sizes;
  check(fn_.vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool_), "vkCreateDescriptorPool");
  auto allocate = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate.descriptorPool = pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &set_layout_;
  check(fn_.vkAllocateDescriptorSets(device_, &allocate, &set_), "vkAllocateDescriptorSets");
  const VkDescriptorBufferInfo buffers[2] = {{buffers_[0], 0, VK_WHOLE_SIZE}, {buffers_[1], 0, VK_WHOLE_SIZE}};
  auto write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set_;
  write.descriptorCount = 2;
  write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  write.pBufferInfo = buffers;
  fn_.vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
}

void Bench::dispatch(VkCommandBuffer cmd, uint32_t groups, uint32_t rounds) const {
  const uint32_t push[2] = {rounds, uint32_t(size_ / 16)};
  fn_.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  fn_.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
  fn_.vkCmdPushConstants(cmd, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push, push);
  fn_.vkCmdDispatch(cmd, groups, 1, 1);
}

double Bench::laneRate() {
  const uint32_t groups = host_.deviceType() == VK_PHYSICAL_DEVICE_TYPE_CPU ? 256 : 32768;
  const auto run = [&](uint32_t rounds) { return seconds([&](VkCommandBuffer cmd) { dispatch(cmd, groups, rounds); }); };
  run(1);  // compiles, where a driver does so late
  uint32_t rounds = 16;
  while (rounds < 1u << 22 && run(rounds) < 0.03) rounds *= 2;
  double best = 1e300;
  for (int attempt = 0; attempt < 7; ++attempt) best = std::min(best, run(rounds));
  return double(groups) * 64 * rounds * 64 / best;  // 64 multiply-adds a lane and round
}

}  // namespace

Calibration calibrate(samples::HeadlessHost& host) {
  Bench bench(host);
  Calibration result;
  result.bytes_per_s = bench.bandwidth();
  result.operations_per_s = bench.laneRate();
  return result;
}

}  // namespace forelock::study
