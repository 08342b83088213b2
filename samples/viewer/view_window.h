// A window with a swapchain and Dear ImGui in it, on a device that Forelock shares. SPDX-License-Identifier: MIT
#pragma once

#include "gpu_resources.h"
#include "view_gpu.h"
#include "view_input.h"

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

struct GLFWwindow;

namespace forelock::samples {

// The device or its surface is gone: all that was made on it must be made again.
struct DeviceLost : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The window itself: GLFW. Outlives a lost device.
class ViewWindow {
public:
  // Throws std::runtime_error with a sentence: no display, no Vulkan surface.
  ViewWindow(int width, int height, const std::string& title);
  ~ViewWindow();
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;

  GLFWwindow* handle() const { return window_; }
  bool wantsToClose() const;
  bool hidden() const;                         // minimised, or no pixels large
  void framebufferSize(int& width, int& height) const;
  float contentScale() const;                  // of text and widgets: 1 at 96 dpi
  void setTitle(const std::string& title);
  void resize(int width, int height);
  std::vector<std::string> takeDropped();      // paths that were dragged in since the last call
  bool droppedWithShift() const { return dropped_with_shift_; }  // the last of them
  void setClipboard(const std::string& text);
  ViewInput& input() { return input_; }

  // Handles what has come in; waits for something up to `wait_s`.
  static void poll(double wait_s);
  static void wake();  // ends the wait; any thread

private:
  static void onDrop(GLFWwindow* window, int count, const char** paths);
  GLFWwindow* window_ = nullptr;
  std::vector<std::string> dropped_;
  bool dropped_with_shift_ = false;
  ViewInput input_;
  std::string title_;
};

// What is drawn into it: device, swapchain, Dear ImGui's objects. Frames are drawn one after the other, each waited for.
class ViewScreen {
public:
  struct Options {
    bool validation = false, vsync = true;
    std::string device_name;
    float ui_scale = 1.0f;
  };
  // Throws std::runtime_error. Null with the reason in `error` when there is no usable device.
  static std::unique_ptr<ViewScreen> create(ViewWindow& window, const Options& options, std::string& error);
  ~ViewScreen();
  ViewScreen(const ViewScreen&) = delete;
  ViewScreen& operator=(const ViewScreen&) = delete;

  HeadlessHost& host() { return *host_; }
  const ViewGpu& gpu() const { return gpu_; }
  VkRenderPass renderPass() const { return render_pass_; }
  // Fonts and widgets of another size; between frames.
  void setUiScale(float scale);
  void setVsync(bool vsync);
  void beginUi();  // a new frame of Dear ImGui

  // Draws Dear ImGui's frame over what `display` draws, after what `before` records outside the render pass; waits and presents. False:
  // nothing was drawn, because the window has no pixels or is hidden; what `before` would have recorded is then still to be done.
  // Throws DeviceLost.
  bool draw(const std::function<void(VkCommandBuffer)>& before, const std::function<void(VkCommandBuffer)>& display);

  // The next frame that is drawn is written to this picture file too, with panels and all. Throws, from draw, std::runtime_error.
  void capture(const std::string& path) { capture_path_ = path; }

private:
  ViewScreen() = default;
  void recordCapture(uint32_t index);
  void writeCapture();
  void makeSurface();
  bool makeSwapchain();
  void dropSwapchain();
  void makeUi(float scale);
  void uploadFonts();
  void check(VkResult result, const char* what) const;

  ViewWindow* window_ = nullptr;
  std::unique_ptr<HeadlessHost> host_;
  ViewGpu gpu_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  uint32_t width_ = 0, height_ = 0;
  std::vector<VkImageView> views_;
  std::vector<VkFramebuffer> framebuffers_;
  std::vector<VkSemaphore> drawn_;  // an image each
  VkSemaphore acquired_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer cmd_ = VK_NULL_HANDLE;
  VkRenderPass render_pass_ = VK_NULL_HANDLE;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  std::string capture_path_;
  GpuBuffer captured_;
  bool vsync_ = true, ui_ = false, stale_ = false, can_capture_ = false;
};

}  // namespace forelock::samples
