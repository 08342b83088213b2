#include "gpu/view.h"

#include <algorithm>
#include <cstring>
#include <iterator>

namespace forelock {
namespace {

constexpr uint64_t kDefaultBudget = uint64_t(256) << 20;
constexpr uint32_t kSmallFrames = 8;                     // before memory twice too large is given back
constexpr VkBufferUsageFlags kBound =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
constexpr VkBufferUsageFlags kConstant = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr VkBufferUsageFlags kAddressed = VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

LightFacts lightFacts(const FlkLight& light) {
  LightFacts facts;
  facts.casts_shadow = light.casts_shadow != 0;
  facts.shadow_size = light.shadow_size ? light.shadow_size : 1024;
  facts.cover_width = light.shadow_cover == FLK_SHADOW_COVER_WIDTH;
  facts.kind = LightKind(light.kind);
  if (light.kind != FLK_LIGHT_POINT) facts.direction = normalize({light.direction[0], light.direction[1], light.direction[2]});
  facts.position = {light.position[0], light.position[1], light.position[2]};
  facts.outer_angle = light.outer_angle;
  facts.host_shadow = light.host_shadow != nullptr;
  facts.host_visibility = light.visibility != 0;
  return facts;
}

}  // namespace

uint32_t stageOf(PassId id) {
  switch (id) {
    case PassId::clear: return FLK_STAGE_CLEAR;
    case PassId::prepare: return FLK_STAGE_PREPARE;
    case PassId::shadow: return FLK_STAGE_SHADOW;
    case PassId::count:
    case PassId::capture:
    case PassId::hard_depth:
    case PassId::hard_payload: return FLK_STAGE_CAPTURE;
    case PassId::resolve: return FLK_STAGE_RESOLVE;
    case PassId::output: return FLK_STAGE_OUTPUT;
  }
  return FLK_STAGE_COUNT;
}

FlkResult View::init(const FlkViewDesc& desc) {
  const uint32_t count = desc.frames_in_flight ? desc.frames_in_flight : 3;
  frames_.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    frames_.emplace_back(&context_.memory());
    frames_[i].view = this, frames_[i].slot = i;
  }
  pool_budget_ = desc.pool_budget ? desc.pool_budget : kDefaultBudget;
  return FLK_SUCCESS;
}

void View::destroy() {
  Device& device = context_.device;
  freeRetired(UINT64_MAX);
  for (Buffer* buffer : {&constants_, &lights_, &heads_, &nodes_, &aggregates_, &counters_, &read_back_}) device.destroy(*buffer);
  device.destroy(shadow_map_);
  if (set_pool_) device.fn.vkDestroyDescriptorPool(device.device, set_pool_, nullptr);
  if (output_pool_) device.fn.vkDestroyDescriptorPool(device.device, output_pool_, nullptr);
  if (queries_) device.fn.vkDestroyQueryPool(device.device, queries_, nullptr);
  set_pool_ = output_pool_ = VK_NULL_HANDLE;
  queries_ = VK_NULL_HANDLE;
}

