// A hair on the GPU.
#pragma once

#include "gpu/device.h"
#include "plan/plan.h"

#include <cstdint>

namespace forelock {

class Context;

class Hair {
public:
  explicit Hair(Context& context) : context_(context) {}

  FlkResult init(const FlkHairDesc& desc, const FlkStrands& strands);
  void destroy();
  void upload(VkCommandBuffer cmd);
  void releaseStaging();
  HairFacts facts() const;
  Context& context() const { return context_; }

  FlkMaterial material{};
  Mat4 world_from_hair = kIdentity;
  VkDescriptorSet set = VK_NULL_HANDLE;
  bool uploaded = false;  // recorded at least
  uint32_t strand_count = 0, vertex_count = 0, segment_count = 0;
  float radius_max = 0;  // of the asset

  uint64_t bytesDevice() const { return bytes_[0] + bytes_[1] + bytes_[2]; }
  uint64_t bytesStaging() const { return staging_.size; }

private:
  void fill(const FlkStrands& strands, bool keep_order, uint32_t seed, unsigned char* staging);
  FlkResult createSet();

  Context& context_;
  Buffer buffers_[3];  // positions, attributes, segments
  uint64_t bytes_[3] = {0, 0, 0};
  Buffer staging_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  Box bounds_;
  double length_ = 0;
};

}  // namespace forelock
