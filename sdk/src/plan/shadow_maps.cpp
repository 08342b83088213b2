#include "plan/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace forelock {
namespace {

constexpr double kMargin = 3;           // texels that taps may reach past the last one asked for
constexpr double kSphereFits = 1.25;    // distance over radius from which one map sees the sphere
constexpr double kWidestCone = 1.0471975511965976;  // 60 degrees
constexpr double kNearShare = 1e-3;     // of the sphere's radius
constexpr double kMostFocal = 1e15;     // texels: of a light so far or so narrow that it is a ray, to stay finite as float

Sphere hairSphere(const HairFacts& hair) {
  const double scale = std::cbrt(std::abs(determinant3(hair.world_from_hair)));
  const Vec3 center = (hair.bounds.min + hair.bounds.max) * 0.5;
  return {transformPoint(hair.world_from_hair, center),
          (length(hair.bounds.max - hair.bounds.min) * 0.5 * scale + hair.radius) * 1.001};
}

struct Axes {
  Vec3 x, y, z;
};

Axes axesAbout(const Vec3& z) {
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(z[i]) < std::abs(z[axis])) axis = i;
  Vec3 e{};
  e[axis] = 1;
  const Vec3 x = normalize(e - z * dot(e, z));
  return {x, cross(z, x), z};
}

Mat4 fromWorld(const Axes& axes, const Vec3& origin, double scale) {
  Mat4 m = kIdentity;
  for (int i = 0; i < 3; ++i) m[i * 4] = axes.x[i] * scale, m[i * 4 + 1] = axes.y[i] * scale, m[i * 4 + 2] = axes.z[i];
  m[12] = -dot(axes.x, origin) * scale;
  m[13] = -dot(axes.y, origin) * scale;
  m[14] = -dot(axes.z, origin);
  return m;
}

ShadowFace sunFace(const Sphere& sphere, const Vec3& to_light, uint32_t size) {
  ShadowFace face;
  face.map_from_world = fromWorld(axesAbout(to_light * -1.0), sphere.center, size / (2.0 * sphere.radius));
  face.map_from_world[14] += sphere.radius;
  face.texel = 2 * sphere.radius / size;
  face.range = 2 * sphere.radius;
  face.size = size;
  return face;
}

ShadowFace coneFace(const Sphere& sphere, const Vec3& position, const Vec3& axis, double half_angle, double widest_cosine,
                    uint32_t size) {
  const double distance = length(sphere.center - position);
  ShadowFace face;
  face.map_from_world = fromWorld(axesAbout(axis), position, 1);
  face.focal = std::min((size * 0.5 - kMargin) / std::tan(half_angle), kMostFocal);
  face.texel = 1 / face.focal;
  face.range = distance + sphere.radius;
  face.near = std::max((distance - sphere.radius) * widest_cosine, kNearShare * sphere.radius);
  face.size = size;
  return face;
}

// The faces of one light; 0: more than fit.
bool addFaces(const LightFacts& light, uint32_t index, const Sphere& sphere, ShadowLayout& layout) {
  auto add = [&](ShadowFace face, uint32_t number) {
    if (layout.faces.count == kMaxFaces) return false;
    face.light = index, face.face = number, face.cover_width = light.cover_width;
    layout.faces.add(face);
    return true;
  };
  if (light.kind == LightKind::directional) return add(sunFace(sphere, light.direction, light.shadow_size), 0);
  const Vec3 away = sphere.center - light.position;
  const double distance = length(away);
  const bool sphere_fits = distance >= kSphereFits * sphere.radius;
  const double sphere_angle = sphere_fits ? std::asin(sphere.radius / distance) : 2;
  const bool cone_fits = light.kind == LightKind::spot && light.outer_angle <= kWidestCone;
  if (cone_fits && light.outer_angle < sphere_angle)
    return add(coneFace(sphere, light.position, light.direction * -1.0, light.outer_angle, std::cos(light.outer_angle),
                        light.shadow_size), 0);
  if (sphere_fits) return add(coneFace(sphere, light.position, away * (1 / distance), sphere_angle, 1, light.shadow_size), 0);
  for (uint32_t i = 0; i < 6; ++i) {
    Vec3 axis{};
    axis[i / 2] = i % 2 ? -1 : 1;
    if (!add(coneFace(sphere, light.position, axis, 0.7853981633974483, 0.5773502691896258, light.shadow_size), i)) return false;
  }
  return true;
}

}  // namespace

Sphere sphereOfAll(std::span<const HairFacts> hairs) {
  if (hairs.empty()) return {};
  if (hairs.size() == 1) return hairSphere(hairs[0]);
  Vec3 low{}, high{};
  for (std::size_t i = 0; i < hairs.size(); ++i) {
    const Sphere sphere = hairSphere(hairs[i]);
    for (int axis = 0; axis < 3; ++axis) {
      const double a = sphere.center[axis] - sphere.radius, b = sphere.center[axis] + sphere.radius;
      low[axis] = i ? std::min(low[axis], a) : a, high[axis] = i ? std::max(high[axis], b) : b;
    }
  }
  Sphere all{(low + high) * 0.5, 0};
  for (const HairFacts& hair : hairs) {
    const Sphere sphere = hairSphere(hair);
    all.radius = std::max(all.radius, length(sphere.center - all.center) + sphere.radius);
  }
  return all;
}

const char* layoutShadowMaps(std::span<const LightFacts> lights, std::span<const HairFacts> hairs, uint32_t limit,
                             ShadowLayout& layout) {
  layout = {};
  const Sphere sphere = sphereOfAll(hairs);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].casts_shadow && !addFaces(lights[i], uint32_t(i), sphere, layout))
      return "the lights need more than 96 hair shadow maps (a point light amid hair takes six): let fewer cast shadows";
  if (layout.faces.count == 0) return nullptr;

  // Shelves of falling height, about as wide as high.
  std::array<uint32_t, kMaxFaces> order{};
  double area = 0;
  uint32_t widest = 0;
  for (uint32_t i = 0; i < layout.faces.count; ++i) {
    order[i] = i;
    area += double(layout.faces.items[i].size) * layout.faces.items[i].size;
    widest = std::max(widest, layout.faces.items[i].size);
  }
  std::sort(order.begin(), order.begin() + layout.faces.count, [&](uint32_t a, uint32_t b) {
    const uint32_t size_a = layout.faces.items[a].size, size_b = layout.faces.items[b].size;
    return size_a != size_b ? size_a > size_b : a < b;
  });
  const uint32_t columns = uint32_t(std::ceil(std::sqrt(area) / widest));
  const uint64_t width = std::min<uint64_t>(uint64_t(columns) * widest, std::max(limit, widest));
  uint64_t x = 0, y = 0, shelf = 0;
  for (uint32_t i = 0; i < layout.faces.count; ++i) {
    ShadowFace& face = layout.faces.items[order[i]];
    if (x + face.size > width) x = 0, y += shelf, shelf = 0;
    shelf = std::max<uint64_t>(shelf, face.size);
    face.x = uint32_t(x), face.y = uint32_t(y);
    x += face.size;
    layout.width = std::max(layout.width, uint32_t(x));
  }
  if (y + shelf > limit || layout.width > limit)
    return "the hair shadow maps of all lights do not fit into one image of the device: let fewer cast shadows, or make them smaller";
  layout.height = uint32_t(y + shelf);
  return nullptr;
}

}  // namespace forelock