uint64_t View::nodeLimit(uint64_t node_bytes) const { return std::max<uint64_t>(1, std::min(pool_budget_ / node_bytes, kMaxNodes)); }

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
  latest_.milliseconds_frame = -1;
  for (double& ms : latest_.milliseconds) ms = -1;
  if (frame.plan.passes.count == 0) return;
  const Device& device = context_.device;
  uint32_t counters[FLK_SHARED_COUNTER_WORDS] = {};
  const std::size_t counter_bytes = std::min<std::size_t>(frame.plan.bytes(ResourceId::counters), sizeof counters);
  if (!device.planning())
    std::memcpy(counters, static_cast<const std::byte*>(read_back_.memory.mapped) + frame.slot * counter_bytes, counter_bytes);
  uint64_t count = counters[0];
  const bool lists = frame.plan.has(PassId::capture);
  for (uint32_t share = 0; share < FLK_SHARES && frame.plan.node_shares; ++share)
    count += std::min(counters[FLK_SHARE_COUNTER(share)],
                      lists ? FLK_SHARE_NODES(share, uint32_t(frame.plan.node_capacity)) : FLK_COUNT_SATURATED);
  count = std::min<uint64_t>(count, FLK_COUNT_SATURATED);
  latest_.fragments = count;
  latest_.overflow_fragments = lists && count > frame.plan.node_capacity ? count - frame.plan.node_capacity : 0;
  latest_.pixels = counters[FLK_COUNTER_PIXELS];
  latest_.full_shades = counters[FLK_COUNTER_FULL], latest_.low_shades = counters[FLK_COUNTER_LOW];
  latest_.shadow_taps = uint64_t(counters[FLK_COUNTER_TAPS + 1]) << 32 | counters[FLK_COUNTER_TAPS];
  if (frame.plan.method->lists()) {  // opaque strands are counted by other rules
    pool_.last_count = count;
    pool_.last_estimate = std::max<uint64_t>(frame.plan.estimate, 1);
    pool_.counted = true;
  }
  if (!frame.plan.timestamps || !queries_) return;
  uint64_t ticks[kTimestamps] = {};
  const bool stages = frame.plan.timestamps == FLK_TIMESTAMPS_STAGES;
  for (uint32_t i = 0; i < kTimestamps; ++i)
    if ((stages || i == 0 || i == FLK_STAGE_COUNT) &&
        device.fn.vkGetQueryPoolResults(device.device, queries_, frame.slot * kTimestamps + i, 1, sizeof ticks[i], &ticks[i],
                                        sizeof ticks[i], VK_QUERY_RESULT_64_BIT) != VK_SUCCESS)
      return;
  const uint64_t mask = device.timestamp_bits >= 64 ? ~uint64_t(0) : (uint64_t(1) << device.timestamp_bits) - 1;
  const auto between = [&](uint32_t first, uint32_t last) {
    return double((ticks[last] - ticks[first]) & mask) * double(device.limits.timestampPeriod) * 1e-6;
  };
  latest_.milliseconds_frame = between(0, FLK_STAGE_COUNT);
  for (uint32_t i = 0; i < FLK_STAGE_COUNT && stages; ++i)
    for (const Pass& pass : frame.plan.passes)
      if (stageOf(pass.id) == kStageOrder[i]) latest_.milliseconds[kStageOrder[i]] = between(i, i + 1);
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

FlkResult View::replace(Buffer& buffer, uint64_t bytes, VkBufferUsageFlags usage, const char* name) {
  retired_.reserve(retired_.size() + 1);  // before there is something to lose
  Buffer fresh;
  const FlkResult result = bytes ? context_.device.createBuffer(bytes, usage, false, name, fresh) : FLK_SUCCESS;
  if (result != FLK_SUCCESS) return result;
  if (buffer.size) retired_.push_back({buffer, {}, last_number_});
  buffer = fresh;
  return FLK_SUCCESS;
}

// Grows at once; what is twice too large for some frames, or not needed at all, is given back.
FlkResult View::follow(Buffer& buffer, uint32_t& small_frames, uint64_t bytes, VkBufferUsageFlags usage, const char* name) {
  small_frames = buffer.size > 2 * bytes ? small_frames + 1 : 0;
  if (buffer.size >= bytes && small_frames <= kSmallFrames) return FLK_SUCCESS;
  const FlkResult result = replace(buffer, bytes, usage, name);
  if (result == FLK_SUCCESS) small_frames = 0;
  return result;
}

