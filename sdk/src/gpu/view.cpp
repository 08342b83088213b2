#include "gpu/view.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace forelock {
namespace {

constexpr uint64_t kDefaultBudget = uint64_t(256) << 20;
constexpr uint64_t kCountBytes = 16;       // of the read-back buffer, a frame
constexpr uint32_t kSmallHeadsFrames = 8;  // before heads twice too large are given back
constexpr VkBufferUsageFlags kStorage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;

}  // namespace

FlkResult View::init(const FlkViewDesc& desc) {
  frames_.resize(desc.frames_in_flight ? desc.frames_in_flight : 3);
  for (uint32_t i = 0; i < frames_.size(); ++i) frames_[i].view = this, frames_[i].slot = i;
  pool_budget_ = desc.pool_budget ? desc.pool_budget : kDefaultBudget;
  return FLK_SUCCESS;
}

void View::destroy() {
  Device& device = context_.device;
  freeRetired(UINT64_MAX);
  for (Buffer* buffer : {&constants_, &heads_, &nodes_, &counters_, &read_back_}) device.destroy(*buffer);
  device.destroy(shadow_map_);
  if (set_pool_) device.fn.vkDestroyDescriptorPool(device.device, set_pool_, nullptr);
  if (queries_) device.fn.vkDestroyQueryPool(device.device, queries_, nullptr);
  set_pool_ = VK_NULL_HANDLE;
  queries_ = VK_NULL_HANDLE;
}

uint64_t View::nodeLimit() const { return std::max<uint64_t>(1, std::min(pool_budget_ / kNodeBytes, kMaxNodes)); }

// ---- Completed frames ----

void View::learn(uint64_t completed) {
  const Frame* newest = nullptr;
  for (const Frame& frame : frames_)
    if (frame.recorded && frame.number <= completed && frame.number > learnt_ &&
        (!newest || frame.number > newest->number))
      newest = &frame;
  if (newest) readStatistics(*newest);
}

void View::readStatistics(const Frame& frame) {
  learnt_ = frame.number;
  latest_ = {};
  latest_.frame_number = frame.number;
  for (double& ms : latest_.milliseconds) ms = -1;
  if (frame.plan.passes.count == 0) return;
  const Device& device = context_.device;
  uint32_t count = 0;
  if (!device.planning())
    count = static_cast<const uint32_t*>(read_back_.memory.mapped)[frame.slot * (kCountBytes / 4)];
  latest_.fragments = count;
  latest_.fragments_lost = count > frame.plan.node_capacity ? count - frame.plan.node_capacity : 0;
  pool_.last_count = count;
  pool_.last_estimate = std::max<uint64_t>(frame.plan.estimate, 1);
  pool_.counted = true;
  if (!frame.plan.timestamps || !queries_) return;
  uint64_t ticks[kTimestamps] = {};
  if (device.fn.vkGetQueryPoolResults(device.device, queries_, frame.slot * kTimestamps, kTimestamps, sizeof ticks,
                                      ticks, sizeof ticks[0], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
    return;
  const uint64_t mask = device.timestamp_bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << device.timestamp_bits) - 1;
  for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage) {
    if (stage == FLK_STAGE_SHADOW && !frame.plan.shadow_size) continue;
    latest_.milliseconds[stage] =
        double((ticks[stage + 1] - ticks[stage]) & mask) * double(device.limits.timestampPeriod) * 1e-6;
  }
}

FlkResult View::statistics(uint64_t completed, FlkStatistics& statistics) {
  learn(std::max(completed, last_completed_));
  if (!learnt_) return FLK_NOT_READY;
  statistics = latest_;
  return FLK_SUCCESS;
}

void View::freeRetired(uint64_t completed) {
  for (Retired& retired : retired_)
    if (retired.last_frame <= completed)
      context_.device.destroy(retired.buffer), context_.device.destroy(retired.image);
  std::erase_if(retired_, [&](const Retired& retired) { return retired.last_frame <= completed; });
}

// ---- Memory ----

FlkResult View::replace(Buffer& buffer, uint64_t bytes, const char* name) {
  retired_.reserve(retired_.size() + 1);  // before there is something to lose
  Buffer fresh;
  const VkBufferUsageFlags usage =
      &buffer == &nodes_ ? VkBufferUsageFlags(VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) : kStorage;
  const FlkResult result = context_.device.createBuffer(bytes, usage, false, name, fresh);
  if (result != FLK_SUCCESS) return result;
  if (buffer.size) retired_.push_back({buffer, {}, last_number_});
  buffer = fresh;
  return FLK_SUCCESS;
}

