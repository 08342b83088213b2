#include "gpu/view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <numbers>

namespace forelock {
namespace {

constexpr double kDefaultSourceRadius = 1e-3;  // metre

double sourceRadius(const FlkLight& light) { return light.source_radius > 0 ? double(light.source_radius) : kDefaultSourceRadius; }

gpu::mat4x3 toMat4x3(const Mat4& m) {
  gpu::mat4x3 r;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) r.m[column * 3 + row] = float(m[column * 4 + row]);
  return r;
}

gpu::mat4 toMat4(const Mat4& m) {
  gpu::mat4 r;
  for (int i = 0; i < 16; ++i) r.m[i] = float(m[i]);
  return r;
}

gpu::vec3 toVec3(const float* v) { return {v[0], v[1], v[2]}; }
gpu::vec3 toVec3(const Vec3& v) { return {float(v[0]), float(v[1]), float(v[2])}; }
gpu::uvec2 toAddress(VkDeviceAddress address) { return {uint32_t(address), uint32_t(address >> 32)}; }

// Mean of max(0, cos)^exponent over all angles.
double meanLobe(double exponent) {
  return std::exp(std::lgamma((exponent + 1) / 2) - std::lgamma(exponent / 2 + 1)) / (2 * std::sqrt(std::numbers::pi));
}

gpu::HairConstants hairConstants(const FlkMaterial& material, const HairFacts& facts) {
  gpu::HairConstants h{};
  h.radius_max = float(facts.radius);
  h.opacity_root = material.opacity_root, h.opacity_tip = material.opacity_tip;
  h.diffuse = material.diffuse;
  h.color = toVec3(material.color);
  h.specular_r = material.specular_r, h.exponent_r = material.exponent_r;
  h.specular_trt = material.specular_trt, h.exponent_trt = material.exponent_trt;
  h.mean_r = float(double(material.specular_r) * meanLobe(double(material.exponent_r)));
  h.mean_trt = float(double(material.specular_trt) * meanLobe(double(material.exponent_trt)));
  h.shadow_log2 = material.shadow_opacity < 1 ? float(std::log2(1.0 - double(material.shadow_opacity))) : -FLT_MAX;
  h.fibres_per_metre = float(std::min(1.0 / double(material.fibre_spacing), double(FLT_MAX)));
  const double tilt = material.cuticle_tilt;
  h.cos_r = float(std::cos(2 * tilt)), h.sin_r = float(std::sin(2 * tilt));
  h.cos_trt = float(std::cos(3 * tilt)), h.sin_trt = float(std::sin(3 * tilt));
  h.tip_color = toVec3(material.tip_color);
  h.tip_blend = material.tip_blend;
  return h;
}

// Products of a unit tangent's components and what they add to ambient light, in view space: docs/methods.md section 5.
void ambientConstants(const FlkFrame& asked, const Camera& camera, gpu::FrameConstants& c) {
  c.ambient = toVec3(asked.ambient);
  if (!asked.ambient_sh) return;
  constexpr double kY00 = 0.28209479177387814, kY20 = 0.31539156525252005, kY21 = 1.0925484305920792, kY22 = 0.5462742152960396;
  float* constant[3] = {&c.ambient.x, &c.ambient.y, &c.ambient.z};
  for (int channel = 0; channel < 3; ++channel) {
    const auto sh = [&](int i) { return double(asked.ambient_sh[i * 3 + channel]); };
    *constant[channel] = float(double(*constant[channel]) + kY00 * sh(0));
    // -1/8 of sum c_2m Y_2m(T) as a symmetric matrix in world space.
    double w[3][3] = {};
    w[0][0] = kY22 * sh(8) - kY20 * sh(6), w[1][1] = -kY22 * sh(8) - kY20 * sh(6), w[2][2] = 2 * kY20 * sh(6);
    w[0][1] = w[1][0] = kY21 / 2 * sh(4), w[1][2] = w[2][1] = kY21 / 2 * sh(5), w[0][2] = w[2][0] = kY21 / 2 * sh(7);
    double v[3][3] = {};
    const Mat4& r = camera.view_from_world;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b) v[i][j] -= 0.125 * r[a * 4 + i] * w[a][b] * r[b * 4 + j];
    const double products[6] = {v[0][0], v[1][1], v[2][2], 2 * v[0][1], 2 * v[0][2], 2 * v[1][2]};
    for (int i = 0; i < 6; ++i) (&c.ambient_squares[i].x)[channel] = float(products[i]);
  }
}

