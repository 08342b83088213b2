// flkCmdRender: the plan's passes and the barriers between them.
#include "gpu/view.h"
#include "shared/walk.h"

#include <cstddef>

namespace forelock {
namespace {

constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kRaster = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kSampled = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
constexpr VkAccessFlags2 kTransferWrite = VK_ACCESS_2_TRANSFER_WRITE_BIT;
constexpr VkDeviceSize kMostUpdate = 65536;  // bytes of one vkCmdUpdateBuffer

VkMemoryBarrier2 memoryBarrier(VkPipelineStageFlags2 from, VkAccessFlags2 written, VkPipelineStageFlags2 to,
                               VkAccessFlags2 used) {
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = from;
  barrier.srcAccessMask = written;
  barrier.dstStageMask = to;
  barrier.dstAccessMask = used;
  return barrier;
}

VkImageMemoryBarrier2 imageBarrier(VkImage image, VkImageSubresourceRange range, const FlkImageState& from,
                                   const FlkImageState& to) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = range;
  return barrier;
}

// Barriers that go together.
struct Barriers {
  VkMemoryBarrier2 memory[2];
  VkImageMemoryBarrier2 images[5];
  uint32_t memory_count = 0, image_count = 0;

  Barriers& add(const VkMemoryBarrier2& barrier) { return memory[memory_count++] = barrier, *this; }
  Barriers& add(const VkImageMemoryBarrier2& barrier) { return images[image_count++] = barrier, *this; }
  void record(const Functions& fn, VkCommandBuffer cmd) const {
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = memory_count;
    info.pMemoryBarriers = memory;
    info.imageMemoryBarrierCount = image_count;
    info.pImageMemoryBarriers = images;
    fn.vkCmdPipelineBarrier2(cmd, &info);
  }
};

VkImageSubresourceRange mapRange(const Image& map) {
  return {VkImageAspectFlags(map.computed ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT), 0, 1, 0, 1};
}

const FlkImageState kStorageInside{VK_IMAGE_LAYOUT_GENERAL, kCompute, kStorageRead | kStorageWrite};
const FlkImageState kOutputInside{VK_IMAGE_LAYOUT_GENERAL, kCompute, kStorageWrite};
const FlkImageState kMapDrawn{VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthTests,
                              VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

void setViewport(const Functions& fn, VkCommandBuffer cmd, float x, float y, float width, float height, const VkRect2D& scissor) {
  const VkViewport viewport{x, y, width, height, 0, 1};
  fn.vkCmdSetViewport(cmd, 0, 1, &viewport);
  fn.vkCmdSetScissor(cmd, 0, 1, &scissor);
}

// As PushConstants of shaders/passes/bindings.glsl.
struct HairPush {
  uint32_t slot = 0, segment_count = 0, first_segment = 0, face = 0;
  gpu::mat4x3 map_from_hair{};
};
static_assert(sizeof(HairPush) == kPushBytes);

struct PreparePush {
  VkDeviceAddress sources, host_positions, attributes, positions;
  uint32_t strand_count, stride;
  float spread_tip;
};

// Items as a grid of groups that every device takes.
void dispatchItems(const Functions& fn, VkCommandBuffer cmd, uint32_t items, uint32_t group) {
  constexpr uint32_t kRow = 32768;
  const uint32_t groups = (items + group - 1) / group;
  fn.vkCmdDispatch(cmd, groups < kRow ? groups : kRow, (groups + kRow - 1) / kRow, 1);
}

void update(const Functions& fn, VkCommandBuffer cmd, VkBuffer buffer, const void* data, VkDeviceSize size) {
  const auto* bytes = static_cast<const std::byte*>(data);
  for (VkDeviceSize at = 0; at < size; at += kMostUpdate)
    fn.vkCmdUpdateBuffer(cmd, buffer, at, size - at < kMostUpdate ? size - at : kMostUpdate, bytes + at);
}

}  // namespace

bool View::drawable(const Frame& frame, uint32_t index) const {
  if (frame.hairs[index]->uploaded) return true;
  // Its buffers hold anything: indices read from them could point anywhere.
  context_.device.messages.say(FLK_SEVERITY_WARNING, "HAIR_NOT_UPLOADED",
                               "hair %u of frame %llu is left out: record flkCmdUpload first", index,
                               static_cast<unsigned long long>(frame.number));
  return false;
}

void View::drawHair(VkCommandBuffer cmd, const Frame& frame, uint32_t index, const ShadowFace* face, uint32_t face_index) {
  const Functions& fn = context_.device.fn;
  const VkPipelineLayout layout = context_.pipelines.layout;
  const Hair& hair = *frame.hairs[index];
  if (!drawable(frame, index)) return;
  HairPush push;
  push.slot = index;
  push.segment_count = hair.segment_count;
  push.face = face_index | (face && face->cover_width ? FLK_FACE_BY_WIDTH : 0u);
  if (face) {
    const Mat4 map = face->map_from_world * frame.world_from_hair[index];
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) push.map_from_hair.m[column * 3 + row] = float(map[std::size_t(column) * 4 + std::size_t(row)]);
  }
  fn.vkCmdPushConstants(cmd, layout, kPushStages, 0, sizeof push, &push);
  if (frame.plan.compute) return dispatchItems(fn, cmd, hair.segment_count, FLK_WALK_SEGMENTS);
  for (uint32_t first = 0; first < hair.segment_count; first += kSegmentsPerDraw) {
    const uint32_t count =
        hair.segment_count - first < kSegmentsPerDraw ? hair.segment_count - first : kSegmentsPerDraw;
    fn.vkCmdDrawIndexed(cmd, count * 6, 1, 0, int32_t(first * 4), 0);
  }
}

