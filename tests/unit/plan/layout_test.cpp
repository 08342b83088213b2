// The structures that C++ and GLSL share: offsets in the compiled shaders against those of the compiler.
#include "shared/frame.h"

#include "shaders_spv/capture_vert.h"
#include "shaders_spv/resolve_shadow_comp.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace forelock {
namespace {

// Members of the structures in a module: "Structure.member" to byte offset. Opcodes of the SPIR-V specification.
std::map<std::string, uint32_t> memberOffsets(std::span<const uint32_t> words) {
  constexpr uint32_t kName = 5, kMemberName = 6, kMemberDecorate = 72, kOffset = 35;
  std::map<uint32_t, std::string> structures;
  std::map<std::pair<uint32_t, uint32_t>, std::string> members;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> offsets;
  const auto text = [&](std::size_t at) { return std::string(reinterpret_cast<const char*>(&words[at])); };
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const uint32_t opcode = words[at] & 0xFFFF;
    if (opcode == kName) structures[words[at + 1]] = text(at + 2);
    if (opcode == kMemberName) members[{words[at + 1], words[at + 2]}] = text(at + 3);
    if (opcode == kMemberDecorate && words[at + 3] == kOffset) offsets[{words[at + 1], words[at + 2]}] = words[at + 4];
  }
  std::map<std::string, uint32_t> result;
  for (const auto& [member, offset] : offsets) result[structures[member.first] + "." + members[member]] = offset;
  return result;
}

TEST(SharedLayout, OffsetsAgreeWithTheShaders) {
  using gpu::FrameConstants;
  using gpu::HairConstants;
  const std::span<const uint32_t> modules[] = {capture_vert, resolve_shadow_comp};
  for (const auto module : modules) {
    std::map<std::string, uint32_t> shader = memberOffsets(module);
    std::size_t seen = 0;
#define FLK_SAME(type, member)                                  \
  ASSERT_TRUE(shader.count(#type "." #member)) << #member;      \
  EXPECT_EQ(shader[#type "." #member], offsetof(type, member)); \
  ++seen;
    FLK_SAME(FrameConstants, proj_scale)
      FLK_SAME(FrameConstants, proj_offset)
        FLK_SAME(FrameConstants, proj_depth)
          FLK_SAME(FrameConstants, orthographic)
            FLK_SAME(FrameConstants, near_plane)
              FLK_SAME(FrameConstants, size)
                FLK_SAME(FrameConstants, pixels_per_unit)
                  FLK_SAME(FrameConstants, rect)
                    FLK_SAME(FrameConstants, node_pool)
                      FLK_SAME(FrameConstants, node_capacity)
                        FLK_SAME(FrameConstants, color_range)
                          FLK_SAME(FrameConstants, depth_range)
                            FLK_SAME(FrameConstants, light_direction)
                              FLK_SAME(FrameConstants, shadow_texel)
                                FLK_SAME(FrameConstants, light_radiance)
                                  FLK_SAME(FrameConstants, shadow_range)
                                    FLK_SAME(FrameConstants, ambient)
                                      FLK_SAME(FrameConstants, shadow_size)
                                        FLK_SAME(FrameConstants, texels_from_view)
                                          FLK_SAME(FrameConstants, hairs)
                                            FLK_SAME(HairConstants, view_from_hair)
                                              FLK_SAME(HairConstants, texels_from_hair)
                                                FLK_SAME(HairConstants, radius_max)
                                                  FLK_SAME(HairConstants, opacity_root)
                                                    FLK_SAME(HairConstants, opacity_tip)
                                                      FLK_SAME(HairConstants, diffuse)
                                                        FLK_SAME(HairConstants, color)
                                                          FLK_SAME(HairConstants, specular_r)
                                                            FLK_SAME(HairConstants, exponent_r)
                                                              FLK_SAME(HairConstants, specular_trt)
                                                                FLK_SAME(HairConstants, exponent_trt)
                                                                  FLK_SAME(HairConstants, shadow_log2)
                                                                    FLK_SAME(HairConstants, fibres_per_metre)
                                                                      FLK_SAME(HairConstants, cos_r)
                                                                        FLK_SAME(HairConstants, sin_r)
                                                                          FLK_SAME(HairConstants, cos_trt)
                                                                            FLK_SAME(HairConstants, sin_trt)
#undef FLK_SAME
                                                                              std::size_t declared = 0;
                                                                              for (const auto& [name, offset] : shader)
                                                                                declared +=
                                                                                    name.starts_with(
                                                                                        "FrameConstants.") ||
                                                                                    name.starts_with("HairConstants.");
                                                                              EXPECT_EQ(
                                                                                  declared,
                                                                                  seen);  // a member that is new in the shader is missing in the list above
  }
}

}  // namespace
}  // namespace forelock
