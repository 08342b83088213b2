// `forelock preview`: a picture of an asset. SPDX-License-Identifier: MIT
#include "commands.h"
#include "picture.h"
#include "progress.h"
#include "scene_options.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace {

struct PreviewArguments : SceneArguments {
  std::string out, device;
  uint32_t turntable = 0;
  bool validation = false, json = false;
};

constexpr const char* kExamples =
    "The picture is framed and lit by itself; with --turntable OUT.png becomes a sheet of all views.\n\n"
    "Examples:\n"
    "  forelock preview groom:long-wavy -o hair.png\n"
    "  forelock preview pony.tfx -o pony.png --up z --azimuth 120 --hair-color c9a26b\n"
    "  forelock preview pony.tfx -o pony.exr --size 1920x1080 --method exact     linear, half floats\n"
    "  forelock preview pony.tfx -o thin.png --width 0.08                        strands 80 um wide\n"
    "  forelock preview groom:paper-load -o load.png --camera 198k --no-head     a camera that the groom stores\n"
    "  forelock preview pony.tfx -o dense.png --follow 8 --tip-color d8a860      eight more strands beside each\n"
    "  forelock preview pony.tfx -o game.png --method hard                       opaque strands, no blending\n"
    "  forelock preview pony.tfx -o layers.png --color layers                    how many fragments a pixel has\n"
    "  forelock preview groom:long-wavy -o turn.png --turntable 12 --size 512x512\n"
    "  forelock preview --scene scene.json -o scene.png --background 202428\n\n"
    "Several lights, a sky, a lens and images of the scalp: in scene files, docs/scene.md.\n";

constexpr const char* kStages[FLK_STAGE_COUNT] = {"clear", "shadow", "capture", "resolve", "prepare", "output"};

std::string numberedPath(const std::string& path, uint32_t number) {
  char suffix[16];
  std::snprintf(suffix, sizeof suffix, "-%03u", number);
  const std::filesystem::path p(path);
  return (p.parent_path() / (p.stem().string() + suffix + p.extension().string())).string();
}

void save(const std::string& path, const Image& image) {
  try {
    writeImage(path, image);
  } catch (const std::runtime_error& error) {
    throw AssetError(FLK_ERROR_IO, path + ": " + error.what());
  }
}

// All views side by side, each averaged down so that the sheet is at most about 2048 pixels wide.
class Sheet {
 public:
  Sheet(uint32_t count, uint32_t width, uint32_t height) {
    columns_ = static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    shrink_ = std::max(1u, (columns_ * width + 2047) / 2048);
    width_ = std::max(1u, width / shrink_);
    height_ = std::max(1u, height / shrink_);
    shrink_ = std::min({shrink_, width, height});
    image = Image(columns_ * width_, (count + columns_ - 1) / columns_ * height_);
  }

  void place(uint32_t index, const Image& view) {
    const float share = 1.0f / static_cast<float>(shrink_ * shrink_);
    for (uint32_t y = 0; y < height_; ++y) {
      for (uint32_t x = 0; x < width_; ++x) {
        float* to = image.pixel(index % columns_ * width_ + x, index / columns_ * height_ + y);
        for (uint32_t j = 0; j < shrink_; ++j) {
          for (uint32_t i = 0; i < shrink_; ++i) {
            const float* from = view.pixel(x * shrink_ + i, y * shrink_ + j);
            for (int channel = 0; channel < 4; ++channel) {
              to[channel] += share * from[channel];
            }
          }
        }
      }
    }
  }

  Image image;

