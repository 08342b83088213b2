// An independent ray cast: the strands in a pixel and their depths, by Embree's linear curves.
#include "reference_support.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <map>

namespace forelock::reference {
namespace {

struct Hits : RTCIntersectContext {
  std::map<unsigned, double> nearest;  // strand to ray parameter
};

void collect(const RTCFilterFunctionNArguments* arguments) {
  Hits& hits = *static_cast<Hits*>(arguments->context);
  const auto* hit = reinterpret_cast<const RTCHit*>(arguments->hit);
  const auto* ray = reinterpret_cast<const RTCRay*>(arguments->ray);
  const auto [entry, fresh] = hits.nearest.try_emplace(hit->geomID, double(ray->tfar));
  if (!fresh) entry->second = std::min(entry->second, double(ray->tfar));
  arguments->valid[0] = 0;  // go on through
}

struct Place {
  double distance, half_width;  // pixels, of the nearest point of the strand's axis
};

Place nearestOnScreen(const Camera& camera, std::span<const Vec3> strand, double radius, double px, double py) {
  Place out{1e30, 0};
  for (size_t i = 0; i + 1 < strand.size(); ++i) {
    const Projected a = project(camera, strand[i]), b = project(camera, strand[i + 1]);
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double v = std::clamp(((px - a.x) * dx + (py - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double distance = std::hypot(px - a.x - v * dx, py - a.y - v * dy);
    if (distance >= out.distance) continue;
    const double depth = 1 / ((1 - v) / a.depth + v / b.depth);
    out = {distance, radius * -camera.clip_from_view[5] * camera.height / 2 / depth};
  }
  return out;
}

void castAndCompare(RTCGeometryType type, const char* name) {
  constexpr int strands = 70, vertices = 9;
  constexpr double radius = 0.02;
  const Camera camera = makeCamera({0.3, 0.2, 3}, {0, 0, 0}, {0, 1, 0}, {}, 240, 160);
  std::mt19937 random(16);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::vector<Vec3>> lines;
  Scene scene;
  scene.hairs.resize(1);
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene rays = rtcNewScene(device);
  rtcSetSceneFlags(rays, RTC_SCENE_FLAG_ROBUST);
  for (int s = 0; s < strands; ++s) {
    // From one side of the view to the other, so that no end is in sight.
    std::vector<Vec3> points;
    const double angle = uniform(random) * std::numbers::pi, shift = uniform(random), z0 = uniform(random) * 0.6;
    for (int v = 0; v < vertices; ++v) {
      const double along = -6 + 12.0 * v / (vertices - 1);
      const double across = shift + 0.15 * uniform(random);
      points.push_back({along * std::cos(angle) - across * std::sin(angle),
                        along * std::sin(angle) + across * std::cos(angle), z0 + 0.1 * uniform(random)});
    }
    addStrand(scene.hairs[0].strands, points, radius);
    RTCGeometry geometry = rtcNewGeometry(device, type);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                                                               16, vertices));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                                                 4, vertices - 1));
    for (size_t v = 0; v < size_t(vertices); ++v) {
      vertex[4 * v] = float(points[v].x);
      vertex[4 * v + 1] = float(points[v].y);
      vertex[4 * v + 2] = float(points[v].z);
      vertex[4 * v + 3] = float(radius);
      if (v + 1 < size_t(vertices)) index[v] = unsigned(v);
    }
    rtcSetGeometryIntersectFilterFunction(geometry, collect);
    rtcCommitGeometry(geometry);
    EXPECT_EQ(rtcAttachGeometry(rays, geometry), unsigned(s));
    rtcReleaseGeometry(geometry);
    lines.push_back(points);
  }
  rtcCommitScene(rays);
  ASSERT_EQ(rtcGetDeviceError(device), RTC_ERROR_NONE);

  const FragmentLists lists = gatherFragments(scene, camera);
  int pixels = 0, compared = 0, pairs = 0;
  double worst_depth = 0;
  const Vec3 eye = unproject(camera, 0, 0, 0);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      std::vector<unsigned> inside;
      bool clear = true;
      for (unsigned s = 0; s < strands; ++s) {
        const Place p = nearestOnScreen(camera, lines[s], radius, x + 0.5, y + 0.5);
        if (p.distance <= p.half_width - 0.7) inside.push_back(s);
        else if (p.distance < p.half_width + 0.75) clear = false;  // beyond h + sqrt(1/2) px there is no fragment
      }
      if (!clear || inside.empty()) continue;
      ++pixels;
      Hits hits;
      rtcInitIntersectContext(&hits);
      RTCRayHit ray{};
      const Vec3 at = unproject(camera, x + 0.5, y + 0.5, 1);  // one metre of depth per unit of the parameter
      ray.ray.org_x = float(eye.x);
      ray.ray.org_y = float(eye.y);
      ray.ray.org_z = float(eye.z);
      ray.ray.dir_x = float(at.x - eye.x);
      ray.ray.dir_y = float(at.y - eye.y);
      ray.ray.dir_z = float(at.z - eye.z);
      ray.ray.tfar = std::numeric_limits<float>::infinity();
      ray.ray.mask = ~0u;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(rays, &hits, &ray);

      std::map<unsigned, double> listed;
      for (const Fragment& f : lists.at(x, y)) {
        const auto [entry, fresh] = listed.try_emplace(f.sequence / (vertices - 1), f.depth);
        if (!fresh) entry->second = std::min(entry->second, f.depth);
      }
      std::vector<unsigned> in_list, in_rays;
      for (const auto& [s, d] : listed) in_list.push_back(s);
      for (const auto& [s, d] : hits.nearest) in_rays.push_back(s);
      EXPECT_EQ(in_list, inside) << name << " " << x << " " << y;
      EXPECT_EQ(in_rays, inside) << name << " " << x << " " << y;
      if (in_list != inside || in_rays != inside) continue;
      for (const unsigned s : inside) {
        worst_depth = std::max(worst_depth, std::fabs(listed[s] - hits.nearest[s]));
        ++compared;
        for (const unsigned other : inside) {
          // Nearer than their thickness the two notions of depth may differ.
          if (listed[s] + 2 * radius >= listed[other]) continue;
          EXPECT_LT(hits.nearest[s], hits.nearest[other]) << name << " " << x << " " << y;
          ++pairs;
        }
      }
    }
  }
  std::printf("%s: %d pixels, %d depths, worst %.3f radii; %d ordered pairs\n", name, pixels, compared,
              worst_depth / radius, pairs);
  EXPECT_GT(pixels, 1000);
  EXPECT_GT(pairs, 200);
  // A strand's axis is one radius behind its surface at most; slopes to the view and the perspective at the border
  // stretch that: strands here rise by less than 0.15 per unit, rays lean by less than 0.8.
  EXPECT_LT(worst_depth, 1.35 * radius);
  rtcReleaseScene(rays);
  rtcReleaseDevice(device);
}

TEST(ReferenceEmbree, RoundCurves) { castAndCompare(RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE, "round"); }
TEST(ReferenceEmbree, FlatCurves) { castAndCompare(RTC_GEOMETRY_TYPE_FLAT_LINEAR_CURVE, "flat"); }

}  // namespace
}  // namespace forelock::reference
