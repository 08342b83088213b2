// SPDX-License-Identifier: MIT
#include "view_window.h"

#include "picture_file.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

extern "C" {
// Of glfw3.h where Vulkan's prototypes are included before it; declared here because this program has none.
VkResult glfwCreateWindowSurface(VkInstance instance, GLFWwindow* window, const VkAllocationCallbacks* allocator, VkSurfaceKHR* surface);
int glfwGetPhysicalDevicePresentationSupport(VkInstance instance, VkPhysicalDevice device, uint32_t family);
}

namespace forelock::samples {

namespace {

constexpr const char* kFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // of fonts-dejavu-core; else Dear ImGui's own
constexpr uint64_t kAcquireNs = 500'000'000;  // a hidden window may never give an image: look for input again after this

std::string glfwReason() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

template <class T>
T tagged(VkStructureType type) {
  T info{};
  info.sType = type;
  return info;
}

// Room around and inside widgets, less dense than the default, and a ground that does not compete with hair.
void styleUi(float scale) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.WindowBorderSize = 0.0f;
  style.ItemSpacing = ImVec2(7.0f, 5.0f);
  style.Colors[ImGuiCol_WindowBg] = ImVec4(0.086f, 0.094f, 0.106f, 1.0f);
  style.Colors[ImGuiCol_PopupBg] = ImVec4(0.11f, 0.12f, 0.135f, 0.98f);
  style.Colors[ImGuiCol_MenuBarBg] = ImVec4(0.11f, 0.12f, 0.135f, 1.0f);
  style.Colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0.0f, 0.0f, 0.0f, 0.5f);
  style.Colors[ImGuiCol_TextDisabled] = ImVec4(0.64f, 0.65f, 0.67f, 1.0f);
  style.Colors[ImGuiCol_SliderGrab].w = 0.45f;  // the number below it is read
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace

// ---- The window ----

ViewWindow::ViewWindow(int width, int height, const std::string& title) : title_(title) {
  if (!glfwInit()) {
    throw std::runtime_error("no window can be opened (" + glfwReason() + "): is there a display? Over ssh use `ssh -X`, without a screen "
                             "`xvfb-run`, or draw pictures with `forelock preview`");
  }
  if (!glfwVulkanSupported()) {
    const std::string why = glfwReason();
    glfwTerminate();
    throw std::runtime_error("Vulkan cannot draw to this display (" + why + ")");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (!window_) {
    const std::string why = glfwReason();
    glfwTerminate();
    throw std::runtime_error("no window can be opened (" + why + ")");
  }
  glfwSetWindowSizeLimits(window_, 560, 400, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSetWindowUserPointer(window_, this);
  glfwSetDropCallback(window_, onDrop);
}

ViewWindow::~ViewWindow() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void ViewWindow::onDrop(GLFWwindow* window, int count, const char** paths) {
  auto* self = static_cast<ViewWindow*>(glfwGetWindowUserPointer(window));
  self->dropped_with_shift_ = ImGui::GetIO().KeyShift || shiftHeld();
  self->dropped_.insert(self->dropped_.end(), paths, paths + count);
}

bool ViewWindow::wantsToClose() const { return glfwWindowShouldClose(window_) != 0; }

bool ViewWindow::hidden() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return width <= 0 || height <= 0 || glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
}

void ViewWindow::framebufferSize(int& width, int& height) const { glfwGetFramebufferSize(window_, &width, &height); }

float ViewWindow::contentScale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  int window_width = 0, window_height = 0, width = 0, height = 0;
  glfwGetWindowSize(window_, &window_width, &window_height);
  glfwGetFramebufferSize(window_, &width, &height);
  // Where a window is measured in points, Dear ImGui scales by itself what is drawn.
  const float points = window_width > 0 ? static_cast<float>(width) / static_cast<float>(window_width) : 1.0f;
  return std::clamp(std::max(x, y) / std::max(points, 1.0f), 0.5f, 4.0f);
}

void ViewWindow::setTitle(const std::string& title) {
  if (title != title_) {
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
  }
}

void ViewWindow::resize(int width, int height) { glfwSetWindowSize(window_, width, height); }
std::vector<std::string> ViewWindow::takeDropped() { return std::exchange(dropped_, {}); }

void ViewWindow::setClipboard(const std::string& text) { glfwSetClipboardString(window_, text.c_str()); }

void ViewWindow::poll(double wait_s) {
  if (wait_s > 0.0) {
    glfwWaitEventsTimeout(wait_s);
  } else {
    glfwPollEvents();
  }
}

void ViewWindow::wake() { glfwPostEmptyEvent(); }

// ---- The screen ----

std::unique_ptr<ViewScreen> ViewScreen::create(ViewWindow& window, const Options& options, std::string& error) {
  HeadlessOptions wanted;
  wanted.validation = options.validation;
  wanted.device_name = options.device_name;
  uint32_t count = 0;
  const char** extensions = glfwGetRequiredInstanceExtensions(&count);
  wanted.instance_extensions.assign(extensions, extensions + count);
  wanted.device_extensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  wanted.can_present = [](VkInstance instance, VkPhysicalDevice device, uint32_t family) {
    return glfwGetPhysicalDevicePresentationSupport(instance, device, family) != 0;
  };
  std::unique_ptr<ViewScreen> screen(new ViewScreen);
  screen->window_ = &window;
  screen->vsync_ = options.vsync;
  screen->host_ = HeadlessHost::create(wanted, error);
  if (!screen->host_) {
    return nullptr;
  }
  const ViewGpu& gpu = screen->gpu_;
  screen->gpu_.load(*screen->host_);
  auto pool = tagged<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool.queueFamilyIndex = gpu.shared.queue_family;
  screen->check(gpu.vkCreateCommandPool(gpu.device, &pool, nullptr, &screen->pool_), "making a command pool");
  auto allocate = tagged<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  allocate.commandPool = screen->pool_;
  allocate.commandBufferCount = 1;
  screen->check(gpu.vkAllocateCommandBuffers(gpu.device, &allocate, &screen->cmd_), "making a command buffer");
  const auto semaphore = tagged<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
  screen->check(gpu.vkCreateSemaphore(gpu.device, &semaphore, nullptr, &screen->acquired_), "making a semaphore");
  const auto fence = tagged<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  screen->check(gpu.vkCreateFence(gpu.device, &fence, nullptr, &screen->fence_), "making a fence");
  screen->makeSurface();
  screen->makeUi(options.ui_scale);
  screen->makeSwapchain();
  return screen;
}

ViewScreen::~ViewScreen() {
  if (!host_) {
    return;
  }
  gpu_.vkDeviceWaitIdle(gpu_.device);
  if (ui_) {
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
  }
  host_->resources().destroy(captured_);
  dropSwapchain();
  gpu_.vkDestroyRenderPass(gpu_.device, render_pass_, nullptr);
  gpu_.vkDestroyDescriptorPool(gpu_.device, descriptors_, nullptr);
  gpu_.vkDestroySemaphore(gpu_.device, acquired_, nullptr);
  gpu_.vkDestroyFence(gpu_.device, fence_, nullptr);
  gpu_.vkDestroyCommandPool(gpu_.device, pool_, nullptr);
  const auto destroy = reinterpret_cast<PFN_vkDestroySurfaceKHR>(gpu_.shared.get_instance_proc_addr(gpu_.shared.instance, "vkDestroySurfaceKHR"));
  destroy(gpu_.shared.instance, surface_, nullptr);
}

void ViewScreen::check(VkResult result, const char* what) const {
  if (result == VK_ERROR_DEVICE_LOST || result == VK_ERROR_SURFACE_LOST_KHR) {
    throw DeviceLost(std::string(what) + ": the " + (result == VK_ERROR_DEVICE_LOST ? "device" : "surface") + " was lost");
  }
  if (result != VK_SUCCESS) {
    throw std::runtime_error(std::string(what) + " failed (VkResult " + std::to_string(result) + ")");
  }
}

void ViewScreen::makeSurface() {
  check(glfwCreateWindowSurface(gpu_.shared.instance, window_->handle(), nullptr, &surface_), "making a surface");
  const auto get = [&](const char* name) { return gpu_.shared.get_instance_proc_addr(gpu_.shared.instance, name); };
  const auto supports = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceSupportKHR>(get("vkGetPhysicalDeviceSurfaceSupportKHR"));
  VkBool32 supported = VK_FALSE;
  check(supports(gpu_.shared.physical_device, gpu_.shared.queue_family, surface_, &supported), "asking the surface");
  if (!supported) {
    throw std::runtime_error(host_->deviceName() + " cannot draw to this window");
  }
  const auto formats = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceFormatsKHR>(get("vkGetPhysicalDeviceSurfaceFormatsKHR"));
  uint32_t count = 0;
  check(formats(gpu_.shared.physical_device, surface_, &count, nullptr), "asking the surface");
  std::vector<VkSurfaceFormatKHR> found(count);
  check(formats(gpu_.shared.physical_device, surface_, &count, found.data()), "asking the surface");
  // Pictures and widgets are sRGB-coded by who draws them, so a format that does not code again.
  format_ = VK_FORMAT_UNDEFINED;
  for (const VkSurfaceFormatKHR& f : found) {
    if ((f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM) && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
      format_ = f.format;
      break;
    }
  }
  if (format_ == VK_FORMAT_UNDEFINED) {
    throw std::runtime_error("the window has no format of 8 bits a channel without sRGB coding, which the viewer draws to");
  }
  VkAttachmentDescription attachment{};
  attachment.format = format_;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  attachment.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference reference{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass{};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  VkSubpassDependency dependency{};
  dependency.srcSubpass = VK_SUBPASS_EXTERNAL;
  dependency.srcStageMask = dependency.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  dependency.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
  auto pass = tagged<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  pass.attachmentCount = 1;
  pass.pAttachments = &attachment;
  pass.subpassCount = 1;
  pass.pSubpasses = &subpass;
  pass.dependencyCount = 1;
  pass.pDependencies = &dependency;
  check(gpu_.vkCreateRenderPass(gpu_.device, &pass, nullptr, &render_pass_), "making a render pass");
}

void ViewScreen::dropSwapchain() {
  for (const VkFramebuffer framebuffer : framebuffers_) {
    gpu_.vkDestroyFramebuffer(gpu_.device, framebuffer, nullptr);
  }
  for (const VkImageView view : views_) {
    gpu_.vkDestroyImageView(gpu_.device, view, nullptr);
  }
  for (const VkSemaphore semaphore : drawn_) {
    gpu_.vkDestroySemaphore(gpu_.device, semaphore, nullptr);
  }
  framebuffers_.clear(), views_.clear(), drawn_.clear();
  if (swapchain_) {
    gpu_.vkDestroySwapchainKHR(gpu_.device, swapchain_, nullptr);
  }
  swapchain_ = VK_NULL_HANDLE;
}

// False: the window has no pixels now.
bool ViewScreen::makeSwapchain() {
  gpu_.vkDeviceWaitIdle(gpu_.device);
  dropSwapchain();
  stale_ = false;
  const auto get = [&](const char* name) { return gpu_.shared.get_instance_proc_addr(gpu_.shared.instance, name); };
  VkSurfaceCapabilitiesKHR able{};
  check(reinterpret_cast<PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR>(get("vkGetPhysicalDeviceSurfaceCapabilitiesKHR"))(
            gpu_.shared.physical_device, surface_, &able), "asking the surface");
  int width = 0, height = 0;
  window_->framebufferSize(width, height);
  VkExtent2D extent = able.currentExtent;
  if (extent.width == UINT32_MAX) {
    extent.width = std::clamp(static_cast<uint32_t>(std::max(width, 0)), able.minImageExtent.width, able.maxImageExtent.width);
    extent.height = std::clamp(static_cast<uint32_t>(std::max(height, 0)), able.minImageExtent.height, able.maxImageExtent.height);
  }
  if (extent.width == 0 || extent.height == 0 || width <= 0 || height <= 0) {
    return false;
  }
  const auto ask_modes = reinterpret_cast<PFN_vkGetPhysicalDeviceSurfacePresentModesKHR>(get("vkGetPhysicalDeviceSurfacePresentModesKHR"));
  uint32_t count = 0;
  check(ask_modes(gpu_.shared.physical_device, surface_, &count, nullptr), "asking the surface");
  std::vector<VkPresentModeKHR> modes(count);
  check(ask_modes(gpu_.shared.physical_device, surface_, &count, modes.data()), "asking the surface");
  auto info = tagged<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = surface_;
  info.minImageCount = std::max(able.minImageCount, 2u);
  if (able.maxImageCount > 0) {
    info.minImageCount = std::min(std::max(info.minImageCount, 3u), able.maxImageCount);
  }
  info.imageFormat = format_;
  info.imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
  info.imageExtent = extent;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  can_capture_ = (able.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;
  info.imageUsage |= can_capture_ ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : 0;
  info.preTransform = able.currentTransform;
  info.compositeAlpha = able.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                                         : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  if (!vsync_ && std::find(modes.begin(), modes.end(), VK_PRESENT_MODE_IMMEDIATE_KHR) != modes.end()) {
    info.presentMode = VK_PRESENT_MODE_IMMEDIATE_KHR;
  }
  info.clipped = VK_TRUE;
  check(gpu_.vkCreateSwapchainKHR(gpu_.device, &info, nullptr, &swapchain_), "making a swapchain");
  width_ = extent.width;
  height_ = extent.height;
  check(gpu_.vkGetSwapchainImagesKHR(gpu_.device, swapchain_, &count, nullptr), "asking the swapchain");
  images_.resize(count);
  check(gpu_.vkGetSwapchainImagesKHR(gpu_.device, swapchain_, &count, images_.data()), "asking the swapchain");
  for (const VkImage image : images_) {
    auto view = tagged<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    view.image = image;
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    check(gpu_.vkCreateImageView(gpu_.device, &view, nullptr, &views_.emplace_back()), "making an image view");
    auto framebuffer = tagged<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    framebuffer.renderPass = render_pass_;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &views_.back();
    framebuffer.width = width_;
    framebuffer.height = height_;
    framebuffer.layers = 1;
    check(gpu_.vkCreateFramebuffer(gpu_.device, &framebuffer, nullptr, &framebuffers_.emplace_back()), "making a framebuffer");
    const auto semaphore = tagged<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    check(gpu_.vkCreateSemaphore(gpu_.device, &semaphore, nullptr, &drawn_.emplace_back()), "making a semaphore");
  }
  return true;
}

void ViewScreen::makeUi(float scale) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ui_ = true;
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // the viewer remembers what there is to remember
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 64}};
  auto pool = tagged<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  pool.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
  pool.maxSets = 16;
  pool.poolSizeCount = 1;
  pool.pPoolSizes = sizes;
  check(gpu_.vkCreateDescriptorPool(gpu_.device, &pool, nullptr, &descriptors_), "making a descriptor pool");
  ImGui_ImplGlfw_InitForVulkan(window_->handle(), true);
  window_->input().install(window_->handle());
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = gpu_.shared.instance;
  info.PhysicalDevice = gpu_.shared.physical_device;
  info.Device = gpu_.device;
  info.QueueFamily = gpu_.shared.queue_family;
  info.Queue = gpu_.shared.queue;
  info.DescriptorPool = descriptors_;
  info.MinImageCount = 2;
  info.ImageCount = 3;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  ImGui_ImplVulkan_Init(&info, render_pass_);
  setUiScale(scale);
}

