// SPDX-License-Identifier: MIT
#include "scene_options.h"

#include "commands.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::samples {

namespace {

uint32_t indexOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<uint32_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

void readSize(const std::string& text, Scene& scene) {
  unsigned width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%ux%u%c", &width, &height, &rest) != 2 || width < 1 || height < 1 || width > 16384 ||
      height > 16384) {
    throw UsageError("--size is " + text + ", must be WIDTHxHEIGHT, each in [1, 16384], for example 1280x720");
  }
  scene.width = width;
  scene.height = height;
}

void turnLight(const std::string& text, Scene& scene) {
  double azimuth = 0.0, elevation = 0.0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%c", &azimuth, &elevation, &rest) != 2 ||
      !(std::abs(azimuth) <= 360.0 && std::abs(elevation) <= 90.0)) {
    throw UsageError("--light is " + text +
                     ", must be AZIMUTH,ELEVATION in degrees, [-360, 360] and [-90, 90], for example --light=-42,44");
  }
  const auto sun = std::find_if(scene.lights.begin(), scene.lights.end(),
                                [](const SceneLight& light) { return light.kind == FLK_LIGHT_DIRECTIONAL; });
  if (sun == scene.lights.end()) {
    throw UsageError("--light turns the scene's first directional light, but it has none");
  }
  sun->azimuth_deg = azimuth;
  sun->elevation_deg = elevation;
}

glm::dvec3 readColor(const char* option, const std::string& text) {
  glm::dvec3 linear;
  if (!parseHexColor(text, linear)) {
    throw UsageError(std::string(option) + " is " + text +
                     ", must be six hexadecimal digits of sRGB, for example 6b4226");
  }
  return linear;
}

}  // namespace

