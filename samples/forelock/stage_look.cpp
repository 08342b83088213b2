// SPDX-License-Identifier: MIT
#include "commands.h"
#include "image.h"
#include "stage.h"
#include "strand_statistics.h"
#include "stray.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

glm::dvec3 mean(const float* rgb, size_t count) {
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < count; ++i) {
    sum += glm::dvec3(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
  }
  return sum / static_cast<double>(std::max<size_t>(count, 1));
}

void loadRootImage(const std::string& path, StagedAsset& asset) {
  if (!asset.info.has_root_uvs) {
    throw AssetError(FLK_ERROR_INVALID_ARGUMENT,
                     asset.opened->label + ": has no root UVs, which root_image needs: .tfx files and grooms have them");
  }
  Image image;
  try {
    image = readImage(path);
  } catch (const std::runtime_error& error) {
    throw AssetError(FLK_ERROR_IO, path + ": " + error.what());
  }
  asset.root_pixels.resize(size_t{3} * image.width * image.height);
  for (size_t i = 0; i < asset.root_pixels.size(); ++i) {
    const float value = image.rgba[i / 3 * 4 + i % 3];
    asset.root_pixels[i] = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
  }
  asset.root_image = {asset.root_pixels.data(), image.width, image.height};
}

// What a centimetre or millimetre is taken for where the library suspects that it is the asset's unit; else 1.
double suspectedUnit(const SceneAsset& wanted, const StagedAsset& asset) {
  const std::vector<AssetFinding> findings = findingsOf(*asset.opened);
  const bool suspect = std::any_of(findings.begin(), findings.end(), [](const AssetFinding& f) { return f.code == "UNIT_SUSPECT"; });
  if (!suspect || wanted.scale != 1.0) {
    return 1.0;
  }
  // The library looks at the farthest coordinate: of strands astray, or far from the origin, that is no size of the hair.
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  const std::vector<uint8_t> stray = findStrayStrands(strands);
  glm::vec3 low(1e30f), high(-1e30f);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    for (uint32_t v = strands.first_vertex[s]; (stray.empty() || stray[s] == 0) && v < strands.first_vertex[s + 1]; ++v) {
      const glm::vec3 p(strands.positions[size_t{3} * v], strands.positions[size_t{3} * v + 1], strands.positions[size_t{3} * v + 2]);
      low = glm::min(low, p), high = glm::max(high, p);
    }
  }
  const float size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  return size <= 10.0f ? 1.0 : size > 1000.0f ? 1000.0 : 100.0;
}

}  // namespace

void stageLook(const SceneAsset& wanted, StagedAsset& asset, std::vector<std::string>& notes) {
  asset.material = wanted.material;
  asset.follow = {wanted.follow.count, static_cast<float>(wanted.follow.radius_mm * 1e-3),
                  static_cast<float>(wanted.follow.spread_tip), wanted.follow.seed};
  asset.flags = wanted.ignore_colors ? FLK_HAIR_IGNORE_COLORS : 0;
  const double unit = suspectedUnit(wanted, asset);
  double scale = static_cast<double>(asset.material.width_scale);
  const double diameter_mm = 2e3 * static_cast<double>(asset.info.max_radius);
  if (wanted.width_mm > 0.0) {
    scale = std::min(wanted.width_mm * unit / diameter_mm, 1e6);
  } else if (!asset.info.has_radii) {
    scale *= followWidthScale(asset.info, wanted.follow.count);
  }
  if (unit != 1.0) {
    asset.material.fibre_spacing *= static_cast<float>(unit);
    asset.follow.radius *= static_cast<float>(unit);
    notes.push_back(asset.opened->label + ": coordinates suggest " + (unit > 100.0 ? "millimetres" : "centimetres") +
                    ", so millimetres of widths and what shadows take for the distance of fibres are " + shortNumber(unit) +
                    " times as large as for metres; `forelock convert --scale` makes it metres");
  }
  asset.material.width_scale = static_cast<float>(scale);
  asset.width_mm = diameter_mm * scale / unit;

  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  const bool own_colors = strands.colors && !wanted.ignore_colors;
  if (!wanted.root_image.empty()) {
    loadRootImage(wanted.root_image, asset);
  }
  if (!wanted.color_given && (own_colors || asset.root_image.width > 0)) {
    std::fill(asset.material.color, asset.material.color + 3, 1.0f);
  }
  const FlkMaterial& m = asset.material;
  const double tip = 0.5 * static_cast<double>(m.tip_blend);
  asset.reflectance = glm::mix(glm::dvec3(m.color[0], m.color[1], m.color[2]),
                               glm::dvec3(m.tip_color[0], m.tip_color[1], m.tip_color[2]), tip);
  if (own_colors) {
    asset.reflectance *= mean(strands.colors, strands.vertex_count);
  }
  if (asset.root_image.width > 0) {
    asset.reflectance *= mean(asset.root_pixels.data(), asset.root_pixels.size() / 3);
  }
}

}  // namespace forelock::samples