FlkResult View::ensureMemory(const FramePlan& plan) {
  FlkResult result = FLK_SUCCESS;
  if (!constants_.size) result = replace(constants_, plan.bytes(ResourceId::constants), "constants");
  if (result == FLK_SUCCESS && !counters_.size)
    result = replace(counters_, plan.bytes(ResourceId::counters), "counters");
  const uint64_t head_bytes = plan.bytes(ResourceId::heads);
  small_heads_ = heads_.size > 2 * head_bytes ? small_heads_ + 1 : 0;
  if (result == FLK_SUCCESS && (heads_.size < head_bytes || small_heads_ > kSmallHeadsFrames)) {
    result = replace(heads_, head_bytes, "heads");
    small_heads_ = 0;
  }
  const uint64_t node_bytes = plan.bytes(ResourceId::nodes);
  if (result == FLK_SUCCESS && nodes_.size != node_bytes) result = replace(nodes_, node_bytes, "nodes");
  if (result == FLK_SUCCESS && shadow_map_.size != plan.shadow_size) {
    retired_.reserve(retired_.size() + 1);
    Image fresh;
    if (plan.shadow_size) result = context_.device.createDepthImage(plan.shadow_size, "shadow map", fresh);
    if (result == FLK_SUCCESS) {
      if (shadow_map_.size) retired_.push_back({{}, shadow_map_, last_number_});
      shadow_map_ = fresh;
    }
  }
  return result;
}

FlkResult View::ensureRing(bool timestamps) {
  Device& device = context_.device;
  const uint32_t count = uint32_t(frames_.size());
  if (!read_back_.size) {
    const FlkResult result =
        device.createBuffer(kCountBytes * count, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, "read-back", read_back_);
    if (result != FLK_SUCCESS) return result;
    // A frame that was recorded and never submitted reads as one that counted nothing.
    if (!device.planning()) std::memset(read_back_.memory.mapped, 0, kCountBytes * count);
  }
  if (device.planning()) return FLK_SUCCESS;
  if (!set_pool_) {
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 3 * count},
                                          {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 2 * count},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, count}};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = count;
    info.poolSizeCount = uint32_t(std::size(sizes));
    info.pPoolSizes = sizes;
    const VkResult result = device.fn.vkCreateDescriptorPool(device.device, &info, nullptr, &set_pool_);
    if (result != VK_SUCCESS) return set_pool_ = VK_NULL_HANDLE, toResult(result);
  }
  if (timestamps && !queries_) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kTimestamps * count;
    const VkResult result = device.fn.vkCreateQueryPool(device.device, &info, nullptr, &queries_);
    if (result != VK_SUCCESS) return queries_ = VK_NULL_HANDLE, toResult(result);
  }
  return FLK_SUCCESS;
}

// A set that still names an image which this frame does without is exchanged for a fresh one: the image may be gone, and
// lavapipe (Mesa 22.3.6) reads every descriptor of a bound set, also those that no shader uses. To be removed with that Mesa.
FlkResult View::ensureSet(Frame& frame, const FramePlan& plan) {
  Device& device = context_.device;
  if (device.planning()) return FLK_SUCCESS;
  const bool stale = (frame.set_has_depth && !plan.has_depth) || (frame.set_has_shadow && !plan.shadow_size);
  if (frame.set && !stale) return FLK_SUCCESS;
  if (frame.set) device.fn.vkFreeDescriptorSets(device.device, set_pool_, 1, &frame.set);
  frame.set = VK_NULL_HANDLE;
  frame.set_has_depth = frame.set_has_shadow = false;
  VkDescriptorSetAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = set_pool_;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &context_.pipelines.view_set;
  const VkResult result = device.fn.vkAllocateDescriptorSets(device.device, &allocate, &frame.set);
  if (result != VK_SUCCESS) frame.set = VK_NULL_HANDLE;
  return toResult(result);
}

