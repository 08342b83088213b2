// Runs one compute shader over an array of items: words in, words out. On the device of host(), which has what
// flkGetRequirements asks for enabled and nothing else, so that a library function that needs more is seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace forelock::test {

// A square D32_SFLOAT image, bound as the shadow map.
struct DepthMap {
  uint32_t size = 1;
  std::vector<float> texels;  // row-major
};

// A specialisation constant.
struct Constant {
  uint32_t id, value;
};

// words.size() / in_stride items; returns out_stride floats for each. Empty, with a failed expectation, where Vulkan fails.
std::vector<float> runItems(std::span<const uint32_t> spirv, std::span<const float> words, uint32_t in_stride,
                            uint32_t out_stride, const DepthMap* map = nullptr,
                            std::span<const Constant> constants = {});

}  // namespace forelock::test
