// `forelock preview`: pictures of assets. SPDX-License-Identifier: MIT
#include "commands.h"
#include "preview.h"

#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace {

constexpr const char* kExamples =
    "The picture is framed and lit by itself. What each colouring shows: docs/preview.md.\n\n"
    "Examples:\n"
    "  forelock preview groom:long-wavy -o hair.png\n"
    "  forelock preview pony.tfx -o pony.png --up z --azimuth 120 --hair-color c9a26b\n"
    "  forelock preview pony.tfx -o pony.exr --size 1920x1080 --method exact     linear, half floats\n"
    "  forelock preview pony.tfx -o thin.png --width 0.08                        strands 80 um wide\n"
    "  forelock preview groom:paper-load -o load.png --camera 198k --no-head     a camera that the groom stores\n"
    "  forelock preview pony.tfx -o dense.png --follow 8 --tip-color d8a860      eight more strands beside each\n"
    "  forelock preview pony.tfx -o game.png --method hard                       opaque strands, no blending\n"
    "To judge an asset:\n"
    "  forelock preview pony.tfx -o sheet.png --sheet                            six views and six colourings\n"
    "  forelock preview pony.tfx -o bad.png --color bad                          strands to look at, in red\n"
    "  forelock preview pony.tfx -o bends.png --color curvature                  with its scale in the corner\n"
    "  forelock preview groom:long-wavy -o turn.png --turntable 12 --size 512x512\n"
    "  forelock preview pony.tfx -o pony.png --watch                             again whenever pony.tfx changes\n"
    "Many assets: OUT is a folder, which gets a picture of each, and overview.png of all:\n"
    "  forelock preview assets/hair -o pictures --recursive\n"
    "  forelock preview a.tfx b.hair groom:curly -o pictures --thumbnail 256\n"
    "A scene with lights, a sky, a lens, images of the scalp (docs/scene.md):\n"
    "  forelock preview --scene scene.json -o scene.png --background 202428\n"
    "  forelock preview --scene '{\"assets\": [{\"source\": \"pony.tfx\"}], \"size\": [800, 600]}' -o pony.png\n";

bool isFolder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

void refuseTogether(const PreviewArguments& arguments, bool batch) {
  if (arguments.turntable > 0 && arguments.sheet) {
    throw UsageError("--turntable and --sheet are two kinds of sheet, use one of them");
  }
  if (arguments.sheet && (!arguments.show.empty() || !arguments.camera.empty())) {
    throw UsageError("--sheet chooses its views and colours itself, leave out " +
                     std::string(arguments.show.empty() ? "--camera" : "--color"));
  }
  if (arguments.thumbnail > 0 && !arguments.size.empty()) {
    throw UsageError("--thumbnail and --size both say how large, use one of them");
  }
  if (arguments.recursive && !batch) {
    throw UsageError("--recursive looks through a folder, but ASSET is none");
  }
  if (arguments.watch && (batch || arguments.json)) {
    throw UsageError(batch ? "--watch draws one asset, name a file" : "--watch prints a line a picture, leave out --json");
  }
}

int runPreview(const CLI::App& command, PreviewArguments& arguments) {
  const bool batch = arguments.assets.size() > 1 || (arguments.assets.size() == 1 && isFolder(arguments.assets[0]));
  arguments.asset = arguments.assets.empty() ? "" : arguments.assets[0];
  refuseTogether(arguments, batch);
  if (batch && (isImagePath(arguments.out) || std::filesystem::is_regular_file(arguments.out))) {
    throw UsageError(arguments.out + ": of several assets or a folder OUT must be a folder; it is made if it is missing");
  }
  if (!batch && (!isImagePath(arguments.out) || std::filesystem::path(arguments.out).extension() == ".pfm")) {
    throw UsageError(arguments.out + ": no picture format of this extension, use .png or .exr");
  }
  if (!arguments.watch) {
    previewScene(command, arguments);  // what is wrong with the options is said before a device is looked for
  }
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
  int exit_code = kDone;
  if (batch) {
    exit_code = runPreviewBatch(command, arguments, *host);
  } else if (arguments.watch) {
    exit_code = runPreviewWatch(command, arguments, *host);
  } else {
    printPreview(arguments, *host, drawPreview(*host, previewScene(command, arguments), arguments, arguments.out));
  }
  for (const std::string& message : host->validationMessages()) {
    std::fprintf(stderr, "forelock: validation: %s\n", message.c_str());
  }
  return host->validationMessages().empty() ? exit_code : kFailed;
}

}  // namespace

void addPreviewCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("preview", "Draw a picture of an asset, or of many.");
  auto arguments = std::make_shared<PreviewArguments>();
  addSceneOptions(*command, *arguments, &arguments->assets);
  command->add_option("-o,--out", arguments->out, "The picture to write: .png (sRGB) or .exr (linear); of several assets a folder")
      ->required()->type_name("OUT");
  command->add_option("--turntable", arguments->turntable, "Views all around, OUT-000 and on, and OUT as their sheet")
      ->check(CLI::Range(2u, 999u))->type_name("N");
  command->add_flag("--sheet", arguments->sheet, "One picture to judge the asset by: labelled views and colourings");
  command->add_option("--thumbnail", arguments->thumbnail, "A small picture, quickly: 256 or 512 pixels a side")
      ->check(CLI::IsMember({256u, 512u}))->type_name("PX");
  command->add_flag("--watch", arguments->watch, "Draw again whenever the file changes, until Ctrl-C");
  command->add_flag("--recursive", arguments->recursive, "Also the folders in the folder");
  command->add_flag("--no-legend", arguments->no_legend, "Draw no scale into the corner of colourings");
  command->add_option("--device", arguments->device, "Part of its name [a discrete GPU, else the best there is]")
      ->type_name("NAME");
  command->add_flag("--validation", arguments->validation, "With Vulkan's validation layers; a message is a failure");
  command->add_flag("--json", arguments->json, "Print the numbers as JSON");
  command->footer(kExamples);
  command->callback([command, arguments, &exit_code] { exit_code = runPreview(*command, *arguments); });
}

}  // namespace forelock::samples
