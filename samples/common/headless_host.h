// A host engine without a window of its own: instance, device, one queue, a colour and a depth image; draws frames and reads them back.
// What the command, the study and the GPU tests render with. The Vulkan loader is opened at run time, so that programs start
// where there is none.
#pragma once

#include "forelock/render.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace forelock::samples {

class GpuResources;
struct GpuImage;

struct HeadlessOptions {
  bool validation = false;   // core and synchronization validation; messages are collected
  std::string device_name;   // part of the device's name; empty: a discrete GPU, else any other, else a CPU device
  bool compute_queue = false;// a queue family without graphics, where the device has one
  // For a program with a window: what its surface and swapchain need, and which queue families may present.
  std::vector<const char*> instance_extensions, device_extensions;
  std::function<bool(VkInstance, VkPhysicalDevice, uint32_t family)> can_present;
};

class HeadlessHost {
public:
  // Null with the reason in `error`.
  static std::unique_ptr<HeadlessHost> create(const HeadlessOptions& options, std::string& error);
  ~HeadlessHost();
  HeadlessHost(const HeadlessHost&) = delete;
  HeadlessHost& operator=(const HeadlessHost&) = delete;

  const std::string& deviceName() const;
  const std::string& driverName() const;
  VkPhysicalDeviceType deviceType() const;
  FlkContext context() const;
  // For work of the caller's own on the same device.
  struct Device {
    PFN_vkGetInstanceProcAddr get_instance_proc_addr;
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    uint32_t queue_family;
  };
  Device device() const;
  const GpuResources& resources() const;
  // What the validation layers and Forelock's message callback have said.
  std::vector<std::string>& validationMessages();
  std::vector<std::string>& messages();

  // Images for frames of this size; forgets background and depth where it changes. False: no device memory.
  bool resize(uint32_t width, uint32_t height);
  // What hair is drawn over: width x height x RGBA, linear, premultiplied; empty: transparent black.
  void setBackground(std::vector<float> rgba);
  // The opaque scene's depth buffer values; empty: no depth source.
  void setDepth(std::vector<float> values);

  // Creates a hair and uploads it, waiting.
  FlkResult createHair(const FlkHairDesc& desc, FlkHair* hair);

  // What a program draws around the hair in the same submission, and what of it the frame is to know: `fill` may change the frame after
  // this host has filled it in, `before` and `after` record on both sides of flkCmdRender. Each may be empty.
  struct Around {
    std::function<void(FlkFrame&)> fill;
    std::function<void(VkCommandBuffer)> before, after;
  };

  // Fills in target, depth, frame_number and completed_frame, plans, records, submits and waits. The plan stays valid until
  // the view has made frames_in_flight more.
  FlkResult render(FlkView view, FlkFrame& frame, FlkPlan* plan = nullptr, const Around& around = {});
  // Several frames of one view in one submission, none completed when the next is planned; depth.layout kNoDepth leaves the
  // depth source out of a frame. What stays in the target is the last.
  FlkResult renderTogether(FlkView view, std::span<FlkFrame> frames, FlkPlan* last = nullptr, const Around& around = {});
  static constexpr VkImageLayout kNoDepth = VK_IMAGE_LAYOUT_MAX_ENUM;
  FlkResult statistics(FlkView view, FlkStatistics& statistics) const;

  std::vector<float> readColor();                               // width x height x RGBA
  std::vector<float> readShadowMap(const FlkShadowMap& map);    // size x size
  // The first layer of an image of the caller's, of RGBA16F or D32 with TRANSFER_SRC usage, that the last submission left in `layout` and
  // that stays in it. Empty: no memory, or the device is lost.
  std::vector<float> readImage(const GpuImage& image, VkImageLayout layout);

  // Pictures besides the colour for the frames that follow, cleared to -1 before each: bits 1 << FLK_OUTPUT_...
  void setOutputs(uint32_t mask);
  std::vector<float> readOutput(uint32_t output);               // width x height x 1 or 2

  // What a host gives the SDK to read; lives until freeUploads().
  FlkSampledImage uploadArray(uint32_t width, uint32_t height, uint32_t layers, std::span<const float> values);
  VkDeviceAddress uploadBuffer(std::span<const std::byte> bytes);
  void freeUploads();
  bool queueHasGraphics() const;

  // Records with `record`, submits, waits. False: the device is lost.
  bool submit(const std::function<void(VkCommandBuffer)>& record);

private:
  HeadlessHost();
  void fillFrame(FlkFrame& frame) const;
  bool uploadDepth();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forelock::samples
