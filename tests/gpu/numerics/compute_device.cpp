#include "compute_device.h"

#include "forelock/render.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace forelock::test {
namespace {

#define NUMERICS_INSTANCE_FUNCTIONS(X)                                                                        \
  X(vkDestroyInstance)                                                                                        \
  X(vkEnumeratePhysicalDevices) X(vkGetPhysicalDeviceProperties2) X(vkGetPhysicalDeviceQueueFamilyProperties) \
      X(vkGetPhysicalDeviceMemoryProperties) X(vkCreateDevice) X(vkGetDeviceProcAddr)                         \
          X(vkCreateDebugUtilsMessengerEXT) X(vkDestroyDebugUtilsMessengerEXT)
#define NUMERICS_DEVICE_FUNCTIONS(X)                                                                              \
  X(vkDestroyDevice)                                                                                              \
  X(vkGetDeviceQueue) X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkAllocateCommandBuffers)                  \
      X(vkBeginCommandBuffer) X(vkEndCommandBuffer) X(vkResetCommandPool) X(vkQueueSubmit2) X(vkQueueWaitIdle)    \
          X(vkCreateImage) X(vkDestroyImage) X(vkCreateImageView) X(vkDestroyImageView)                           \
              X(vkGetImageMemoryRequirements) X(vkBindImageMemory) X(vkCreateBuffer) X(vkDestroyBuffer)           \
                  X(vkGetBufferMemoryRequirements) X(vkBindBufferMemory) X(vkAllocateMemory) X(vkFreeMemory)      \
                      X(vkMapMemory) X(vkCmdPipelineBarrier2) X(vkCmdCopyBufferToImage) X(vkCreateShaderModule)   \
                          X(vkDestroyShaderModule) X(vkCreateDescriptorSetLayout) X(vkDestroyDescriptorSetLayout) \
                              X(vkCreatePipelineLayout) X(vkDestroyPipelineLayout) X(vkCreateComputePipelines)    \
                                  X(vkDestroyPipeline) X(vkCreateDescriptorPool) X(vkDestroyDescriptorPool)       \
                                      X(vkAllocateDescriptorSets) X(vkUpdateDescriptorSets) X(vkCmdBindPipeline)  \
                                          X(vkCmdBindDescriptorSets) X(vkCmdPushConstants) X(vkCmdDispatch)

#define NUMERICS_DECLARE(f) PFN_##f f = nullptr;
struct Functions {
  NUMERICS_INSTANCE_FUNCTIONS(NUMERICS_DECLARE)
  NUMERICS_DEVICE_FUNCTIONS(NUMERICS_DECLARE)
};
#undef NUMERICS_DECLARE

void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw std::runtime_error(std::string(what) + " failed: " + std::to_string(result));
}

template <class T>
T make(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  static_cast<std::vector<std::string>*>(user)->push_back(data->pMessage);
  return VK_FALSE;
}

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;
};

class ValidationListener : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo&) override {
    std::vector<std::string>& messages = ComputeDevice::shared().validationMessages();
    for (const std::string& message : messages) ADD_FAILURE() << message;
    messages.clear();
  }
};
const bool kListening = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new ValidationListener);
  return true;
}();

}  // namespace

struct ComputeDevice::Impl {
  Functions fn;
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory{};
  VkDevice device = VK_NULL_HANDLE;
  uint32_t family = 0;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer cmd = VK_NULL_HANDLE;
  std::string name;
  std::vector<std::string> validation;

  void open(bool with_validation);
  void pick(const FlkRequirements& need);
  VkDeviceMemory allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags flags) const;
  Buffer makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const;
  void destroyBuffer(const Buffer& buffer) const;
  void uploadMap(VkImage image, VkBuffer from, uint32_t size) const;
};

void ComputeDevice::Impl::open(bool with_validation) {
  void* loader = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!loader) throw std::runtime_error("no Vulkan loader");
  const auto get = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loader, "vkGetInstanceProcAddr"));
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get(nullptr, "vkCreateInstance"));
  auto application = make<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.apiVersion = VK_API_VERSION_1_3;
  const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  auto features = make<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enabled;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  auto info = make<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  if (with_validation) {
    info.pNext = &features;
    info.enabledLayerCount = info.enabledExtensionCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.ppEnabledExtensionNames = &extension;
  }
  check(create(&info, nullptr, &instance), "vkCreateInstance");
