// Draws layers into the window. SPDX-License-Identifier: MIT
#pragma once

#include "gpu_resources.h"
#include "view_gpu.h"

#include <array>

namespace forelock::samples {

enum class Compare : uint32_t { none = 0, split = 1, difference = 2 };

inline constexpr uint32_t kDisplayImages = 3;

struct DisplayPush {  // display.frag
  float rect[4];
  float ground[4];
  uint32_t mode;
  float divider, gain;
  uint32_t has_opaque;
  float scale;
};

class DisplayPass {
public:
  // Throws std::runtime_error.
  DisplayPass(const ViewGpu& gpu, VkRenderPass render_pass);
  ~DisplayPass();
  DisplayPass(const DisplayPass&) = delete;
  DisplayPass& operator=(const DisplayPass&) = delete;

  // hair_first, hair_second, opaque, all in SHADER_READ_ONLY_OPTIMAL; between frames.
  void bind(const std::array<VkImageView, kDisplayImages>& views);
  void record(VkCommandBuffer cmd, const DisplayPush& push) const;

private:
  void release();
  const ViewGpu& gpu_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout set_layout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace forelock::samples