void View::recordPrepare(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline) {
  const Functions& fn = context_.device.fn;
  fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  for (uint32_t i = 0; i < frame.hair_count; ++i) {
    const Hair& hair = *frame.hairs[i];
    const MovedHair& moved = frame.moved[i];
    if (!moved.moved || !hair.uploaded) continue;
    // Frames before may still read the positions, and the host may still be writing its own.
    Barriers()
        .add(memoryBarrier(context_.device.graphics ? kCompute | kRaster : kCompute, 0, kCompute, kStorageWrite))
        .add(memoryBarrier(moved.entry_stages, moved.entry_access, kCompute, kStorageRead))
        .record(fn, cmd);
    const PreparePush push{hair.address(Hair::kSources), moved.address,     hair.address(Hair::kAttributes),
                           hair.address(Hair::kMoved),   hair.strand_count, moved.stride,
                           hair.spread_tip};
    fn.vkCmdPushConstants(cmd, context_.pipelines.layout, kPushStages, 0, 44, &push);
    dispatchItems(fn, cmd, hair.strand_count, 64);
  }
  Barriers()
      .add(memoryBarrier(kCompute, kStorageWrite, context_.device.graphics ? kCompute | kRaster : kCompute, kStorageRead))
      .record(fn, cmd);
}

void View::recordShadow(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline) {
  const Functions& fn = context_.device.fn;
  const Image& map = frame.shadow_map;
  const bool compute = frame.plan.compute;
  if (compute) {
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  } else {
    const FlkImageState from{VK_IMAGE_LAYOUT_UNDEFINED, kCompute | kRaster | kDepthTests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    FlkImageState to = kMapDrawn;
    to.access |= VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    Barriers().add(imageBarrier(map.handle, mapRange(map), from, to)).record(fn, cmd);
    VkRenderingAttachmentInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    depth.imageView = map.view;
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
    depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    depth.clearValue.depthStencil = {1.0f, 0};
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{0, 0}, {map.width, map.height}};
    info.layerCount = 1;
    info.pDepthAttachment = &depth;
    fn.vkCmdBeginRendering(cmd, &info);
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  }
  for (uint32_t f = 0; f < frame.plan.shadow.faces.count; ++f) {
    const ShadowFace& face = frame.plan.shadow.faces.items[f];
    if (!compute)
      setViewport(fn, cmd, float(face.x), float(face.y), float(face.size), float(face.size),
                  {{int32_t(face.x), int32_t(face.y)}, {face.size, face.size}});
    for (uint32_t i = 0; i < frame.hair_count; ++i) drawHair(cmd, frame, i, &face, f);
  }
  if (!compute) fn.vkCmdEndRendering(cmd);
}

// From the shadow pass to what reads its map: capture where it shades, else resolve, so that shadow and capture may overlap.
VkImageMemoryBarrier2 View::shadowDone(const Frame& frame) const {
  const FlkImageState read{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                           context_.device.graphics ? kCompute | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT : kCompute, kSampled};
  const Image& map = frame.shadow_map;
  return imageBarrier(map.handle, mapRange(map), frame.plan.compute ? kStorageInside : kMapDrawn, read);
}

void View::recordCapture(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline) {
  const Functions& fn = context_.device.fn;
  const Rect& rect = frame.plan.rect;
  if (frame.plan.compute) {
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  } else {
    VkRenderingInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    info.renderArea = {{int32_t(rect.x), int32_t(rect.y)}, {rect.width, rect.height}};
    info.layerCount = 1;
    fn.vkCmdBeginRendering(cmd, &info);
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    setViewport(fn, cmd, 0, 0, float(frame.target.width), float(frame.target.height), info.renderArea);
  }
  for (uint32_t i = 0; i < frame.hair_count; ++i)
    if (frame.plan.visible >> i & 1) drawHair(cmd, frame, i, nullptr, 0);
  if (!frame.plan.compute) fn.vkCmdEndRendering(cmd);
}

