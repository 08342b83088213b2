#include "plan/pool.h"

#include <algorithm>

namespace forelock {
namespace {

constexpr double kHeadroom = 1.125;  // what a frame may grow by before nodes are lost
constexpr double kRoomy = 1.25;      // more than this above the count is given back
constexpr uint32_t kRoomyFrames = 3;
constexpr uint64_t kGrain = 1024;  // nodes

}  // namespace

uint64_t choosePoolCapacity(PoolState& state, uint64_t estimate, uint64_t limit) {
  auto rounded = [&](double nodes) {
    return std::clamp(uint64_t((nodes + double(kGrain - 1)) / kGrain) * kGrain, uint64_t(1), limit);
  };
  if (state.last_estimate == 0 || state.last_count == 0) return std::min(std::max(state.capacity, rounded(double(estimate))), limit);

  // A camera that came nearer since the count has more to store, in proportion to the estimates.
  const double growth = std::max(1.0, double(estimate) / double(state.last_estimate));
  const double needed = double(state.last_count) * growth;
  const uint64_t wanted = rounded(needed * kHeadroom);
  if (double(state.capacity) < std::min(needed * 1.02, double(limit))) {
    state.roomy_frames = 0;
    return wanted;
  }
  const bool roomy = double(state.capacity) > needed * kRoomy && wanted < state.capacity;
  state.roomy_frames = !roomy ? 0 : state.roomy_frames + (state.counted ? 1 : 0);
  state.counted = false;
  if (state.roomy_frames < kRoomyFrames) return std::min(state.capacity, limit);
  state.roomy_frames = 0;
  return wanted;
}

}  // namespace forelock
