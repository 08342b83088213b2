// What is drawn: assets, materials and transforms, and the setting they come in. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "condition.h"
#include "options.h"
#include "scene_file.h"

#include <forelock/forelock.hpp>

#include <string>
#include <vector>

namespace forelock::study {

struct SubjectAsset {
  samples::OpenedAsset opened;
  FlkAssetInfo info{};
  samples::SceneAsset wanted;      // as the scene has it
  FlkMaterial material{};          // the scene's, of the right width
  FlkFollowStrands follow{};
  uint32_t flags = 0;              // FLK_HAIR_... but for the order
  double world_from_hair[16] = {};
  double scale = 1;
};

struct Subject {
  std::string name;       // in the column `asset`
  bool has_setting;       // a scene file says materials and lights; else the condition does
  samples::Scene scene;   // assets' sources such that they are found from anywhere
  std::vector<SubjectAsset> assets;

  samples::UpAxis up() const { return scene.camera.up; }
};

// Opens everything, with a progress bar; says on stderr what the library has to say. Throws AssetError or UsageError, the latter
// also for what the study does not mirror in its reference.
Subject openSubject(const Options& options);

FlkMaterial subjectMaterial(const Subject& subject, std::size_t asset, samples::HairColor color);

// Points for framing (world) and the widest reach around them.
std::vector<glm::vec3> subjectPoints(const Subject& subject, double& radius);

}  // namespace forelock::study
