// The mock's vkCmd... functions: each is written down, checked, and carried out where it only moves bytes.
#include "mock_vulkan.h"

#include <algorithm>
#include <cstring>

namespace mock {
namespace {

// A command with one object: known, alive and used by this frame from now on.
Command& recordWith(VkCommandBuffer cmd, const char* name, const void* handle, Kind kind, bool inside,
                    bool both = false) {
  Driver& driver = Driver::current();
  Command& command = driver.record(cmd, name, inside, both);
  if (Object* object = driver.known(handle, kind, name)) {
    driver.use(object);
    command.objects.push_back(object);
  }
  return command;
}

VKAPI_ATTR void VKAPI_CALL CmdPipelineBarrier2(VkCommandBuffer cmd, const VkDependencyInfo* info) {
  Driver& driver = Driver::current();
  Command& command = driver.record(cmd, "vkCmdPipelineBarrier2", false);
  command.image_barriers.assign(info->pImageMemoryBarriers, info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
  command.buffer_barriers = info->bufferMemoryBarrierCount + info->memoryBarrierCount;
  for (uint32_t i = 0; i < info->memoryBarrierCount; ++i)
    command.stages |= info->pMemoryBarriers[i].srcStageMask | info->pMemoryBarriers[i].dstStageMask;
  for (const VkImageMemoryBarrier2& barrier : command.image_barriers) command.stages |= barrier.srcStageMask | barrier.dstStageMask;
  driver.checkStages(command.stages, "vkCmdPipelineBarrier2");
  for (const VkImageMemoryBarrier2& barrier : command.image_barriers)
    if (Object* image = driver.known(barrier.image, Kind::Image, "vkCmdPipelineBarrier2")) {
      driver.use(image);
      command.objects.push_back(image);
    }
  for (uint32_t i = 0; i < info->bufferMemoryBarrierCount; ++i)
    if (Object* buffer = driver.known(info->pBufferMemoryBarriers[i].buffer, Kind::Buffer, "vkCmdPipelineBarrier2"))
      driver.use(buffer);
}

// What only a queue with graphics takes.
void graphicsOnly(const char* name) {
  Driver& driver = Driver::current();
  if (!(driver.queue_flags & VK_QUEUE_GRAPHICS_BIT)) driver.breach(std::string(name) + ": on a queue without graphics");
}

VKAPI_ATTR void VKAPI_CALL CmdBindPipeline(VkCommandBuffer cmd, VkPipelineBindPoint point, VkPipeline pipeline) {
  if (point == VK_PIPELINE_BIND_POINT_GRAPHICS) graphicsOnly("vkCmdBindPipeline");
  Command& command = recordWith(cmd, "vkCmdBindPipeline", pipeline, Kind::Pipeline, false, true);
  if (!command.objects.empty() && command.objects[0]->bind_point != point)
    Driver::current().breach("vkCmdBindPipeline: wrong bind point");
  if (!command.objects.empty()) Driver::current().bound_pipelines[command.objects[0]->bind_point] = command.objects[0];
}

VKAPI_ATTR void VKAPI_CALL CmdBindDescriptorSets(VkCommandBuffer cmd, VkPipelineBindPoint point,
                                                 VkPipelineLayout layout, uint32_t first, uint32_t count,
                                                 const VkDescriptorSet* sets, uint32_t, const uint32_t*) {
  Driver& driver = Driver::current();
  if (point == VK_PIPELINE_BIND_POINT_GRAPHICS) graphicsOnly("vkCmdBindDescriptorSets");
  Command& command = recordWith(cmd, "vkCmdBindDescriptorSets", layout, Kind::PipelineLayout, false, true);
  command.numbers = {first, count};
  for (uint32_t i = 0; i < count; ++i)
    if (Object* set = driver.known(sets[i], Kind::DescriptorSet, "vkCmdBindDescriptorSets")) {
      driver.use(set);
      driver.bound_sets[point][first + i] = set;
      command.objects.push_back(set);
    }
}

VKAPI_ATTR void VKAPI_CALL CmdPushConstants(VkCommandBuffer cmd, VkPipelineLayout layout, VkShaderStageFlags stages,
                                            uint32_t offset, uint32_t size, const void* data) {
  recordWith(cmd, "vkCmdPushConstants", layout, Kind::PipelineLayout, false, true).numbers = {offset, size};
  Driver& driver = Driver::current();
  if (size == 0 || size % 4 != 0 || offset % 4 != 0 || offset + size > driver.push_bytes)
    driver.breach("vkCmdPushConstants: wrong size or range");
  if (stages != driver.push_stages) driver.breach("vkCmdPushConstants: other stages than the range's");
  driver.useAddresses(data, size);
}

// A draw or dispatch uses what its pipeline declares of the sets that are bound; other bindings may be stale.
void useBound(VkPipelineBindPoint point, const char* name) {
  Driver& driver = Driver::current();
  const Object* pipeline = driver.bound_pipelines[point];
  if (!pipeline) return driver.breach(std::string(name) + ": no pipeline is bound");
  for (const auto& [set_number, binding] : pipeline->reads) {
    const auto set = driver.bound_sets[point].find(set_number);
    const std::string place = " (set " + std::to_string(set_number) + ", binding " + std::to_string(binding) + ")";
    if (set == driver.bound_sets[point].end()) {
      driver.breach(std::string(name) + ": no set is bound" + place);
      continue;
    }
    const auto resource = set->second->bindings.find({binding, 0});
    if (resource == set->second->bindings.end()) driver.breach(std::string(name) + ": nothing was written to" + place);
    else driver.use(resource->second);
  }
}

VKAPI_ATTR void VKAPI_CALL CmdDispatch(VkCommandBuffer cmd, uint32_t x, uint32_t y, uint32_t z) {
  Driver& driver = Driver::current();
  useBound(VK_PIPELINE_BIND_POINT_COMPUTE, "vkCmdDispatch");
  driver.record(cmd, "vkCmdDispatch", false).numbers = {x, y, z};
  const uint32_t* limit = driver.claims.properties.limits.maxComputeWorkGroupCount;
  if (x > limit[0] || y > limit[1] || z > limit[2]) driver.breach("vkCmdDispatch: too many groups");
}

VKAPI_ATTR void VKAPI_CALL CmdDispatchIndirect(VkCommandBuffer cmd, VkBuffer buffer, VkDeviceSize offset) {
  useBound(VK_PIPELINE_BIND_POINT_COMPUTE, "vkCmdDispatchIndirect");
  recordWith(cmd, "vkCmdDispatchIndirect", buffer, Kind::Buffer, false).numbers = {offset};
}

VKAPI_ATTR void VKAPI_CALL CmdDraw(VkCommandBuffer cmd, uint32_t vertices, uint32_t instances, uint32_t, uint32_t) {
  useBound(VK_PIPELINE_BIND_POINT_GRAPHICS, "vkCmdDraw");
  Driver::current().record(cmd, "vkCmdDraw", true).numbers = {vertices, instances};
}

VKAPI_ATTR void VKAPI_CALL CmdDrawIndexed(VkCommandBuffer cmd, uint32_t indices, uint32_t instances, uint32_t,
                                          int32_t, uint32_t) {
  useBound(VK_PIPELINE_BIND_POINT_GRAPHICS, "vkCmdDrawIndexed");
  Driver::current().record(cmd, "vkCmdDrawIndexed", true).numbers = {indices, instances};
}

VKAPI_ATTR void VKAPI_CALL CmdBindIndexBuffer(VkCommandBuffer cmd, VkBuffer buffer, VkDeviceSize offset, VkIndexType) {
  graphicsOnly("vkCmdBindIndexBuffer");
  recordWith(cmd, "vkCmdBindIndexBuffer", buffer, Kind::Buffer, false, true).numbers = {offset};
}

VKAPI_ATTR void VKAPI_CALL CmdSetViewport(VkCommandBuffer cmd, uint32_t, uint32_t, const VkViewport*) {
  graphicsOnly("vkCmdSetViewport");
  Driver::current().record(cmd, "vkCmdSetViewport", false, true);
}

VKAPI_ATTR void VKAPI_CALL CmdSetScissor(VkCommandBuffer cmd, uint32_t, uint32_t, const VkRect2D* scissors) {
  graphicsOnly("vkCmdSetScissor");
  Command& command = Driver::current().record(cmd, "vkCmdSetScissor", false, true);
  command.numbers = {scissors[0].extent.width, scissors[0].extent.height};
  if (scissors[0].offset.x < 0 || scissors[0].offset.y < 0)
    Driver::current().breach("vkCmdSetScissor: negative offset");
}

VKAPI_ATTR void VKAPI_CALL CmdBeginRendering(VkCommandBuffer cmd, const VkRenderingInfo* info) {
  Driver& driver = Driver::current();
  graphicsOnly("vkCmdBeginRendering");
  Command& command = driver.record(cmd, "vkCmdBeginRendering", false);
  command.numbers = {info->renderArea.extent.width, info->renderArea.extent.height};
  std::vector<const VkRenderingAttachmentInfo*> attachments{info->pDepthAttachment, info->pStencilAttachment};
  for (uint32_t i = 0; i < info->colorAttachmentCount; ++i) attachments.push_back(&info->pColorAttachments[i]);
  for (const VkRenderingAttachmentInfo* attachment : attachments)
    if (attachment && attachment->imageView)
      if (Object* view = driver.known(attachment->imageView, Kind::ImageView, "vkCmdBeginRendering")) {
        driver.use(view);
        command.objects.push_back(view);
      }
  driver.inside_rendering = true;
}

VKAPI_ATTR void VKAPI_CALL CmdEndRendering(VkCommandBuffer cmd) {
  Driver::current().record(cmd, "vkCmdEndRendering", true);
  Driver::current().inside_rendering = false;
}

VKAPI_ATTR void VKAPI_CALL CmdCopyBuffer(VkCommandBuffer cmd, VkBuffer from, VkBuffer to, uint32_t count,
                                         const VkBufferCopy* regions) {
  Driver& driver = Driver::current();
  Command& command = recordWith(cmd, "vkCmdCopyBuffer", from, Kind::Buffer, false);
  Object* source = driver.known(from, Kind::Buffer, "vkCmdCopyBuffer");
  Object* target = driver.known(to, Kind::Buffer, "vkCmdCopyBuffer");
  if (!source || !target) return;
  driver.use(target);
  command.objects.push_back(target);
  if (!(source->usage & VK_BUFFER_USAGE_TRANSFER_SRC_BIT) || !(target->usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT))
    driver.breach("vkCmdCopyBuffer: a buffer was not made for that");
  for (uint32_t i = 0; i < count; ++i) {
    const VkBufferCopy& region = regions[i];
    if (region.srcOffset + region.size > source->size || region.dstOffset + region.size > target->size) {
      driver.breach("vkCmdCopyBuffer: region past the end");
      continue;
    }
    command.numbers.insert(command.numbers.end(), {region.srcOffset, region.dstOffset, region.size});
    std::byte *read = bytesOf(source, region.srcOffset), *write = bytesOf(target, region.dstOffset);
    if (read && write) std::memmove(write, read, region.size);
    else driver.breach("vkCmdCopyBuffer: a buffer has no memory");
  }
}

VKAPI_ATTR void VKAPI_CALL CmdFillBuffer(VkCommandBuffer cmd, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                                         uint32_t value) {
  Driver& driver = Driver::current();
  Command& command = recordWith(cmd, "vkCmdFillBuffer", buffer, Kind::Buffer, false);
  if (command.objects.empty()) return;
  Object* target = command.objects[0];
  const VkDeviceSize bytes = size == VK_WHOLE_SIZE ? (target->size - offset) / 4 * 4 : size;
  command.numbers = {offset, bytes, value};
  if (!(target->usage & VK_BUFFER_USAGE_TRANSFER_DST_BIT) || offset % 4 != 0 || bytes % 4 != 0 ||
      offset + bytes > target->size) {
    driver.breach("vkCmdFillBuffer: wrong usage, alignment or range");
    return;
  }
  if (auto* words = reinterpret_cast<uint32_t*>(bytesOf(target, offset))) std::fill_n(words, bytes / 4, value);
}

VKAPI_ATTR void VKAPI_CALL CmdUpdateBuffer(VkCommandBuffer cmd, VkBuffer buffer, VkDeviceSize offset, VkDeviceSize size,
                                           const void* data) {
  Driver& driver = Driver::current();
  Command& command = recordWith(cmd, "vkCmdUpdateBuffer", buffer, Kind::Buffer, false);
  command.numbers = {offset, size};
  if (command.objects.empty()) return;
  if (size > 65536 || size % 4 != 0 || offset % 4 != 0 || offset + size > command.objects[0]->size) {
    driver.breach("vkCmdUpdateBuffer: wrong size or range");
    return;
  }
  if (std::byte* write = bytesOf(command.objects[0], offset)) std::memcpy(write, data, size);
  driver.useAddresses(data, size);
}

VKAPI_ATTR void VKAPI_CALL CmdResetQueryPool(VkCommandBuffer cmd, VkQueryPool pool, uint32_t first, uint32_t count) {
  Command& command = recordWith(cmd, "vkCmdResetQueryPool", pool, Kind::QueryPool, false);
  command.numbers = {first, count};
  for (uint32_t i = 0; !command.objects.empty() && i < count; ++i) command.objects[0]->query_states.at(first + i) = 1;
}

// Each stamp is a millisecond after the one before (timestampPeriod is 1 ns).
VKAPI_ATTR void VKAPI_CALL CmdWriteTimestamp2(VkCommandBuffer cmd, VkPipelineStageFlags2 stages, VkQueryPool pool,
                                              uint32_t query) {
  static uint64_t now = 0;
  Driver& driver = Driver::current();
  Command& command = recordWith(cmd, "vkCmdWriteTimestamp2", pool, Kind::QueryPool, false, true);
  command.numbers = {query};
  driver.checkStages(command.stages = stages, "vkCmdWriteTimestamp2");
  if (command.objects.empty()) return;
  int& state = command.objects[0]->query_states.at(query);
  if (state != 1) driver.breach("vkCmdWriteTimestamp2: the query was not reset");
  state = 2;
  command.objects[0]->query_values[query] = now += 1000000;
}

}  // namespace

const FunctionTable& commandFunctions() {
#define MOCK(Name) {"vk" #Name, reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vk##Name>(Name))}
  static const FunctionTable table = {
      MOCK(CmdPipelineBarrier2), MOCK(CmdBindPipeline), MOCK(CmdBindDescriptorSets), MOCK(CmdPushConstants),
      MOCK(CmdDispatch), MOCK(CmdDispatchIndirect), MOCK(CmdDraw), MOCK(CmdDrawIndexed), MOCK(CmdBindIndexBuffer),
      MOCK(CmdSetViewport), MOCK(CmdSetScissor), MOCK(CmdBeginRendering), MOCK(CmdEndRendering), MOCK(CmdCopyBuffer),
      MOCK(CmdFillBuffer), MOCK(CmdUpdateBuffer), MOCK(CmdResetQueryPool), MOCK(CmdWriteTimestamp2)};
#undef MOCK
  return table;
}

}  // namespace mock
