// SPDX-License-Identifier: MIT
#include "opaque_pipelines.h"

#include "opaque_frag_spv.h"
#include "opaque_vert_spv.h"

namespace forelock::samples {

namespace {

constexpr VkPipelineStageFlags2 kDepthTests = VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr VkPipelineStageFlags2 kReaders = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

template <class T>
T make(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

VkImageMemoryBarrier2 barrierOf(const GpuImage& image, VkImageLayout from, VkImageLayout to) {
  auto barrier = make<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.image;
  barrier.subresourceRange = image.range;
  return barrier;
}

}  // namespace

bool OpaquePipelines::create(const HeadlessHost::Device& device, std::string& error) {
  device_ = device.device;
  const auto get_device = reinterpret_cast<PFN_vkGetDeviceProcAddr>(device.get_instance_proc_addr(device.instance, "vkGetDeviceProcAddr"));
#define FORELOCK_OPAQUE_LOAD(name) name##_ = reinterpret_cast<PFN_##name>(get_device(device_, #name));
  FORELOCK_OPAQUE_FUNCTIONS(FORELOCK_OPAQUE_LOAD)
#undef FORELOCK_OPAQUE_LOAD
  error = "the device has no memory for the pipelines that meshes are drawn with";

  auto sampler = make<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);  // nearest
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkDescriptorSetLayoutBinding bindings[2]{};
  for (uint32_t i = 0; i < 2; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  }
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = 2;
  set_info.pBindings = bindings;
  const VkDescriptorPoolSize sizes{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2};
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 1;
  pool_info.pPoolSizes = &sizes;
  if (vkCreateSampler_(device_, &sampler, nullptr, &sampler_) != VK_SUCCESS ||
      vkCreateDescriptorSetLayout_(device_, &set_info, nullptr, &set_layout_) != VK_SUCCESS ||
      vkCreateDescriptorPool_(device_, &pool_info, nullptr, &pool_) != VK_SUCCESS) {
    return false;
  }
  auto set = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  set.descriptorPool = pool_;
  set.descriptorSetCount = 1;
  set.pSetLayouts = &set_layout_;
  const VkPushConstantRange push{kStages, 0, sizeof(OpaquePush)};
  auto layout = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = layout.pushConstantRangeCount = 1;
  layout.pSetLayouts = &set_layout_;
  layout.pPushConstantRanges = &push;
  const auto module = [&](std::span<const uint32_t> code, VkShaderModule& made) {
    auto info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = code.size_bytes();
    info.pCode = code.data();
    return vkCreateShaderModule_(device_, &info, nullptr, &made) == VK_SUCCESS;
  };
  if (vkAllocateDescriptorSets_(device_, &set, &set_) != VK_SUCCESS || vkCreatePipelineLayout_(device_, &layout, nullptr, &layout_) != VK_SUCCESS ||
      !module(opaque_vert_spv, vertex_) || !module(opaque_frag_spv, fragment_)) {
    return false;
  }
  depth_ = makePipeline(false);
  color_ = makePipeline(true);
  if (!depth_ || !color_) {
    return false;
  }
  error.clear();
  return true;
}

// One vertex shader for both: with `invariant` the colour pass finds exactly the depths that the depth pass left.
VkPipeline OpaquePipelines::makePipeline(bool color) const {
  VkPipelineShaderStageCreateInfo stages[2];
  for (VkPipelineShaderStageCreateInfo& stage : stages) {
    stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    stage.pName = "main";
  }
  stages[0].stage = VK_SHADER_STAGE_VERTEX_BIT;
  stages[0].module = vertex_;
  stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
  stages[1].module = fragment_;
  const VkVertexInputBindingDescription bindings[3] = {{0, 12, VK_VERTEX_INPUT_RATE_VERTEX}, {1, 12, VK_VERTEX_INPUT_RATE_VERTEX}, {2, 4, VK_VERTEX_INPUT_RATE_VERTEX}};
  const VkVertexInputAttributeDescription attributes[3] = {
      {0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0}, {1, 1, VK_FORMAT_R32G32B32_SFLOAT, 0}, {2, 2, VK_FORMAT_R32_SFLOAT, 0}};
  auto input = make<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
  input.vertexBindingDescriptionCount = input.vertexAttributeDescriptionCount = 3;
  input.pVertexBindingDescriptions = bindings;
  input.pVertexAttributeDescriptions = attributes;
  auto assembly = make<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  auto viewport = make<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
  viewport.viewportCount = viewport.scissorCount = 1;
  auto raster = make<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VK_CULL_MODE_NONE;  // meshes need not be closed
  raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  raster.lineWidth = 1.0f;
  auto samples = make<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
  samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  auto tests = make<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
  tests.depthTestEnable = VK_TRUE;
  tests.depthWriteEnable = color ? VK_FALSE : VK_TRUE;
  tests.depthCompareOp = VK_COMPARE_OP_EQUAL;
  VkPipelineColorBlendAttachmentState attachment{};
  attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
  auto blend = make<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
  blend.attachmentCount = color ? 1 : 0;
  blend.pAttachments = &attachment;
  const VkDynamicState changing[3] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_DEPTH_COMPARE_OP};
  auto dynamic = make<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
  dynamic.dynamicStateCount = color ? 2 : 3;
  dynamic.pDynamicStates = changing;
  const VkFormat format = VK_FORMAT_R16G16B16A16_SFLOAT;
  auto rendering = make<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
  rendering.colorAttachmentCount = color ? 1 : 0;
  rendering.pColorAttachmentFormats = &format;
  rendering.depthAttachmentFormat = VK_FORMAT_D32_SFLOAT;
  auto info = make<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
  info.pNext = &rendering;
  info.stageCount = color ? 2 : 1;
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &samples;
  info.pDepthStencilState = &tests;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout_;
  VkPipeline pipeline = VK_NULL_HANDLE;
  return vkCreateGraphicsPipelines_(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline) == VK_SUCCESS ? pipeline : VK_NULL_HANDLE;
}

