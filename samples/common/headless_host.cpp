#include "headless_host.h"

#include "gpu_resources.h"

#include <dlfcn.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <mutex>

namespace forelock::samples {
namespace {

#define HOST_INSTANCE_FUNCTIONS(X)                                                                              \
  X(vkDestroyInstance)                                                                                          \
  X(vkEnumeratePhysicalDevices)                                                                                 \
  X(vkGetPhysicalDeviceProperties2) X(vkGetPhysicalDeviceFeatures2) X(vkGetPhysicalDeviceQueueFamilyProperties) \
      X(vkEnumerateDeviceExtensionProperties) X(vkCreateDevice) X(vkGetDeviceProcAddr)
#define HOST_DEVICE_FUNCTIONS(X)                                                                              \
  X(vkDestroyDevice)                                                                                          \
  X(vkGetDeviceQueue)                                                                                         \
  X(vkCreateCommandPool) X(vkDestroyCommandPool) X(vkAllocateCommandBuffers) X(vkBeginCommandBuffer)          \
      X(vkEndCommandBuffer) X(vkResetCommandPool) X(vkQueueSubmit2) X(vkCreateFence) X(vkDestroyFence)        \
          X(vkWaitForFences) X(vkResetFences) X(vkDeviceWaitIdle) X(vkCmdCopyBufferToImage)                   \
              X(vkCmdCopyImageToBuffer) X(vkCmdClearColorImage)

struct Functions {
#define HOST_DECLARE(name) PFN_##name name = nullptr;
  HOST_INSTANCE_FUNCTIONS(HOST_DECLARE)
    HOST_DEVICE_FUNCTIONS(HOST_DECLARE)
#undef HOST_DECLARE
};

float halfToFloat(uint16_t half) {
  const uint32_t sign = uint32_t(half & 0x8000u) << 16, exponent = half >> 10 & 31u, mantissa = half & 1023u;
  if (exponent == 0) return std::bit_cast<float>(sign | 0x3F800000u) * std::ldexp(float(mantissa), -24);
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7F800000u | mantissa << 13);
  return std::bit_cast<float>(sign | (exponent + 112) << 23 | mantissa << 13);
}

// Round to nearest even; beyond the range to the largest.
uint16_t floatToHalf(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value);
  const uint16_t sign = uint16_t(bits >> 16 & 0x8000u);
  const float magnitude = std::abs(value);
  if (!(magnitude < 65504.0f)) return uint16_t(sign | (std::isnan(value) ? 0x7E00u : 0x7BFFu));
  if (magnitude < 6.103515625e-5f) return uint16_t(sign | uint16_t(std::nearbyint(std::ldexp(magnitude, 24))));
  const uint32_t m = std::bit_cast<uint32_t>(magnitude) - 0x38000000u;
  return uint16_t(sign | (m + 0x0FFFu + (m >> 13 & 1u)) >> 13);
}

constexpr uint32_t kOutputValues[FLK_OUTPUT_COUNT] = {1, 1, 2, 2};
constexpr VkFormat kOutputFormats[FLK_OUTPUT_COUNT] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R16G16_SFLOAT,
                                                       VK_FORMAT_R32G32_SFLOAT};
constexpr VkImageSubresourceRange kColorRange{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
constexpr VkImageSubresourceRange kDepthRange{VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};

int preference(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return 2;
    default: return 3;
  }
}

}  // namespace

struct HeadlessHost::Impl {
  void* loader = nullptr;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
  PFN_vkDestroyDebugUtilsMessengerEXT destroy_messenger = nullptr;
  Functions fn;
  VkInstance instance = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
  VkPhysicalDevice physical_device = VK_NULL_HANDLE;
  GpuResources resources;
  VkPhysicalDeviceType type{};
  VkDevice device = VK_NULL_HANDLE;
  uint32_t family = 0;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer cmd = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  FlkContext context = nullptr;
  std::string device_name, driver_name;
  std::vector<std::string> validation, messages;

