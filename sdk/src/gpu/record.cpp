// flkCmdRender: the plan's passes and the barriers between them.
#include "gpu/view.h"

#include <cstddef>

namespace forelock {
namespace {

constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
constexpr VkPipelineStageFlags2 kVertex = VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags2 kStorageRead = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

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
  VkImageMemoryBarrier2 images[2];
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

const VkImageSubresourceRange kDepthRange{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
const FlkImageState kTargetInside{VK_IMAGE_LAYOUT_GENERAL, kCompute, kStorageRead | kStorageWrite};
const FlkImageState kShadowDrawn{VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, kDepthTests,
                                 VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
const FlkImageState kShadowRead{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, kFragment | kCompute,
                                VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

void setViewport(const Functions& fn, VkCommandBuffer cmd, float width, float height, const VkRect2D& scissor) {
  const VkViewport viewport{0, 0, width, height, 0, 1};
  fn.vkCmdSetViewport(cmd, 0, 1, &viewport);
  fn.vkCmdSetScissor(cmd, 0, 1, &scissor);
}

}  // namespace

void View::drawHair(VkCommandBuffer cmd, const Frame& frame, uint32_t index) {
  const Functions& fn = context_.device.fn;
  const VkPipelineLayout layout = context_.pipelines.layout;
  const Hair& hair = *frame.hairs[index];
  if (!hair.uploaded) {  // its buffers hold anything: indices read from them could point anywhere
    context_.device.messages.say(FLK_SEVERITY_WARNING, "HAIR_NOT_UPLOADED",
                                 "hair %u of frame %llu is left out: record flkCmdUpload first", index,
                                 static_cast<unsigned long long>(frame.number));
    return;
  }
  fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 1, 1, &hair.set, 0, nullptr);
  fn.vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof index,
                        &index);
  for (uint32_t first = 0; first < hair.segment_count; first += kSegmentsPerDraw) {
    const uint32_t count =
        hair.segment_count - first < kSegmentsPerDraw ? hair.segment_count - first : kSegmentsPerDraw;
    fn.vkCmdDrawIndexed(cmd, count * 6, 1, 0, int32_t(first * 4), 0);
  }
}

void View::recordShadow(VkCommandBuffer cmd, const Frame& frame) {
  const Functions& fn = context_.device.fn;
  const uint32_t size = frame.plan.shadow_size;
  VkRenderingAttachmentInfo depth{};
  depth.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  depth.imageView = frame.shadow_map.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  depth.clearValue.depthStencil = {1.0f, 0};
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = {{0, 0}, {size, size}};
  info.layerCount = 1;
  info.pDepthAttachment = &depth;
  fn.vkCmdBeginRendering(cmd, &info);
  fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, frame.shadow);
  setViewport(fn, cmd, float(size), float(size), info.renderArea);
  for (uint32_t i = 0; i < frame.hair_count; ++i) drawHair(cmd, frame, i);
  fn.vkCmdEndRendering(cmd);
}

void View::recordCapture(VkCommandBuffer cmd, const Frame& frame) {
  const Functions& fn = context_.device.fn;
  const Rect& rect = frame.plan.rect;
  VkRenderingInfo info{};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  info.renderArea = {{int32_t(rect.x), int32_t(rect.y)}, {rect.width, rect.height}};
  info.layerCount = 1;
  fn.vkCmdBeginRendering(cmd, &info);
  fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, frame.capture);
  setViewport(fn, cmd, float(frame.target.width), float(frame.target.height), info.renderArea);
  for (uint32_t i = 0; i < frame.hair_count; ++i)
    if (frame.plan.visible >> i & 1) drawHair(cmd, frame, i);
  fn.vkCmdEndRendering(cmd);
}

