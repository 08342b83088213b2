// A Vulkan driver that draws nothing: it counts, checks and records. The SDK reaches it through getInstanceProcAddr(),
// as it reaches a real one. What it is for: nothing leaks and nothing goes while a frame in flight uses it, every call
// that can fail may be made to fail, and what flkCmdRender recorded can be compared with the plan.
//
// Memory is real (malloc), so mapping works; copies, fills and updates of buffers are carried out when they are
// recorded; draws and dispatches do nothing, but what their shaders declare must be bound and alive. Functions that the
// SDK must never use (submit, wait, queues, command pools) are breaches already when they are asked for. One driver
// exists at a time.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

namespace mock {

enum class Kind {
  Instance, PhysicalDevice, Device, CommandBuffer, Buffer, Image, ImageView, Sampler, Memory, ShaderModule, SetLayout,
  PipelineLayout, Pipeline, DescriptorPool, DescriptorSet, QueryPool, PipelineCache
};
const char* kindName(Kind kind);

// Every handle points to one of these; it stays after its destruction, so that a second one is seen.
struct Object {
  Kind kind = Kind::Buffer;
  bool alive = true;
  bool of_host = false;             // made by the test, not by the SDK
  uint64_t last_frame = 0;          // the latest frame that recorded a use of it
  VkDeviceSize size = 0;            // buffer, image, memory
  VkFlags usage = 0;                // buffer, image, image view; pool: its flags
  VkFormat format = VK_FORMAT_UNDEFINED;  // image, image view
  bool mutable_format = false;      // image
  VkDeviceAddress address = 0;      // buffer, once it was asked for
  Object* memory = nullptr;         // buffer, image: what it is bound to
  VkDeviceSize memory_offset = 0;
  uint32_t memory_type = 0;         // memory
  void* bytes = nullptr;            // memory
  bool addressable = false;         // memory: made with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT
  bool mapped = false;              // memory
  std::vector<Object*> uses;        // image view: its image; pool: its sets; pipeline: its layout
  std::map<std::pair<uint32_t, uint32_t>, Object*> bindings; // descriptor set: (binding, element) -> resource
  std::map<VkDescriptorType, uint32_t> room;                 // descriptor pool: descriptors left
  uint32_t sets_left = 0;
  std::vector<VkDescriptorSetLayoutBinding> layout;          // set layout; descriptor set: its layout
  VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_GRAPHICS;
  std::set<std::pair<uint32_t, uint32_t>> reads;             // shader module, pipeline: (set, binding) of its interface
  std::vector<int> query_states;                             // 0 never reset, 1 reset, 2 written
  std::vector<uint64_t> query_values;
};

struct Command {
  std::string name;              // "vkCmdDraw"
  std::vector<Object*> objects;  // what it names, in the order of its arguments
  std::vector<uint64_t> numbers; // counts and groups
  VkPipelineStageFlags2 stages = 0;  // that a barrier or a timestamp names
  std::vector<VkImageMemoryBarrier2> image_barriers;
  uint32_t buffer_barriers = 0;  // of buffers and of memory as a whole
};

// What the device claims to be. The defaults meet every requirement; a test changes one of them.
struct Claims {
  uint32_t instance_version = VK_API_VERSION_1_3;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceVulkan11Properties properties11{};
  VkPhysicalDeviceFeatures features{};
  VkPhysicalDeviceVulkan12Features features12{};
  VkPhysicalDeviceVulkan13Features features13{};
  VkPhysicalDeviceMemoryProperties memory{};
  std::vector<VkQueueFamilyProperties> queue_families;
  std::map<VkFormat, VkFormatFeatureFlags> formats; // instead of the default of its kind (colour, depth)
  std::set<std::string> missing_functions;          // answered with NULL
  Claims();
};

class Driver {
public:
  Driver();
  ~Driver();
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;
  static PFN_vkGetInstanceProcAddr getInstanceProcAddr();

  Claims claims;
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  VkCommandBuffer command_buffer;

