// SPDX-License-Identifier: MIT
#include "colored_stage.h"

#include "commands.h"
#include "strand_edit.h"
#include "strand_faults.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace forelock::samples {

namespace {

const glm::vec3 kBad(0.90f, 0.01f, 0.01f), kPale(0.42f), kGuide(1.0f, 0.50f, 0.03f), kFollower(0.10f, 0.16f, 0.26f);
constexpr double kSeenWidthPx = 2.0, kSeenLengthPx = 6.0;  // of strands that must not be overlooked

std::vector<float> oneColor(uint32_t vertices, const glm::vec3& color) {
  std::vector<float> colors(size_t{3} * vertices);
  for (size_t i = 0; i < colors.size(); ++i) {
    colors[i] = color[static_cast<int>(i % 3)];
  }
  return colors;
}

EditableStrands chosenStrands(const FlkStrands& all, const std::vector<uint8_t>& chosen, uint8_t wanted) {
  EditableStrands strands;
  strands.first_vertex.push_back(0);
  for (uint32_t s = 0; s < all.strand_count; ++s) {
    if ((chosen[s] != 0) == (wanted != 0)) {
      const uint32_t begin = all.first_vertex[s], end = all.first_vertex[s + 1];
      strands.positions.insert(strands.positions.end(), all.positions + size_t{3} * begin, all.positions + size_t{3} * end);
      strands.radii.insert(strands.radii.end(), all.radii + begin, all.radii + end);
      strands.first_vertex.push_back(strands.first_vertex.back() + end - begin);
    }
  }
  return strands;
}

class Colorer {
 public:
  Colorer(const Stage& plain, Stage& colored) : plain_(plain), colored_(colored) {
    const Camera camera = stageCamera(plain, 0, 1);
    pixel_m_ = 2.0 * glm::length(camera.eye - camera.target) * std::tan(0.5 * camera.vertical_fov) / plain.scene.height;
  }

  void add(size_t index, const EditableStrands& strands, double opacity, bool follow) {
    if (strands.strands() == 0) {
      return;
    }
    const StagedAsset& from = plain_.assets[index];
    StagedAsset& asset = colored_.assets.emplace_back();
    auto opened = std::make_shared<OpenedAsset>(assetOf(strands.view(), from.opened->label));
    opened->recipe = from.opened->recipe;
    asset.opened = std::move(opened);
    flkAssetGetInfo(asset.opened->asset.get(), &asset.info);
    asset.info.has_radii = from.info.has_radii;
    asset.material = from.material;
    FlkMaterial& m = asset.material;
    std::fill(m.color, m.color + 3, 1.0f);
    m.tip_blend = m.specular_r = m.specular_trt = 0.0f;
    m.diffuse = 1.0f;
    m.opacity_root = m.opacity_tip = static_cast<float>(opacity);
    asset.follow = follow ? from.follow : FlkFollowStrands{};
    asset.reflectance = glm::dvec3(1.0);
    asset.width_mm = from.width_mm;
    std::copy(from.world_from_hair, from.world_from_hair + 16, asset.world_from_hair);
    colored_.scene.assets.push_back(plain_.scene.assets[index]);
  }

  // A pixel in the asset's unit.
  double pixelOf(size_t index) const { return pixel_m_ / plain_.scene.assets[index].scale; }

  void widen(size_t index, EditableStrands& strands, double width_px) const {
    const double scale = std::max(static_cast<double>(plain_.assets[index].material.width_scale), 1e-12);
    const float least = static_cast<float>(std::min(0.5 * width_px * pixelOf(index) / scale, 1e6));
    for (float& radius : strands.radii) {
      radius = std::max(radius, least);
    }
  }

