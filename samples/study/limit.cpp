// SPDX-License-Identifier: MIT
#include "limit.h"

#include <algorithm>
#include <cstring>

namespace forelock::study {
namespace {

constexpr double kOperationsPerFragment = 24, kMicrosecondsPerPass = 3;
constexpr uint64_t kColorBytes = 16;  // four halves, read and written

}  // namespace

uint64_t compulsoryBytes(FlkPlan plan, const Work& work) {
  FlkPlanInfo info{};
  flkPlanGetInfo(plan, &info);
  uint64_t bytes = work.hair_pixels * kColorBytes;
  for (uint32_t i = 0; i < info.pass_count; ++i) {
    FlkPassInfo pass{};
    flkPlanGetPass(plan, i, &pass);
    if (pass.stage == FLK_STAGE_SHADOW || pass.stage == FLK_STAGE_CAPTURE || pass.stage == FLK_STAGE_PREPARE)
      bytes += info.bytes_persistent;
  }
  for (uint32_t i = 0; i < info.resource_count; ++i) {
    FlkResourceInfo resource{};
    flkPlanGetResource(plan, i, &resource);
    if (!resource.transient) continue;
    uint64_t used = resource.bytes;
    if (std::strcmp(resource.name, "nodes") == 0 && info.node_capacity > 0)
      used = resource.bytes / info.node_capacity * std::min(work.fragments, info.node_capacity);
    bytes += 2 * used;
  }
  return bytes;
}

double limitMicroseconds(FlkPlan plan, const Work& work, const Calibration& device) {
  FlkPlanInfo info{};
  flkPlanGetInfo(plan, &info);
  const double moved = double(compulsoryBytes(plan, work)) / device.bytes_per_s;
  const double computed = kOperationsPerFragment * double(work.fragments) / device.operations_per_s;
  return 1e6 * std::max(moved, computed) + kMicrosecondsPerPass * info.pass_count;
}

}  // namespace forelock::study
