// SPDX-License-Identifier: MIT
#include "dense.h"

#include "compute_bench.h"
#include "dense_spv.h"
#include "references.h"
#include "shared/frame.h"
#include "shared/light.h"

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <vector>

namespace forelock::study {
namespace {

constexpr std::size_t kMostFragments = (std::size_t(128) << 20) / 16;  // of a binding that every device has
constexpr uint32_t kRow = 32768;                                       // groups
constexpr int kTangentBits = 13;

struct Held {
  uint32_t pixel, depth, tangent, code;
};

std::vector<Held> heldFragments(const Twin& twin, const View& view) {
  std::vector<Held> held;
  held.reserve(view.fragments);
  for (const Rect& rect : bandsOf(view)) {
    reference::GatherOptions options;
    options.payload = reference::Payload::kept;
    const reference::FragmentLists lists =
        reference::gatherFragments(twin.scene, referenceCamera(view.matrices, view.width, view.height, rect), options);
    for (uint32_t y = 0; y < rect.height; ++y)
      for (uint32_t x = 0; x < rect.width; ++x)
        for (const reference::Fragment& f : lists.at(int(x), int(y)))
          held.push_back({(rect.x + x) | (rect.y + y) << 16, std::bit_cast<uint32_t>(float(f.depth)),
                          reference::tangentCode(f.tangent, kTangentBits), uint32_t(std::sqrt(f.alpha) * 511 + 0.5)});
  }
  return held;
}

gpu::vec3 toVec3(const float* v) { return {v[0], v[1], v[2]}; }

struct Constants {
  gpu::FrameConstants frame;
  gpu::LightConstants light;
  gpu::FaceConstants face;
};

// Of the frame as the SDK would set them; the light and its map follow at `address`.
Constants constantsOf(const View& view, const FlkMaterial& material, const Lighting& lighting, const FlkShadowMap& map, VkDeviceAddress address) {
  Constants c{};
  const float* clip = view.matrices.clip_from_view;
  const bool orthographic = clip[11] == 0;
  c.frame.proj_scale = {clip[0], clip[5]};
  c.frame.proj_offset = {clip[orthographic ? 12 : 8], clip[orthographic ? 13 : 9]};
  c.frame.orthographic = orthographic ? 1.0f : 0.0f;
  c.frame.size = {float(view.width), float(view.height)};
  c.frame.color_range = 1;
  c.frame.light_count = 1;
  const auto split = [](VkDeviceAddress at) { return gpu::uvec2{uint32_t(at), uint32_t(at >> 32)}; };
  c.frame.lights = split(address + offsetof(Constants, light));
  c.frame.faces = split(address + offsetof(Constants, face));
  c.frame.ambient = toVec3(lighting.ambient);
  gpu::HairConstants& h = c.frame.hairs[0];
  h.diffuse = material.diffuse, h.color = toVec3(material.color);
  h.specular_r = material.specular_r, h.exponent_r = material.exponent_r;
  h.specular_trt = material.specular_trt, h.exponent_trt = material.exponent_trt;
  h.shadow_log2 = material.shadow_opacity < 1 ? std::log2(1 - material.shadow_opacity) : -FLT_MAX;
  h.fibres_per_metre = 1 / material.fibre_spacing;
  h.cos_r = std::cos(2 * material.cuticle_tilt), h.sin_r = std::sin(2 * material.cuticle_tilt);
  h.cos_trt = std::cos(3 * material.cuticle_tilt), h.sin_trt = std::sin(3 * material.cuticle_tilt);

  const double* to_view = view.matrices.view_from_world;
  const float* direction = lighting.lights[0].direction;
  const double length = std::hypot(double(direction[0]), double(direction[1]), double(direction[2]));
  float place[3];
  for (int row = 0; row < 3; ++row) {
    double sum = 0;
    for (int column = 0; column < 3; ++column) sum += to_view[column * 4 + row] * double(direction[column]);
    place[row] = float(sum / length);
  }
  c.light.place = toVec3(place);
  c.light.radiance = toVec3(lighting.lights[0].radiance);
  c.light.face_count = 1;
  // Texels from the map's middle, from view space: view_from_world is rigid, so its inverse is its transpose and a shift.
  for (int row = 0; row < 3; ++row) {
    double linear[3], shift = map.texels_from_world[12 + row] - (row < 2 ? 0.5 * map.size : 0.0);
    for (int column = 0; column < 3; ++column) {
      linear[column] = 0;
      for (int world = 0; world < 3; ++world) linear[column] += map.texels_from_world[world * 4 + row] * to_view[world * 4 + column];
      shift -= linear[column] * to_view[12 + column];
    }
    for (int column = 0; column < 3; ++column) c.face.map_from_view.m[column * 3 + row] = float(linear[column]);
    c.face.map_from_view.m[9 + row] = float(shift);
  }
  c.face.texel = map.texel, c.face.range = map.depth_range;
  c.face.offset = {map.offset[0], map.offset[1]};
  c.face.size = map.size;
  return c;
}

class Bench : ComputeBench {
public:
  explicit Bench(samples::HeadlessHost& host) : ComputeBench(host) {}

  double run(const View& view, const FlkMaterial& material, const Lighting& lighting, const FlkShadowMap& map, const std::vector<Held>& held) {
    const VkBuffer constants = makeBuffer(sizeof(Constants)), results = makeBuffer(4 * held.size()), fragments = makeBuffer(16 * held.size());
    const Constants values = constantsOf(view, material, lighting, map, addressOf(constants));
    write(constants, std::as_bytes(std::span(&values, 1)));
    write(fragments, std::as_bytes(std::span(held)));
    makePipeline(dense_spv, sizeof(uint32_t),
                 {{0, constants, VK_NULL_HANDLE, true}, {1, results, VK_NULL_HANDLE}, {2, fragments, VK_NULL_HANDLE}, {4, VK_NULL_HANDLE, map.view}});
    const auto count = uint32_t(held.size()), groups = (count + 63) / 64;
    const double s = secondsOfOne(
        [&](VkCommandBuffer cmd) { dispatch(cmd, &count, std::min(groups, kRow), (groups + kRow - 1) / kRow); }, onProcessor() ? 3 : 7);
    return s * 1e3;
  }
};

}  // namespace

std::optional<double> denseShading(samples::HeadlessHost& host, const Twin& twin, const View& view, const FlkMaterial& material,
                                   const Lighting& lighting, const FlkShadowMap& map) {
  if (lighting.lights.size() != 1 || lighting.lights[0].kind != FLK_LIGHT_DIRECTIONAL || lighting.has_sh || map.perspective != 0 ||
      twin.scene.hairs.size() != 1 || material.tip_blend > 0 || !twin.scene.hairs[0].strands.colors.empty() || view.fragments == 0 ||
      view.fragments > kMostFragments)
    return std::nullopt;
  const std::vector<Held> held = heldFragments(twin, view);
  return Bench(host).run(view, material, lighting, map, held);
}

}  // namespace forelock::study
