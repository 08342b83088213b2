// SPDX-License-Identifier: MIT
#include "view_command.h"

#include "commands.h"
#include "scene_options.h"
#include "viewer.h"

#include <cstdio>
#include <memory>

namespace forelock::samples {

namespace {

struct ViewArguments : SceneArguments {
  std::vector<std::string> assets;
  std::string device, script, window, beside;
  uint32_t frames = 0;
  bool validation = false, forget = false;
};

constexpr const char* kExamples =
    "In the window: drag turns, the wheel goes nearer, a click picks a strand, F1 has all keys. docs/viewer.md has pictures.\n\n"
    "Examples:\n"
    "  forelock view groom:long-wavy\n"
    "  forelock view pony.tfx --up z\n"
    "  forelock view pony.tfx --beside exact                two methods, a divider between them\n"
    "  forelock view --scene scene.json\n"
    "  forelock view                                        an empty window to drag files into\n"
    "  xvfb-run forelock view pony.tfx --frames 3           for tests: three pictures, then it quits\n";

int runView(const CLI::App& command, const ViewArguments& arguments) {
  ViewerOptions options;
  SceneArguments scene = arguments;
  if (arguments.assets.empty() && arguments.scene.empty()) {
    scene.asset = "groom:none";  // options still make a scene
    options.scene = makeScene(command, scene);
    options.scene.assets.clear();
  } else {
    scene.asset = arguments.assets.empty() ? "" : arguments.assets[0];
    options.scene = makeScene(command, scene);
    for (size_t i = 1; i < arguments.assets.size(); ++i) {
      SceneAsset asset = options.scene.assets[0];
      asset.source = arguments.assets[i];
      options.scene.assets.push_back(asset);
    }
  }
  options.device = arguments.device;
  options.script = arguments.script;
  options.second_method = arguments.beside;
  options.frames = arguments.frames;
  options.validation = arguments.validation;
  options.forget = arguments.forget;
  if (!arguments.window.empty()) {
    char rest = 0;
    if (std::sscanf(arguments.window.c_str(), "%dx%d%c", &options.width, &options.height, &rest) != 2 || options.width < 320 || options.height < 240 ||
        options.width > 16384 || options.height > 16384) {
      throw UsageError("--window is " + arguments.window + ", must be WIDTHxHEIGHT, from 320x240 to 16384x16384");
    }
  }
  return runViewer(options);
}

}  // namespace

void addViewCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("view", "A window to see hair in, to light it, to compare methods and what they cost.");
  auto arguments = std::make_shared<ViewArguments>();
  addSceneOptions(*command, *arguments, &arguments->assets);
  command->add_option("--beside", arguments->beside, "A second method on the right of a divider")
      ->check(CLI::IsMember(methodNames()))->type_name("NAME");
  command->add_option("--window", arguments->window, "Of the window [as it was the last time]")->type_name("WxH");
  command->add_option("--device", arguments->device, "Part of its name [a discrete GPU, else the best there is]")->type_name("NAME");
  command->add_flag("--forget", arguments->forget, "Neither read nor keep settings and recent files");
  command->add_option("--frames", arguments->frames, "Draw so many full pictures, then quit")->check(CLI::Range(1u, 1000000u))->type_name("N");
  command->add_option("--script", arguments->script, "Steps to take as a person would (docs/viewer.md), then quit")->type_name("FILE");
  command->add_flag("--validation", arguments->validation, "With Vulkan's validation layers; a message is a failure");
  command->footer(kExamples);
  command->callback([command, arguments, &exit_code] { exit_code = runView(*command, *arguments); });
}

}  // namespace forelock::samples