void addSceneOptions(CLI::App& command, SceneArguments& arguments, std::vector<std::string>* assets) {
  const auto given = [](const std::vector<std::string>& names) { return CLI::IsMember(names); };
  if (assets) {
    command.add_option("ASSET", *assets, "A strand file, a recipe or groom:NAME, or several, or a folder; not needed with --scene");
  } else {
    command.add_option("ASSET", arguments.asset, "A strand file, a recipe or groom:NAME; not needed with --scene");
  }
  command.add_option("--scene", arguments.scene, "A scene file (docs/scene.md), or '{...}', a scene itself; other options change what it says")
      ->type_name("FILE.json");
  command.add_option("--size", arguments.size, "Of the picture in pixels [1024x1024, or the stored camera's]")
      ->type_name("WxH");
  addOpenOptions(command, arguments.points_per_strand);

  const char* camera = "Camera";
  command.add_option("--azimuth", arguments.azimuth, "Degrees from the front to the hair's left [32]")
      ->check(CLI::Range(-360.0, 360.0))->type_name("DEG")->group(camera);
  command.add_option("--elevation", arguments.elevation, "Degrees above the horizon [8]")
      ->check(CLI::Range(-90.0, 90.0))->type_name("DEG")->group(camera);
  command.add_option("--up", arguments.up, "The asset's up axis: y or z [y]")
      ->check(given({"y", "z"}))->type_name("AXIS")->group(camera);
  command.add_option("--camera", arguments.camera, "A camera that the groom stores, instead of framing")
      ->type_name("NAME")->group(camera);

  const char* look = "Look";
  command.add_option("--hair-color", arguments.hair_color, "sRGB, for example 6b4226, 2a1a12, c9a26b")
      ->type_name("HEX")->group(look);
  command.add_option("--tip-color", arguments.tip_color, "sRGB that the hair's colour turns into towards the tips [none]")
      ->type_name("HEX")->group(look);
  command.add_option("--follow", arguments.follow,
                     "Strands beside each strand of the asset, within 1 mm of it, to thicken thin guides [0]")
      ->check(CLI::Range(0u, 1023u))->type_name("N")->group(look);
  command.add_option("--alpha", arguments.alpha, "Opacity of a pixel that a strand covers wholly [0.63]")
      ->check(CLI::Range(0.0, 1.0))->type_name("A")->group(look);
  command.add_option("--width", arguments.width_mm, "Diameter of the widest vertex, a unit being a metre [the asset's]")
      ->check(CLI::Range(1e-6, 1e6))->type_name("MM")->group(look);
  command.add_option("--light", arguments.light, "Where the directional light comes from, seen from the camera, degrees [-42,44]")
      ->type_name("AZ,EL")->group(look);
  command.add_option("--exposure", arguments.exposure, "What all light is multiplied by [chosen from a small first picture]")
      ->check(CLI::Range(1e-6, 1e6))->type_name("X")->group(look);
  command.add_flag("--no-shadow", arguments.no_shadow, "Hair casts no shadow on itself")->group(look);
  command.add_option("--shadow-size", arguments.shadow_size, "Texels of a side of a shadow map [2048]")
      ->check(CLI::Range(64u, 8192u))->type_name("N")->group(look);
  command.add_option("--background", arguments.background, "sRGB [transparent]")->type_name("HEX")->group(look);
  CLI::Option* head = command.add_flag("--head", arguments.head, "Draw the bust")->group(look);
  command.add_flag("--no-head", arguments.no_head, "Draw no bust [drawn under grooms that lie on it]")
      ->excludes(head)->group(look);
  command.add_option("--mesh", arguments.meshes, "An opaque mesh of a .gltf or .glb file beside the hair, or several: --mesh A --mesh B")
      ->type_name("FILE")->allow_extra_args(false)->group(look);
  command.add_option("--color", arguments.show,
                     "shaded; of the drawing: width (in pixels), depth, layers (fragments a pixel)\n"
                     "of the strands: strand (one a strand), root-tip, curvature, length, segments (each by its\n"
                     "strand's mean), thickness, groups, guides (beside follow strands), bad (faults in red)")
      ->check(given(displayNames()))->type_name("MODE")->group(look);

  const char* method = "Method (docs/methods.md section 6)";
  command.add_option("--method", arguments.method,
                     "core_tail: the nearest k in full quality, the rest cheaply [the default]\n"
                     "exact: all in full quality and in order\n"
                     "forward: all in full quality, shaded before they are sorted\n"
                     "core_only: as core_tail, but the rest only hides\n"
                     "all_low: as core_tail, but all of it cheaply\n"
                     "hard: the nearest alone, opaque")
      ->check(given(methodNames()))->type_name("NAME")->group(method);
  command.add_option("--k", arguments.k, "Fragments a pixel shaded fully; 0: none [8]")
      ->check(CLI::Range(0u, 32u))->type_name("N")->group(method);
  command.add_option("--k-sort", arguments.k_sort, "Fragments a pixel in order [max(8, k)]")
      ->check(CLI::Range(1u, 32u))->type_name("N")->group(method);
  command.add_option("--tail", arguments.tail,
                     "What lies behind the k-sort nearest\n"
                     "deterministic: a mean, the same from run to run [the default]\n"
                     "list: in order of arrival, as in the paper\n"
                     "once: its nearest fragment's colour for all of it")
      ->check(given(tailNames()))->type_name("NAME")->group(method);
  command.add_option("--low-shade", arguments.low_shade,
                     "The cheap shade of what is not in full quality: diffuse [the default], mean-lobes, lobes")
      ->check(given(lowShadeNames()))->type_name("NAME")->group(method);
  command.add_option("--core-taps", arguments.core_taps, "Reads of a hair shadow map for a full shade: 1, 4, 9, 25 [25]")
      ->check(CLI::IsMember({1u, 4u, 9u, 25u}))->type_name("N")->group(method);
  command.add_option("--capture", arguments.capture, "Who turns strands into fragments: raster, compute [raster]")
      ->check(given(captureNames()))->type_name("NAME")->group(method);
  command.add_option("--payload", arguments.payload, "Coding of a stored fragment: default, paper")
      ->check(given(payloadNames()))->type_name("NAME")->group(method);
}

