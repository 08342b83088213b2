// SPDX-License-Identifier: MIT
#include "calibration.h"

#include "calibration_spv.h"
#include "compute_bench.h"

#include <algorithm>

namespace forelock::study {
namespace {

class Bench : ComputeBench {
public:
  explicit Bench(samples::HeadlessHost& host) : ComputeBench(host) {
    // Far beyond any cache; on a processor as much as is copied in some ten milliseconds.
    size_ = onProcessor() ? VkDeviceSize(128) << 20 : VkDeviceSize(512) << 20;
    for (VkBuffer& buffer : buffers_) buffer = makeBuffer(size_);
    makePipeline(calibration_spv, 2 * sizeof(uint32_t), {{0, buffers_[0], VK_NULL_HANDLE}, {1, buffers_[1], VK_NULL_HANDLE}});
  }
  double bandwidth();
  double laneRate();

private:
  void run(VkCommandBuffer cmd, uint32_t groups, uint32_t rounds) const {
    const uint32_t push[2] = {rounds, uint32_t(size_ / 16)};
    dispatch(cmd, push, groups);
  }

  VkBuffer buffers_[2] = {};
  VkDeviceSize size_ = 0;
};

double Bench::bandwidth() {
  seconds([&](VkCommandBuffer cmd) {  // pages that were never written may not exist
    for (const VkBuffer buffer : buffers_) fn_.vkCmdFillBuffer(cmd, buffer, 0, VK_WHOLE_SIZE, 0);
  });
  const VkBufferCopy region{0, 0, size_};
  const double copied = secondsOfOne([&](VkCommandBuffer cmd) { fn_.vkCmdCopyBuffer(cmd, buffers_[0], buffers_[1], 1, &region); }, 5);
  const double by_shader = secondsOfOne([&](VkCommandBuffer cmd) { run(cmd, onProcessor() ? 64 : 16384, 0); }, 5);
  return 2 * double(size_) / std::min(copied, by_shader);
}

double Bench::laneRate() {
  const uint32_t groups = onProcessor() ? 256 : 32768;
  const auto timed = [&](uint32_t rounds) { return seconds([&](VkCommandBuffer cmd) { run(cmd, groups, rounds); }); };
  timed(1);  // compiles, where a driver does so late
  uint32_t rounds = 16;
  while (rounds < 1u << 22 && timed(rounds) < 0.03) rounds *= 2;
  double best = 1e300;
  for (int attempt = 0; attempt < 7; ++attempt) best = std::min(best, timed(rounds));
  return double(groups) * 64 * rounds * 64 / best;  // 64 multiply-adds a lane and round
}

}  // namespace

Calibration calibrate(samples::HeadlessHost& host) {
  Bench bench(host);
  Calibration result;
  result.bytes_per_s = bench.bandwidth();
  result.operations_per_s = bench.laneRate();
  return result;
}

}  // namespace forelock::study