  uint32_t width = 0, height = 0;
  GpuImage color, depth, outputs[FLK_OUTPUT_COUNT];
  uint32_t output_mask = 0;
  bool graphics = true;
  std::vector<GpuImage> uploaded_images;
  std::vector<GpuBuffer> uploaded_buffers;
  GpuBuffer transfer;
  std::vector<float> background, depth_values;
  bool depth_changed = false;
  uint64_t frame = 0;

  ~Impl() { destroy(); }
  void destroy();
  bool createInstance(const HeadlessOptions& options, std::string& error);
  bool hasExtensions(VkPhysicalDevice candidate, const HeadlessOptions& options) const;
  bool createDevice(const HeadlessOptions& options, std::string& error);
  bool createImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect, GpuImage& image);
  bool ensureOutputs();
  bool ensureTransfer(VkDeviceSize size);
  void uploadImage(const GpuImage& image, const VkImageSubresourceRange& range, VkImageLayout to) const;
};

namespace {

std::mutex messages_mutex;  // the layers call from every thread that calls Vulkan

VKAPI_ATTR VkBool32 VKAPI_CALL onValidation(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  const std::lock_guard<std::mutex> lock(messages_mutex);
  static_cast<std::vector<std::string>*>(user)->push_back(data->pMessage);
  return VK_FALSE;
}

void onMessage(void* user, const FlkMessage* message) {
  static_cast<std::vector<std::string>*>(user)->push_back(std::string(message->id) + ": " + message->text);
}

}  // namespace

bool HeadlessHost::Impl::createInstance(const HeadlessOptions& options, std::string& error) {
  const bool with_validation = options.validation;
  loader = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  if (!loader) return error = "there is no Vulkan loader (libvulkan.so.1): install libvulkan1 and a driver", false;
  get_instance_proc_addr = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(loader, "vkGetInstanceProcAddr"));
  if (!get_instance_proc_addr) return error = "libvulkan.so.1 is no Vulkan loader", false;
  const auto create = reinterpret_cast<PFN_vkCreateInstance>(get_instance_proc_addr(nullptr, "vkCreateInstance"));

  VkApplicationInfo application{};
  application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
  application.pApplicationName = "forelock";
  application.apiVersion = VK_API_VERSION_1_3;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  std::vector<const char*> extensions = options.instance_extensions;
  const VkValidationFeatureEnableEXT enabled = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{};
  features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enabled;
  VkDebugUtilsMessengerCreateInfoEXT debug{};
  debug.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  debug.pNext = &features;
  debug.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  debug.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  debug.pfnUserCallback = onValidation;
  debug.pUserData = &validation;
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pApplicationInfo = &application;
  if (with_validation) {
    info.pNext = &debug;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  }
  info.enabledExtensionCount = uint32_t(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  if (create(&info, nullptr, &instance) != VK_SUCCESS)
    return error = with_validation ? "no Vulkan instance with validation layers: install vulkan-validationlayers"
                                   : "no Vulkan instance: is a driver installed?",
           false;
#define HOST_LOAD(name) fn.name = reinterpret_cast<PFN_##name>(get_instance_proc_addr(instance, #name));
  HOST_INSTANCE_FUNCTIONS(HOST_LOAD)
#undef HOST_LOAD
    if (with_validation) {
      debug.pNext = nullptr;
      const auto create_messenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
          get_instance_proc_addr(instance, "vkCreateDebugUtilsMessengerEXT"));
      destroy_messenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
          get_instance_proc_addr(instance, "vkDestroyDebugUtilsMessengerEXT"));
      if (!create_messenger || create_messenger(instance, &debug, nullptr, &messenger) != VK_SUCCESS)
        return error = "no debug messenger", false;
    }
    return true;
}

