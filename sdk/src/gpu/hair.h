// A hair on the GPU.
#pragma once

#include "gpu/device.h"
#include "plan/plan.h"
#include "shared/hair.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

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

  enum Part { kPositions, kAttributes, kSegments, kColors, kSources, kMoved, kPartCount };
  // 0 where the hair has no such buffer.
  VkDeviceAddress address(Part part) const { return buffers_[part].address; }
  // Of the positions that are drawn.
  VkDeviceAddress drawnPositions() const { return address(host_positions ? kMoved : kPositions); }
  bool takesHostPositions() const { return takes_host_positions_; }

  FlkMaterial material{};
  Mat4 world_from_hair = kIdentity;
  Mat4 previous_world_from_hair = kIdentity;
  bool moves = false;  // previous_world_from_hair is set
  bool host_positions = false;
  FlkHairPositions moved{};
  bool uploaded = false;  // recorded at least
  uint32_t strand_count = 0, vertex_count = 0, segment_count = 0;
  float radius_max = 0;  // of the asset
  float spread_tip = 1;

  uint64_t bytesDevice() const;
  uint64_t bytesStaging() const { return staging_.size; }

private:
  void fill(const FlkStrands& strands, const FlkHairDesc& desc, unsigned char* staging);

  Context& context_;
  Buffer buffers_[kPartCount];
  uint64_t bytes_[kPartCount] = {};
  Buffer staging_;
  Box bounds_;
  double length_ = 0;
  double follow_reach_ = 0;  // of follow strands from their guides
  bool takes_host_positions_ = false;
};

}  // namespace forelock