void View::recordClear(VkCommandBuffer cmd, const Frame& frame, VkPipeline pipeline) {
  const Functions& fn = context_.device.fn;
  const FramePlan& plan = frame.plan;
  const VkPipelineStageFlags2 shaders = context_.device.graphics ? kCompute | kRaster : kCompute;
  // After the frame before, whose passes may still run on this queue.
  Barriers before;
  before.add(memoryBarrier(shaders | kTransfer, kStorageWrite | kTransferWrite, kTransfer | (pipeline ? kCompute : 0),
                           kTransferWrite | (pipeline ? kStorageWrite : 0)));
  Barriers ready;
  ready.add(memoryBarrier(kTransfer, kTransferWrite, shaders, VK_ACCESS_2_UNIFORM_READ_BIT | kStorageRead | kStorageWrite));
  if (pipeline) {
    const Image& map = frame.shadow_map;
    before.add(imageBarrier(map.handle, mapRange(map), {VK_IMAGE_LAYOUT_UNDEFINED, shaders, 0}, kStorageInside)).record(fn, cmd);
    fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    const uint32_t head_count = uint32_t(plan.bytes(ResourceId::heads) / 4);
    fn.vkCmdPushConstants(cmd, context_.pipelines.layout, kPushStages, 0, sizeof head_count, &head_count);
    const Pass& clear = plan.passes.items[0];
    fn.vkCmdDispatch(cmd, clear.groups[0], clear.groups[1], clear.groups[2]);
    ready.add(memoryBarrier(kCompute, kStorageWrite, kCompute, kStorageRead | kStorageWrite));
  } else {
    before.record(fn, cmd);
    if (plan.bytes(ResourceId::heads)) fn.vkCmdFillBuffer(cmd, frame.heads, 0, plan.bytes(ResourceId::heads), FLK_LINK_END);
    fn.vkCmdFillBuffer(cmd, frame.counters, 0, VK_WHOLE_SIZE, 0);
  }
  if (plan.aggregate) fn.vkCmdFillBuffer(cmd, frame.aggregates, 0, plan.bytes(ResourceId::aggregates), 0);
  update(fn, cmd, frame.constants, &frame.values,
         offsetof(gpu::FrameConstants, hairs) + frame.hair_count * sizeof(gpu::HairConstants));
  if (!frame.light_values.empty()) update(fn, cmd, frame.lights, frame.light_values.data(), frame.light_values.size());
  if (plan.light_mode == FLK_LIGHTS_TILES)
    ready.add(memoryBarrier(frame.light_tiles.entry_stages, frame.light_tiles.entry_access, shaders, kStorageRead));
  auto await = [&](VkImage image, const VkImageSubresourceRange& range, VkImageLayout image_layout, VkPipelineStageFlags2 stages,
                   VkAccessFlags2 access) {
    ready.add(imageBarrier(image, range, {image_layout, stages, access}, {image_layout, shaders, kSampled}));
  };
  if (plan.has_depth)
    await(frame.depth.image, frame.depth.range, frame.depth.layout, frame.depth.entry_stages, frame.depth.entry_access);
  if (plan.host_light)
    for (const FlkSampledImage* image : {&frame.host_shadow_maps, &frame.host_visibility})
      if (image->view) await(image->image, image->range, image->layout, image->entry_stages, image->entry_access);
  ready.record(fn, cmd);
}