  // Images of the host: never destroyed by the SDK, or it is a breach. `usage`: what they may be bound as.
  VkImage hostImage(VkImageView* view, VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
  // A buffer of the host that shaders reach by the address that comes back.
  VkDeviceAddress hostBuffer(VkDeviceSize size);

  // The call that fails, counted from 1 over all calls that can; 0: none. `failed_call` names it afterwards.
  uint64_t fail_at = 0;
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  uint64_t fallible_calls = 0;
  std::string failed_call;

  // Frames: uses are recorded for `frame`; what is used by a frame after `completed` may not be destroyed or rewritten.
  uint64_t frame = 0;
  uint64_t completed = 0;
  // While set, every call but vkCmd... is a breach.
  bool recording_only = false;

  std::vector<Command> commands;                 // in order of recording; a test clears it
  std::vector<std::string> breaches;             // what must never happen, in words
  std::map<std::string, uint64_t> calls;         // by name
  std::set<std::string> asked_for;               // names given to vkGet...ProcAddr

  size_t alive(Kind kind) const;                 // objects of the SDK
  std::string leaks() const;                     // objects of the SDK that are alive, in words; empty: none
  VkDeviceSize bytesAllocated() const;
  VkDeviceSize bytesOfResources() const;         // of the SDK's buffers and images, as asked for
  uint64_t calledOutsideRecording() const;       // calls so far that were not vkCmd...

  std::vector<std::string> commandNames() const;
  size_t countCommands(const std::string& name) const;
  // Where the latest recorded copy into memory that the host can read has gone; NULL: there was none.
  uint32_t* latestReadBack() const;

  // For the functions of the driver.
  static Driver& current();
  Object* make(Kind kind);
  Object* known(const void* handle, Kind kind, const char* by);
  void breach(std::string text) { breaches.push_back(std::move(text)); }
  bool refuse(const char* name, VkResult* result);
  void enter(const char* name);
  void checkDevice(VkDevice handle, const char* by);
  void use(Object* object);
  // Buffers that words given to shaders point into: used as if they were bound. Addresses are never given twice.
  void useAddresses(const void* data, size_t size);
  VkDeviceAddress giveAddress(Object* buffer);
  bool busy(const Object* object) const { return object->last_frame > completed; }
  void destroy(const void* handle, Kind kind, const char* by);
  void dropSet(Object* pool, Object* set, const char* by);
  Command& record(VkCommandBuffer cmd, const char* name, bool wanted_inside, bool allowed_both = false);

  // Of the latest pipeline layout.
  uint32_t push_bytes = 0;
  VkShaderStageFlags push_stages = 0;

  // State of the command buffer, by bind point (graphics, compute).
  bool inside_rendering = false;
  // The family that the command buffer is for; what it does not offer may not be recorded.
  VkQueueFlags queue_flags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  void checkStages(VkPipelineStageFlags2 stages, const char* by);
  Object* bound_pipelines[2] = {nullptr, nullptr};
  std::map<uint32_t, Object*> bound_sets[2];
  void beginCommandBuffer();  // as vkBeginCommandBuffer: nothing is bound

private:
  std::vector<std::unique_ptr<Object>> objects_;
  std::unordered_set<const void*> addresses_;
  std::map<VkDeviceAddress, Object*> device_addresses_;
  VkDeviceAddress next_address_ = 0x5EED00000000;  // whose upper word is no number that shaders are given
};

// Where a buffer's bytes are; NULL: it has no memory.
std::byte* bytesOf(const Object* buffer, VkDeviceSize offset);

using FunctionTable = std::map<std::string, PFN_vkVoidFunction>;
const FunctionTable& deviceFunctions();   // mock_device.cpp
const FunctionTable& commandFunctions();  // mock_commands.cpp

// Handles are pointers to objects.
template <class Handle> Handle handleOf(Object* object) { return reinterpret_cast<Handle>(object); }

}  // namespace mock