// Arriving of a light at most, of what it sends: docs/methods.md section 4.
double mostArriving(const FlkLight& light, const Sphere& hairs) {
  if (light.kind == FLK_LIGHT_DIRECTIONAL) return 1;
  const double away = length(hairs.center - Vec3{light.position[0], light.position[1], light.position[2]}) - hairs.radius;
  const double nearest = std::max(away, sourceRadius(light));
  return 1 / (nearest * nearest);
}

// No fragment is shaded brighter: every lobe and every sine is at most 1. low: without lobes.
float brightestFragment(const Frame& frame, const FlkFrame& asked, const Sphere& hairs, const gpu::FrameConstants& c, bool low) {
  double brightest = 1e-30;
  const float ambient[3] = {c.ambient.x, c.ambient.y, c.ambient.z};
  for (int channel = 0; channel < 3; ++channel) {
    double light = 0, around = std::max(0.0, double(ambient[channel]));
    for (uint32_t i = 0; i < asked.light_count; ++i)
      light += double(asked.lights[i].radiance[channel]) * mostArriving(asked.lights[i], hairs);
    for (const gpu::vec3& square : c.ambient_squares) around += std::abs(double((&square.x)[channel]));
    for (uint32_t i = 0; i < asked.hair_count; ++i) {
      const FlkMaterial& m = frame.hairs[i]->material;
      const double fibre = std::max(m.color[channel], m.tip_blend > 0 ? m.tip_color[channel] : 0.0f);
      const double diffuse = double(m.diffuse) * fibre;
      const double lobes = low ? 0 : double(m.specular_r) + double(m.specular_trt) * fibre;
      brightest = std::max(brightest, light * (diffuse + lobes) + around * diffuse);
    }
  }
  return float(std::min(brightest, 1e30));
}

gpu::LightConstants lightConstants(const FlkLight& light, const LightFacts& facts, const Camera& camera) {
  gpu::LightConstants g{};
  g.kind = light.kind;
  g.radiance = toVec3(light.radiance);
  const Mat4& view = camera.view_from_world;
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    g.place = toVec3(transformDirection(view, facts.direction));
  } else {
    g.place = toVec3(transformPoint(view, facts.position));
    g.inverse_range = light.range > 0 ? 1 / light.range : 0;
    g.source_radius_squared = float(sourceRadius(light) * sourceRadius(light));
  }
  if (light.kind == FLK_LIGHT_SPOT) {
    g.axis = toVec3(transformDirection(view, facts.direction * -1.0));
    g.cos_outer = float(std::cos(double(light.outer_angle)));
    g.inverse_cone = float(1 / std::max(std::cos(double(light.inner_angle)) - std::cos(double(light.outer_angle)), 1e-6));
  }
  g.host_layer = g.visibility_layer = FLK_NO_LAYER;
  g.host_sign = 1;
  if (light.host_shadow) {
    const FlkHostShadow& shadow = *light.host_shadow;
    Mat4 map;
    std::copy(shadow.map_from_world, shadow.map_from_world + 16, map.begin());
    g.host_from_view = toMat4(map * inverseRigid(view));
    g.host_rect = {shadow.rect[0], shadow.rect[1], shadow.rect[0] + shadow.rect[2], shadow.rect[1] + shadow.rect[3]};
    g.host_layer = shadow.layer;
    g.host_bias = shadow.bias;
    g.host_sign = shadow.reversed ? -1.0f : 1.0f;
  }
  if (light.visibility) g.visibility_layer = light.visibility - 1;
  return g;
}

// Of the frame before: clip space from view space now, for velocity.
Mat4 clipBefore(const FlkFrame& asked, const Hair& hair, const Camera& camera) {
  Mat4 clip, view = camera.view_from_world;
  const float* p = asked.previous_clip_from_view ? asked.previous_clip_from_view : asked.clip_from_view;
  std::copy(p, p + 16, clip.begin());
  if (asked.previous_view_from_world) std::copy(asked.previous_view_from_world, asked.previous_view_from_world + 16, view.begin());
  const Mat4 back = inverseRigid(camera.view_from_world);
  return hair.moves ? clip * (view * (hair.previous_world_from_hair * (inverseAffine(hair.world_from_hair) * back)))
                    : clip * (view * back);
}

template <class T> void append(std::pmr::vector<std::byte>& bytes, const T& value) {
  const auto* from = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

}  // namespace