void View::writeSet(Frame& frame) {
  VkDescriptorBufferInfo buffers[3];
  const VkBuffer handles[] = {frame.constants, frame.heads, frame.counters};
  VkDescriptorImageInfo images[3] = {
      {VK_NULL_HANDLE, frame.depth.view, frame.depth.layout},
      {VK_NULL_HANDLE, frame.shadow_map.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
      {VK_NULL_HANDLE, frame.target.view, VK_IMAGE_LAYOUT_GENERAL},
  };
  VkWriteDescriptorSet writes[6]{};
  uint32_t count = 0;
  auto write = [&](uint32_t binding, VkDescriptorType type) -> VkWriteDescriptorSet& {
    VkWriteDescriptorSet& w = writes[count++];
    w.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    w.dstSet = frame.set;
    w.dstBinding = binding;
    w.descriptorCount = 1;
    w.descriptorType = type;
    return w;
  };
  for (uint32_t i = 0; i < 3; ++i) {
    buffers[i] = {handles[i], 0, VK_WHOLE_SIZE};
    write(kBindFrame + i, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER).pBufferInfo = &buffers[i];
  }
  if (frame.plan.has_depth) write(kBindHostDepth, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE).pImageInfo = &images[0];
  if (frame.plan.shadow_size) write(kBindShadowMap, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE).pImageInfo = &images[1];
  write(kBindTarget, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE).pImageInfo = &images[2];
  context_.device.fn.vkUpdateDescriptorSets(context_.device.device, count, writes, 0, nullptr);
  frame.set_has_depth = frame.plan.has_depth;
  frame.set_has_shadow = frame.plan.shadow_size != 0;
}

// ---- Plan ----

Frame* View::freeSlot(uint64_t completed) {
  Frame* oldest = nullptr;
  for (Frame& frame : frames_)
    if (frame.number <= completed && (!oldest || frame.number < oldest->number)) oldest = &frame;
  return oldest;
}

FlkResult View::plan(const FlkFrame& asked, Hair* const* hairs, Frame*& planned) {
  const Messages& messages = context_.device.messages;
  if (asked.frame_number <= last_number_ || asked.completed_frame >= asked.frame_number) {
    messages.say(FLK_SEVERITY_ERROR, "FRAME_NUMBER",
                 "frame_number must rise with every plan of a view and exceed completed_frame");
    return FLK_ERROR_INVALID_ARGUMENT;
  }
  Camera camera;
  if (const char* fault = makeCamera(asked.view_from_world, asked.clip_from_view, asked.reversed_depth,
                                     asked.target.width, asked.target.height, camera)) {
    messages.say(FLK_SEVERITY_ERROR, "FRAME_CAMERA", "%s", fault);
    return FLK_ERROR_INVALID_ARGUMENT;
  }
  const uint64_t completed = std::max(asked.completed_frame, last_completed_);
  learn(completed);
  freeRetired(completed);
  last_completed_ = completed;
  Frame* frame = freeSlot(completed);
  if (!frame) {
    messages.say(FLK_SEVERITY_ERROR, "FRAMES_IN_FLIGHT",
                 "%zu frames of this view are planned and not completed: wait for one, or create the view with more "
                 "frames_in_flight",
                 frames_.size());
    return FLK_ERROR_TOO_MANY_FRAMES;
  }

  HairFacts hair_facts[kMaxHairs];
  for (uint32_t i = 0; i < asked.hair_count; ++i) hair_facts[i] = hairs[i]->facts();
  LightFacts light_facts[1];
  for (uint32_t i = 0; i < asked.light_count; ++i)
    light_facts[i] = {asked.lights[i].casts_shadow != 0,
                      asked.lights[i].shadow_size ? asked.lights[i].shadow_size : 1024};
  FrameFacts facts;
  facts.camera = camera;
  facts.hairs = {hair_facts, asked.hair_count};
  facts.lights = {light_facts, asked.light_count};
  facts.method = asked.method, facts.display = asked.display, facts.payload = asked.payload;
  facts.k = asked.k == FLK_K_NONE ? 0 : asked.k ? asked.k : 8;
  facts.k_sort = asked.k_sort ? asked.k_sort : std::max(8u, facts.k);
  facts.has_depth = asked.depth.view != VK_NULL_HANDLE;
  facts.timestamps = asked.timestamps && (context_.device.planning() || context_.device.timestamp_bits > 0);

  PoolState pool = pool_;
  // A speck may be estimated at no fragment; while it is in view there is room for some.
  pool.capacity = choosePoolCapacity(pool, std::max<uint64_t>(estimateFragments(facts), 1), nodeLimit());
  const FramePlan plan = planFrame(facts, pool.capacity);
  const VkPhysicalDeviceLimits& limits = context_.device.limits;
  if (!context_.device.planning() &&
      (asked.target.width > std::min(limits.maxFramebufferWidth, limits.maxViewportDimensions[0]) ||
       asked.target.height > std::min(limits.maxFramebufferHeight, limits.maxViewportDimensions[1]) ||
       plan.shadow_size > std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth))) {
    messages.say(FLK_SEVERITY_ERROR, "DEVICE_LIMIT",
                 "a target of %u x %u or a shadow map of %u exceeds what the device can draw to", asked.target.width,
                 asked.target.height, plan.shadow_size);
    return FLK_ERROR_LIMIT;
  }
  if (plan.bytes(ResourceId::heads) > context_.device.limits.maxStorageBufferRange) {
    messages.say(FLK_SEVERITY_ERROR, "HEADS_TOO_LARGE",
                 "hair covers %u x %u pixels, whose list heads need %llu bytes, and the device binds at most %u: draw "
                 "fewer pixels",
                 plan.rect.width, plan.rect.height, static_cast<unsigned long long>(plan.bytes(ResourceId::heads)),
                 context_.device.limits.maxStorageBufferRange);
    return FLK_ERROR_LIMIT;
  }

  VkPipeline shadow = VK_NULL_HANDLE, capture = VK_NULL_HANDLE, resolve = VK_NULL_HANDLE;
  if (plan.passes.count) {
    FlkResult result = ensureRing(plan.timestamps);
    if (result == FLK_SUCCESS) result = ensureMemory(plan);
    if (result == FLK_SUCCESS) result = ensureSet(*frame, plan);
    if (result == FLK_SUCCESS && plan.shadow_size)
      result = context_.pipelines.get(context_.device, shadowRecipe(plan), shadow);
    if (result == FLK_SUCCESS) result = context_.pipelines.get(context_.device, captureRecipe(plan), capture);
    if (result == FLK_SUCCESS) result = context_.pipelines.get(context_.device, resolveRecipe(plan), resolve);
    if (result != FLK_SUCCESS) return result;
  }

  // Nothing below fails.
  if (plan.passes.count) pool_ = pool;
  last_number_ = asked.frame_number;
  frame->number = asked.frame_number;
  frame->plan = plan;
  frame->recorded = false;
  frame->hair_count = asked.hair_count;
  frame->bytes_persistent = 0;
  for (uint32_t i = 0; i < asked.hair_count; ++i) frame->bytes_persistent += hairs[i]->bytesDevice();
  for (uint32_t i = 0; i < asked.hair_count; ++i) frame->hairs[i] = hairs[i];
  frame->shadow = shadow, frame->capture = capture, frame->resolve = resolve;
  frame->target = asked.target, frame->depth = asked.depth;
  frame->texels_from_world = kIdentity;
  if (plan.passes.count) {
    frame->constants = constants_.handle, frame->heads = heads_.handle, frame->counters = counters_.handle;
    frame->node_address = nodes_.address;
    frame->shadow_map = shadow_map_;
    fillConstants(*frame, asked, camera, hair_facts);
    if (!context_.device.planning()) writeSet(*frame);
  }
  planned = frame;
  return FLK_SUCCESS;
}

FlkResult View::shadowMap(FlkShadowMap& map) const {
  const Frame* latest = nullptr;
  for (const Frame& frame : frames_)
    if (frame.number == last_number_ && frame.number) latest = &frame;
  if (!latest || !latest->plan.shadow_size) return FLK_NOT_READY;
  map.image = latest->shadow_map.handle;
  map.view = latest->shadow_map.view;
  map.size = latest->plan.shadow_size;
  std::copy(latest->texels_from_world.begin(), latest->texels_from_world.end(), map.texels_from_world);
  map.texels_from_world[12] += map.size * 0.5,
      map.texels_from_world[13] += map.size * 0.5;  // from the corner, as images are read
  map.depth_range = latest->shadow_range;
  map.texel = latest->shadow_texel;
  return FLK_SUCCESS;
}

}  // namespace forelock
