// SPDX-License-Identifier: MIT
#include "preview.h"

#include "commands.h"
#include "contact_sheet.h"
#include "progress.h"

#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

constexpr const char* kStages[FLK_STAGE_COUNT] = {"clear", "shadow", "capture", "resolve", "prepare", "output"};

// All views of a turntable side by side without gaps, each averaged down so that the sheet is at most about 2048 pixels wide.
class Strip {
 public:
  Strip(uint32_t count, uint32_t width, uint32_t height) {
    columns_ = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const uint32_t factor = std::max(1u, (columns_ * width + 2047) / 2048);
    width_ = (width + factor - 1) / factor;
    height_ = (height + factor - 1) / factor;
    image = Image(columns_ * width_, (count + columns_ - 1) / columns_ * height_);
  }

  void place(uint32_t index, const Image& view) {
    const Image small = shrink(view, width_, height_);
    for (uint32_t y = 0; y < std::min(height_, small.height); ++y) {
      std::copy_n(small.pixel(0, y), size_t{4} * std::min(width_, small.width),
                  image.pixel(index % columns_ * width_, index / columns_ * height_ + y));
    }
  }

  Image image;

 private:
  uint32_t columns_, width_, height_;
};

const char* deviceKind(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return "the processor";
    default: return "another kind";
  }
}

nlohmann::ordered_json legendJson(const Legend& legend) {
  nlohmann::ordered_json json;
  json["title"] = legend.title;
  json["marks"] = nlohmann::ordered_json::array();
  for (const auto& [share, text] : legend.marks) {
    json["marks"].push_back({share, text});
  }
  json["colors"] = nlohmann::ordered_json::array();
  for (const auto& [color, text] : legend.swatches) {
    json["colors"].push_back(text);
  }
  json["notes"] = legend.notes;
  return json;
}

void printJson(const PreviewArguments& arguments, const HeadlessHost& host, const Stage& stage, const Picture& picture) {
  nlohmann::ordered_json json;
  json["out"] = arguments.out;
  json["device"] = host.deviceName();
  json["driver"] = host.driverName();
  json["size"] = {stage.scene.width, stage.scene.height};
  json["method"] = methodNames()[stage.scene.method];
  json["tail"] = tailNames()[stage.scene.tail];
  json["capture"] = captureNames()[stage.scene.capture];
  json["lights"] = stage.scene.lights.size();
  json["show"] = shownName(stage.scene);
  if (!stage.legend.title.empty()) {
    json["legend"] = legendJson(stage.legend);
  }
  json["notes"] = stage.notes;
  json["exposure"] = picture.exposure;
  json["segments"] = picture.plan.segment_count;
  json["hair_pixels"] = picture.hair_pixels;
  json["fragments"] = picture.statistics.fragments;
  json["overflow_fragments"] = picture.statistics.overflow_fragments;
  json["mean_layers"] = picture.meanLayers();
  for (int stage_index = 0; stage_index < FLK_STAGE_COUNT; ++stage_index) {
    const double ms = picture.statistics.milliseconds[stage_index];
    json["milliseconds"][kStages[stage_index]] = ms >= 0.0 ? nlohmann::ordered_json(ms) : nlohmann::ordered_json();
  }
  json["bytes_persistent"] = picture.plan.bytes_persistent;
  json["bytes_transient"] = picture.plan.bytes_transient;
  json["left_out"] = picture.omissions;
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // a path need not be UTF-8
  std::printf("%s\n", json.dump(2, ' ', false, replace).c_str());
}

void printNotes(const Stage& stage) {
  if (!stage.legend.title.empty()) {
    std::printf("  colours     %s\n", legendText(stage.legend).c_str());
  }
  for (const std::string& note : stage.legend.notes) {
    std::printf("              %s\n", note.c_str());
  }
  for (const std::string& note : stage.notes) {
    std::printf("  note        %s\n", note.c_str());
  }
}