void fillLights(Frame& frame, const FlkFrame& asked, const Camera& camera, std::span<const LightFacts> lights) {
  const FramePlan& plan = frame.plan;
  frame.light_values.clear();
  std::size_t next_face = 0;
  for (uint32_t i = 0; i < plan.light_count; ++i) {
    gpu::LightConstants light = lightConstants(asked.lights[i], lights[i], camera);
    light.first_face = uint32_t(next_face);
    while (next_face < plan.shadow.faces.count && plan.shadow.faces.items[next_face].light == i) ++next_face, ++light.face_count;
    append(frame.light_values, light);
  }
  const Mat4 world_from_view = inverseRigid(camera.view_from_world);
  for (const ShadowFace& face : plan.shadow.faces) {
    gpu::FaceConstants g{};
    g.map_from_view = toMat4x3(face.map_from_world * world_from_view);
    g.focal = float(face.focal), g.texel = float(face.texel), g.range = float(face.range), g.near = float(face.near);
    g.offset = {face.x, face.y};
    g.size = face.size;
    append(frame.light_values, g);
  }
  if (plan.outputs >> FLK_OUTPUT_VELOCITY & 1)
    for (uint32_t i = 0; i < asked.hair_count; ++i) append(frame.light_values, toMat4(clipBefore(asked, *frame.hairs[i], camera)));
}

void fillConstants(Frame& frame, const FlkFrame& asked, const Camera& camera, const HairFacts* facts) {
  gpu::FrameConstants& c = frame.values;
  const FramePlan& plan = frame.plan;
  c = {};
  c.proj_scale = {float(camera.scale[0]), float(camera.scale[1])};
  c.proj_offset = {float(camera.offset[0]), float(camera.offset[1])};
  c.proj_depth = {float(camera.depth[0]), float(camera.depth[1])};
  c.orthographic = camera.orthographic ? 1.0f : 0.0f;
  c.near_plane = float(camera.near_plane);
  c.size = {float(camera.width), float(camera.height)};
  c.pixels_per_unit = {float(std::abs(camera.scale[0]) * camera.width / 2),
                       float(std::abs(camera.scale[1]) * camera.height / 2)};
  c.rect = {plan.rect.x, plan.rect.y, plan.rect.width, plan.rect.height};
  c.node_capacity = uint32_t(plan.node_capacity);
  c.nodes = toAddress(frame.node_address);
  c.node_colors = toAddress(frame.node_address + 12 * plan.node_capacity);
  c.aggregates = toAddress(frame.aggregate_address);
  c.depth_range = {float(std::max(plan.nearest, camera.near_plane)), float(plan.farthest)};
  c.light_count = plan.light_count;
  c.lights = toAddress(frame.light_address);
  c.faces = toAddress(frame.light_address + plan.light_count * sizeof(gpu::LightConstants));
  if (asked.light_tiles.address) {
    c.light_tiles = toAddress(asked.light_tiles.address);
    c.light_tile_size = asked.light_tiles.tile_size;
    c.light_tiles_x = asked.light_tiles.tiles_x, c.light_tiles_y = asked.light_tiles.tiles_y;
  }
  ambientConstants(asked, camera, c);
  for (uint32_t i = 0; i < asked.opacity_modifier_count; ++i) {
    const FlkOpacityModifier& m = asked.opacity_modifiers[i];
    gpu::OpacityModifier& g = c.modifiers[i];
    g.kind = m.kind;
    g.center = {m.center[0], m.center[1]};
    g.start = m.kind == FLK_OPACITY_LENS ? m.radius : m.start;
    g.inverse_ramp = 1 / (m.kind == FLK_OPACITY_LENS ? m.feather : m.end - m.start);
    g.inside = m.inside;
  }
  const Sphere hairs = sphereOfAll({facts, asked.hair_count});
  c.color_range = c.tail_range = 1;
  if (plan.method->shaded) {
    c.tail_range = brightestFragment(frame, asked, hairs, c, plan.low_shade == FLK_LOW_PLAIN);
    if (plan.method->capture == CaptureKind::color)
      c.color_range = plan.payload == FLK_PAYLOAD_PAPER ? 1 / (asked.exposure == 0 ? 1.0f : asked.exposure)
                                                        : brightestFragment(frame, asked, hairs, c, false);
  }
  for (uint32_t i = 0; i < asked.hair_count; ++i) {
    const Hair& hair = *frame.hairs[i];
    gpu::HairConstants h = hairConstants(hair.material, facts[i]);
    h.view_from_hair = toMat4x3(camera.view_from_world * facts[i].world_from_hair);
    h.positions = toAddress(hair.drawnPositions());
    h.attributes = toAddress(hair.address(Hair::kAttributes));
    h.segments = toAddress(hair.address(Hair::kSegments));
    h.colors = toAddress(hair.address(Hair::kColors));
    c.hairs[i] = h;
  }
}

}  // namespace forelock