#define NUMERICS_LOAD(f) fn.f = reinterpret_cast<PFN_##f>(get(instance, #f));
  NUMERICS_INSTANCE_FUNCTIONS(NUMERICS_LOAD)
#undef NUMERICS_LOAD
  if (with_validation) {
    auto debug = make<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    debug.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    debug.pfnUserCallback = onValidation;
    debug.pUserData = &validation;
    check(fn.vkCreateDebugUtilsMessengerEXT(instance, &debug, nullptr, &messenger), "vkCreateDebugUtilsMessengerEXT");
  }

  FlkRequirements need{};
  flkGetRequirements(&need);
  pick(need);
  const float priority = 1;
  auto queue_info = make<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue_info.queueFamilyIndex = family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  need.features12.pNext = &need.features13;
  auto device_info = make<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  device_info.pNext = &need.features12;
  device_info.queueCreateInfoCount = 1;
  device_info.pQueueCreateInfos = &queue_info;
  device_info.pEnabledFeatures = &need.features;
  check(fn.vkCreateDevice(physical_device, &device_info, nullptr, &device), "vkCreateDevice");
#define NUMERICS_LOAD(f) fn.f = reinterpret_cast<PFN_##f>(fn.vkGetDeviceProcAddr(device, #f));
  NUMERICS_DEVICE_FUNCTIONS(NUMERICS_LOAD)
#undef NUMERICS_LOAD
  fn.vkGetPhysicalDeviceMemoryProperties(physical_device, &memory);
  fn.vkGetDeviceQueue(device, family, 0, &queue);
  auto pool_info = make<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.queueFamilyIndex = family;
  check(fn.vkCreateCommandPool(device, &pool_info, nullptr, &pool), "vkCreateCommandPool");
  auto allocate_info = make<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate_info.commandPool = pool;
  allocate_info.commandBufferCount = 1;
  check(fn.vkAllocateCommandBuffers(device, &allocate_info, &cmd), "vkAllocateCommandBuffers");
}

// The first device that is no CPU, else the first.
void ComputeDevice::Impl::pick(const FlkRequirements& need) {
  uint32_t count = 0;
  check(fn.vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  fn.vkEnumeratePhysicalDevices(instance, &count, devices.data());
  bool found_gpu = false;
  for (VkPhysicalDevice candidate : devices) {
    auto driver = make<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = make<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &driver;
    fn.vkGetPhysicalDeviceProperties2(candidate, &properties);
    const bool gpu = properties.properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
    if (properties.properties.apiVersion < need.api_version || (physical_device && (found_gpu || !gpu))) continue;
    uint32_t families = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, nullptr);
    std::vector<VkQueueFamilyProperties> each(families);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, each.data());
    const auto fit = std::find_if(each.begin(), each.end(), [&](const VkQueueFamilyProperties& f) {
      return (f.queueFlags & need.queue_flags) == need.queue_flags;
    });
    if (fit == each.end()) continue;
    physical_device = candidate;
    family = uint32_t(fit - each.begin());
    found_gpu = gpu;
    name = std::string(properties.properties.deviceName) + ", " + driver.driverName + " " + driver.driverInfo;
  }
  if (!physical_device) throw std::runtime_error("no Vulkan 1.3 device");
}

VkDeviceMemory ComputeDevice::Impl::allocate(const VkMemoryRequirements& requirements,
                                             VkMemoryPropertyFlags flags) const {
  auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = requirements.size;
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    if (!(requirements.memoryTypeBits >> i & 1) || (memory.memoryTypes[i].propertyFlags & flags) != flags) continue;
    info.memoryTypeIndex = i;
    break;
  }
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  check(fn.vkAllocateMemory(device, &info, nullptr, &allocated), "vkAllocateMemory");
  return allocated;
}

Buffer ComputeDevice::Impl::makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) const {
  Buffer made;
  auto info = make<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  check(fn.vkCreateBuffer(device, &info, nullptr, &made.buffer), "vkCreateBuffer");
  VkMemoryRequirements requirements{};
  fn.vkGetBufferMemoryRequirements(device, made.buffer, &requirements);
  made.memory = allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(fn.vkBindBufferMemory(device, made.buffer, made.memory, 0), "vkBindBufferMemory");
  check(fn.vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, &made.mapped), "vkMapMemory");
  return made;
}

