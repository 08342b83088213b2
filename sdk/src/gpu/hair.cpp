#include "gpu/hair.h"

#include "gpu/context.h"

#include "shared/hair.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory_resource>
#include <utility>
#include <vector>

namespace forelock {
namespace {

// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": one step of SplitMix64.
uint64_t splitMix(uint64_t& state) {
  uint64_t z = state += 0x9E3779B97F4A7C15u;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

}  // namespace

FlkResult Hair::init(const FlkHairDesc& desc, const FlkStrands& strands) {
  if (desc.material)
    material = *desc.material;
  else
    flkMaterialDefault(&material);
  strand_count = strands.strand_count;
  vertex_count = strands.vertex_count;
  segment_count = vertex_count - strand_count;
  bytes_[0] = uint64_t(vertex_count) * 12;
  bytes_[1] = uint64_t(vertex_count) * 4;
  bytes_[2] = uint64_t(segment_count) * 4;

  bounds_.min = bounds_.max = {strands.positions[0], strands.positions[1], strands.positions[2]};
  for (uint32_t i = 0; i < vertex_count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      bounds_.min[axis] = std::min(bounds_.min[axis], double(strands.positions[i * std::size_t(3) + axis]));
      bounds_.max[axis] = std::max(bounds_.max[axis], double(strands.positions[i * std::size_t(3) + axis]));
    }
    radius_max = std::max(radius_max, strands.radii[i]);
  }

  Device& device = context_.device;
  const char* names[] = {"hair positions", "hair attributes", "hair segments"};
  for (int i = 0; i < 3; ++i) {
    if (bytes_[i] > device.limits.maxStorageBufferRange) {
      device.messages.say(FLK_SEVERITY_ERROR, "HAIR_TOO_LARGE",
                          "%s need %llu bytes, the device binds at most %u: split the asset", names[i],
                          static_cast<unsigned long long>(bytes_[i]), device.limits.maxStorageBufferRange);
      return FLK_ERROR_LIMIT;
    }
  }
  FlkResult result = FLK_SUCCESS;
  for (int i = 0; i < 3 && result == FLK_SUCCESS; ++i)
    result = device.createBuffer(bytes_[i], VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                 false, names[i], buffers_[i]);
  if (result == FLK_SUCCESS)
    result = device.createBuffer(bytesDevice(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true, "hair staging", staging_);
  if (result == FLK_SUCCESS && !device.planning()) result = createSet();
  if (result != FLK_SUCCESS) return destroy(), result;

  try {
    fill(strands, desc.flags & FLK_HAIR_KEEP_ORDER, desc.shuffle_seed,
         static_cast<unsigned char*>(staging_.memory.mapped));
  } catch (...) {
    destroy();
    throw;
  }
  return FLK_SUCCESS;
}

// With a planning device only lengths are taken.
void Hair::fill(const FlkStrands& strands, bool keep_order, uint32_t seed, unsigned char* staging) {
  const bool store = staging != nullptr;
  auto* positions = reinterpret_cast<float*>(staging);
  auto* attributes = store ? reinterpret_cast<uint32_t*>(staging + bytes_[0]) : nullptr;
  auto* segments = store ? reinterpret_cast<uint32_t*>(staging + bytes_[0] + bytes_[1]) : nullptr;
  std::pmr::vector<uint32_t> order(strand_count, &context_.memory());
  for (uint32_t i = 0; i < strand_count; ++i) order[i] = i;
  if (!keep_order) {
    uint64_t state = seed;
    for (uint32_t i = strand_count; i > 1; --i) std::swap(order[i - 1], order[splitMix(state) % i]);
  }

  uint32_t vertex = 0;
  length_ = 0;
  for (const uint32_t strand : order) {
    const uint32_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    auto segmentLength = [&](uint32_t i) {
      const float* p = strands.positions + std::size_t(i) * 3;
      return std::hypot(double(p[3]) - p[0], double(p[4]) - p[1], double(p[5]) - p[2]);
    };
    double strand_length = 0;
    for (uint32_t i = begin; i + 1 < end; ++i) strand_length += segmentLength(i);
    length_ += strand_length;
    if (!store) continue;
    uint64_t hash_state = strand;
    const uint32_t hash = uint32_t(splitMix(hash_state) & 0x1F);
    double walked = 0;
    for (uint32_t i = begin; i < end; ++i, ++vertex) {
      std::memcpy(positions + std::size_t(vertex) * 3, strands.positions + std::size_t(i) * 3, 12);
      const double radius = radius_max > 0 ? std::sqrt(double(strands.radii[i]) / radius_max) : 0;
      const double fraction = std::min(walked / strand_length, 1.0);  // an asset holds no strand without length
      attributes[vertex] = uint32_t(std::lround(radius * FLK_RADIUS_STEPS)) |
                           uint32_t(std::lround(fraction * FLK_FRACTION_STEPS)) << FLK_FRACTION_SHIFT |
                           hash << FLK_HASH_SHIFT;
      if (i + 1 == end) continue;
      walked += segmentLength(i);
      *segments++ = vertex | (i == begin ? FLK_SEGMENT_ROOT : 0) | (i + 2 == end ? FLK_SEGMENT_TIP : 0);
    }
  }
}

FlkResult Hair::createSet() {
  Device& device = context_.device;
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3};
  VkDescriptorPoolCreateInfo pool{};
  pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  pool.maxSets = 1;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  VkResult result = device.fn.vkCreateDescriptorPool(device.device, &pool, nullptr, &pool_);
  if (result != VK_SUCCESS) return pool_ = VK_NULL_HANDLE, toResult(result);
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool_;
  info.descriptorSetCount = 1;
  info.pSetLayouts = &context_.pipelines.hair_set;
  result = device.fn.vkAllocateDescriptorSets(device.device, &info, &set);
  if (result != VK_SUCCESS) return toResult(result);
  VkDescriptorBufferInfo buffers[3];
  VkWriteDescriptorSet writes[3]{};
  for (uint32_t i = 0; i < 3; ++i) {
    buffers[i] = {buffers_[i].handle, 0, VK_WHOLE_SIZE};
    writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    writes[i].dstSet = set;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[i].pBufferInfo = &buffers[i];
  }
  device.fn.vkUpdateDescriptorSets(device.device, 3, writes, 0, nullptr);
  return FLK_SUCCESS;
}

void Hair::destroy() {
  Device& device = context_.device;
  if (pool_) device.fn.vkDestroyDescriptorPool(device.device, pool_, nullptr);
  pool_ = VK_NULL_HANDLE;
  set = VK_NULL_HANDLE;
  for (Buffer& buffer : buffers_) device.destroy(buffer);
  device.destroy(staging_);
}

void Hair::upload(VkCommandBuffer cmd) {
  uploaded = true;
  const Functions& fn = context_.device.fn;
  uint64_t offset = 0;
  for (int i = 0; i < 3; ++i) {
    const VkBufferCopy region{offset, 0, bytes_[i]};
    fn.vkCmdCopyBuffer(cmd, staging_.handle, buffers_[i].handle, 1, &region);
    offset += bytes_[i];
  }
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  fn.vkCmdPipelineBarrier2(cmd, &info);
}

void Hair::releaseStaging() { context_.device.destroy(staging_); }

HairFacts Hair::facts() const {
  HairFacts facts;
  const double scale = std::cbrt(std::abs(determinant3(world_from_hair)));
  facts.segments = segment_count;
  facts.bounds = bounds_;
  facts.world_from_hair = world_from_hair;
  facts.radius = double(radius_max) * material.width_scale * scale;
  facts.length = length_ * scale;
  return facts;
}

}  // namespace forelock
