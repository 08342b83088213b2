// A scene with its assets opened: what preview draws and plan plans. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "scene_file.h"

#include <forelock/forelock.hpp>

#include <string>
#include <vector>

namespace forelock::samples {

struct StagedAsset {
  OpenedAsset opened;
  FlkAssetInfo info;
  FlkMaterial material;       // with the width that was asked for
  double world_from_hair[16];
};

struct Stage {
  Scene scene;                // size is set, and head
  std::vector<StagedAsset> assets;
  std::vector<glm::vec3> seen;  // points that framing must see: an even sample of the vertices, and the head (world, m)
  double radius = 0.0;          // (m) the widest vertex's

  double aspect() const { return static_cast<double>(scene.width) / static_cast<double>(scene.height); }
};

// Shows progress; prints what the library has to say of the assets. Throws AssetError or UsageError.
Stage openStage(const Scene& scene);

// View `turn` of `turns` around the hair.
Camera stageCamera(const Stage& stage, uint32_t turn, uint32_t turns);

// Unit vector to the light in world space.
glm::dvec3 stageLight(const Stage& stage, const Camera& camera);

// Hairs of the stage's assets in a context that plans.
std::vector<Hair> planHairs(FlkContext context, const Stage& stage);
FlkHairDesc stagedHairDesc(const StagedAsset& asset);

// One frame: everything but target, depth and numbers. Its pointers live as long as the object, which must not move.
struct StagedFrame {
  StagedFrame(const Stage& stage, const Camera& camera, const std::vector<Hair>& hairs, double exposure, double aspect);
  StagedFrame(const StagedFrame&) = delete;
  StagedFrame& operator=(const StagedFrame&) = delete;

  FlkFrame frame;
  FlkLight light;
  std::vector<FlkHair> handles;
};

// "core_tail, k 8, k_sort 8" as the frame will use it.
std::string methodText(const Scene& scene);

}  // namespace forelock::samples