void OpaquePipelines::destroy() {
  if (!device_) {
    return;
  }
  vkDestroyPipeline_(device_, depth_, nullptr);
  vkDestroyPipeline_(device_, color_, nullptr);
  vkDestroyShaderModule_(device_, vertex_, nullptr);
  vkDestroyShaderModule_(device_, fragment_, nullptr);
  vkDestroyPipelineLayout_(device_, layout_, nullptr);
  vkDestroyDescriptorPool_(device_, pool_, nullptr);
  vkDestroyDescriptorSetLayout_(device_, set_layout_, nullptr);
  vkDestroySampler_(device_, sampler_, nullptr);
}

VkImageView OpaquePipelines::layerView(const GpuImage& image, uint32_t layer) const {
  auto info = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = image.image;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = image.format;
  info.subresourceRange = image.range;
  info.subresourceRange.baseArrayLayer = layer;
  info.subresourceRange.layerCount = 1;
  VkImageView view = VK_NULL_HANDLE;
  return vkCreateImageView_(device_, &info, nullptr, &view) == VK_SUCCESS ? view : VK_NULL_HANDLE;
}

void OpaquePipelines::destroyView(VkImageView view) const { vkDestroyImageView_(device_, view, nullptr); }

void OpaquePipelines::barrier(VkCommandBuffer cmd, const VkImageMemoryBarrier2& image) const {
  auto info = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &image;
  vkCmdPipelineBarrier2_(cmd, &info);
}