void printText(const PreviewArguments& arguments, const HeadlessHost& host, const Stage& stage, const Picture& picture) {
  const FlkStatistics& statistics = picture.statistics;
  std::printf("%s\n", arguments.out.c_str());
  if (arguments.turntable > 0) {
    std::printf("  views       %u, %s and on; the numbers are the last one's\n", arguments.turntable,
                numberedPath(arguments.out, 0).c_str());
  }
  std::printf("  device      %s (%s, %s)\n", host.deviceName().c_str(), deviceKind(host.deviceType()),
              host.driverName().c_str());
  std::printf("  size        %u x %u%s\n", stage.scene.width, stage.scene.height, arguments.sheet ? " a tile" : "");
  std::printf("  method      %s\n", methodText(stage.scene).c_str());
  if (stage.scene.display == FLK_DISPLAY_SHADED && stage.scene.coloring == StrandColoring::none) {
    std::printf("  exposure    %.4g%s\n", picture.exposure,
                stage.scene.exposure > 0.0 ? "" : " (chosen; --exposure X keeps it)");
  }
  printNotes(stage);
  std::printf("  hair        %s segments, %s pixels, %s fragments, %.1f layers on average\n",
              groupedDigits(picture.plan.segment_count).c_str(), groupedDigits(picture.hair_pixels).c_str(),
              groupedDigits(statistics.fragments).c_str(), picture.meanLayers());
  std::printf("  time       ");
  double total = 0.0;
  for (int i = 0; i < FLK_STAGE_COUNT; ++i) {
    if (statistics.milliseconds[i] >= 0.0) {
      std::printf(" %s %.2f", kStages[i], statistics.milliseconds[i]);
      total += statistics.milliseconds[i];
    }
  }
  std::printf(", together %.2f ms\n", total);
  std::printf("  memory      %s hair, %s of the view while it draws\n",
              readableBytes(picture.plan.bytes_persistent).c_str(), readableBytes(picture.plan.bytes_transient).c_str());
  for (size_t i = 0; i < picture.omissions.size(); ++i) {
    std::printf("  %-11s %s\n", i == 0 ? "left out" : "", picture.omissions[i].c_str());
  }
  for (size_t i = 0; i < stage.assets.size(); ++i) {
    const StagedAsset& asset = stage.assets[i];
    if (asset.follow.count > 0) {
      std::printf("  strands     %s and %u follow strands beside each, within %.3g mm, of %s\n",
                  groupedDigits(asset.info.strand_count).c_str(), asset.follow.count, 1e3 * static_cast<double>(asset.follow.radius),
                  asset.opened->label.c_str());
    }
    const bool again = i > 0 && stage.assets[i - 1].opened->label == asset.opened->label;
    if (!asset.info.has_radii && stage.scene.assets[i].width_mm <= 0.0 && !again) {
      std::printf("  width       %.3g mm: %s has none, so a share of its size by its strands%s; --width MM changes it\n",
                  asset.width_mm, asset.opened->label.c_str(), asset.follow.count > 0 ? ", follow strands too" : "");
    }
  }
}

void warnOfPicture(const std::string& out, const Picture& picture) {
  if (picture.statistics.overflow_fragments > 0) {
    std::fprintf(stderr, "forelock: %s: %s of %s fragments did not fit into 1 GiB and are drawn as a sum; draw a smaller "
                         "--size or thinner strands (--width)\n", out.c_str(),
                 groupedDigits(picture.statistics.overflow_fragments).c_str(),
                 groupedDigits(picture.statistics.fragments).c_str());
  }
}

}  // namespace

Scene previewScene(const CLI::App& command, const PreviewArguments& arguments) {
  Scene scene = makeScene(command, arguments);
  const auto asked = [&](const char* option) { return command.count(option) > 0; };
  if (arguments.thumbnail > 0) {
    scene.width = scene.height = arguments.thumbnail;
    scene.core_taps = asked("--core-taps") ? scene.core_taps : 9;
    for (SceneLight& light : scene.lights) {
      light.shadow_size = asked("--shadow-size") ? light.shadow_size : std::min(light.shadow_size, 1024u);
    }
  }
  const uint32_t tile = arguments.sheet ? 384 : arguments.out.empty() || isImagePath(arguments.out) ? 0 : 512;
  if (tile > 0 && arguments.thumbnail == 0 && !asked("--size") && arguments.camera.empty()) {
    scene.width = scene.height = tile;
  }
  return scene;
}

Preview drawPreview(HeadlessHost& host, const Scene& scene, const PreviewArguments& arguments, const std::string& out) {
  Preview preview;
  host.messages().clear();
  if (arguments.sheet) {
    preview.picture.image = drawAssetSheet(host, scene, out, preview);
    savePicture(out, preview.picture.image);
    return preview;
  }
  preview.stage = openStage(scene);
  const Stage& stage = preview.stage;
  Painter painter(host, stage);
  const uint32_t views = std::max(arguments.turntable, 1u);
  Strip strip(views, stage.scene.width, stage.scene.height);
  double exposure = scene.exposure;
  int corner = -1;
  {
    Progress progress("drawing " + out);
    for (uint32_t i = 0; i < views; ++i) {
      progress.update(i, views);
      preview.picture = painter.draw(stageCamera(stage, i, views), exposure);
      exposure = preview.picture.exposure;  // one light for all views
      warnOfPicture(out, preview.picture);
      if (!arguments.no_legend) {
        drawLegend(preview.picture.image, stage.legend, corner);
      }
      if (arguments.turntable > 0) {
        savePicture(numberedPath(out, i), preview.picture.image);
        strip.place(i, preview.picture.image);
      }
    }
  }
  if (arguments.turntable > 0) {
    preview.picture.image = std::move(strip.image);
  }
  savePicture(out, preview.picture.image);
  if (preview.picture.hair_pixels == 0) {
    std::fprintf(stderr, "forelock: %s: no hair is in the picture; look at `forelock inspect`, or at --camera and "
                         "--width\n", out.c_str());
  }
  return preview;
}

void printPreview(const PreviewArguments& arguments, const HeadlessHost& host, const Preview& preview) {
  if (arguments.json) {
    printJson(arguments, host, preview.stage, preview.picture);
  } else {
    printText(arguments, host, preview.stage, preview.picture);
  }
}

}  // namespace forelock::samples