Scene makeScene(const CLI::App& command, const SceneArguments& arguments) {
  Scene scene;
  if (!arguments.scene.empty()) {
    const bool is_inline = isInlineScene(arguments.scene);
    try {
      scene = is_inline ? parseScene(arguments.scene) : loadScene(arguments.scene);
    } catch (const SceneError& error) {
      throw AssetError(FLK_ERROR_MALFORMED, (is_inline ? "--scene" : arguments.scene) + ": " + error.what());
    }
  }
  if (!arguments.asset.empty()) {
    SceneAsset asset = scene.assets.empty() ? SceneAsset{} : scene.assets[0];
    asset.source = arguments.asset;
    scene.assets = {asset};
  }
  if (scene.assets.empty()) {
    throw UsageError(command.get_name() + " needs an ASSET or a --scene with one; `forelock " + command.get_name() +
                     " --help` explains");
  }
  const auto asked = [&](const char* option) { return command.count(option) > 0; };
  if (asked("--size")) readSize(arguments.size, scene);
  if (asked("--azimuth")) scene.camera.azimuth_deg = arguments.azimuth;
  if (asked("--elevation")) scene.camera.elevation_deg = arguments.elevation;
  if (asked("--azimuth") || asked("--elevation")) scene.camera.placed.reset();
  if (asked("--up")) scene.camera.up = arguments.up == "z" ? UpAxis::Z : UpAxis::Y;
  if (asked("--camera")) scene.camera.name = arguments.camera, scene.camera.placed.reset();
  for (SceneAsset& asset : scene.assets) {
    if (asked("--hair-color")) {
      const glm::dvec3 color = readColor("--hair-color", arguments.hair_color);
      for (int i = 0; i < 3; ++i) asset.material.color[i] = static_cast<float>(color[i]);
      asset.color_given = true;
    }
    if (asked("--tip-color")) {
      const glm::dvec3 color = readColor("--tip-color", arguments.tip_color);
      for (int i = 0; i < 3; ++i) asset.material.tip_color[i] = static_cast<float>(color[i]);
      if (asset.material.tip_blend == 0.0f) asset.material.tip_blend = 1.0f;
    }
    if (asked("--follow")) asset.follow.count = arguments.follow;
    if (asked("--alpha")) asset.material.opacity_root = asset.material.opacity_tip = static_cast<float>(arguments.alpha);
    if (asked("--points-per-strand")) asset.points_per_strand = arguments.points_per_strand;
    if (asked("--width")) asset.width_mm = arguments.width_mm;
  }
  for (const std::string& file : arguments.meshes) {
    scene.meshes.emplace_back().source = file;
  }
  if (asked("--light")) turnLight(arguments.light, scene);
  if (asked("--exposure")) scene.exposure = arguments.exposure;
  for (SceneLight& light : scene.lights) {
    if (asked("--no-shadow")) light.shadow = false;
    if (asked("--shadow-size")) light.shadow_size = arguments.shadow_size - arguments.shadow_size % 2;
  }
  if (asked("--background")) scene.background = readColor("--background", arguments.background);
  if (asked("--head")) scene.head = true;
  if (asked("--no-head")) scene.head = false;
  if (asked("--color")) setShown(scene, indexOf(displayNames(), arguments.show));
  if (asked("--method")) scene.method = indexOf(methodNames(), arguments.method);
  if (asked("--k")) scene.k = arguments.k == 0 ? FLK_K_NONE : arguments.k;
  if (asked("--k-sort")) scene.k_sort = arguments.k_sort;
  if (asked("--tail")) scene.tail = indexOf(tailNames(), arguments.tail);
  if (asked("--low-shade")) scene.low_shade = indexOf(lowShadeNames(), arguments.low_shade);
  if (asked("--core-taps")) scene.core_taps = arguments.core_taps;
  if (asked("--capture")) scene.capture = indexOf(captureNames(), arguments.capture);
  if (asked("--payload")) scene.payload = indexOf(payloadNames(), arguments.payload);
  const uint32_t full = scene.k == FLK_K_NONE ? 0 : scene.k == 0 ? 8 : scene.k;
  if (scene.k_sort != 0 && scene.k_sort < full) {
    throw UsageError("k-sort is " + std::to_string(scene.k_sort) + ", must be at least k, which is " +
                     std::to_string(full));
  }
  return scene;
}

}  // namespace forelock::samples