void OpaquePipelines::beforeDepth(VkCommandBuffer cmd, const GpuImage& image) const {
  VkImageMemoryBarrier2 start = barrierOf(image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
  start.srcStageMask = kDepthTests | kReaders;  // of an earlier frame
  start.srcAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  start.dstStageMask = kDepthTests;
  start.dstAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  barrier(cmd, start);
}

void OpaquePipelines::afterDepth(VkCommandBuffer cmd, const GpuImage& image, VkImageLayout layout) const {
  VkImageMemoryBarrier2 drawn = barrierOf(image, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL, layout);
  drawn.srcStageMask = kDepthTests;
  drawn.srcAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  drawn.dstStageMask = kDepthTests | kReaders;
  drawn.dstAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  barrier(cmd, drawn);
}

void OpaquePipelines::draw(VkCommandBuffer cmd, VkExtent2D size, OpaquePush push, std::span<const OpaqueDraw> draws) const {
  const VkViewport viewport{0.0f, 0.0f, static_cast<float>(size.width), static_cast<float>(size.height), 0.0f, 1.0f};
  const VkRect2D scissor{{0, 0}, size};
  vkCmdSetViewport_(cmd, 0, 1, &viewport);
  vkCmdSetScissor_(cmd, 0, 1, &scissor);
  for (const OpaqueDraw& draw : draws) {
    const VkBuffer buffers[3] = {draw.buffer, draw.buffer, draw.buffer};
    const VkDeviceSize offsets[3] = {0, draw.normals_at, draw.openness_at};
    vkCmdBindVertexBuffers_(cmd, 0, 3, buffers, offsets);
    vkCmdBindIndexBuffer_(cmd, draw.buffer, draw.indices_at, VK_INDEX_TYPE_UINT32);
    push.albedo = draw.albedo;
    vkCmdPushConstants_(cmd, layout_, kStages, 0, sizeof push, &push);
    vkCmdDrawIndexed_(cmd, draw.index_count, 1, 0, 0, 0);
  }
}

void OpaquePipelines::recordDepth(VkCommandBuffer cmd, VkImageView view, VkExtent2D size, bool reversed, const OpaquePush& push,
                                  std::span<const OpaqueDraw> draws) const {
  auto depth = make<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  depth.imageView = view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  depth.clearValue.depthStencil.depth = reversed ? 0.0f : 1.0f;
  auto info = make<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  info.renderArea.extent = size;
  info.layerCount = 1;
  info.pDepthAttachment = &depth;
  vkCmdBeginRendering_(cmd, &info);
  vkCmdBindPipeline_(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, depth_);
  vkCmdSetDepthCompareOp_(cmd, reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS);
  draw(cmd, size, push, draws);
  vkCmdEndRendering_(cmd);
}

void OpaquePipelines::bindImages(VkImageView hair_map, VkImageView mesh_maps) const {
  const VkDescriptorImageInfo images[2] = {{sampler_, hair_map, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                                           {sampler_, mesh_maps, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL}};
  auto write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write.dstSet = set_;
  write.descriptorCount = 2;  // goes on into the next binding
  write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
  write.pImageInfo = images;
  vkUpdateDescriptorSets_(device_, 1, &write, 0, nullptr);
}

void OpaquePipelines::recordColor(VkCommandBuffer cmd, const GpuImage& target, const GpuImage& depth_image, const OpaquePush& push,
                                  std::span<const OpaqueDraw> draws) const {
  VkImageMemoryBarrier2 start = barrierOf(target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  start.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  start.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  start.dstStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  start.dstAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  barrier(cmd, start);
  auto color = make<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  color.imageView = target.view;
  color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  auto depth = make<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  depth.imageView = depth_image.view;
  depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
  auto info = make<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  info.renderArea.extent = {target.width, target.height};
  info.layerCount = 1;
  info.colorAttachmentCount = 1;
  info.pColorAttachments = &color;
  info.pDepthAttachment = &depth;
  vkCmdBeginRendering_(cmd, &info);
  vkCmdBindPipeline_(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, color_);
  vkCmdBindDescriptorSets_(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
  draw(cmd, info.renderArea.extent, push, draws);
  vkCmdEndRendering_(cmd);
  VkImageMemoryBarrier2 drawn = barrierOf(target, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  drawn.srcStageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  drawn.srcAccessMask = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  drawn.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  drawn.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier(cmd, drawn);
}

}  // namespace forelock::samples
