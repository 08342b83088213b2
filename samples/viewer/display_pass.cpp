// SPDX-License-Identifier: MIT
#include "display_pass.h"

#include "view_display_frag_spv.h"
#include "view_display_vert_spv.h"

#include <stdexcept>
#include <string>

namespace forelock::samples {

namespace {

template <class T>
T tagged(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) {
    throw std::runtime_error(std::string("making ") + what + " failed (VkResult " + std::to_string(result) + ")");
  }
}

}  // namespace

DisplayPass::DisplayPass(const ViewGpu& gpu, VkRenderPass render_pass) : gpu_(gpu) {
  const VkDevice device = gpu.device;
  auto sampler = tagged<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  sampler.magFilter = sampler.minFilter = VK_FILTER_LINEAR;  // a picture of the window's size is met in its texels' middles
  sampler.addressModeU = sampler.addressModeV = sampler.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkDescriptorSetLayoutBinding bindings[kDisplayImages] = {};
  for (uint32_t i = 0; i < kDisplayImages; ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  }
  auto set_layout = tagged<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_layout.bindingCount = kDisplayImages;
  set_layout.pBindings = bindings;
  const VkPushConstantRange range{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(DisplayPush)};
  auto layout = tagged<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, kDisplayImages};
  auto pool = tagged<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.maxSets = pool.poolSizeCount = 1;
  pool.pPoolSizes = &size;
  VkShaderModule modules[2] = {};
  try {
    check(gpu.vkCreateSampler(device, &sampler, nullptr, &sampler_), "a sampler");
    check(gpu.vkCreateDescriptorSetLayout(device, &set_layout, nullptr, &set_layout_), "a descriptor layout");
    layout.pSetLayouts = &set_layout_;
    check(gpu.vkCreatePipelineLayout(device, &layout, nullptr, &layout_), "a pipeline layout");
    check(gpu.vkCreateDescriptorPool(device, &pool, nullptr, &pool_), "a descriptor pool");
    auto allocate = tagged<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pool_;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &set_layout_;
    check(gpu.vkAllocateDescriptorSets(device, &allocate, &set_), "a descriptor set");
    auto code = tagged<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    code.codeSize = sizeof(view_display_vert_spv);
    code.pCode = view_display_vert_spv;
    check(gpu.vkCreateShaderModule(device, &code, nullptr, &modules[0]), "a shader");
    code.codeSize = sizeof(view_display_frag_spv);
    code.pCode = view_display_frag_spv;
    check(gpu.vkCreateShaderModule(device, &code, nullptr, &modules[1]), "a shader");
    VkPipelineShaderStageCreateInfo stages[2];
    for (int i = 0; i < 2; ++i) {
      stages[i] = tagged<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
      stages[i].stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT;
      stages[i].module = modules[i];
      stages[i].pName = "main";
    }
    const auto vertices = tagged<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    auto assembly = tagged<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    auto viewport = tagged<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewport.viewportCount = viewport.scissorCount = 1;
    auto raster = tagged<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.lineWidth = 1.0f;
    auto samples = tagged<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState attachment{};
    attachment.colorWriteMask = 0xF;
    auto blend = tagged<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;
    const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    auto dynamic = tagged<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = 2;
    dynamic.pDynamicStates = states;
    auto info = tagged<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout_;
    info.renderPass = render_pass;
    check(gpu.vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_), "a pipeline");
  } catch (...) {
    gpu.vkDestroyShaderModule(device, modules[0], nullptr);
    gpu.vkDestroyShaderModule(device, modules[1], nullptr);
    release();
    throw;
  }
  gpu.vkDestroyShaderModule(device, modules[0], nullptr);
  gpu.vkDestroyShaderModule(device, modules[1], nullptr);
}

DisplayPass::~DisplayPass() { release(); }

void DisplayPass::release() {
  gpu_.vkDestroyPipeline(gpu_.device, pipeline_, nullptr);
  gpu_.vkDestroyDescriptorPool(gpu_.device, pool_, nullptr);
  gpu_.vkDestroyPipelineLayout(gpu_.device, layout_, nullptr);
  gpu_.vkDestroyDescriptorSetLayout(gpu_.device, set_layout_, nullptr);
  gpu_.vkDestroySampler(gpu_.device, sampler_, nullptr);
}

void DisplayPass::bind(const std::array<VkImageView, kDisplayImages>& views) {

  VkDescriptorImageInfo images[kDisplayImages];
  VkWriteDescriptorSet writes[kDisplayImages];
  for (uint32_t i = 0; i < kDisplayImages; ++i) {
    images[i] = {sampler_, views[i], VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    writes[i] = tagged<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    writes[i].dstSet = set_;
    writes[i].dstBinding = i;
    writes[i].descriptorCount = 1;
    writes[i].descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    writes[i].pImageInfo = &images[i];
  }
  gpu_.vkUpdateDescriptorSets(gpu_.device, kDisplayImages, writes, 0, nullptr);
}

void DisplayPass::record(VkCommandBuffer cmd, const DisplayPush& push) const {
  const VkViewport viewport{push.rect[0], push.rect[1], push.rect[2], push.rect[3], 0.0f, 1.0f};
  const VkRect2D scissor{{static_cast<int32_t>(push.rect[0]), static_cast<int32_t>(push.rect[1])},
                         {static_cast<uint32_t>(push.rect[2]), static_cast<uint32_t>(push.rect[3])}};
  gpu_.vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  gpu_.vkCmdSetViewport(cmd, 0, 1, &viewport);
  gpu_.vkCmdSetScissor(cmd, 0, 1, &scissor);
  gpu_.vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0, nullptr);
  gpu_.vkCmdPushConstants(cmd, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push, &push);
  gpu_.vkCmdDraw(cmd, 3, 1, 0, 0);
}

}  // namespace forelock::samples
