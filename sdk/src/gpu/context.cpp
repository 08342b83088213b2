#include "gpu/context.h"

namespace forelock {

FlkResult Context::init(const FlkContextDesc& desc) {
  FlkResult result = device.init(desc, Messages(desc.message, desc.message_user));
  if (result != FLK_SUCCESS || device.planning()) return result;
  result = pipelines.init(device);
  if (result != FLK_SUCCESS) return destroy(), result;
  if (!device.graphics) return result;
  result = device.createBuffer(kSegmentsPerDraw * 6 * sizeof(uint16_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT, true,
                               "segment indices", indices);
  if (result != FLK_SUCCESS) return destroy(), result;
  auto* index = static_cast<uint16_t*>(indices.memory.mapped);
  for (uint32_t segment = 0; segment < kSegmentsPerDraw; ++segment)
    for (uint32_t corner : {0, 1, 2, 2, 1, 3}) *index++ = uint16_t(segment * 4 + corner);
  return FLK_SUCCESS;
}

void Context::destroy() {
  device.destroy(indices);
  pipelines.destroy(device);
}

}  // namespace forelock