void View::record(VkCommandBuffer cmd, Frame& frame) {
  const Functions& fn = context_.device.fn;
  const FramePlan& plan = frame.plan;
  frame.recorded = true;
  if (plan.passes.count == 0) {
    Barriers()
        .add(imageBarrier(frame.target.image, frame.target.range, frame.target.entry, frame.target.exit))
        .record(fn, cmd);
    return;
  }
  const uint32_t first_query = frame.slot * kTimestamps;
  auto timestamp = [&](uint32_t index) {
    if (plan.timestamps)
      fn.vkCmdWriteTimestamp2(cmd, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, first_query + index);
  };
  if (plan.timestamps) fn.vkCmdResetQueryPool(cmd, queries_, first_query, kTimestamps);
  timestamp(0);

  // After the frame before, whose passes may still run on this queue.
  constexpr VkPipelineStageFlags2 kBefore = kVertex | kFragment | kCompute | kTransfer;
  Barriers()
      .add(memoryBarrier(kBefore, kStorageWrite | VK_ACCESS_2_TRANSFER_WRITE_BIT, kTransfer,
                         VK_ACCESS_2_TRANSFER_WRITE_BIT))
      .record(fn, cmd);
  const uint64_t constant_bytes = offsetof(gpu::FrameConstants, hairs) + frame.hair_count * sizeof(gpu::HairConstants);
  fn.vkCmdUpdateBuffer(cmd, frame.constants, 0, constant_bytes, &frame.values);
  fn.vkCmdFillBuffer(cmd, frame.heads, 0, plan.bytes(ResourceId::heads), FLK_LINK_END);
  fn.vkCmdFillBuffer(cmd, frame.counters, 0, VK_WHOLE_SIZE, 0);
  Barriers ready;
  ready.add(memoryBarrier(kTransfer, VK_ACCESS_2_TRANSFER_WRITE_BIT, kVertex | kFragment | kCompute,
                          kStorageRead | kStorageWrite));
  if (plan.has_depth) {
    FlkImageState from{frame.depth.layout, frame.depth.entry_stages, frame.depth.entry_access};
    ready.add(imageBarrier(frame.depth.image, frame.depth.range, from,
                           {frame.depth.layout, kFragment, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}));
  }
  if (plan.shadow_size) {
    const FlkImageState from{VK_IMAGE_LAYOUT_UNDEFINED, kFragment | kCompute | kDepthTests,
                             VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    FlkImageState to = kShadowDrawn;
    to.access |= VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
    ready.add(imageBarrier(frame.shadow_map.handle, kDepthRange, from, to));
  }
  ready.record(fn, cmd);
  timestamp(1 + FLK_STAGE_CLEAR);

  const VkPipelineLayout layout = context_.pipelines.layout;
  fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &frame.set, 0, nullptr);
  fn.vkCmdBindIndexBuffer(cmd, context_.indices.handle, 0, VK_INDEX_TYPE_UINT16);
  if (plan.shadow_size) {
    recordShadow(cmd, frame);
    Barriers().add(imageBarrier(frame.shadow_map.handle, kDepthRange, kShadowDrawn, kShadowRead)).record(fn, cmd);
  }
  timestamp(1 + FLK_STAGE_SHADOW);

  recordCapture(cmd, frame);
  Barriers()
      .add(memoryBarrier(kFragment, kStorageWrite, kCompute | VK_PIPELINE_STAGE_2_COPY_BIT,
                         kStorageRead | VK_ACCESS_2_TRANSFER_READ_BIT))
      .add(imageBarrier(frame.target.image, frame.target.range, frame.target.entry, kTargetInside))
      .record(fn, cmd);
  timestamp(1 + FLK_STAGE_CAPTURE);

  const VkBufferCopy count{0, frame.slot * uint64_t(16), 16};
  fn.vkCmdCopyBuffer(cmd, frame.counters, read_back_.handle, 1, &count);
  fn.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &frame.set, 0, nullptr);
  fn.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, frame.resolve);
  const Pass& resolve = *(plan.passes.end() - 1);
  fn.vkCmdDispatch(cmd, resolve.groups[0], resolve.groups[1], resolve.groups[2]);
  Barriers()
      .add(memoryBarrier(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_HOST_BIT,
                         VK_ACCESS_2_HOST_READ_BIT))
      .add(imageBarrier(frame.target.image, frame.target.range, kTargetInside, frame.target.exit))
      .record(fn, cmd);
  timestamp(1 + FLK_STAGE_RESOLVE);
}

}  // namespace forelock
