#include "gpu/view.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace forelock {
namespace {

gpu::mat4x3 toMat4x3(const Mat4& m) {
  gpu::mat4x3 r;
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) r.m[column * 3 + row] = float(m[column * 4 + row]);
  return r;
}

gpu::vec3 toVec3(const float* v) { return {v[0], v[1], v[2]}; }

struct Sphere {
  Vec3 center{};
  double radius = 0;
};

Sphere hairSphere(const HairFacts& hair) {
  const double scale = std::cbrt(std::abs(determinant3(hair.world_from_hair)));
  const Vec3 center = (hair.bounds.min + hair.bounds.max) * 0.5;
  return {transformPoint(hair.world_from_hair, center),
          (length(hair.bounds.max - hair.bounds.min) * 0.5 * scale + hair.radius) * 1.001};
}

// docs/methods.md section 4.
Sphere sphereOfAll(const HairFacts* facts, uint32_t count) {
  if (count == 1) return hairSphere(facts[0]);
  Vec3 low{}, high{};
  for (uint32_t i = 0; i < count; ++i) {
    const Sphere sphere = hairSphere(facts[i]);
    for (int axis = 0; axis < 3; ++axis) {
      const double a = sphere.center[axis] - sphere.radius, b = sphere.center[axis] + sphere.radius;
      low[axis] = i ? std::min(low[axis], a) : a, high[axis] = i ? std::max(high[axis], b) : b;
    }
  }
  Sphere all{(low + high) * 0.5, 0};
  for (uint32_t i = 0; i < count; ++i) {
    const Sphere sphere = hairSphere(facts[i]);
    all.radius = std::max(all.radius, length(sphere.center - all.center) + sphere.radius);
  }
  return all;
}

// From the middle of the map.
Mat4 texelsFromWorld(const Sphere& sphere, const Vec3& to_light, uint32_t size) {
  const Vec3 z = to_light * -1.0;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(z[i]) < std::abs(z[axis])) axis = i;
  Vec3 e{};
  e[axis] = 1;
  const Vec3 x = normalize(e - z * dot(e, z)), y = cross(z, x);
  const double scale = size / (2.0 * sphere.radius);
  Mat4 m = kIdentity;
  for (int i = 0; i < 3; ++i) m[i * 4] = x[i] * scale, m[i * 4 + 1] = y[i] * scale, m[i * 4 + 2] = z[i];
  m[12] = -dot(x, sphere.center) * scale;
  m[13] = -dot(y, sphere.center) * scale;
  m[14] = -dot(z, sphere.center) + sphere.radius;
  return m;
}

gpu::HairConstants hairConstants(const FlkMaterial& material, const HairFacts& facts) {
  gpu::HairConstants h{};
  h.radius_max = float(facts.radius);
  h.opacity_root = material.opacity_root, h.opacity_tip = material.opacity_tip;
  h.diffuse = material.diffuse;
  h.color = toVec3(material.color);
  h.specular_r = material.specular_r, h.exponent_r = material.exponent_r;
  h.specular_trt = material.specular_trt, h.exponent_trt = material.exponent_trt;
  h.shadow_log2 = material.shadow_opacity < 1 ? float(std::log2(1.0 - double(material.shadow_opacity))) : -FLT_MAX;
  h.fibres_per_metre = float(std::min(1.0 / double(material.fibre_spacing), double(FLT_MAX)));
  const double tilt = material.cuticle_tilt;
  h.cos_r = float(std::cos(2 * tilt)), h.sin_r = float(std::sin(2 * tilt));
  h.cos_trt = float(std::cos(3 * tilt)), h.sin_trt = float(std::sin(3 * tilt));
  return h;
}

// No fragment is shaded brighter: every lobe and every sine is at most 1.
float brightestFragment(const Frame& frame, const FlkFrame& asked) {
  float brightest = 1e-30f;
  for (uint32_t i = 0; i < asked.hair_count; ++i) {
    const FlkMaterial& m = frame.hairs[i]->material;
    for (int channel = 0; channel < 3; ++channel) {
      const float light = asked.light_count ? asked.lights[0].radiance[channel] : 0;
      const float diffuse = m.diffuse * m.color[channel];
      brightest = std::max(brightest, light * (diffuse + m.specular_r + m.specular_trt * m.color[channel]) +
                                          asked.ambient[channel] * diffuse);
    }
  }
  return std::min(brightest, 1e30f);
}

}  // namespace

void fillConstants(Frame& frame, const FlkFrame& asked, const Camera& camera, const HairFacts* facts) {
  gpu::FrameConstants& c = frame.values;
  const FramePlan& plan = frame.plan;
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
  c.node_pool = {uint32_t(frame.node_address), uint32_t(frame.node_address >> 32)};
  c.color_range = 1;
  c.depth_range = {float(std::max(plan.nearest, camera.near_plane)), float(plan.farthest)};
  c.ambient = toVec3(asked.ambient);
  c.light_direction = {0, 0, 1};
  c.light_radiance = {0, 0, 0};
  c.shadow_texel = c.shadow_range = 1;
  c.shadow_size = plan.shadow_size;
  c.texels_from_view = toMat4x3(kIdentity);

  if (asked.light_count) {
    const FlkLight& light = asked.lights[0];
    const Vec3 to_light = normalize({light.direction[0], light.direction[1], light.direction[2]});
    const Vec3 in_view = transformDirection(camera.view_from_world, to_light);
    c.light_direction = {float(in_view[0]), float(in_view[1]), float(in_view[2])};
    c.light_radiance = toVec3(light.radiance);
    if (plan.shadow_size) {
      const Sphere sphere = sphereOfAll(facts, asked.hair_count);
      frame.texels_from_world = texelsFromWorld(sphere, to_light, plan.shadow_size);
      c.shadow_texel = frame.shadow_texel = float(2 * sphere.radius / plan.shadow_size);
      c.shadow_range = frame.shadow_range = float(2 * sphere.radius);
      c.texels_from_view = toMat4x3(frame.texels_from_world * inverseRigid(camera.view_from_world));
    }
  }
  if (plan.method->shaded && plan.method->capture == CaptureKind::color)
    c.color_range = plan.payload == FLK_PAYLOAD_PAPER ? 1 / (asked.exposure == 0 ? 1.0f : asked.exposure)
                                                      : brightestFragment(frame, asked);
  for (uint32_t i = 0; i < asked.hair_count; ++i) {
    gpu::HairConstants h = hairConstants(frame.hairs[i]->material, facts[i]);
    h.view_from_hair = toMat4x3(camera.view_from_world * facts[i].world_from_hair);
    h.texels_from_hair = toMat4x3(frame.texels_from_world * facts[i].world_from_hair);
    c.hairs[i] = h;
  }
}

}  // namespace forelock