FlkResult View::ensureMemory(const FramePlan& plan) {
  FlkResult result = FLK_SUCCESS;
  if (!constants_.size) result = replace(constants_, plan.bytes(ResourceId::constants), kConstant, "constants");
  if (result == FLK_SUCCESS && !counters_.size) result = replace(counters_, plan.bytes(ResourceId::counters), kBound, "counters");
  if (result == FLK_SUCCESS && lights_.size != plan.bytes(ResourceId::lights))
    result = replace(lights_, plan.bytes(ResourceId::lights), kAddressed, "lights");
  if (result == FLK_SUCCESS) result = follow(heads_, small_heads_, plan.bytes(ResourceId::heads), kBound, "heads");
  if (result == FLK_SUCCESS)
    result = follow(aggregates_, small_aggregates_, plan.bytes(ResourceId::aggregates), kAddressed, "aggregates");
  const uint64_t node_bytes = plan.bytes(ResourceId::nodes);
  if (result == FLK_SUCCESS && nodes_.size != node_bytes && !plan.count_only)
    result = replace(nodes_, node_bytes, VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, "nodes");
  const ShadowLayout& shadow = plan.shadow;
  if (result == FLK_SUCCESS && (shadow_map_.width != shadow.width || shadow_map_.height != shadow.height ||
                                (shadow.width && shadow_map_.computed != plan.compute))) {
    retired_.reserve(retired_.size() + 1);
    Image fresh;
    if (shadow.width) result = context_.device.createMapImage(shadow.width, shadow.height, plan.compute, "shadow map", fresh);
    if (result == FLK_SUCCESS) {
      if (shadow_map_.width) retired_.push_back({{}, shadow_map_, last_number_});
      shadow_map_ = fresh;
    }
  }
  return result;
}

namespace {

FlkResult createSetPool(Device& device, uint32_t sets, VkDescriptorPool& pool) {
  constexpr VkDescriptorType kTypes[] = {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
  VkDescriptorPoolSize sizes[std::size(kTypes)];
  for (std::size_t t = 0; t < std::size(kTypes); ++t) {
    sizes[t] = {kTypes[t], 0};
    for (uint32_t i = 0; i < kBindingCount; ++i) sizes[t].descriptorCount += bindingType(i) == kTypes[t] ? sets : 0;
  }
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  info.maxSets = sets;
  info.poolSizeCount = uint32_t(std::size(kTypes));
  info.pPoolSizes = sizes;
  const VkResult result = device.fn.vkCreateDescriptorPool(device.device, &info, nullptr, &pool);
  if (result != VK_SUCCESS) pool = VK_NULL_HANDLE;
  return toResult(result);
}

// Bindings that a frame's passes read.
uint32_t neededBindings(const FramePlan& plan) {
  uint32_t needed = 1u << kBindFrame | 1u << kBindFrameStored | 1u << kBindHeads | 1u << kBindCounters;
  if (plan.has_depth) needed |= 1u << kBindHostDepth;
  if (plan.hasShadow()) needed |= 1u << kBindShadowMap;
  if (plan.hasShadow() && plan.compute) needed |= 1u << kBindShadowStore;
  if (plan.host_light) needed |= 1u << kBindHostShadowMaps | 1u << kBindHostVisibility;
  if (!plan.count_only) needed |= 1u << kBindTarget;
  return needed;
}

constexpr uint32_t kOutputBindings = 1u << kBindFrame | 1u << kBindHeads | 1u << kBindCounters | 1u << kBindTarget;

}  // namespace

FlkResult View::ensureRing(const FramePlan& plan) {
  Device& device = context_.device;
  const uint32_t count = uint32_t(frames_.size());
  if (!read_back_.size) {
    const uint64_t bytes = plan.bytes(ResourceId::read_back);
    const FlkResult result = device.createBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, true, "read-back", read_back_);
    if (result != FLK_SUCCESS) return result;
    // A frame that was recorded and never submitted reads as one that counted nothing.
    if (!device.planning()) std::memset(read_back_.memory.mapped, 0, bytes);
  }
  if (device.planning()) return FLK_SUCCESS;
  FlkResult result = FLK_SUCCESS;
  if (!set_pool_) result = createSetPool(device, count, set_pool_);
  if (result == FLK_SUCCESS && plan.outputs && !output_pool_) result = createSetPool(device, count * FLK_OUTPUT_COUNT, output_pool_);
  if (result == FLK_SUCCESS && plan.timestamps && !queries_) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kTimestamps * count;
    const VkResult made = device.fn.vkCreateQueryPool(device.device, &info, nullptr, &queries_);
    if (made != VK_SUCCESS) queries_ = VK_NULL_HANDLE;
    result = toResult(made);
  }
  return result;
}

