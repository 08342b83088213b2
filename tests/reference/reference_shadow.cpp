// The hair shadow map and its attenuation: section 4.
#include "reference_quads.h"

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

ShadowMap shadowFrame(const Sphere& sphere, Vec3 direction_to_light, int size) {
  ShadowMap map;
  map.size = size;
  map.rho = sphere.radius;
  map.texel = 2 * sphere.radius / size;
  map.center = sphere.center;
  map.z = -1.0 * normalizeOrZero(direction_to_light);
  const double ax = std::fabs(map.z.x), ay = std::fabs(map.z.y), az = std::fabs(map.z.z);
  Vec3 e{1, 0, 0};
  if (ay < ax && ay <= az) e = {0, 1, 0};
  if (az < ax && az < ay) e = {0, 0, 1};
  map.x = normalizeOrZero(e - dot(e, map.z) * map.z);
  map.y = cross(map.z, map.x);
  map.depth.assign(size_t(size) * size_t(size), std::numeric_limits<float>::infinity());
  return map;
}

ShadowMap renderShadowMap(const Scene& scene, const Light& light) {
  return renderShadowMap(scene, light, boundingSphere(scene));
}

ShadowMap renderShadowMap(const Scene& scene, const Light& light, const Sphere& sphere) {
  ShadowMap map = shadowFrame(sphere, light.direction_to_light, light.shadow_size);
  if (!(map.rho > 0)) return map;
  std::vector<PlaneSegment> planes;
  std::vector<double> depths;
  for (const Hair& hair : scene.hairs) {
    const Strands& strands = hair.strands;
    for (size_t strand = 0; strand < strands.count(); ++strand) {
      const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
      if (end < begin + 2) continue;
      planes.assign(end - begin - 1, {});
      depths.assign(end - begin, 0);
      for (size_t v = begin; v < end; ++v) {
        const Vec3 q = strands.positions[v] - map.center;
        const Vec2 at{(dot(q, map.x) / map.rho + 1) / 2 * map.size, (dot(q, map.y) / map.rho + 1) / 2 * map.size};
        const double h = std::max(strands.radii[v] * hair.material.width_scale / map.texel, 0.5);
        depths[v - begin] = dot(q, map.z) + map.rho;
        if (v + 1 < end) {
          planes[v - begin].exists = true;
          planes[v - begin].a = at;
          planes[v - begin].h_a = h;
        }
        if (v > begin) {
          planes[v - begin - 1].b = at;
          planes[v - begin - 1].h_b = h;
        }
      }
      for (PlaneSegment& plane : planes) setDirection(plane);
      shapeStrand(planes, true);
      for (size_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].exists) continue;
        forEachCell(planes[i].corner, map.size, 0, map.size, [&](int column, int row) {
          const double y = dot(Vec2{column + 0.5, row + 0.5} - planes[i].a, planes[i].t);
          const double d = mix(depths[i], depths[i + 1], std::clamp(y / planes[i].l, 0.0, 1.0));
          float& stored = map.depth[size_t(row) * size_t(map.size) + size_t(column)];
          stored = std::min(stored, float(d));
        });
      }
    }
  }
  return map;
}

std::vector<ShadowMap> renderShadowMaps(const Scene& scene) {
  std::vector<ShadowMap> maps;
  for (const Light& light : scene.lights) maps.push_back(light.shadow ? renderShadowMap(scene, light) : ShadowMap{});
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

double shadowLight(const ShadowMap& map, const Material& material, Vec3 position, Vec3 tangent, bool core) {
  if (map.size == 0 || !(map.rho > 0)) return 1;
  const Vec3 q = position - map.center;
  const double depth = dot(q, map.z) + map.rho;
  const double column = std::floor((dot(q, map.x) / map.rho + 1) / 2 * map.size);
  const double row = std::floor((dot(q, map.y) / map.rho + 1) / 2 * map.size);
  if (!(std::fabs(column) < 1e9) || !(std::fabs(row) < 1e9)) return 1;
  const double cosine = -dot(tangent, map.z);
  const double sine = length(cross(tangent, map.z));
  const double bias = map.texel * std::fabs(cosine) / std::max(sine, 0.1);
  static const std::array<double, 25> weights = [] {
    std::array<double, 25> w{};
    for (int i = 0; i < 25; ++i) w[size_t(i)] = gaussianWeight(i % 5 - 2, i / 5 - 2);
    return w;
  }();
  const int reach = core ? 2 : 0;
  double light = 0;
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      const int x = int(column) + i, y = int(row) + j;
      double tap = 1;
      if (x >= 0 && y >= 0 && x < map.size && y < map.size) {
        tap = shadowTap(depth, double(map.depth[size_t(y) * size_t(map.size) + size_t(x)]), bias,
                        material.shadow_opacity, material.fibre_spacing);
      }
      light += core ? weights[size_t((j + 2) * 5 + i + 2)] * tap : tap;
    }
  }
  return light;
}

}  // namespace forelock::reference