void ViewScreen::setUiScale(float scale) {
  gpu_.vkDeviceWaitIdle(gpu_.device);
  styleUi(scale);
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  std::error_code error;
  if (std::filesystem::is_regular_file(kFont, error)) {
    fonts.AddFontFromFileTTF(kFont, std::max(8.0f, std::round(14.0f * scale)));
  } else {
    ImFontConfig config;
    config.SizePixels = std::max(8.0f, std::round(13.0f * scale));
    fonts.AddFontDefault(&config);
  }
  ImGui_ImplVulkan_DestroyFontUploadObjects();
  uploadFonts();
}

void ViewScreen::uploadFonts() {
  if (!host_->submit([](VkCommandBuffer cmd) { ImGui_ImplVulkan_CreateFontsTexture(cmd); })) {
    throw DeviceLost("uploading the letters: the device was lost");
  }
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

void ViewScreen::setVsync(bool vsync) {
  if (vsync != vsync_) {
    vsync_ = vsync;
    stale_ = true;
  }
}

void ViewScreen::beginUi() {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  window_->input().feed();
}

void ViewScreen::recordCapture(uint32_t index) {
  if (!can_capture_ || !host_->resources().createBuffer(VkDeviceSize{4} * width_ * height_, VK_BUFFER_USAGE_TRANSFER_DST_BIT, captured_)) {
    throw std::runtime_error(capture_path_ + ": this window's pictures cannot be read back");
  }
  const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  host_->resources().transition(cmd_, images_[index], range, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {width_, height_, 1};
  gpu_.vkCmdCopyImageToBuffer(cmd_, images_[index], VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, captured_.buffer, 1, &region);
  host_->resources().transition(cmd_, images_[index], range, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

void ViewScreen::writeCapture() {
  Image image(width_, height_);
  const auto* bytes = static_cast<const unsigned char*>(captured_.mapped);
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    const size_t channel = i % 4;
    const size_t from = channel == 3 || format_ == VK_FORMAT_R8G8B8A8_UNORM ? i : i - channel + (2 - channel);
    const float coded = static_cast<float>(bytes[from]) / 255.0f;
    image.rgba[i] = channel == 3 ? 1.0f : decodeSrgb(coded);
  }
  host_->resources().destroy(captured_);
  savePicture(std::exchange(capture_path_, {}), image);
}

bool ViewScreen::draw(const std::function<void(VkCommandBuffer)>& before, const std::function<void(VkCommandBuffer)>& display) {
  int width = 0, height = 0;
  window_->framebufferSize(width, height);
  if (window_->hidden()) {
    return false;
  }
  const bool resized = static_cast<uint32_t>(width) != width_ || static_cast<uint32_t>(height) != height_;
  if ((!swapchain_ || stale_ || resized) && !makeSwapchain()) {
    return false;
  }
  uint32_t index = 0;
  const VkResult got = gpu_.vkAcquireNextImageKHR(gpu_.device, swapchain_, kAcquireNs, acquired_, VK_NULL_HANDLE, &index);
  if (got == VK_TIMEOUT || got == VK_NOT_READY) {
    return false;
  }
  if (got == VK_ERROR_OUT_OF_DATE_KHR) {
    stale_ = true;
    return false;
  }
  if (got != VK_SUBOPTIMAL_KHR) {
    check(got, "asking for an image of the window");
  }
  check(gpu_.vkResetCommandPool(gpu_.device, pool_, 0), "drawing");
  auto begin = tagged<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(gpu_.vkBeginCommandBuffer(cmd_, &begin), "drawing");
  before(cmd_);
  auto pass = tagged<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
  pass.renderPass = render_pass_;
  pass.framebuffer = framebuffers_[index];
  pass.renderArea = {{0, 0}, {width_, height_}};
  VkClearValue ground{};
  pass.clearValueCount = 1;
  pass.pClearValues = &ground;
  gpu_.vkCmdBeginRenderPass(cmd_, &pass, VK_SUBPASS_CONTENTS_INLINE);
  display(cmd_);
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), cmd_);
  gpu_.vkCmdEndRenderPass(cmd_);
  const bool capturing = !capture_path_.empty();
  if (capturing) {
    recordCapture(index);
  }
  check(gpu_.vkEndCommandBuffer(cmd_), "drawing");

  auto wait = tagged<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
  wait.semaphore = acquired_;
  wait.stageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  auto signal = tagged<VkSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO);
  signal.semaphore = drawn_[index];
  signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  auto buffer = tagged<VkCommandBufferSubmitInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO);
  buffer.commandBuffer = cmd_;
  auto submit = tagged<VkSubmitInfo2>(VK_STRUCTURE_TYPE_SUBMIT_INFO_2);
  submit.waitSemaphoreInfoCount = submit.commandBufferInfoCount = submit.signalSemaphoreInfoCount = 1;
  submit.pWaitSemaphoreInfos = &wait;
  submit.pCommandBufferInfos = &buffer;
  submit.pSignalSemaphoreInfos = &signal;
  check(gpu_.vkQueueSubmit2(gpu_.shared.queue, 1, &submit, fence_), "drawing");
  check(gpu_.vkWaitForFences(gpu_.device, 1, &fence_, VK_TRUE, UINT64_MAX), "drawing");
  check(gpu_.vkResetFences(gpu_.device, 1, &fence_), "drawing");
  if (capturing) {
    writeCapture();
  }
  auto present = tagged<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
  present.waitSemaphoreCount = 1;
  present.pWaitSemaphores = &drawn_[index];
  present.swapchainCount = 1;
  present.pSwapchains = &swapchain_;
  present.pImageIndices = &index;
  const VkResult shown = gpu_.vkQueuePresentKHR(gpu_.shared.queue, &present);
  if (shown == VK_ERROR_OUT_OF_DATE_KHR || shown == VK_SUBOPTIMAL_KHR || got == VK_SUBOPTIMAL_KHR) {
    stale_ = true;
  } else {
    check(shown, "showing the picture");
  }
  return true;
}

}  // namespace forelock::samples
