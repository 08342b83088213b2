// The structures that C++ and GLSL share: offsets and strides in the compiled shaders against those of the compiler.
#include "shared/frame.h"
#include "shared/hair.h"
#include "shared/light.h"

#include "shaders_spv/capture_vert_spv.h"
#include "shaders_spv/prepare_spv.h"
#include "shaders_spv/resolve_shadow_host_light_spv.h"
#include "shaders_spv/shadow_compute_spv.h"
#include "shaders_spv/shadow_width_compute_spv.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace forelock {
namespace {

struct Layouts {
  std::map<std::string, uint32_t> offsets;  // "Structure.member" to bytes
  std::map<std::string, uint32_t> strides;  // of arrays of a structure
};

// Opcodes and decorations of the SPIR-V specification.
Layouts layoutsOf(std::span<const uint32_t> words) {
  constexpr uint32_t kName = 5, kMemberName = 6, kTypeArray = 28, kTypeRuntimeArray = 29, kDecorate = 71, kMemberDecorate = 72;
  constexpr uint32_t kArrayStride = 6, kOffset = 35;
  std::map<uint32_t, std::string> structures;
  std::map<std::pair<uint32_t, uint32_t>, std::string> members;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> offsets;
  std::map<uint32_t, uint32_t> strides, elements;
  const auto text = [&](std::size_t at) { return std::string(reinterpret_cast<const char*>(&words[at])); };
  for (std::size_t at = 5; at < words.size(); at += words[at] >> 16) {
    const uint32_t opcode = words[at] & 0xFFFF;
    if (opcode == kName) structures[words[at + 1]] = text(at + 2);
    if (opcode == kMemberName) members[{words[at + 1], words[at + 2]}] = text(at + 3);
    if (opcode == kMemberDecorate && words[at + 3] == kOffset) offsets[{words[at + 1], words[at + 2]}] = words[at + 4];
    if (opcode == kDecorate && words[at + 2] == kArrayStride) strides[words[at + 1]] = words[at + 3];
    if (opcode == kTypeArray || opcode == kTypeRuntimeArray) elements[words[at + 1]] = words[at + 2];
  }
  Layouts result;
  for (const auto& [member, offset] : offsets) result.offsets[structures[member.first] + "." + members[member]] = offset;
  for (const auto& [array, stride] : strides) result.strides[structures[elements[array]]] = stride;
  return result;
}

struct Member {
  const char* name;
  std::size_t offset;
};

// Every member of a structure, no more and no fewer, where C++ has it.
void expectSame(const Layouts& shader, const std::string& structure, std::size_t size, const std::vector<Member>& members) {
  for (const Member& member : members) {
    const auto found = shader.offsets.find(structure + "." + member.name);
    ASSERT_NE(found, shader.offsets.end()) << structure << "." << member.name;
    EXPECT_EQ(found->second, member.offset) << structure << "." << member.name;
  }
  std::size_t declared = 0;
  for (const auto& [name, offset] : shader.offsets) declared += name.starts_with(structure + ".");
  EXPECT_EQ(declared, members.size()) << "a member of " << structure << " is missing in the list of this test";
  if (const auto stride = shader.strides.find(structure); stride != shader.strides.end()) { EXPECT_EQ(stride->second, size) << structure; }
}

#define FLK_AT(member) {#member, offsetof(Type, member)}

const std::vector<Member> kHairMembers = [] {
  using Type = gpu::HairConstants;
  return std::vector<Member>{
      FLK_AT(view_from_hair), FLK_AT(radius_max),   FLK_AT(opacity_root), FLK_AT(opacity_tip),      FLK_AT(diffuse),
      FLK_AT(color),          FLK_AT(specular_r),   FLK_AT(exponent_r),   FLK_AT(specular_trt),     FLK_AT(exponent_trt),
      FLK_AT(shadow_log2),    FLK_AT(fibres_per_metre), FLK_AT(cos_r),    FLK_AT(sin_r),            FLK_AT(cos_trt),
      FLK_AT(sin_trt),        FLK_AT(mean_r),       FLK_AT(mean_trt),     FLK_AT(tip_color),    FLK_AT(tip_blend),    FLK_AT(positions),        FLK_AT(attributes),
      FLK_AT(segments),       FLK_AT(colors)};
}();

const std::vector<Member> kModifierMembers = [] {
  using Type = gpu::OpacityModifier;
  return std::vector<Member>{FLK_AT(kind), FLK_AT(center), FLK_AT(start), FLK_AT(inverse_ramp), FLK_AT(inside)};
}();

const std::vector<Member> kFrameMembers = [] {
  using Type = gpu::FrameConstants;
  return std::vector<Member>{
      FLK_AT(proj_scale),     FLK_AT(proj_offset),   FLK_AT(proj_depth),  FLK_AT(orthographic),    FLK_AT(near_plane),
      FLK_AT(size),           FLK_AT(pixels_per_unit), FLK_AT(rect),      FLK_AT(nodes),
      FLK_AT(node_colors),    FLK_AT(aggregates),
      FLK_AT(node_capacity),  FLK_AT(color_range),   FLK_AT(tail_range),  FLK_AT(light_count),     FLK_AT(lights),
      FLK_AT(faces),          FLK_AT(light_tiles),   FLK_AT(light_tile_size), FLK_AT(light_tiles_x), FLK_AT(light_tiles_y),
      FLK_AT(depth_range),    FLK_AT(ambient),       FLK_AT(ambient_squares), FLK_AT(modifiers),   FLK_AT(hairs)};
}();

const std::vector<Member> kLightMembers = [] {
  using Type = gpu::LightConstants;
  return std::vector<Member>{
      FLK_AT(place),        FLK_AT(kind),       FLK_AT(radiance),  FLK_AT(inverse_range),  FLK_AT(axis),
      FLK_AT(cos_outer),    FLK_AT(inverse_cone), FLK_AT(source_radius_squared), FLK_AT(first_face), FLK_AT(face_count),
      FLK_AT(host_from_view), FLK_AT(host_rect), FLK_AT(host_layer), FLK_AT(host_bias),    FLK_AT(host_sign),
      FLK_AT(visibility_layer)};
}();

const std::vector<Member> kFaceMembers = [] {
  using Type = gpu::FaceConstants;
  return std::vector<Member>{FLK_AT(map_from_view), FLK_AT(focal), FLK_AT(texel), FLK_AT(range),
                             FLK_AT(near),          FLK_AT(offset), FLK_AT(size)};
}();

const std::vector<Member> kSourceMembers = [] {
  using Type = gpu::StrandSource;
  return std::vector<Member>{FLK_AT(vertex), FLK_AT(guide_vertex), FLK_AT(count), FLK_AT(offset), FLK_AT(rest)};
}();

#undef FLK_AT

TEST(SharedLayout, FrameAgreesWithTheShaders) {
  const std::span<const uint32_t> modules[] = {capture_vert_spv, resolve_shadow_host_light_spv, shadow_compute_spv, shadow_width_compute_spv};
  for (const auto module : modules) {
    const Layouts shader = layoutsOf(module);
    expectSame(shader, "FrameConstants", sizeof(gpu::FrameConstants), kFrameMembers);
    expectSame(shader, "HairConstants", sizeof(gpu::HairConstants), kHairMembers);
    expectSame(shader, "OpacityModifier", sizeof(gpu::OpacityModifier), kModifierMembers);
    EXPECT_EQ(shader.strides.count("HairConstants"), 1u);
    EXPECT_EQ(shader.strides.count("OpacityModifier"), 1u);
  }
}

TEST(SharedLayout, LightsAgreeWithTheShaders) {
  const Layouts resolve = layoutsOf(resolve_shadow_host_light_spv), shadow = layoutsOf(shadow_compute_spv);
  expectSame(resolve, "LightConstants", sizeof(gpu::LightConstants), kLightMembers);
  EXPECT_EQ(resolve.strides.count("LightConstants"), 1u);
  for (const Layouts* shader : {&resolve, &shadow}) {
    expectSame(*shader, "FaceConstants", sizeof(gpu::FaceConstants), kFaceMembers);
    EXPECT_EQ(shader->strides.count("FaceConstants"), 1u);
  }
}

TEST(SharedLayout, StrandSourcesAgreeWithTheShader) {
  const Layouts shader = layoutsOf(prepare_spv);
  expectSame(shader, "StrandSource", sizeof(gpu::StrandSource), kSourceMembers);
  EXPECT_EQ(shader.strides.count("StrandSource"), 1u);
}

// The push constants of every pass lie within the 64 bytes of the pipeline layout, where record.cpp writes them.
TEST(SharedLayout, PushConstants) {
  const Layouts draw = layoutsOf(shadow_compute_spv), by_width = layoutsOf(shadow_width_compute_spv), prepare = layoutsOf(prepare_spv);
  const std::pair<const char*, uint32_t> hair[] = {
      {"hair_slot", 0}, {"segment_count", 4}, {"first_segment", 8}, {"face", 12}, {"map_from_hair", 16}};
  for (const auto& [member, offset] : hair)
    for (const Layouts* shader : {&draw, &by_width}) EXPECT_EQ(shader->offsets.at(std::string("PushConstants.") + member), offset) << member;
  const std::pair<const char*, uint32_t> moved[] = {{"sources", 0},       {"host_positions", 8}, {"attributes", 16}, {"positions", 24},
                                                    {"strand_count", 32}, {"stride", 36},        {"spread_tip", 40}};
  for (const auto& [member, offset] : moved) EXPECT_EQ(prepare.offsets.at(std::string("PushConstants.") + member), offset) << member;
}

}  // namespace
}  // namespace forelock
