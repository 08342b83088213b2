#include "mock_vulkan.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace mock {
namespace {

Driver* the_driver = nullptr;

PFN_vkVoidFunction find(const char* name, bool of_device) {
  Driver& driver = Driver::current();
  driver.enter(of_device ? "vkGetDeviceProcAddr" : "vkGetInstanceProcAddr");
  driver.asked_for.insert(name);
  // What the host alone does.
  static const std::set<std::string> forbidden = {
      "vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle", "vkWaitForFences", "vkWaitSemaphores",
      "vkGetDeviceQueue", "vkGetDeviceQueue2", "vkCreateDevice", "vkCreateInstance", "vkCreateCommandPool",
      "vkAllocateCommandBuffers", "vkBeginCommandBuffer", "vkEndCommandBuffer", "vkCreateFence", "vkCreateSemaphore",
      "vkQueueBindSparse", "vkQueuePresentKHR", "vkDestroyDevice", "vkDestroyInstance"};
  if (forbidden.count(name)) driver.breach(std::string("asks for ") + name);
  if (driver.claims.missing_functions.count(name)) return nullptr;
  for (const FunctionTable* table : {&deviceFunctions(), &commandFunctions()})
    if (const auto found = table->find(name); found != table->end()) return found->second;
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetDeviceProcAddr(VkDevice device, const char* name) {
  Driver::current().checkDevice(device, "vkGetDeviceProcAddr");
  return find(name, true);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL GetInstanceProcAddr(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
    return reinterpret_cast<PFN_vkVoidFunction>(static_cast<PFN_vkGetDeviceProcAddr>(GetDeviceProcAddr));
  // Without an instance only the functions that make one are to be had.
  if (!instance && std::strcmp(name, "vkEnumerateInstanceVersion") != 0) return nullptr;
  return find(name, false);
}

}  // namespace

std::byte* bytesOf(const Object* buffer, VkDeviceSize offset) {
  if (!buffer || !buffer->memory || !buffer->memory->bytes) return nullptr;
  return static_cast<std::byte*>(buffer->memory->bytes) + buffer->memory_offset + offset;
}

const char* kindName(Kind kind) {
  static const char* const names[] = {
      "instance",   "physical device", "device",         "command buffer", "buffer",        "image",
      "image view", "sampler",         "memory",         "shader module",  "set layout",    "pipeline layout",
      "pipeline",   "descriptor pool", "descriptor set", "query pool",     "pipeline cache"};
  return names[static_cast<int>(kind)];
}

Claims::Claims() {
  std::strcpy(properties.deviceName, "mock");
  properties.apiVersion = VK_API_VERSION_1_3;
  properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
  VkPhysicalDeviceLimits& limits = properties.limits;
  limits.maxImageDimension2D = 16384;
  limits.maxFramebufferWidth = limits.maxFramebufferHeight = 16384;
  limits.maxStorageBufferRange = 1u << 27;  // 128 MiB, lavapipe's and the least the specification allows
  limits.maxUniformBufferRange = 65536;
  limits.maxPushConstantsSize = 128;
  limits.maxMemoryAllocationCount = 4096;
  limits.bufferImageGranularity = 64;
  limits.maxBoundDescriptorSets = 4;
  limits.maxPerStageDescriptorStorageBuffers = limits.maxPerStageDescriptorSampledImages = 16;
  limits.maxPerStageDescriptorStorageImages = limits.maxPerStageDescriptorUniformBuffers = 8;
  limits.maxPerStageResources = 128;
  limits.maxComputeSharedMemorySize = 32768;
  limits.maxComputeWorkGroupInvocations = 1024;
  for (int i = 0; i < 3; ++i) {
    limits.maxComputeWorkGroupCount[i] = 65535;
    limits.maxComputeWorkGroupSize[i] = i < 2 ? 1024 : 64;
  }
  limits.minStorageBufferOffsetAlignment = limits.minUniformBufferOffsetAlignment = 64;
  limits.minMemoryMapAlignment = 64;
  limits.nonCoherentAtomSize = 64;
  limits.timestampComputeAndGraphics = VK_TRUE;
  limits.timestampPeriod = 1.0f;
  limits.maxViewportDimensions[0] = limits.maxViewportDimensions[1] = 16384;
  properties11.subgroupSize = 32;
  properties11.subgroupSupportedStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  properties11.subgroupSupportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
  features.fragmentStoresAndAtomics = VK_TRUE;
  features12.scalarBlockLayout = VK_TRUE;
  features12.bufferDeviceAddress = VK_TRUE;
  features13.dynamicRendering = VK_TRUE;
  features13.synchronization2 = VK_TRUE;
  queue_families = {{VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT, 1, 64, {1, 1, 1}},
                    {VK_QUEUE_TRANSFER_BIT, 1, 0, {1, 1, 1}}};
  memory.memoryHeapCount = 2;
  memory.memoryHeaps[0] = {VkDeviceSize{8} << 30, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
  memory.memoryHeaps[1] = {VkDeviceSize{16} << 30, 0};
  memory.memoryTypeCount = 3;
  memory.memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
  memory.memoryTypes[1] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, 1};
  memory.memoryTypes[2] = {VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT |
                               VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 1};
}

Driver::Driver() {
  if (the_driver) std::abort();
  the_driver = this;
  const auto ofHost = [this](Kind kind) {
    Object* object = make(kind);
    object->of_host = true;
    return object;
  };
  instance = handleOf<VkInstance>(ofHost(Kind::Instance));
  physical_device = handleOf<VkPhysicalDevice>(ofHost(Kind::PhysicalDevice));
  device = handleOf<VkDevice>(ofHost(Kind::Device));
  command_buffer = handleOf<VkCommandBuffer>(ofHost(Kind::CommandBuffer));
}

Driver::~Driver() {
  for (const auto& object : objects_) std::free(object->bytes);
  the_driver = nullptr;
}

Driver& Driver::current() {
  if (!the_driver) std::abort();
  return *the_driver;
}

PFN_vkGetInstanceProcAddr Driver::getInstanceProcAddr() { return GetInstanceProcAddr; }

VkImage Driver::hostImage(VkImageView* view, VkImageUsageFlags usage) {
  Object* image = make(Kind::Image);
  Object* image_view = make(Kind::ImageView);
  image->of_host = image_view->of_host = true;
  image->usage = image_view->usage = usage;
  image_view->uses = {image};
  *view = handleOf<VkImageView>(image_view);
  return handleOf<VkImage>(image);
}

VkDeviceAddress Driver::hostBuffer(VkDeviceSize size) {
  Object* buffer = make(Kind::Buffer);
  buffer->of_host = true;
  buffer->size = size;
  return giveAddress(buffer);
}

size_t Driver::alive(Kind kind) const {
  return static_cast<size_t>(std::count_if(objects_.begin(), objects_.end(), [&](const auto& object) {
    return object->alive && !object->of_host && object->kind == kind;
  }));
}

std::string Driver::leaks() const {
  std::map<std::string, int> counts;
  for (const auto& object : objects_)
    if (object->alive && !object->of_host) ++counts[kindName(object->kind)];
  std::string text;
  for (const auto& [name, count] : counts) text += std::to_string(count) + " x " + name + "; ";
  return text;
}

VkDeviceSize Driver::bytesAllocated() const {
  VkDeviceSize bytes = 0;
  for (const auto& object : objects_)
    if (object->alive && object->kind == Kind::Memory) bytes += object->size;
  return bytes;
}

VkDeviceSize Driver::bytesOfResources() const {
  VkDeviceSize bytes = 0;
  for (const auto& object : objects_)
    if (object->alive && !object->of_host && (object->kind == Kind::Buffer || object->kind == Kind::Image)) bytes += object->size;
  return bytes;
}

uint64_t Driver::calledOutsideRecording() const {
  uint64_t count = 0;
  for (const auto& [name, times] : calls)
    if (name.rfind("vkCmd", 0) != 0) count += times;
  return count;
}

std::vector<std::string> Driver::commandNames() const {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return names;
}

size_t Driver::countCommands(const std::string& name) const {
  return static_cast<size_t>(
      std::count_if(commands.begin(), commands.end(), [&](const Command& command) { return command.name == name; }));
}

uint32_t* Driver::latestReadBack() const {
  for (auto command = commands.rbegin(); command != commands.rend(); ++command) {
    if (command->name != "vkCmdCopyBuffer" || command->objects.size() != 2 || command->numbers.size() < 3) continue;
    const Object* target = command->objects[1];
    const VkFlags flags = target->memory ? claims.memory.memoryTypes[target->memory->memory_type].propertyFlags : 0;
    if (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)
      return reinterpret_cast<uint32_t*>(bytesOf(target, command->numbers[1]));
  }
  return nullptr;
}

Object* Driver::make(Kind kind) {
  objects_.push_back(std::make_unique<Object>());
  objects_.back()->kind = kind;
  addresses_.insert(objects_.back().get());
  return objects_.back().get();
}

Object* Driver::known(const void* handle, Kind kind, const char* by) {
  if (!addresses_.count(handle)) {
    breach(std::string(by) + ": " + (handle ? "an unknown handle" : "VK_NULL_HANDLE") + " where a " + kindName(kind) +
           " belongs");
    return nullptr;
  }
  auto* object = static_cast<Object*>(const_cast<void*>(handle));
  if (object->kind != kind) {
    breach(std::string(by) + ": a " + kindName(object->kind) + " where a " + kindName(kind) + " belongs");
    return nullptr;
  }
  if (!object->alive) {
    breach(std::string(by) + ": a " + kindName(kind) + " that was destroyed");
    return nullptr;
  }
  return object;
}

void Driver::enter(const char* name) {
  ++calls[name];
  if (recording_only && std::strncmp(name, "vkCmd", 5) != 0) breach(std::string(name) + " while recording");
}

bool Driver::refuse(const char* name, VkResult* result) {
  if (++fallible_calls != fail_at) return false;
  failed_call = name;
  *result = failure;
  return true;
}

void Driver::checkDevice(VkDevice handle, const char* by) {
  enter(by);
  if (handle != device) breach(std::string(by) + ": not the host's device");
}

// What an object uses is used with it: views their image, resources their memory.
void Driver::use(Object* object) {
  if (!object) return;
  if (!object->alive) breach(std::string("a ") + kindName(object->kind) + " is used after it was destroyed");
  object->last_frame = std::max(object->last_frame, frame);
  if (object->memory) use(object->memory);
  for (Object* part : object->uses) use(part);
}

VkDeviceAddress Driver::giveAddress(Object* buffer) {
  if (buffer->address == 0) {
    buffer->address = next_address_;
    device_addresses_[buffer->address] = buffer;
    next_address_ += (buffer->size + 511) / 256 * 256;  // with a gap behind it
  }
  return buffer->address;
}

void Driver::useAddresses(const void* data, size_t size) {
  for (size_t at = 0; at + sizeof(VkDeviceAddress) <= size; at += sizeof(uint32_t)) {
    VkDeviceAddress word;
    std::memcpy(&word, static_cast<const std::byte*>(data) + at, sizeof word);
    const auto after = device_addresses_.upper_bound(word);
    if (after == device_addresses_.begin()) continue;
    const auto& [address, buffer] = *std::prev(after);
    if (word - address < buffer->size) use(buffer);
  }
}

// A queue without graphics has no stage of the rasteriser.
void Driver::checkStages(VkPipelineStageFlags2 stages, const char* by) {
  constexpr VkPipelineStageFlags2 kEvery = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT |
                                           VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT |
                                           VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
  if (!(queue_flags & VK_QUEUE_GRAPHICS_BIT) && (stages & ~kEvery))
    breach(std::string(by) + ": a stage of graphics on a queue without them");
}

void Driver::beginCommandBuffer() {
  inside_rendering = false;
  for (int point = 0; point < 2; ++point) {
    bound_pipelines[point] = nullptr;
    bound_sets[point].clear();
  }
}

void Driver::dropSet(Object* pool, Object* set, const char* by) {
  if (!set->alive) return;
  if (busy(set)) breach(std::string(by) + ": a descriptor set of a frame in flight");
  for (const VkDescriptorSetLayoutBinding& binding : set->layout)
    pool->room[binding.descriptorType] += binding.descriptorCount;
  ++pool->sets_left;
  set->alive = false;
}

void Driver::destroy(const void* handle, Kind kind, const char* by) {
  if (!handle) return;  // allowed by every vkDestroy... and vkFree...
  Object* object = known(handle, kind, by);
  if (!object) return;
  if (object->of_host) breach(std::string(by) + ": the host's");
  if (busy(object)) breach(std::string(by) + ": frame " + std::to_string(object->last_frame) + " in flight uses it");
  object->alive = false;
  if (kind == Kind::DescriptorPool)
    for (Object* set : object->uses) dropSet(object, set, by);
  if (kind == Kind::Memory) {
    std::free(object->bytes);
    object->bytes = nullptr;
  }
}

Command& Driver::record(VkCommandBuffer cmd, const char* name, bool wanted_inside, bool allowed_both) {
  enter(name);
  if (cmd != command_buffer) breach(std::string(name) + ": not the host's command buffer");
  if (!allowed_both && wanted_inside != inside_rendering)
    breach(std::string(name) + (inside_rendering ? ": inside rendering" : ": outside rendering"));
  commands.emplace_back();
  commands.back().name = name;
  return commands.back();
}

}  // namespace mock