// A set that still names an image which this frame does without is exchanged for a fresh one: the image may be gone, and
// lavapipe (Mesa 22.3.6) reads every descriptor of a bound set, also those that no shader uses. To be removed with that Mesa.
FlkResult View::ensureSet(VkDescriptorPool pool, BoundSet& bound, uint32_t needed) {
  Device& device = context_.device;
  if (bound.set && !(bound.written & ~needed)) return FLK_SUCCESS;
  if (bound.set) device.fn.vkFreeDescriptorSets(device.device, pool, 1, &bound.set);
  bound = {};
  VkDescriptorSetAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  allocate.descriptorPool = pool;
  allocate.descriptorSetCount = 1;
  allocate.pSetLayouts = &context_.pipelines.view_set;
  const VkResult result = device.fn.vkAllocateDescriptorSets(device.device, &allocate, &bound.set);
  if (result != VK_SUCCESS) bound.set = VK_NULL_HANDLE;
  return toResult(result);
}

FlkResult View::ensureSets(Frame& frame, const FramePlan& plan) {
  if (context_.device.planning()) return FLK_SUCCESS;
  FlkResult result = ensureSet(set_pool_, frame.bound, neededBindings(plan));
  for (uint32_t i = 0; i < FLK_OUTPUT_COUNT && result == FLK_SUCCESS; ++i)
    if (plan.outputs >> i & 1) result = ensureSet(output_pool_, frame.output_bound[i], kOutputBindings);
  return result;
}

