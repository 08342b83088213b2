// `forelock preview --sheet`: views and colourings of one asset in one picture. SPDX-License-Identifier: MIT
#include "colored_stage.h"
#include "commands.h"
#include "contact_sheet.h"
#include "preview.h"
#include "progress.h"
#include "strand_faults.h"

#include <cstdio>

namespace forelock::samples {

namespace {

struct View {
  const char* name;
  double azimuth_deg, elevation_deg;
};

constexpr View kViews[] = {{"three-quarter", 32.0, 8.0}, {"front", 0.0, 0.0}, {"its left", 90.0, 0.0},
                           {"back", 180.0, 0.0},         {"its right", -90.0, 0.0}, {"top", 0.0, 90.0}};
constexpr StrandColoring kColorings[] = {StrandColoring::thickness, StrandColoring::curvature, StrandColoring::bad};
constexpr uint32_t kTiles = 12, kColumns = 4;

std::string rangeText(float low, float high) {
  return low == high ? shortNumber(static_cast<double>(low))
                     : shortNumber(static_cast<double>(low)) + " to " + shortNumber(static_cast<double>(high));
}

std::string factsOf(const Stage& stage) {
  std::string text;
  for (const StagedAsset& asset : stage.assets) {
    const FlkAssetInfo& info = asset.info;
    text += asset.opened->format + ", " + groupedDigits(info.strand_count) + " strands";
    if (info.strands_in_source != info.strand_count) {
      text += " of " + groupedDigits(info.strands_in_source);
    }
    text += "\n" + groupedDigits(info.vertex_count) + " vertices, " +
            (info.min_vertices_per_strand == info.max_vertices_per_strand ? "" : std::to_string(info.min_vertices_per_strand) + " to ") +
            std::to_string(info.max_vertices_per_strand) + " a strand\nlength " + rangeText(info.min_length, info.max_length) + ", mean " +
            shortNumber(static_cast<double>(info.mean_length)) + "\nwidth " + rangeText(2.0f * info.min_radius, 2.0f * info.max_radius) +
            (info.has_radii ? "" : " (default)") + "\nsize ";
    for (int axis = 0; axis < 3; ++axis) {
      text += (axis ? " x " : "") + shortNumber(static_cast<double>(info.max_bounds[axis] - info.min_bounds[axis]));
    }
    text += "\nhas" + std::string(info.has_radii ? " widths" : "") + (info.has_root_uvs ? " root-UVs" : "") +
            (info.has_inverse_masses ? " masses" : "") + (info.has_colors ? " colours" : "") + " positions\n";
    for (const AssetFinding& finding : findingsOf(*asset.opened)) {
      if (finding.severity != FLK_SEVERITY_INFO) {
        text += finding.code + " x " + groupedDigits(finding.count) + "\n";
      }
    }
  }
  for (const std::string& note : stage.notes) {
    const std::string prefix = stage.assets[0].opened->label + ": ";
    text += (note.rfind(prefix, 0) == 0 ? note.substr(prefix.size()) : note) + "\n";
  }
  return text;
}

}  // namespace

Image drawAssetSheet(HeadlessHost& host, const Scene& wanted, const std::string& out, Preview& preview) {
  Scene scene = wanted;
  scene.coloring = StrandColoring::none;
  scene.display = FLK_DISPLAY_SHADED;
  scene.camera.placed.reset();
  scene.camera.azimuth_deg = kViews[0].azimuth_deg;
  scene.camera.elevation_deg = kViews[0].elevation_deg;
  preview.stage = openStage(scene);
  Stage& stage = preview.stage;
  std::string title;
  for (const StagedAsset& asset : stage.assets) {
    title += (title.empty() ? "" : ", ") + asset.opened->label;
  }
  ContactSheet sheet(layoutSheet(kTiles, stage.scene.width, stage.scene.height, kColumns, true), title);
  Progress progress("drawing " + out);
  uint32_t tile = 0;
  Painter painter(host, stage);
  Picture shaded;
  double exposure = scene.exposure;
  for (const View& view : kViews) {
    progress.update(tile, kTiles);
    stage.scene.camera.azimuth_deg = view.azimuth_deg;
    stage.scene.camera.elevation_deg = view.elevation_deg;
    const Picture picture = painter.draw(stageCamera(stage, 0, 1), exposure);
    exposure = picture.exposure;  // one light for all views
    sheet.place(tile++, picture.image, view.name);
    if (&view == kViews) {
      shaded = picture;
    }
  }
  stage.scene.camera.azimuth_deg = kViews[0].azimuth_deg;
  stage.scene.camera.elevation_deg = kViews[0].elevation_deg;
  const Camera camera = stageCamera(stage, 0, 1);
  for (const uint32_t display : {FLK_DISPLAY_ROOT_TIP, FLK_DISPLAY_LAYERS}) {
    progress.update(tile, kTiles);
    stage.scene.display = display;
    sheet.place(tile++, painter.draw(camera, 1.0).image, shortLegend(displayLegend(display), displayNames()[display]));
  }
  stage.scene.display = FLK_DISPLAY_SHADED;
  for (const StrandColoring coloring : kColorings) {
    progress.update(tile, kTiles);
    const Stage colored = coloredStage(stage, coloring);
    Painter color_painter(host, colored);
    sheet.place(tile++, color_painter.draw(camera, 1.0).image, shortLegend(colored.legend, shownName(colored.scene)));
    stage.legend.notes.insert(stage.legend.notes.end(), colored.legend.notes.begin(), colored.legend.notes.end());
  }
  sheet.placeText(tile, factsOf(stage), "", false);
  preview.picture = std::move(shaded);
  return std::move(sheet.image);
}

}  // namespace forelock::samples
