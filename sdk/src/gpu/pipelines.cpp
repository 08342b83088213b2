#include "gpu/pipelines.h"

#include "gpu/shader_code.h"

#include <iterator>

namespace forelock {
namespace {

// Only the stages that read a binding: no stage sees more than 4 storage buffers, the least that every device offers.
constexpr VkShaderStageFlags kVertex = VK_SHADER_STAGE_VERTEX_BIT, kFragment = VK_SHADER_STAGE_FRAGMENT_BIT,
                             kCompute = VK_SHADER_STAGE_COMPUTE_BIT;

struct BindingKind {
  VkDescriptorType type;
  VkShaderStageFlags stages;
};

constexpr VkDescriptorType kBuffer = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kImage = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                           kUniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                           kStore = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, kSampled = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
constexpr BindingKind kBindings[kBindingCount] = {
    {kUniform, kVertex | kFragment | kCompute},
    {kBuffer, kFragment | kCompute},
    {kBuffer, kFragment | kCompute},
    {kImage, kFragment | kCompute},
    {kSampled, kFragment | kCompute},
    {kStore, kCompute},
    {kImage, kFragment | kCompute},
    {kImage, kFragment | kCompute},
    {kStore, kCompute},
    {kBuffer, kCompute},
};

VkResult createShader(Device& device, std::span<const uint32_t> code, VkShaderModule& module) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = code.size_bytes();
  info.pCode = code.data();
  return device.fn.vkCreateShaderModule(device.device, &info, nullptr, &module);
}

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                          const VkSpecializationInfo* constants) {
  VkPipelineShaderStageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage = stage;
  info.module = module;
  info.pName = "main";
  info.pSpecializationInfo = constants;
  return info;
}

VkResult createCompute(Device& device, VkPipelineLayout layout, VkShaderModule main,
                       const VkSpecializationInfo* constants, VkPipeline& pipeline) {
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, main, constants);
  info.layout = layout;
  return device.fn.vkCreateComputePipelines(device.device, device.pipeline_cache, 1, &info, nullptr, &pipeline);
}

VkResult createRaster(Device& device, VkPipelineLayout layout, VkShaderModule vertex, VkShaderModule fragment,
                      bool depth, const VkSpecializationInfo* constants, VkPipeline& pipeline) {
  const VkPipelineShaderStageCreateInfo stages[] = {stageInfo(VK_SHADER_STAGE_VERTEX_BIT, vertex, constants),
                                                    stageInfo(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, constants)};
  VkPipelineVertexInputStateCreateInfo input{};
  input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
  assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
  VkPipelineViewportStateCreateInfo viewport{};
  viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
  viewport.viewportCount = viewport.scissorCount = 1;
  VkPipelineRasterizationStateCreateInfo raster{};
  raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
  raster.polygonMode = VK_POLYGON_MODE_FILL;
  raster.cullMode = VK_CULL_MODE_NONE;
  raster.lineWidth = 1;
  VkPipelineMultisampleStateCreateInfo multisample{};
  multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
  multisample.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
  VkPipelineDepthStencilStateCreateInfo depth_state{};
  depth_state.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
  depth_state.depthTestEnable = depth_state.depthWriteEnable = depth;
  depth_state.depthCompareOp = VK_COMPARE_OP_LESS;
  VkPipelineColorBlendStateCreateInfo blend{};
  blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
  const VkDynamicState states[] = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
  dynamic.dynamicStateCount = uint32_t(std::size(states));
  dynamic.pDynamicStates = states;
  VkPipelineRenderingCreateInfo rendering{};
  rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
  rendering.depthAttachmentFormat = depth ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_UNDEFINED;

  VkGraphicsPipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
  info.pNext = &rendering;
  info.stageCount = uint32_t(std::size(stages));
  info.pStages = stages;
  info.pVertexInputState = &input;
  info.pInputAssemblyState = &assembly;
  info.pViewportState = &viewport;
  info.pRasterizationState = &raster;
  info.pMultisampleState = &multisample;
  info.pDepthStencilState = &depth_state;
  info.pColorBlendState = &blend;
  info.pDynamicState = &dynamic;
  info.layout = layout;
  return device.fn.vkCreateGraphicsPipelines(device.device, device.pipeline_cache, 1, &info, nullptr, &pipeline);
}

}  // namespace

VkDescriptorType bindingType(uint32_t binding) { return kBindings[binding].type; }

