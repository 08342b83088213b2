// The frames of hair shadow maps and the attenuation they give: section 4.
#include "reference_quads.h"

#include <numbers>

namespace forelock::reference {

Sphere boundingSphere(const Hair& hair) {
  const Strands& strands = hair.strands;
  if (strands.positions.empty()) return {};
  Vec3 low = strands.positions[0], high = low;
  double radius = 0;
  for (size_t i = 0; i < strands.positions.size(); ++i) {
    const Vec3 p = strands.positions[i];
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    radius = std::max(radius, strands.radii[i] * hair.material.width_scale);
  }
  return {0.5 * (low + high), (length(high - low) / 2 + radius) * 1.001};
}

Sphere boundingSphere(const Scene& scene) {
  std::vector<Sphere> spheres;
  for (const Hair& hair : scene.hairs) {
    if (!hair.strands.positions.empty()) spheres.push_back(boundingSphere(hair));
  }
  if (spheres.empty()) return {};
  if (spheres.size() == 1) return spheres[0];
  Vec3 low = spheres[0].center, high = low;
  for (const Sphere& s : spheres) {
    const double r = s.radius;
    low = {std::min(low.x, s.center.x - r), std::min(low.y, s.center.y - r), std::min(low.z, s.center.z - r)};
    high = {std::max(high.x, s.center.x + r), std::max(high.y, s.center.y + r), std::max(high.z, s.center.z + r)};
  }
  Sphere all{0.5 * (low + high), 0};
  for (const Sphere& s : spheres) all.radius = std::max(all.radius, length(s.center - all.center) + s.radius);
  return all;
}

namespace {

// x and y of the map's axes from its z; empty depths.
void finishFrame(ShadowMap& map, int size) {
  map.size = size;
  const double ax = std::fabs(map.z.x), ay = std::fabs(map.z.y), az = std::fabs(map.z.z);
  Vec3 e{1, 0, 0};
  if (ay < ax && ay <= az) e = {0, 1, 0};
  if (az < ax && az < ay) e = {0, 0, 1};
  map.x = normalizeOrZero(e - dot(e, map.z) * map.z);
  map.y = cross(map.z, map.x);
  map.depth.assign(size_t(size) * size_t(size), std::numeric_limits<float>::infinity());
}

}  // namespace

ShadowMap shadowFrame(const Sphere& sphere, Vec3 direction_to_light, int size) {
  ShadowMap map;
  map.rho = sphere.radius;
  map.texel = 2 * sphere.radius / size;
  map.center = sphere.center;
  map.z = -1.0 * normalizeOrZero(direction_to_light);
  finishFrame(map, size);
  return map;
}

ShadowMap perspectiveFrame(const Sphere& sphere, Vec3 origin, Vec3 axis, double half_angle, int size,
                           double widest_cosine) {
  ShadowMap map;
  map.rho = sphere.radius;
  map.center = sphere.center;
  map.origin = origin;
  map.z = normalizeOrZero(axis);
  map.focal = (size / 2.0 - 3) / std::tan(half_angle);
  map.near_depth = std::max((length(sphere.center - origin) - sphere.radius) * widest_cosine, 0.001 * sphere.radius);
  finishFrame(map, size);
  return map;
}

namespace {

LightMaps emptyFrames(const Light& light, const Sphere& sphere) {
  LightMaps maps;
  const int size = light.shadow_size;
  if (!light.shadow || !(sphere.radius > 0)) return maps;
  if (light.kind == LightKind::directional) {
    maps.faces.push_back(shadowFrame(sphere, light.direction_to_light, size));
    return maps;
  }
  const Vec3 way = sphere.center - light.position;
  const double r = length(way);
  double half_angle = std::numeric_limits<double>::infinity();
  double widest_cosine = 1;
  Vec3 axis{};
  if (r >= 1.25 * sphere.radius) {
    half_angle = std::asin(sphere.radius / r);
    axis = way;
  }
  if (light.kind == LightKind::spot && light.outer_angle <= std::numbers::pi / 3 && light.outer_angle < half_angle) {
    half_angle = light.outer_angle;
    axis = light.axis;
    widest_cosine = std::cos(light.outer_angle);
  }
  if (std::isfinite(half_angle)) {
    maps.faces.push_back(perspectiveFrame(sphere, light.position, axis, half_angle, size, widest_cosine));
    return maps;
  }
  for (const Vec3& z : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
    maps.faces.push_back(perspectiveFrame(sphere, light.position, z, std::numbers::pi / 4, size, 1 / std::numbers::sqrt3));
  }
  return maps;
}

}  // namespace

LightMaps lightFrames(const Light& light, const Sphere& sphere) {
  LightMaps maps = emptyFrames(light, sphere);
  for (ShadowMap& map : maps.faces) map.cover_width = light.cover_width;
  return maps;
}

double shadowTap(double depth, double map_depth, double bias, double opacity, double spacing) {
  const double beyond = depth - map_depth - bias;
  if (!(beyond > 0)) return 1;  // an empty texel is infinitely far
  if (opacity >= 1) return 0;
  const double n = std::min(beyond / spacing, 1e6);
  return std::exp2(n * std::log2(1 - opacity));
}

double gaussianWeight(int i, int j) {
  static const double sum = [] {
    double row = 0;
    for (int k = -2; k <= 2; ++k) row += std::exp(-k * k / 2.0);
    return row * row;
  }();
  return std::exp(-(i * i + j * j) / 2.0) / sum;
}

double shadowTaps(const ShadowMap& map, const Material& material, Vec3 position, Vec3 tangent, int taps) {
  if (map.size == 0 || !(map.rho > 0)) return 1;
  const bool perspective = map.focal > 0;
  const Vec3 q = position - (perspective ? map.origin : map.center);
  const double vx = dot(q, map.x), vy = dot(q, map.y), vz = dot(q, map.z);
  if (perspective && !(vz >= map.near_depth)) return 1;
  const double depth = perspective ? length(q) : vz + map.rho;
  const double texel = perspective ? vz / map.focal : map.texel;
  const Vec3 from_light = perspective ? normalizeOrZero(q) : map.z;
  const double half = map.size / 2.0;
  const double early = taps == 4 ? 0.5 : 0;  // an even number of taps lies around the position
  const double column = std::floor((perspective ? half + map.focal * vx / vz : (vx / map.rho + 1) / 2 * map.size) - early);
  const double row = std::floor((perspective ? half + map.focal * vy / vz : (vy / map.rho + 1) / 2 * map.size) - early);
  if (!(std::fabs(column) < 1e9) || !(std::fabs(row) < 1e9)) return 1;
  const double cosine = -dot(tangent, from_light);
  const double sine = length(cross(tangent, from_light));
  const double bias = texel * std::fabs(cosine) / std::max(sine, 0.1);
  const int side = int(std::lround(std::sqrt(taps)));
  double light = 0, sum = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const int x = int(column) + i - (side - 1) / 2, y = int(row) + j - (side - 1) / 2;
      double tap = 1;
      if (x >= 0 && y >= 0 && x < map.size && y < map.size) {
        tap = shadowTap(depth, double(map.depth[size_t(y) * size_t(map.size) + size_t(x)]), bias,
                        material.shadow_opacity, material.fibre_spacing);
      }
      const double dx = i - (side - 1) / 2.0, dy = j - (side - 1) / 2.0;  // from the middle of all taps
      const double weight = side == 5 ? gaussianWeight(i - 2, j - 2) : std::exp(-(dx * dx + dy * dy) / 2);
      light += weight * tap;
      sum += weight;
    }
  }
  return light / sum;
}

double shadowTaps(std::span<const ShadowMap> faces, const Material& material, Vec3 position, Vec3 tangent, int taps) {
  if (faces.empty()) return 1;
  const ShadowMap* seen = &faces[0];
  for (const ShadowMap& face : faces.subspan(1)) {
    if (dot(position - face.origin, face.z) > dot(position - seen->origin, seen->z)) seen = &face;
  }
  return shadowTaps(*seen, material, position, tangent, taps);
}

}  // namespace forelock::reference
