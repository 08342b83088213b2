// SPDX-License-Identifier: MIT
#include "subject.h"

#include "progress.h"
#include "strand_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace forelock::study {

using namespace samples;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string fromAnywhere(const std::string& source) {
  std::error_code error;
  if (source.starts_with("groom:") || !std::filesystem::exists(source, error)) return source;
  return std::filesystem::absolute(source).lexically_normal().string();
}

void refuseUnmirrored(const Scene& scene, const std::string& file) {
  const auto refuse = [&](const std::string& key) {
    throw UsageError(file + ": " + key + " is not mirrored by the study's reference, leave it out");
  };
  for (std::size_t i = 0; i < scene.assets.size(); ++i)
    if (!scene.assets[i].root_image.empty()) refuse("assets[" + std::to_string(i) + "].root_image");
  if (!scene.meshes.empty()) refuse("meshes");
  if (scene.near_fade) refuse("near_fade");
  if (scene.lens) refuse("lens");
  if (scene.head && *scene.head) refuse("head");
  if (scene.display != FLK_DISPLAY_SHADED || scene.coloring != StrandColoring::none) refuse("show");
  if (scene.lights.empty() && !scene.sky && !scene.ambient_sh && scene.ambient == glm::dvec3(0.0))
    throw UsageError(file + ": lights is empty and nothing else shines, a study needs light");
}

void place(const SceneAsset& wanted, UpAxis up, double matrix[16]) {
  const double c = std::cos(wanted.turn_deg * kDegree) * wanted.scale, s = std::sin(wanted.turn_deg * kDegree) * wanted.scale;
  std::fill(matrix, matrix + 16, 0.0);
  matrix[0] = matrix[5] = matrix[10] = wanted.scale;
  matrix[15] = 1;
  if (up == UpAxis::Z) matrix[0] = matrix[5] = c, matrix[1] = s, matrix[4] = -s;
  else matrix[0] = matrix[10] = c, matrix[2] = -s, matrix[8] = s;
  for (int i = 0; i < 3; ++i) matrix[12 + i] = wanted.position[i];
}

// As `forelock preview` understands the keys of a scene.
void look(SubjectAsset& asset) {
  const SceneAsset& wanted = asset.wanted;
  asset.material = wanted.material;
  asset.follow = {wanted.follow.count, float(wanted.follow.radius_mm * 1e-3), float(wanted.follow.spread_tip), wanted.follow.seed};
  asset.flags = wanted.ignore_colors ? uint32_t(FLK_HAIR_IGNORE_COLORS) : 0u;
  double scale = double(asset.material.width_scale);
  if (wanted.width_mm > 0) {
    scale = std::min(wanted.width_mm / (2e3 * double(asset.info.max_radius)), 1e6);
  } else if (!asset.info.has_radii) {
    scale *= followWidthScale(asset.info, wanted.follow.count);
  }
  asset.material.width_scale = float(scale);
  if (!wanted.color_given && asset.info.has_colors && !wanted.ignore_colors)
    std::fill(asset.material.color, asset.material.color + 3, 1.0f);
  asset.scale = wanted.scale;
}

}  // namespace

Subject openSubject(const Options& options) {
  Subject subject;
  subject.has_setting = !options.scene.empty();
  if (subject.has_setting) {
    try {
      subject.scene = loadScene(options.scene);
    } catch (const SceneError& error) {
      throw UsageError(options.scene + ": " + error.what());
    }
    refuseUnmirrored(subject.scene, options.scene);
    subject.name = std::filesystem::path(options.scene).filename().string();
  } else {
    subject.scene.camera.up = options.z_up ? UpAxis::Z : UpAxis::Y;
  }
  if (!options.asset.empty()) {  // another asset in the same setting
    subject.scene.assets.resize(std::min<std::size_t>(subject.scene.assets.size(), 1));
    if (subject.scene.assets.empty()) subject.scene.assets.emplace_back();
    subject.scene.assets[0].source = options.asset;
    const bool groom = options.asset.starts_with("groom:");
    subject.name = groom ? options.asset : std::filesystem::path(options.asset).filename().string();
  }
  if (subject.scene.assets.empty()) throw UsageError(options.scene + ": has no asset, add --asset ASSET");
  subject.scene.head = false;
  for (SceneAsset& wanted : subject.scene.assets) {
    SubjectAsset& asset = subject.assets.emplace_back();
    {
      Progress progress("opening " + wanted.source);
      asset.opened = openAsset(wanted.source, [&](uint64_t done, uint64_t total) { progress.update(done, total); },
                               {wanted.points_per_strand});
    }
    for (const AssetMessage& message : *asset.opened.messages)
      if (message.severity != FLK_SEVERITY_INFO) std::fprintf(stderr, "forelock-study: %s\n", message.text.c_str());
    flkAssetGetInfo(asset.opened.asset.get(), &asset.info);
    wanted.source = fromAnywhere(wanted.source);
    asset.wanted = wanted;
    look(asset);
    if (!subject.has_setting) asset.flags |= FLK_HAIR_IGNORE_COLORS;  // the condition's material is the only colour
    place(wanted, subject.up(), asset.world_from_hair);
  }
  return subject;
}

FlkMaterial subjectMaterial(const Subject& subject, std::size_t asset, HairColor color) {
  return subject.has_setting ? subject.assets[asset].material : conditionMaterial(color);
}

std::vector<glm::vec3> subjectPoints(const Subject& subject, double& radius) {
  constexpr std::size_t kMost = 1u << 18;
  std::vector<glm::vec3> points;
  radius = 0;
  std::size_t vertices = 0;
  for (const SubjectAsset& asset : subject.assets) vertices += asset.info.vertex_count;
  for (const SubjectAsset& asset : subject.assets) {
    FlkStrands strands{};
    flkAssetGetStrands(asset.opened.asset.get(), &strands);
    const double* m = asset.world_from_hair;
    for (std::size_t v = 0; v < strands.vertex_count; v += vertices / kMost + 1) {
      const float* p = strands.positions + 3 * v;
      glm::dvec3 world(m[12], m[13], m[14]);
      for (int column = 0; column < 3; ++column)
        world += glm::dvec3(m[4 * column], m[4 * column + 1], m[4 * column + 2]) * double(p[column]);
      points.emplace_back(world);
    }
    const double follow = asset.follow.count ? double(asset.follow.radius) * std::max(double(asset.follow.spread_tip), 1.0) : 0.0;
    radius = std::max(radius, asset.scale * (follow + double(asset.info.max_radius * asset.material.width_scale)));
  }
  return points;
}

}  // namespace forelock::study