 private:
  uint32_t columns_, shrink_, width_, height_;
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
  json["show"] = displayNames()[stage.scene.display];
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

void printText(const PreviewArguments& arguments, const HeadlessHost& host, const Stage& stage, const Picture& picture) {
  const FlkStatistics& statistics = picture.statistics;
  std::printf("%s\n", arguments.out.c_str());
  if (arguments.turntable > 0) {
    std::printf("  views       %u, %s and on; the numbers are the last one's\n", arguments.turntable,
                numberedPath(arguments.out, 0).c_str());
  }
  std::printf("  device      %s (%s, %s)\n", host.deviceName().c_str(), deviceKind(host.deviceType()),
              host.driverName().c_str());
  std::printf("  size        %u x %u\n", stage.scene.width, stage.scene.height);
  std::printf("  method      %s\n", methodText(stage.scene).c_str());
  if (stage.scene.display == FLK_DISPLAY_SHADED) {
    std::printf("  exposure    %.4g%s\n", picture.exposure,
                stage.scene.exposure > 0.0 ? "" : " (chosen; --exposure X keeps it)");
  }
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
  for (const StagedAsset& asset : stage.assets) {
    if (asset.follow.count > 0) {
      std::printf("  strands     %s and %u follow strands beside each, within %.3g mm, of %s\n",
                  groupedDigits(asset.info.strand_count).c_str(), asset.follow.count, 1e3 * static_cast<double>(asset.follow.radius),
                  asset.opened.label.c_str());
    }
    const SceneAsset& wanted = stage.scene.assets[static_cast<size_t>(&asset - stage.assets.data())];
    if (!asset.info.has_radii && wanted.width_mm <= 0.0) {
      std::printf("  width       %.3g mm: %s has none, so a share of its size by its strands%s; --width MM changes it\n",
                  asset.width_mm, asset.opened.label.c_str(), asset.follow.count > 0 ? ", follow strands too" : "");
    }
  }
}

int runPreview(const CLI::App& command, const PreviewArguments& arguments) {
  if (!isImagePath(arguments.out) || std::filesystem::path(arguments.out).extension() == ".pfm") {
    throw UsageError(arguments.out + ": no picture format of this extension, use .png or .exr");
  }
  const Scene scene = makeScene(command, arguments);
  HeadlessOptions options;
  options.validation = arguments.validation;
  options.device_name = arguments.device;
  std::string error;
  const std::unique_ptr<HeadlessHost> host = HeadlessHost::create(options, error);
  if (!host) {
    std::fprintf(stderr, "forelock: no usable device: %s; install a Vulkan 1.3 driver (Debian without a GPU: "
                         "mesa-vulkan-drivers), or look with `vulkaninfo --summary`\n", error.c_str());
    return kNoDevice;
  }
  const Stage stage = openStage(scene);
  Painter painter(*host, stage);
  const uint32_t views = std::max(arguments.turntable, 1u);
  Sheet sheet(views, stage.scene.width, stage.scene.height);
  Picture picture;
  double exposure = scene.exposure;
  {
    Progress progress("drawing " + arguments.out);
    for (uint32_t i = 0; i < views; ++i) {
      progress.update(i, views);
      picture = painter.draw(stageCamera(stage, i, views), exposure);
      exposure = picture.exposure;  // one light for all views
      if (picture.statistics.overflow_fragments > 0) {
        std::fprintf(stderr, "forelock: %s: %s of %s fragments did not fit into 1 GiB and are drawn as a sum; draw a smaller "
                             "--size or thinner strands (--width)\n", arguments.out.c_str(),
                     groupedDigits(picture.statistics.overflow_fragments).c_str(),
                     groupedDigits(picture.statistics.fragments).c_str());
      }
      if (arguments.turntable > 0) {
        save(numberedPath(arguments.out, i), picture.image);
        sheet.place(i, picture.image);
      }
    }
  }
  save(arguments.out, arguments.turntable > 0 ? sheet.image : picture.image);
  if (arguments.json) {
    printJson(arguments, *host, stage, picture);
  } else {
    printText(arguments, *host, stage, picture);
  }
  if (picture.hair_pixels == 0) {
    std::fprintf(stderr, "forelock: %s: no hair is in the picture; look at `forelock inspect`, or at --camera and "
                         "--width\n", arguments.out.c_str());
  }
  for (const std::string& message : host->validationMessages()) {
    std::fprintf(stderr, "forelock: validation: %s\n", message.c_str());
  }
  return host->validationMessages().empty() ? kDone : kFailed;
}

}  // namespace

void addPreviewCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("preview", "Draw a picture of an asset.");
  auto arguments = std::make_shared<PreviewArguments>();
  addSceneOptions(*command, *arguments);
  command->add_option("-o,--out", arguments->out, "The picture to write: .png (sRGB) or .exr (linear)")
      ->required()->type_name("OUT");
  command->add_option("--turntable", arguments->turntable, "Views all around, OUT-000 and on, and OUT as their sheet")
      ->check(CLI::Range(2u, 999u))->type_name("N");
  command->add_option("--device", arguments->device, "Part of its name [a discrete GPU, else the best there is]")
      ->type_name("NAME");
  command->add_flag("--validation", arguments->validation, "With Vulkan's validation layers; a message is a failure");
  command->add_flag("--json", arguments->json, "Print the numbers as JSON");
  command->footer(kExamples);
  command->callback([command, arguments, &exit_code] { exit_code = runPreview(*command, *arguments); });
}

}  // namespace forelock::samples