void View::record(VkCommandBuffer cmd, Frame& frame) {
  const Functions& fn = context_.device.fn;
  const FramePlan& plan = frame.plan;
  frame.recorded = true;
  if (plan.passes.count == 0) {
    Barriers only;
    only.add(imageBarrier(frame.target.image, frame.target.range, frame.target.entry, frame.target.exit));
    for (const FlkOutputImage& output : frame.outputs)
      if (output.view) only.add(imageBarrier(output.image, output.range, output.entry, output.exit));
    only.record(fn, cmd);
    return;
  }
  const uint32_t first_query = frame.slot * kTimestamps;
  auto timestamp = [&](uint32_t index) {
    if (plan.timestamps == FLK_TIMESTAMPS_STAGES || (plan.timestamps && (index == 0 || index == FLK_STAGE_COUNT)))
      fn.vkCmdWriteTimestamp2(cmd, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, first_query + index);
  };
  if (plan.timestamps) fn.vkCmdResetQueryPool(cmd, queries_, first_query, kTimestamps);
  timestamp(0);

  const VkPipelineLayout layout = context_.pipelines.layout;
  const VkPipelineStageFlags2 capturing = plan.compute ? kCompute : VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  const bool capture_shades = plan.method->capture == CaptureKind::color;
  uint32_t at_stage = 0;  // of kStageOrder
  for (std::size_t i = 0; i < plan.passes.count; ++i) {
    const Pass& pass = plan.passes.items[i];
    for (; kStageOrder[at_stage] != stageOf(pass.id); ++at_stage) timestamp(1 + at_stage);
    const VkPipeline pipeline = frame.pipelines[i];
    switch (pass.id) {
      case PassId::clear:
        if (!plan.compute) {
          fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &frame.bound.set, 0, nullptr);
          fn.vkCmdBindIndexBuffer(cmd, context_.indices.handle, 0, VK_INDEX_TYPE_UINT16);
        }
        fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &frame.bound.set, 0, nullptr);
        recordClear(cmd, frame, pipeline);
        break;
      case PassId::prepare: recordPrepare(cmd, frame, pipeline); break;
      case PassId::shadow:
        recordShadow(cmd, frame, pipeline);
        if (capture_shades) Barriers().add(shadowDone(frame)).record(fn, cmd);
        break;
      case PassId::hard_depth:
        recordCapture(cmd, frame, pipeline);
        Barriers()
            .add(memoryBarrier(capturing, kStorageWrite, capturing, kStorageRead | kStorageWrite))
            .record(fn, cmd);
        break;
      case PassId::count:
      case PassId::capture:
      case PassId::hard_payload: {
        recordCapture(cmd, frame, pipeline);
        Barriers done;
        done.add(memoryBarrier(capturing, kStorageWrite, kCompute | VK_PIPELINE_STAGE_2_COPY_BIT,
                               kStorageRead | kStorageWrite | VK_ACCESS_2_TRANSFER_READ_BIT));
        if (plan.hasShadow() && !capture_shades) done.add(shadowDone(frame));
        if (!plan.count_only) done.add(imageBarrier(frame.target.image, frame.target.range, frame.target.entry, kStorageInside));
        done.record(fn, cmd);
        break;
      }
      case PassId::resolve:
        fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        fn.vkCmdDispatch(cmd, pass.groups[0], pass.groups[1], pass.groups[2]);
        break;
      case PassId::output: recordOutput(cmd, frame, pass, pipeline); break;
    }
  }
  for (; at_stage < FLK_STAGE_COUNT; ++at_stage) timestamp(1 + at_stage);

  if (plan.count_work)
    Barriers().add(memoryBarrier(kCompute, kStorageWrite, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT)).record(fn, cmd);
  const VkDeviceSize count_bytes = plan.bytes(ResourceId::counters);
  const VkBufferCopy count{0, frame.slot * count_bytes, count_bytes};
  fn.vkCmdCopyBuffer(cmd, frame.counters, read_back_.handle, 1, &count);
  Barriers last;
  last.add(memoryBarrier(VK_PIPELINE_STAGE_2_COPY_BIT, kTransferWrite, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT));
  last.add(imageBarrier(frame.target.image, frame.target.range, plan.count_only ? frame.target.entry : kStorageInside,
                        frame.target.exit));
  for (uint32_t i = 0; i < FLK_OUTPUT_COUNT; ++i)
    if (frame.outputs[i].view && !(plan.outputs >> i & 1))
      last.add(imageBarrier(frame.outputs[i].image, frame.outputs[i].range, frame.outputs[i].entry, frame.outputs[i].exit));
  last.record(fn, cmd);
}

void View::recordOutput(VkCommandBuffer cmd, const Frame& frame, const Pass& pass, VkPipeline pipeline) {
  const Functions& fn = context_.device.fn;
  const VkPipelineLayout layout = context_.pipelines.layout;
  const FlkOutputImage& output = frame.outputs[pass.output];
  Barriers().add(imageBarrier(output.image, output.range, output.entry, kOutputInside)).record(fn, cmd);
  fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &frame.output_bound[pass.output].set, 0, nullptr);
  if (pass.output == FLK_OUTPUT_VELOCITY) {
    const VkDeviceAddress before = frame.light_address + frame.plan.light_count * sizeof(gpu::LightConstants) +
                                   frame.plan.shadow.faces.count * sizeof(gpu::FaceConstants);
    fn.vkCmdPushConstants(cmd, layout, kPushStages, 0, sizeof before, &before);
  }
  fn.vkCmdDispatch(cmd, pass.groups[0], pass.groups[1], pass.groups[2]);
  Barriers().add(imageBarrier(output.image, output.range, kOutputInside, output.exit)).record(fn, cmd);
}

}  // namespace forelock
