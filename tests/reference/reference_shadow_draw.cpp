// Strands into hair shadow maps: section 4.
#include "reference_quads.h"

namespace forelock::reference {
namespace {

struct MapVertex {
  Vec3 v;  // in the map's axes, from the sphere's middle or the light
  double radius = 0;
  double opacity = 1;
};

struct MapPoint {
  Vec2 at;  // texels
  double depth = 0, texel = 0;
};

MapPoint placeInMap(const ShadowMap& map, const MapVertex& vertex) {
  const Vec3 v = vertex.v;
  if (map.focal > 0) {
    const double half = map.size / 2.0;
    return {{half + map.focal * v.x / v.z, half + map.focal * v.y / v.z}, length(v), v.z / map.focal};
  }
  return {{(v.x / map.rho + 1) / 2 * map.size, (v.y / map.rho + 1) / 2 * map.size}, v.z + map.rho, map.texel};
}

struct MapEnds {
  MapVertex a, b;
};

// The depth where the axis has the share v of its way across the map.
double axisDepth(const ShadowMap& map, const PlaneSegment& plane, const MapEnds& ends, double v) {
  if (!(map.focal > 0)) return mix(ends.a.v.z + map.rho, ends.b.v.z + map.rho, v);
  const double z = 1 / ((1 - v) / ends.a.v.z + v / ends.b.v.z);
  const Vec2 at = plane.a + v * (plane.b - plane.a);
  const double x = (at.x - map.size / 2.0) / map.focal, y = (at.y - map.size / 2.0) / map.focal;
  return z * std::sqrt(1 + x * x + y * y);
}

// False where the segment is wholly nearer than near.
bool cutAtNear(const ShadowMap& map, PlaneSegment& plane, MapEnds& ends) {
  if (!(map.focal > 0)) return true;
  const double za = ends.a.v.z, zb = ends.b.v.z, near_depth = map.near_depth;
  plane.cut_a = !(za >= near_depth);
  plane.cut_b = !(zb >= near_depth);
  if (plane.cut_a && plane.cut_b) return false;
  if (plane.cut_a || plane.cut_b) {
    const double t = (near_depth - za) / (zb - za);
    MapVertex& cut = plane.cut_a ? ends.a : ends.b;
    cut = {mix(ends.a.v, ends.b.v, t), mix(ends.a.radius, ends.b.radius, t), mix(ends.a.opacity, ends.b.opacity, t)};
    cut.v.z = near_depth;
  }
  return true;
}

// Coverage by width: one number a segment, by 32-bit arithmetic that wraps.
uint32_t coverSeed(size_t vertex, uint32_t slot) {
  uint32_t h = uint32_t(vertex) * 64 + slot;
  h ^= h / 65536;
  h *= 0x7FEB352D;
  h ^= h / 32768;
  h *= 0x846CA68B;
  h ^= h / 65536;
  return h;
}

bool coverKeeps(uint32_t seed, int column, int row, double share) {
  const uint32_t turn = seed + uint32_t(column) * 3242174889u + uint32_t(row) * 2447445414u;
  return turn / 256 < uint32_t(std::floor(share * 16777216 + 0.5));
}

}  // namespace

void drawShadowMap(ShadowMap& map, const Scene& scene) {
  if (!(map.rho > 0)) return;
  const Vec3 from = map.focal > 0 ? map.origin : map.center;
  std::vector<PlaneSegment> planes;
  std::vector<MapEnds> ends;
  std::vector<Vec2> covers;  // half widths at both ends that would cover as much if they were opaque
  for (const Hair& hair : scene.hairs) {
    const Strands& strands = hair.strands;
    auto vertexAt = [&](size_t v) {
      const Vec3 q = strands.positions[v] - from;
      return MapVertex{{dot(q, map.x), dot(q, map.y), dot(q, map.z)}, strands.radii[v] * hair.material.width_scale,
                       mix(hair.material.opacity_root, hair.material.opacity_tip, strands.fraction[v])};
    };
    for (size_t strand = 0; strand < strands.count(); ++strand) {
      const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
      if (end < begin + 2) continue;
      planes.assign(end - begin - 1, {});
      ends.assign(end - begin - 1, {});
      covers.assign(end - begin - 1, {});
      for (size_t i = 0; i < planes.size(); ++i) {
        ends[i] = {vertexAt(begin + i), vertexAt(begin + i + 1)};
        if (!cutAtNear(map, planes[i], ends[i])) continue;
        planes[i].exists = true;
        const MapPoint a = placeInMap(map, ends[i].a), b = placeInMap(map, ends[i].b);
        planes[i].a = a.at;
        planes[i].b = b.at;
        planes[i].h_a = std::max(ends[i].a.radius / a.texel, 0.5);
        planes[i].h_b = std::max(ends[i].b.radius / b.texel, 0.5);
        covers[i] = {ends[i].a.opacity * ends[i].a.radius / a.texel, ends[i].b.opacity * ends[i].b.radius / b.texel};
        setDirection(planes[i]);
      }
      shapeStrand(planes, true);
      for (size_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].exists) continue;
        forEachCell(planes[i].corner, map.size, 0, map.size, [&](int column, int row) {
          const double y = dot(Vec2{column + 0.5, row + 0.5} - planes[i].a, planes[i].t);
          const double v = std::clamp(y / planes[i].l, 0.0, 1.0);
          if (map.cover_width) {
            const double share = mix(covers[i].x, covers[i].y, v) / mix(planes[i].h_a, planes[i].h_b, v);
            if (!coverKeeps(coverSeed(begin + i, hair.slot), column, row, share)) return;
          }
          const double d = axisDepth(map, planes[i], ends[i], v);
          float& stored = map.depth[size_t(row) * size_t(map.size) + size_t(column)];
          stored = std::min(stored, float(d));
        });
      }
    }
  }
}

std::vector<LightMaps> renderLightMaps(const Scene& scene) {
  const Sphere sphere = boundingSphere(scene);
  std::vector<LightMaps> maps;
  for (const Light& light : scene.lights) {
    maps.push_back(lightFrames(light, sphere));
    for (ShadowMap& face : maps.back().faces) drawShadowMap(face, scene);
  }
  return maps;
}

ShadowMap renderShadowMap(const Scene& scene, const Light& light) {
  return renderShadowMap(scene, light, boundingSphere(scene));
}

ShadowMap renderShadowMap(const Scene& scene, const Light& light, const Sphere& sphere) {
  Light shadowing = light;
  shadowing.shadow = true;
  LightMaps maps = lightFrames(shadowing, sphere);
  if (maps.faces.size() != 1) return {};
  drawShadowMap(maps.faces[0], scene);
  return std::move(maps.faces[0]);
}

std::vector<ShadowMap> renderShadowMaps(const Scene& scene) {
  std::vector<ShadowMap> maps;
  for (const Light& light : scene.lights) maps.push_back(light.shadow ? renderShadowMap(scene, light) : ShadowMap{});
  return maps;
}

}  // namespace forelock::reference
