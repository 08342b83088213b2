// A device that runs one compute shader over an array of items: words in, words out. With what flkGetRequirements asks
// for enabled and nothing else, so that a library function that needs more is seen.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace forelock::test {

// A square D32_SFLOAT image, bound as the shadow map.
struct DepthMap {
  uint32_t size = 1;
  std::vector<float> texels;  // row-major
};

class ComputeDevice {
public:
  // The one that all tests share, validation on. "No device" ends the run as failed.
  static ComputeDevice& shared();
  ~ComputeDevice();
  ComputeDevice(const ComputeDevice&) = delete;
  ComputeDevice& operator=(const ComputeDevice&) = delete;

  // words.size() / in_stride items; returns out_stride floats for each. Empty, with a failed expectation, where Vulkan
  // fails.
  std::vector<float> run(std::span<const uint32_t> spirv, std::span<const float> words, uint32_t in_stride,
                         uint32_t out_stride, const DepthMap* map = nullptr);

  const std::string& name() const;  // device and driver
  std::vector<std::string>& validationMessages();

private:
  ComputeDevice();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace forelock::test