bool HeadlessHost::Impl::hasExtensions(VkPhysicalDevice candidate, const HeadlessOptions& options) const {
  uint32_t count = 0;
  fn.vkEnumerateDeviceExtensionProperties(candidate, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> there(count);
  fn.vkEnumerateDeviceExtensionProperties(candidate, nullptr, &count, there.data());
  return std::all_of(options.device_extensions.begin(), options.device_extensions.end(), [&](const char* name) {
    return std::any_of(there.begin(), there.end(), [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
  });
}

bool HeadlessHost::Impl::createDevice(const HeadlessOptions& options, std::string& error) {
  const std::string& wanted = options.device_name;
  FlkRequirements need{};
  flkGetRequirements(&need);
  uint32_t count = 0;
  fn.vkEnumeratePhysicalDevices(instance, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  fn.vkEnumeratePhysicalDevices(instance, &count, devices.data());
  std::string found;
  int best = 100;
  for (VkPhysicalDevice candidate : devices) {
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &driver;
    fn.vkGetPhysicalDeviceProperties2(candidate, &properties);
    const std::string name = properties.properties.deviceName;
    found += (found.empty() ? "" : ", ") + name;
    if (properties.properties.apiVersion < need.api_version) continue;
    if (!wanted.empty() && name.find(wanted) == std::string::npos) continue;
    uint32_t families = 0;
    fn.vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, nullptr);
    std::vector<VkQueueFamilyProperties> family_properties(families);
    fn.vkGetPhysicalDeviceQueueFamilyProperties(candidate, &families, family_properties.data());
    for (uint32_t i = 0; i < families; ++i) {
      if ((family_properties[i].queueFlags & need.queue_flags) != need.queue_flags) continue;
      if (options.can_present && !(hasExtensions(candidate, options) && options.can_present(instance, candidate, i))) continue;
      const bool rasterises = family_properties[i].queueFlags & VK_QUEUE_GRAPHICS_BIT;
      // A family of the kind wanted if there is one, else any.
      const int rank = 2 * preference(properties.properties.deviceType) + (rasterises == options.compute_queue);
      if (rank >= best) continue;
      graphics = rasterises;
      best = rank;
      physical_device = candidate;
      family = i;
      type = properties.properties.deviceType;
      device_name = name;
      driver_name = std::string(driver.driverName) + " " + driver.driverInfo;
    }
  }
  if (!physical_device)
    return error = std::string("no Vulkan 1.3 device") + (options.can_present ? " that can draw to this screen" : "") +
                   (wanted.empty() ? std::string() : " named " + wanted) + "; found: " + (found.empty() ? "none" : found),
           false;

  const float priority = 1;
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  need.features12.pNext = &need.features13;
  need.features.shaderStorageImageExtendedFormats = need.output_features.shaderStorageImageExtendedFormats;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &need.features12;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue_info;
  info.pEnabledFeatures = &need.features;
  info.enabledExtensionCount = uint32_t(options.device_extensions.size());
  info.ppEnabledExtensionNames = options.device_extensions.data();
  if (fn.vkCreateDevice(physical_device, &info, nullptr, &device) != VK_SUCCESS)
    return error = device_name + " lacks a feature that Forelock needs", false;
#define HOST_LOAD(name) fn.name = reinterpret_cast<PFN_##name>(fn.vkGetDeviceProcAddr(device, #name));
  HOST_DEVICE_FUNCTIONS(HOST_LOAD)
#undef HOST_LOAD
    resources.load(get_instance_proc_addr, instance, physical_device, device);
    fn.vkGetDeviceQueue(device, family, 0, &queue);
    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.queueFamilyIndex = family;
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandBufferCount = 1;
    if (fn.vkCreateCommandPool(device, &pool_info, nullptr, &pool) != VK_SUCCESS ||
        fn.vkCreateFence(device, &fence_info, nullptr, &fence) != VK_SUCCESS)
      return error = "no memory for a command pool", false;
    allocate.commandPool = pool;
    if (fn.vkAllocateCommandBuffers(device, &allocate, &cmd) != VK_SUCCESS)
      return error = "no memory for a command buffer", false;

    FlkContextDesc desc{};
    desc.type = FLK_TYPE_CONTEXT;
    desc.instance = instance;
    desc.physical_device = physical_device;
    desc.device = device;
    desc.get_instance_proc_addr = get_instance_proc_addr;
    desc.queue_family = family;
    desc.message = onMessage;
    desc.message_user = &messages;
    if (flkContextCreate(&desc, &context) != FLK_SUCCESS)
      return error = messages.empty() ? "flkContextCreate failed" : messages.back(), false;
    return true;
}

void HeadlessHost::Impl::destroy() {
  if (device) {
    fn.vkDeviceWaitIdle(device);
    flkContextDestroy(context);
    resources.destroy(color);
    resources.destroy(depth);
    for (GpuImage& image : outputs) resources.destroy(image);
    for (GpuImage& image : uploaded_images) resources.destroy(image);
    for (GpuBuffer& buffer : uploaded_buffers) resources.destroy(buffer);
    resources.destroy(transfer);
    if (fence) fn.vkDestroyFence(device, fence, nullptr);
    if (pool) fn.vkDestroyCommandPool(device, pool, nullptr);
    fn.vkDestroyDevice(device, nullptr);
  }
  if (messenger) destroy_messenger(instance, messenger, nullptr);
  if (instance && fn.vkDestroyInstance) fn.vkDestroyInstance(instance, nullptr);
  if (loader) dlclose(loader);
}

bool HeadlessHost::Impl::createImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect, GpuImage& image) {
  return resources.createImage({width, height, 1, VK_IMAGE_VIEW_TYPE_2D, format, usage, aspect}, image);
}

bool HeadlessHost::Impl::ensureTransfer(VkDeviceSize size) {
  if (transfer.size >= size) return true;
  resources.destroy(transfer);
  return resources.createBuffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, transfer);
}

bool HeadlessHost::Impl::ensureOutputs() {
  for (uint32_t i = 0; i < FLK_OUTPUT_COUNT; ++i)
    if ((output_mask >> i & 1) && !outputs[i].view &&
        !createImage(kOutputFormats[i], VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                     VK_IMAGE_ASPECT_COLOR_BIT, outputs[i]))
      return false;
  return true;
}

void HeadlessHost::Impl::uploadImage(const GpuImage& image, const VkImageSubresourceRange& range,
                                     VkImageLayout to) const {
  resources.transition(cmd, image.image, range, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {range.aspectMask, 0, 0, 1};
  region.imageExtent = {width, height, 1};
  fn.vkCmdCopyBufferToImage(cmd, transfer.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
  resources.transition(cmd, image.image, range, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, to);
}

HeadlessHost::HeadlessHost() : impl_(std::make_unique<Impl>()) {}
HeadlessHost::~HeadlessHost() = default;

std::unique_ptr<HeadlessHost> HeadlessHost::create(const HeadlessOptions& options, std::string& error) {
  std::unique_ptr<HeadlessHost> host(new HeadlessHost);
  if (!host->impl_->createInstance(options, error) || !host->impl_->createDevice(options, error))
    return nullptr;
  return host;
}

const std::string& HeadlessHost::deviceName() const { return impl_->device_name; }
const std::string& HeadlessHost::driverName() const { return impl_->driver_name; }
VkPhysicalDeviceType HeadlessHost::deviceType() const { return impl_->type; }
FlkContext HeadlessHost::context() const { return impl_->context; }
HeadlessHost::Device HeadlessHost::device() const {
  return {impl_->get_instance_proc_addr, impl_->instance, impl_->physical_device, impl_->device, impl_->queue, impl_->family};
}
const GpuResources& HeadlessHost::resources() const { return impl_->resources; }
std::vector<std::string>& HeadlessHost::validationMessages() { return impl_->validation; }
std::vector<std::string>& HeadlessHost::messages() { return impl_->messages; }

bool HeadlessHost::resize(uint32_t width, uint32_t height) {
  Impl& i = *impl_;
  if (i.width == width && i.height == height && i.color.view && i.depth.view) return true;
  i.resources.destroy(i.color);
  i.resources.destroy(i.depth);
  for (GpuImage& image : i.outputs) i.resources.destroy(image);
  i.width = width, i.height = height;
  i.background.clear();
  i.depth_values.clear();
  return i.createImage(VK_FORMAT_R16G16B16A16_SFLOAT,
                       VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                       VK_IMAGE_ASPECT_COLOR_BIT, i.color) &&
         i.createImage(VK_FORMAT_D32_SFLOAT, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                       VK_IMAGE_ASPECT_DEPTH_BIT, i.depth);
}

void HeadlessHost::setOutputs(uint32_t mask) { impl_->output_mask = mask; }
bool HeadlessHost::queueHasGraphics() const { return impl_->graphics; }

FlkSampledImage HeadlessHost::uploadArray(uint32_t width, uint32_t height, uint32_t layers, std::span<const float> values) {
  Impl& i = *impl_;
  GpuImage& image = i.uploaded_images.emplace_back();
  if (!i.resources.createImage({width, height, layers, VK_IMAGE_VIEW_TYPE_2D_ARRAY, VK_FORMAT_R32_SFLOAT,
                                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_IMAGE_ASPECT_COLOR_BIT},
                               image) ||
      !i.ensureTransfer(values.size_bytes()))
    return {};
  std::memcpy(i.transfer.mapped, values.data(), values.size_bytes());
  const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, layers};
  submit([&](VkCommandBuffer cmd) {
    i.resources.transition(cmd, image.image, range, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, layers};
    region.imageExtent = {width, height, 1};
    i.fn.vkCmdCopyBufferToImage(cmd, i.transfer.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    i.resources.transition(cmd, image.image, range, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  return {image.image, image.view, range, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
          VK_ACCESS_2_TRANSFER_WRITE_BIT};
}

VkDeviceAddress HeadlessHost::uploadBuffer(std::span<const std::byte> bytes) {
  Impl& i = *impl_;
  GpuBuffer& buffer = i.uploaded_buffers.emplace_back();
  if (!i.resources.createBuffer(bytes.size(), VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, buffer)) return 0;
  std::memcpy(buffer.mapped, bytes.data(), bytes.size());
  return i.resources.address(buffer);
}

void HeadlessHost::freeUploads() {
  for (GpuImage& image : impl_->uploaded_images) impl_->resources.destroy(image);
  for (GpuBuffer& buffer : impl_->uploaded_buffers) impl_->resources.destroy(buffer);
  impl_->uploaded_images.clear();
  impl_->uploaded_buffers.clear();
}

void HeadlessHost::setBackground(std::vector<float> rgba) { impl_->background = std::move(rgba); }

void HeadlessHost::setDepth(std::vector<float> values) {
  impl_->depth_values = std::move(values);
  impl_->depth_changed = true;
}

bool HeadlessHost::submit(const std::function<void(VkCommandBuffer)>& record) {
  Impl& i = *impl_;
  VkCommandBufferBeginInfo begin{};
  begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  if (i.fn.vkResetCommandPool(i.device, i.pool, 0) != VK_SUCCESS ||
      i.fn.vkBeginCommandBuffer(i.cmd, &begin) != VK_SUCCESS)
    return false;
  record(i.cmd);
  VkCommandBufferSubmitInfo buffer{};
  buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
  buffer.commandBuffer = i.cmd;
  VkSubmitInfo2 info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  return i.fn.vkEndCommandBuffer(i.cmd) == VK_SUCCESS &&
         i.fn.vkQueueSubmit2(i.queue, 1, &info, i.fence) == VK_SUCCESS &&
         i.fn.vkWaitForFences(i.device, 1, &i.fence, VK_TRUE, UINT64_MAX) == VK_SUCCESS &&
         i.fn.vkResetFences(i.device, 1, &i.fence) == VK_SUCCESS;
}

FlkResult HeadlessHost::createHair(const FlkHairDesc& desc, FlkHair* hair) {
  FlkResult result = flkHairCreate(impl_->context, &desc, hair);
  if (result != FLK_SUCCESS) return result;
  if (!submit([&](VkCommandBuffer cmd) { result = flkCmdUpload(cmd, *hair); })) result = FLK_ERROR_DEVICE_LOST;
  flkHairReleaseStaging(*hair);
  return result;
}

void HeadlessHost::fillFrame(FlkFrame& frame) const {
  const Impl& i = *impl_;
  frame.type = FLK_TYPE_FRAME;
  frame.target = {i.color.image,
                  i.color.view,
                  VK_FORMAT_R16G16B16A16_SFLOAT,
                  VK_SAMPLE_COUNT_1_BIT,
                  kColorRange,
                  i.width,
                  i.height,
                  {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT},
                  {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT}};
  frame.depth = {};
  if (!i.depth_values.empty())
    frame.depth = {i.depth.image,
                   i.depth.view,
                   VK_FORMAT_D32_SFLOAT,
                   VK_SAMPLE_COUNT_1_BIT,
                   kDepthRange,
                   VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL,
                   VK_PIPELINE_STAGE_2_COPY_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT};
  for (uint32_t o = 0; o < FLK_OUTPUT_COUNT; ++o)
    frame.outputs[o] = i.output_mask >> o & 1 ? FlkOutputImage{i.outputs[o].image, i.outputs[o].view, kColorRange,
                                                               frame.target.entry, frame.target.exit}
                                              : FlkOutputImage{};
}

bool HeadlessHost::uploadDepth() {
  Impl& i = *impl_;
  if (i.depth_values.empty() || !i.depth_changed) return true;
  const std::size_t pixels = std::size_t(i.width) * i.height;
  std::memcpy(i.transfer.mapped, i.depth_values.data(), std::min(pixels, i.depth_values.size()) * 4);
  i.depth_changed = false;
  return submit([&](VkCommandBuffer) { i.uploadImage(i.depth, kDepthRange, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL); });
}

FlkResult HeadlessHost::render(FlkView view, FlkFrame& frame, FlkPlan* planned, const Around& around) {
  return renderTogether(view, {&frame, 1}, planned, around);
}

FlkResult HeadlessHost::renderTogether(FlkView view, std::span<FlkFrame> frames, FlkPlan* planned, const Around& around) {
  Impl& i = *impl_;
  std::vector<FlkPlan> plans;
  const uint64_t completed = i.frame;
  if (!i.ensureOutputs()) return FLK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (FlkFrame& frame : frames) {
    const FlkDepthSource given = frame.depth;
    fillFrame(frame);
    if (given.layout == kNoDepth) frame.depth = {};
    if (around.fill) around.fill(frame);
    frame.frame_number = i.frame + 1;
    frame.completed_frame = completed;
    FlkPlan plan = nullptr;
    const FlkResult result = flkPlanFrame(view, &frame, &plan);
    if (result != FLK_SUCCESS) return result;
    i.frame += 1;
    plans.push_back(plan);
  }
  const std::size_t pixels = std::size_t(i.width) * i.height;
  if (!i.ensureTransfer(pixels * 8)) return FLK_ERROR_OUT_OF_DEVICE_MEMORY;
  if (!uploadDepth()) return FLK_ERROR_DEVICE_LOST;
  if (!i.background.empty()) {
    auto* half = static_cast<uint16_t*>(i.transfer.mapped);
    for (std::size_t c = 0; c < std::min(pixels * 4, i.background.size()); ++c) half[c] = floatToHalf(i.background[c]);
  }
  const bool drawn = submit([&](VkCommandBuffer cmd) {
    for (const FlkPlan plan : plans) {
      if (i.background.empty()) {
        const VkClearColorValue transparent{};
        i.resources.transition(cmd, i.color.image, kColorRange, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        i.fn.vkCmdClearColorImage(cmd, i.color.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &transparent, 1,
                                  &kColorRange);
      } else {
        i.uploadImage(i.color, kColorRange, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
      }
      for (uint32_t o = 0; o < FLK_OUTPUT_COUNT; ++o) {
        if (!(i.output_mask >> o & 1)) continue;
        VkClearColorValue unset{};
        for (float& value : unset.float32) value = -1;
        i.resources.transition(cmd, i.outputs[o].image, kColorRange, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        i.fn.vkCmdClearColorImage(cmd, i.outputs[o].image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &unset, 1, &kColorRange);
      }
      if (around.before) around.before(cmd);
      flkCmdRender(cmd, plan);
      if (around.after) around.after(cmd);
    }
  });
  if (planned) *planned = plans.back();
  return drawn ? FLK_SUCCESS : FLK_ERROR_DEVICE_LOST;
}

FlkResult HeadlessHost::statistics(FlkView view, FlkStatistics& statistics) const {
  return flkViewGetStatistics(view, impl_->frame, &statistics);
}

std::vector<float> HeadlessHost::readColor() { return readImage(impl_->color, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL); }

std::vector<float> HeadlessHost::readShadowMap(const FlkShadowMap& map) {
  Impl& i = *impl_;
  const std::size_t values = std::size_t(map.size) * map.size;
  std::vector<float> depth(values);
  if (!i.ensureTransfer(values * 4)) return {};
  const VkImageSubresourceRange range = map.format == VK_FORMAT_D32_SFLOAT ? kDepthRange : kColorRange;
  submit([&](VkCommandBuffer cmd) {
    i.resources.transition(cmd, map.image, range, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {range.aspectMask, 0, 0, 1};
    region.imageOffset = {int32_t(map.offset[0]), int32_t(map.offset[1]), 0};
    region.imageExtent = {map.size, map.size, 1};
    i.fn.vkCmdCopyImageToBuffer(cmd, map.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, i.transfer.buffer, 1, &region);
    i.resources.transition(cmd, map.image, range, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  });
  std::memcpy(depth.data(), i.transfer.mapped, values * 4);
  return depth;
}

std::vector<float> HeadlessHost::readImage(const GpuImage& image, VkImageLayout layout) {
  Impl& i = *impl_;
  const bool color = image.format == VK_FORMAT_R16G16B16A16_SFLOAT;
  const std::size_t pixels = std::size_t(image.width) * image.height;
  std::vector<float> values(pixels * (color ? 4 : 1));
  if (!i.ensureTransfer(pixels * (color ? 8 : 4))) return {};
  const bool move = layout != VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  const bool done = submit([&](VkCommandBuffer cmd) {
    if (move) i.resources.transition(cmd, image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {image.range.aspectMask, 0, 0, 1};
    region.imageExtent = {image.width, image.height, 1};
    i.fn.vkCmdCopyImageToBuffer(cmd, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, i.transfer.buffer, 1, &region);
    if (move) i.resources.transition(cmd, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
  });
  if (!done) return {};
  if (color) {
    const auto* half = static_cast<const uint16_t*>(i.transfer.mapped);
    std::transform(half, half + values.size(), values.begin(), halfToFloat);
  } else {
    std::memcpy(values.data(), i.transfer.mapped, values.size() * 4);
  }
  return values;
}

std::vector<float> HeadlessHost::readOutput(uint32_t output) {
  Impl& i = *impl_;
  const std::size_t values = std::size_t(i.width) * i.height * kOutputValues[output];
  if (!i.ensureTransfer(values * 4)) return {};
  submit([&](VkCommandBuffer cmd) {
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = {i.width, i.height, 1};
    i.fn.vkCmdCopyImageToBuffer(cmd, i.outputs[output].image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, i.transfer.buffer, 1, &region);
  });
  std::vector<float> result(values);
  if (kOutputFormats[output] == VK_FORMAT_R16G16_SFLOAT) {
    const auto* half = static_cast<const uint16_t*>(i.transfer.mapped);
    std::transform(half, half + values, result.begin(), halfToFloat);
  } else {
    std::memcpy(result.data(), i.transfer.mapped, values * 4);
  }
  return result;
}

}  // namespace forelock::samples