  // Strands below a few pixels grow from their roots.
  void lengthen(size_t index, EditableStrands& strands) const {
    const FlkStrands view = strands.view();
    const std::vector<float> lengths = strandLengths(view);
    for (uint32_t s = 0; s < strands.strands(); ++s) {
      const uint32_t begin = strands.first_vertex[s];
      const double factor = kSeenLengthPx * pixelOf(index) / static_cast<double>(lengths[begin]);
      for (uint32_t v = begin + 1; factor > 1.0 && v < strands.first_vertex[s + 1]; ++v) {
        for (size_t axis = 0; axis < 3; ++axis) {
          const double root = static_cast<double>(strands.positions[size_t{3} * begin + axis]);
          float& p = strands.positions[size_t{3} * v + axis];
          p = static_cast<float>(root + (static_cast<double>(p) - root) * factor);
        }
      }
    }
  }

 private:
  const Stage& plain_;
  Stage& colored_;
  double pixel_m_;
};

FlkStrands strandsOf(const StagedAsset& asset) {
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
  return strands;
}

std::vector<float> valuesOf(const StagedAsset& asset, StrandColoring coloring) {
  const FlkStrands strands = strandsOf(asset);
  switch (coloring) {
    case StrandColoring::curvature: return strandCurvature(strands);
    case StrandColoring::length: return strandLengths(strands);
    case StrandColoring::segments: return segmentRatios(strands);
    default: {
      std::vector<float> diameters = strandDiameters(strands);
      for (float& diameter : diameters) {
        diameter *= asset.material.width_scale;
      }
      return diameters;
    }
  }
}

// One scale for all assets.
void showScale(const Stage& plain, StrandColoring coloring, Colorer& colorer, Legend& legend) {
  std::vector<std::vector<float>> values;
  std::vector<float> all;
  for (const StagedAsset& asset : plain.assets) {
    values.push_back(valuesOf(asset, coloring));
    all.insert(all.end(), values.back().begin(), values.back().end());
  }
  const ColorScale scale = coloring == StrandColoring::segments ? ColorScale{0.25, 4.0, true}
                                                                : usualScale(all, coloring == StrandColoring::curvature);
  switch (coloring) {
    case StrandColoring::curvature: legend = scaleLegend("curvature (rad per unit)", scale); break;
    case StrandColoring::length: legend = scaleLegend("length (unit of the asset)", scale); break;
    case StrandColoring::segments: legend = scaleLegend("segment by its strand's mean", scale); break;
    default: legend = scaleLegend("thickness (unit of the asset)", scale); break;
  }
  if (coloring == StrandColoring::curvature) {
    legend.notes.push_back("red: turns as on a circle of radius " + shortNumber(1.0 / scale.red) + " and less");
  }
  for (size_t i = 0; i < plain.assets.size(); ++i) {
    EditableStrands strands = editableStrands(strandsOf(plain.assets[i]), true);
    strands.colors = scaleColors(values[i], scale);
    colorer.add(i, strands, 1.0, true);
  }
}

void showGroups(const Stage& plain, Colorer& colorer, Legend& legend) {
  legend.title = "groups";
  bool any = false;
  uint32_t number = 0;
  for (size_t i = 0; i < plain.assets.size(); ++i) {
    const OpenedAsset& opened = *plain.assets[i].opened;
    EditableStrands strands = editableStrands(strandsOf(plain.assets[i]), true);
    strands.colors = oneColor(strands.vertices(), distinctColor(number));
    if (opened.groups.size() == strands.strands() && !opened.group_names.empty()) {
      any = true;
      for (uint32_t s = 0; s < strands.strands(); ++s) {
        const glm::vec3 color = distinctColor(number + opened.groups[s]);
        for (uint32_t v = strands.first_vertex[s]; v < strands.first_vertex[s + 1]; ++v) {
          std::copy(&color.x, &color.x + 3, &strands.colors[size_t{3} * v]);
        }
      }
      for (const std::string& name : opened.group_names) {
        legend.swatches.emplace_back(distinctColor(number++), name);
      }
    } else {
      legend.swatches.emplace_back(distinctColor(number++), std::filesystem::path(opened.label).filename().string());
    }
    colorer.add(i, strands, 1.0, true);
  }
  if (!any) {
    legend.notes.push_back(plain.assets.size() > 1 ? "no asset has groups: a colour an asset" : "the asset has no groups: one colour for all of it");
  }
}

void showGuides(const Stage& plain, Colorer& colorer, Legend& legend) {
  legend.title = "guides";
  bool any = false;
  for (size_t i = 0; i < plain.assets.size(); ++i) {
    const FlkFollowStrands& follow = plain.assets[i].follow;
    EditableStrands strands = editableStrands(strandsOf(plain.assets[i]), true);
    if (follow.count > 0) {
      any = true;
      strands.colors = oneColor(strands.vertices(), kFollower);
      colorer.add(i, strands, 0.12, true);
    }
    strands.colors = oneColor(strands.vertices(), kGuide);
    colorer.widen(i, strands, follow.count > 0 ? 0.5 * kSeenWidthPx : 0.0);
    colorer.add(i, strands, 1.0, false);
  }
  legend.swatches.emplace_back(kGuide, "strands of the file");
  if (any) {
    legend.swatches.emplace_back(kFollower, "follow strands beside them");
  } else {
    legend.notes.push_back("no follow strands are grown, so all strands are drawn as guides; --follow N grows N beside each");
  }
}

void showBad(const Stage& plain, Colorer& colorer, Legend& legend) {
  legend.title = "strands to look at";
  uint64_t bad = 0;
  for (size_t i = 0; i < plain.assets.size(); ++i) {
    const StagedAsset& asset = plain.assets[i];
    const FlkStrands all = strandsOf(asset);
    const StrandFaults faults = findStrandFaults(all);
    EditableStrands good = chosenStrands(all, faults.of, 0), wrong = chosenStrands(all, faults.of, 1);
    good.colors = oneColor(good.vertices(), kPale);
    wrong.colors = oneColor(wrong.vertices(), kBad);
    colorer.widen(i, wrong, kSeenWidthPx);
    colorer.lengthen(i, wrong);
    colorer.add(i, good, 0.25, true);
    colorer.add(i, wrong, 1.0, false);
    bad += faults.strands;
    const std::string whose = plain.assets.size() > 1 ? asset.opened->label + ": " : "";
    legend.notes.push_back(whose + describeFaults(faults));
    if (asset.info.strands_in_source > asset.info.strand_count) {
      legend.notes.push_back(whose + groupedDigits(asset.info.strands_in_source - asset.info.strand_count) +
                             " more of the source cannot be drawn; `forelock inspect` says why");
    }
  }
  legend.swatches = {{kBad, groupedDigits(bad) + (bad == 1 ? " strand" : " strands")}, {kPale, "the others"}};
}

}  // namespace

Stage coloredStage(const Stage& plain, StrandColoring coloring) {
  Stage stage;
  stage.scene = plain.scene;
  stage.scene.assets.clear();
  stage.scene.coloring = coloring;
  stage.scene.display = FLK_DISPLAY_SHADED;
  stage.scene.method = FLK_METHOD_CORE_TAIL;  // the nearest eight in order; without lights a cheap shade is the full one
  stage.scene.k = stage.scene.k_sort = 0;
  stage.scene.tail = FLK_TAIL_DEFAULT;
  stage.scene.low_shade = FLK_LOW_SHADE_DEFAULT;
  stage.meshes = plain.meshes;
  stage.seen = plain.seen;
  stage.radius = plain.radius;
  stage.notes = plain.notes;
  Colorer colorer(plain, stage);
  switch (coloring) {
    case StrandColoring::groups: showGroups(plain, colorer, stage.legend); break;
    case StrandColoring::guides: showGuides(plain, colorer, stage.legend); break;
    case StrandColoring::bad: showBad(plain, colorer, stage.legend); break;
    default: showScale(plain, coloring, colorer, stage.legend); break;
  }
  return stage;
}

}  // namespace forelock::samples