void View::writeSet(Frame& frame, BoundSet& bound, VkImageView storage, uint32_t needed) {
  VkDescriptorBufferInfo buffers[kBindingCount];
  VkDescriptorImageInfo images[kBindingCount];
  VkWriteDescriptorSet writes[kBindingCount]{};
  uint32_t count = 0;
  // A frame that only counts has no heads: its counters stand in for what no shader of it touches. Likewise for the one of the
  // host's two pictures that is missing.
  buffers[kBindFrame] = buffers[kBindFrameStored] = {frame.constants, 0, VK_WHOLE_SIZE};
  buffers[kBindHeads] = {frame.heads ? frame.heads : frame.counters, 0, VK_WHOLE_SIZE};
  buffers[kBindCounters] = {frame.counters, 0, VK_WHOLE_SIZE};
  const FlkSampledImage& maps = frame.host_shadow_maps.view ? frame.host_shadow_maps : frame.host_visibility;
  const FlkSampledImage& visibility = frame.host_visibility.view ? frame.host_visibility : frame.host_shadow_maps;
  images[kBindHostDepth] = {VK_NULL_HANDLE, frame.depth.view, frame.depth.layout};
  images[kBindShadowMap] = {VK_NULL_HANDLE, frame.shadow_map.view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  images[kBindTarget] = {VK_NULL_HANDLE, storage, VK_IMAGE_LAYOUT_GENERAL};
  images[kBindHostShadowMaps] = {VK_NULL_HANDLE, maps.view, maps.layout};
  images[kBindHostVisibility] = {VK_NULL_HANDLE, visibility.view, visibility.layout};
  images[kBindShadowStore] = {VK_NULL_HANDLE, frame.shadow_map.store_view, VK_IMAGE_LAYOUT_GENERAL};
  for (uint32_t i = 0; i < kBindingCount; ++i) {
    if (!(needed >> i & 1)) continue;
    VkWriteDescriptorSet& write = writes[count++];
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = bound.set;
    write.dstBinding = i;
    write.descriptorCount = 1;
    write.descriptorType = bindingType(i);
    if (i <= kBindCounters || i == kBindFrameStored) write.pBufferInfo = &buffers[i];
    else write.pImageInfo = &images[i];
  }
  context_.device.fn.vkUpdateDescriptorSets(context_.device.device, count, writes, 0, nullptr);
  bound.written = needed;
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
  std::pmr::vector<LightFacts> light_facts(asked.light_count, &context_.memory());
  for (uint32_t i = 0; i < asked.light_count; ++i) light_facts[i] = lightFacts(asked.lights[i]);
  const Device& device = context_.device;
  const VkPhysicalDeviceLimits& limits = device.limits;
  FrameFacts facts;
  facts.camera = camera;
  facts.hairs = {hair_facts, asked.hair_count};
  facts.lights = light_facts;
  facts.method = asked.method, facts.display = asked.display, facts.payload = asked.payload, facts.tail = asked.tail;
  facts.core_taps = asked.core_taps ? asked.core_taps : kFullTaps, facts.low_shade = asked.low_shade;
  facts.k = asked.k == FLK_K_NONE ? 0 : asked.k ? asked.k : 8;
  facts.k_sort = asked.k_sort ? asked.k_sort : std::max(8u, facts.k);
  if (asked.method == FLK_METHOD_ALL_LOW) facts.k = 0;
  facts.compute = asked.capture == FLK_CAPTURE_COMPUTE || (asked.capture == FLK_CAPTURE_DEFAULT && !device.graphics);
  if (!facts.compute && !device.graphics) {
    messages.say(FLK_SEVERITY_ERROR, "FRAME_CAPTURE", "FLK_CAPTURE_RASTER needs a queue family with graphics");
    return FLK_ERROR_INVALID_ARGUMENT;
  }
  facts.cpu = device.cpu;
  facts.drop_overflow = asked.overflow == FLK_OVERFLOW_DROP;
  facts.count_only = asked.count_only, facts.count_work = asked.count_work;
  facts.ambient_sh = asked.ambient_sh != nullptr;
  facts.light_tiles = asked.light_tiles.address != 0;
  for (uint32_t i = 0; i < asked.opacity_modifier_count; ++i) facts.modifiers |= asked.opacity_modifiers[i].kind << 2 * i;
  for (uint32_t i = 0; i < FLK_OUTPUT_COUNT; ++i) facts.outputs |= asked.outputs[i].view ? 1u << i : 0;
  facts.has_depth = asked.depth.view != VK_NULL_HANDLE;
  facts.frames_in_flight = uint32_t(frames_.size());
  facts.timestamps = device.planning() || device.timestamp_bits > 0 ? asked.timestamps : 0u;
  if (!device.planning()) facts.image_limit = std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth);

  PoolState pool = pool_;
  const uint64_t node_bytes = nodeBytes(facts);
  // A speck may be estimated at no fragment; while it is in view there is room for some.
  const bool lists = asked.display || kMethods[asked.method].lists();
  if (lists && !asked.count_only)
    pool.capacity = choosePoolCapacity(pool, std::max<uint64_t>(estimateFragments(facts), 1), nodeLimit(node_bytes));
  const FramePlan plan = planFrame(facts, pool.capacity);
  if (plan.fault) {
    messages.say(FLK_SEVERITY_ERROR, "SHADOW_MAPS", "%s", plan.fault);
    return FLK_ERROR_LIMIT;
  }
  if (!device.planning() &&
      (asked.target.width > std::min(limits.maxFramebufferWidth, limits.maxViewportDimensions[0]) ||
       asked.target.height > std::min(limits.maxFramebufferHeight, limits.maxViewportDimensions[1]))) {
    messages.say(FLK_SEVERITY_ERROR, "DEVICE_LIMIT", "a target of %u x %u exceeds what the device can draw to",
                 asked.target.width, asked.target.height);
    return FLK_ERROR_LIMIT;
  }
  if (plan.bytes(ResourceId::heads) > limits.maxStorageBufferRange) {
    messages.say(FLK_SEVERITY_ERROR, "HEADS_TOO_LARGE",
                 "hair covers %u x %u pixels, whose list heads need %llu bytes, and the device binds at most %u: draw "
                 "fewer pixels",
                 plan.rect.width, plan.rect.height, static_cast<unsigned long long>(plan.bytes(ResourceId::heads)),
                 limits.maxStorageBufferRange);
    return FLK_ERROR_LIMIT;
  }

  std::array<VkPipeline, 16> pipelines{};
  std::array<uint64_t, 16> hashes{};
  if (plan.passes.count) {
    FlkResult result = ensureRing(plan);
    if (result == FLK_SUCCESS) result = ensureMemory(plan);
    if (result == FLK_SUCCESS) result = ensureSets(*frame, plan);
    for (std::size_t i = 0; i < plan.passes.count && result == FLK_SUCCESS; ++i) {
      const Recipe recipe = recipeOf(plan, plan.passes.items[i]);
      if (recipe.main == ShaderId::none) continue;
      result = context_.pipelines.get(context_.device, recipe, pipelines[i], hashes[i]);
    }
    if (result == FLK_SUCCESS) frame->light_values.reserve(plan.bytes(ResourceId::lights));
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
  for (uint32_t i = 0; i < asked.hair_count; ++i) {
    const Hair& hair = *hairs[i];
    frame->bytes_persistent += hair.bytesDevice();
    frame->hairs[i] = hairs[i];
    frame->world_from_hair[i] = hair.world_from_hair;
    frame->moved[i] = {hair.host_positions, hair.moved.address, (hair.moved.stride ? hair.moved.stride : 12) / 4,
                       hair.moved.entry_stages, hair.moved.entry_access};
  }
  frame->pipelines = pipelines, frame->hashes = hashes;
  frame->target = asked.target, frame->depth = asked.depth;
  frame->host_shadow_maps = asked.host_shadow_maps, frame->host_visibility = asked.host_visibility;
  frame->light_tiles = asked.light_tiles;
  std::copy(asked.outputs, asked.outputs + FLK_OUTPUT_COUNT, frame->outputs);
  if (plan.passes.count) {
    frame->constants = constants_.handle, frame->lights = lights_.handle, frame->counters = counters_.handle;
    frame->heads = plan.bytes(ResourceId::heads) ? heads_.handle : VK_NULL_HANDLE;
    frame->aggregates = plan.aggregate ? aggregates_.handle : VK_NULL_HANDLE;
    frame->node_address = nodes_.address, frame->aggregate_address = aggregates_.address;
    frame->light_address = lights_.address;
    frame->shadow_map = shadow_map_;
    fillConstants(*frame, asked, camera, hair_facts);
    fillLights(*frame, asked, camera, light_facts);
    if (!device.planning()) {
      writeSet(*frame, frame->bound, frame->target.view, neededBindings(plan));
      for (uint32_t i = 0; i < FLK_OUTPUT_COUNT; ++i)
        if (plan.outputs >> i & 1) writeSet(*frame, frame->output_bound[i], frame->outputs[i].view, kOutputBindings);
    }
  }
  planned = frame;
  return FLK_SUCCESS;
}

FlkResult View::shadowMap(uint32_t light, uint32_t face, FlkShadowMap& map) const {
  const Frame* latest = nullptr;
  for (const Frame& frame : frames_)
    if (frame.number == last_number_ && frame.number) latest = &frame;
  if (!latest) return FLK_NOT_READY;
  const ShadowFace* found = nullptr;
  uint32_t count = 0;
  for (const ShadowFace& candidate : latest->plan.shadow.faces) {
    if (candidate.light != light) continue;
    ++count;
    if (candidate.face == face) found = &candidate;
  }
  if (!found) return FLK_NOT_READY;
  map = {};
  map.image = latest->shadow_map.handle;
  map.view = latest->shadow_map.view;
  map.format = latest->shadow_map.computed ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_D32_SFLOAT;
  map.offset[0] = found->x, map.offset[1] = found->y;
  map.size = found->size;
  map.face = face, map.face_count = count;
  map.perspective = found->focal > 0;
  // From the corner, as images are read.
  Mat4 m = found->map_from_world;
  const double middle = found->size * 0.5;
  for (int column = 0; column < 4; ++column) {
    double* c = &m[std::size_t(column) * 4];
    if (map.perspective) c[0] = found->focal * c[0] + middle * c[2], c[1] = found->focal * c[1] + middle * c[2], c[3] = c[2];
    else if (column == 3) c[0] += middle, c[1] += middle;
  }
  std::copy(m.begin(), m.end(), map.texels_from_world);
  map.depth_range = float(found->range);
  map.texel = float(found->texel);
  return FLK_SUCCESS;
}

}  // namespace forelock
