// Options that `forelock preview` and `forelock plan` share: they make a scene, or change the one of --scene.
// SPDX-License-Identifier: MIT
#pragma once

#include "scene_file.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace forelock::samples {

struct SceneArguments {
  std::string asset, scene, size, method, payload, up, hair_color, tip_color, light, show, camera, background, tail, capture, low_shade;
  std::vector<std::string> meshes;
  uint32_t k = 0, k_sort = 0, core_taps = 0, shadow_size = 0, follow = 0, points_per_strand = 0;
  double azimuth = 0.0, elevation = 0.0, alpha = 0.0, width_mm = 0.0, exposure = 0.0;
  bool head = false, no_head = false, no_shadow = false;
};

// `assets`: where several may be named, else one, which becomes arguments.asset.
void addSceneOptions(CLI::App& command, SceneArguments& arguments, std::vector<std::string>* assets = nullptr);

// The scene that was asked for. Throws UsageError or AssetError.
Scene makeScene(const CLI::App& command, const SceneArguments& arguments);

}  // namespace forelock::samples
