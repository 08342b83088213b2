// One per VkDevice: the device, its pipelines, and the index pattern that all hairs share.
#pragma once

#include "gpu/device.h"
#include "gpu/pipelines.h"

namespace forelock {

// Quads of a run of segments: 0 1 2, 2 1 3 on four vertices each, in 16 bits; longer hairs draw it again with a vertex offset.
inline constexpr uint32_t kSegmentsPerDraw = 16384;

class Context {
public:
  explicit Context(const FlkHostAllocator* allocator) : memory_(allocator), pipelines(&memory_) {}

  FlkResult init(const FlkContextDesc& desc);
  void destroy();
  HostMemory& memory() { return memory_; }

private:
  HostMemory memory_;  // first: what follows lives in it

public:
  Device device;
  Pipelines pipelines;
  Buffer indices;
};

}  // namespace forelock