FlkResult Pipelines::init(Device& device) {
  if (device.planning()) return FLK_SUCCESS;
  VkSamplerCreateInfo sampler_info{};  // nearest
  sampler_info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  sampler_info.addressModeU = sampler_info.addressModeV = sampler_info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkResult result = device.fn.vkCreateSampler(device.device, &sampler_info, nullptr, &shadow_sampler_);
  if (result != VK_SUCCESS) return shadow_sampler_ = VK_NULL_HANDLE, toResult(result);
  VkDescriptorSetLayoutBinding bindings[kBindingCount]{};
  for (uint32_t i = 0; i < kBindingCount; ++i) bindings[i] = {i, kBindings[i].type, 1, kBindings[i].stages, kBindings[i].type == kSampled ? &shadow_sampler_ : nullptr};
  VkDescriptorSetLayoutCreateInfo set_info{};
  set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  set_info.bindingCount = kBindingCount;
  set_info.pBindings = bindings;
  result = device.fn.vkCreateDescriptorSetLayout(device.device, &set_info, nullptr, &view_set);
  if (result != VK_SUCCESS) return view_set = VK_NULL_HANDLE, destroy(device), toResult(result);
  const VkPushConstantRange range{kPushStages, 0, kPushBytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &view_set;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  result = device.fn.vkCreatePipelineLayout(device.device, &info, nullptr, &layout);
  if (result != VK_SUCCESS) layout = VK_NULL_HANDLE, destroy(device);
  return toResult(result);
}

void Pipelines::destroy(Device& device) {
  for (const Entry& entry : cache_)
    if (entry.pipeline) device.fn.vkDestroyPipeline(device.device, entry.pipeline, nullptr);
  cache_.clear();
  if (layout) device.fn.vkDestroyPipelineLayout(device.device, layout, nullptr);
  if (view_set) device.fn.vkDestroyDescriptorSetLayout(device.device, view_set, nullptr);
  if (shadow_sampler_) device.fn.vkDestroySampler(device.device, shadow_sampler_, nullptr);
  layout = VK_NULL_HANDLE;
  view_set = VK_NULL_HANDLE;
  shadow_sampler_ = VK_NULL_HANDLE;
}

FlkResult Pipelines::get(Device& device, const Recipe& recipe, VkPipeline& pipeline, uint64_t& hash) {
  pipeline = VK_NULL_HANDLE;
  for (const Entry& entry : cache_)
    if (entry.recipe == recipe) return pipeline = entry.pipeline, hash = entry.hash, FLK_SUCCESS;
  const auto main_code = shaderCode(recipe.main, recipe.images), vertex_code = shaderCode(recipe.vertex, 0);
  if (main_code.empty() || (recipe.vertex != ShaderId::none && vertex_code.empty())) {
    device.messages.say(FLK_SEVERITY_ERROR, "NOT_BUILT",
                        "this build of Forelock does without something that the frame asks for (CMake options FORELOCK_...)");
    return FLK_ERROR_NOT_BUILT;
  }
  hash = recipeHash(recipe);
  cache_.reserve(cache_.size() + 1);  // before there is a pipeline to lose

  if (device.planning()) return cache_.push_back({recipe, VK_NULL_HANDLE, hash}), FLK_SUCCESS;

  VkSpecializationMapEntry entries[FLK_SPEC_COUNT];
  for (uint32_t i = 0; i < FLK_SPEC_COUNT; ++i) entries[i] = {i, uint32_t(i * sizeof(uint32_t)), sizeof(uint32_t)};
  const VkSpecializationInfo constants{FLK_SPEC_COUNT, entries, sizeof recipe.constants, recipe.constants};
  VkShaderModule vertex = VK_NULL_HANDLE, main = VK_NULL_HANDLE;
  VkResult result = createShader(device, main_code, main);
  if (result != VK_SUCCESS) main = VK_NULL_HANDLE;
  if (result == VK_SUCCESS && recipe.vertex != ShaderId::none) {
    result = createShader(device, vertex_code, vertex);
    if (result != VK_SUCCESS) vertex = VK_NULL_HANDLE;
  }
  if (result == VK_SUCCESS)
    result = vertex ? createRaster(device, layout, vertex, main, recipe.depth_attachment, &constants, pipeline)
                    : createCompute(device, layout, main, &constants, pipeline);
  if (vertex) device.fn.vkDestroyShaderModule(device.device, vertex, nullptr);
  if (main) device.fn.vkDestroyShaderModule(device.device, main, nullptr);
  if (result != VK_SUCCESS) {
    pipeline = VK_NULL_HANDLE;
    device.messages.say(FLK_SEVERITY_ERROR, "PIPELINE", "the driver could not compile a pipeline (VkResult %d)",
                        int(result));
    return toResult(result);
  }
  cache_.push_back({recipe, pipeline, hash});
  return FLK_SUCCESS;
}

}  // namespace forelock
