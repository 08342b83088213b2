// SPDX-License-Identifier: MIT
#include "twin.h"

#include "reference_follow.h"

#include <algorithm>
#include <cmath>

namespace forelock::study {
namespace {

using reference::Vec3;

reference::Strands guidesOf(const SubjectAsset& asset) {
  FlkStrands given{};
  flkAssetGetStrands(asset.opened.asset.get(), &given);
  reference::Strands strands;
  std::vector<Vec3> points;
  std::vector<double> radii;
  for (uint32_t s = 0; s < given.strand_count; ++s) {
    points.clear(), radii.clear();
    for (std::size_t v = given.first_vertex[s]; v < given.first_vertex[s + 1]; ++v) {
      points.push_back({given.positions[v * 3], given.positions[v * 3 + 1], given.positions[v * 3 + 2]});
      radii.push_back(given.radii[v]);
    }
    reference::addStrand(strands, points, radii);
  }
  if (given.colors && !(asset.flags & FLK_HAIR_IGNORE_COLORS))
    for (std::size_t v = 0; v < given.vertex_count; ++v)
      strands.colors.push_back({given.colors[v * 3], given.colors[v * 3 + 1], given.colors[v * 3 + 2]});
  return strands;
}

Vec3 transformed(const double m[16], Vec3 p) {
  return {m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12], m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
          m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]};
}

// A hair's sphere is of its box before the transform, which a turned hair's own box is not.
reference::Sphere sphereOf(const reference::Strands& rest, const SubjectAsset& asset, double width_scale) {
  reference::Hair hair;
  hair.strands.positions = rest.positions;
  hair.strands.radii = rest.radii;
  hair.material.width_scale = width_scale;
  reference::Sphere sphere = reference::boundingSphere(hair);
  return {transformed(asset.world_from_hair, sphere.center), sphere.radius * asset.scale};
}

reference::Sphere around(const std::vector<reference::Sphere>& spheres) {
  if (spheres.size() == 1) return spheres[0];
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (const reference::Sphere& s : spheres) {
    const double c[3] = {s.center.x, s.center.y, s.center.z};
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], c[i] - s.radius), high[i] = std::max(high[i], c[i] + s.radius);
  }
  reference::Sphere all{{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}, 0};
  for (const reference::Sphere& s : spheres)
    all.radius = std::max(all.radius, std::hypot(s.center.x - all.center.x, s.center.y - all.center.y, s.center.z - all.center.z) +
                                          s.radius);
  return all;
}

}  // namespace

Twin makeTwin(const Subject& subject, samples::HairColor color) {
  Twin twin;
  std::vector<reference::Sphere> spheres;
  for (std::size_t i = 0; i < subject.assets.size(); ++i) {
    const SubjectAsset& asset = subject.assets[i];
    reference::Hair& hair = twin.scene.hairs.emplace_back();
    hair.slot = uint32_t(i);
    hair.strands = guidesOf(asset);
    if (asset.follow.count)
      hair.strands = reference::followStrands(hair.strands, asset.follow.count, double(asset.follow.radius),
                                              double(asset.follow.spread_tip), asset.follow.seed);
    spheres.push_back(sphereOf(hair.strands, asset, double(subjectMaterial(subject, i, color).width_scale)));
    for (Vec3& p : hair.strands.positions) p = transformed(asset.world_from_hair, p);
    for (double& r : hair.strands.radii) r *= asset.scale;
  }
  twin.sphere = around(spheres);
  setTwinMaterials(twin, subject, color);
  return twin;
}

void setTwinMaterials(Twin& twin, const Subject& subject, samples::HairColor color) {
  for (std::size_t i = 0; i < subject.assets.size(); ++i) {
    const FlkMaterial m = subjectMaterial(subject, i, color);
    reference::Material& t = twin.scene.hairs[i].material;
    for (int c = 0; c < 3; ++c) t.color[c] = double(m.color[c]), t.tip_color[c] = double(m.tip_color[c]);
    t.opacity_root = double(m.opacity_root), t.opacity_tip = double(m.opacity_tip), t.width_scale = double(m.width_scale);
    t.kd = double(m.diffuse), t.kr = double(m.specular_r), t.exponent_r = double(m.exponent_r);
    t.kt = double(m.specular_trt), t.exponent_trt = double(m.exponent_trt), t.cuticle_tilt = double(m.cuticle_tilt);
    t.shadow_opacity = double(m.shadow_opacity), t.fibre_spacing = double(m.fibre_spacing), t.tip_blend = double(m.tip_blend);
  }
}

void setTwinLights(Twin& twin, const Lighting& lighting) {
  twin.scene.lights.clear();
  for (const FlkLight& light : lighting.lights) {
    reference::Light& l = twin.scene.lights.emplace_back();
    l.kind = reference::LightKind(light.kind);
    if (light.kind != FLK_LIGHT_POINT) {
      const double x = double(light.direction[0]), y = double(light.direction[1]), z = double(light.direction[2]);
      const double length = std::sqrt(x * x + y * y + z * z);
      l.direction_to_light = {x / length, y / length, z / length};
      l.axis = {-x / length, -y / length, -z / length};
    }
    l.position = {light.position[0], light.position[1], light.position[2]};
    for (int c = 0; c < 3; ++c) l.radiance[c] = double(light.radiance[c]);
    l.range = double(light.range);
    l.source_radius = light.source_radius > 0 ? double(light.source_radius) : 1e-3;
    l.inner_angle = double(light.inner_angle), l.outer_angle = double(light.outer_angle);
    l.shadow = light.casts_shadow != 0;
    l.shadow_size = int(light.shadow_size);
    l.cover_width = light.shadow_cover == FLK_SHADOW_COVER_WIDTH;
  }
  for (int c = 0; c < 3; ++c) twin.scene.ambient[c] = double(lighting.ambient[c]);
  twin.scene.ambient_sh.reset();
  if (lighting.has_sh) {
    twin.scene.ambient_sh.emplace();
    for (std::size_t i = 0; i < 27; ++i) (*twin.scene.ambient_sh)[i / 3][i % 3] = double(lighting.ambient_sh[i]);
  }
}

std::vector<reference::LightMaps> twinMaps(const Twin& twin) {
  std::vector<reference::LightMaps> all;
  for (const reference::Light& light : twin.scene.lights) {
    all.push_back(reference::lightFrames(light, twin.sphere));
    for (reference::ShadowMap& map : all.back().faces) reference::drawShadowMap(map, twin.scene);
  }
  return all;
}

}  // namespace forelock::study