void ComputeDevice::Impl::destroyBuffer(const Buffer& buffer) const {
  fn.vkDestroyBuffer(device, buffer.buffer, nullptr);
  fn.vkFreeMemory(device, buffer.memory, nullptr);
}

void ComputeDevice::Impl::uploadMap(VkImage image, VkBuffer from, uint32_t size) const {
  auto transition = [&](VkImageLayout before, VkImageLayout after) {
    auto barrier = make<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    auto dependency = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    fn.vkCmdPipelineBarrier2(cmd, &dependency);
  };
  transition(VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1};
  region.imageExtent = {size, size, 1};
  fn.vkCmdCopyBufferToImage(cmd, from, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  transition(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

ComputeDevice::ComputeDevice() : impl_(std::make_unique<Impl>()) {
  impl_->open(std::getenv("FORELOCK_NO_VALIDATION") == nullptr);
}

ComputeDevice::~ComputeDevice() {
  const Functions& fn = impl_->fn;
  fn.vkDestroyCommandPool(impl_->device, impl_->pool, nullptr);
  fn.vkDestroyDevice(impl_->device, nullptr);
  if (impl_->messenger) fn.vkDestroyDebugUtilsMessengerEXT(impl_->instance, impl_->messenger, nullptr);
  fn.vkDestroyInstance(impl_->instance, nullptr);
}

ComputeDevice& ComputeDevice::shared() {
  static std::unique_ptr<ComputeDevice> device = [] {
    try {
      return std::unique_ptr<ComputeDevice>(new ComputeDevice);
    } catch (const std::exception& e) {
      ADD_FAILURE() << "a GPU test needs a device: " << e.what();
      std::exit(1);
    }
  }();
  return *device;
}

const std::string& ComputeDevice::name() const { return impl_->name; }
std::vector<std::string>& ComputeDevice::validationMessages() { return impl_->validation; }

std::vector<float> ComputeDevice::run(std::span<const uint32_t> spirv, std::span<const float> words, uint32_t in_stride,
                                      uint32_t out_stride, const DepthMap* map) try {
  Impl& i = *impl_;
  const Functions& fn = i.fn;
  const uint32_t items = uint32_t(words.size() / in_stride);
  std::vector<float> results(std::size_t(items) * out_stride);
  const Buffer in = i.makeBuffer(words.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const Buffer out = i.makeBuffer(results.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  std::memcpy(in.mapped, words.data(), words.size_bytes());

  VkImage image = VK_NULL_HANDLE;
  VkDeviceMemory image_memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  Buffer texels;
  if (map) {
    auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = VK_FORMAT_D32_SFLOAT;
    info.extent = {map->size, map->size, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    check(fn.vkCreateImage(i.device, &info, nullptr, &image), "vkCreateImage");
    VkMemoryRequirements requirements{};
    fn.vkGetImageMemoryRequirements(i.device, image, &requirements);
    image_memory = i.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    check(fn.vkBindImageMemory(i.device, image, image_memory, 0), "vkBindImageMemory");
    auto view_info = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view_info.image = image;
    view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view_info.format = info.format;
    view_info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
    check(fn.vkCreateImageView(i.device, &view_info, nullptr, &view), "vkCreateImageView");
    texels = i.makeBuffer(map->texels.size() * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(texels.mapped, map->texels.data(), map->texels.size() * sizeof(float));
  }

  const VkDescriptorSetLayoutBinding bindings[3] = {
      {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
      {2, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
  auto set_info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set_info.bindingCount = map ? 3 : 2;
  set_info.pBindings = bindings;
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  check(fn.vkCreateDescriptorSetLayout(i.device, &set_info, nullptr, &set_layout), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(uint32_t)};
  auto layout_info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = layout_info.pushConstantRangeCount = 1;
  layout_info.pSetLayouts = &set_layout;
  layout_info.pPushConstantRanges = &push;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(fn.vkCreatePipelineLayout(i.device, &layout_info, nullptr, &layout), "vkCreatePipelineLayout");
  auto module_info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  check(fn.vkCreateShaderModule(i.device, &module_info, nullptr, &module), "vkCreateShaderModule");
  auto pipeline_info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  pipeline_info.stage = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
  pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  pipeline_info.stage.module = module;
  pipeline_info.stage.pName = "main";
  pipeline_info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(fn.vkCreateComputePipelines(i.device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline),
        "vkCreateComputePipelines");

  const VkDescriptorPoolSize sizes[2] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2}, {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1}};
  auto pool_info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool_info.maxSets = 1;
  pool_info.poolSizeCount = 2;
  pool_info.pPoolSizes = sizes;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  check(fn.vkCreateDescriptorPool(i.device, &pool_info, nullptr, &descriptors), "vkCreateDescriptorPool");
  auto allocate_info = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  allocate_info.descriptorPool = descriptors;
  allocate_info.descriptorSetCount = 1;
  allocate_info.pSetLayouts = &set_layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(fn.vkAllocateDescriptorSets(i.device, &allocate_info, &set), "vkAllocateDescriptorSets");
  const VkDescriptorBufferInfo buffers[2] = {{in.buffer, 0, VK_WHOLE_SIZE}, {out.buffer, 0, VK_WHOLE_SIZE}};
  const VkDescriptorImageInfo image_info{VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  VkWriteDescriptorSet writes[2] = {};
  for (VkWriteDescriptorSet& write : writes) write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET, write.dstSet = set;
  writes[0].descriptorCount = 2;
  writes[0].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  writes[0].pBufferInfo = buffers;
  writes[1].dstBinding = 2;
  writes[1].descriptorCount = 1;
  writes[1].descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
  writes[1].pImageInfo = &image_info;
  fn.vkUpdateDescriptorSets(i.device, map ? 2 : 1, writes, 0, nullptr);

  check(fn.vkResetCommandPool(i.device, i.pool, 0), "vkResetCommandPool");
  auto begin = make<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(fn.vkBeginCommandBuffer(i.cmd, &begin), "vkBeginCommandBuffer");
  if (map) i.uploadMap(image, texels.buffer, map->size);
  fn.vkCmdBindPipeline(i.cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  fn.vkCmdBindDescriptorSets(i.cmd, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, nullptr);
  fn.vkCmdPushConstants(i.cmd, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(items), &items);
  fn.vkCmdDispatch(i.cmd, (items + 63) / 64, 1, 1);
  auto to_host = make<VkMemoryBarrier2>(VK_STRUCTURE_TYPE_MEMORY_BARRIER_2);
  to_host.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  to_host.srcAccessMask = VK_ACCESS_2_SHADER_WRITE_BIT;
  to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  auto dependency = make<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.memoryBarrierCount = 1;
  dependency.pMemoryBarriers = &to_host;
  fn.vkCmdPipelineBarrier2(i.cmd, &dependency);
  check(fn.vkEndCommandBuffer(i.cmd), "vkEndCommandBuffer");
  auto submitted = make<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
  submitted.commandBuffer = i.cmd;
  auto submit = make<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
  submit.commandBufferInfoCount = 1;
  submit.pCommandBufferInfos = &submitted;
  check(fn.vkQueueSubmit2(i.queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit2");
  check(fn.vkQueueWaitIdle(i.queue), "vkQueueWaitIdle");
  std::memcpy(results.data(), out.mapped, results.size() * sizeof(float));

  fn.vkDestroyDescriptorPool(i.device, descriptors, nullptr);
  fn.vkDestroyPipeline(i.device, pipeline, nullptr);
  fn.vkDestroyShaderModule(i.device, module, nullptr);
  fn.vkDestroyPipelineLayout(i.device, layout, nullptr);
  fn.vkDestroyDescriptorSetLayout(i.device, set_layout, nullptr);
  i.destroyBuffer(in);
  i.destroyBuffer(out);
  if (map) {
    i.destroyBuffer(texels);
    fn.vkDestroyImageView(i.device, view, nullptr);
    fn.vkDestroyImage(i.device, image, nullptr);
    fn.vkFreeMemory(i.device, image_memory, nullptr);
  }
  return results;
} catch (const std::exception& e) {
  // What was made so far is leaked: the device is lost or out of memory, and the test has failed.
  ADD_FAILURE() << e.what();
  return {};
}

}  // namespace forelock::test
