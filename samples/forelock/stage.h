// A scene with its assets opened: what preview draws and plan plans. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "legend.h"
#include "opaque_scene.h"
#include "scene_file.h"

#include <forelock/forelock.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace forelock::samples {

struct StagedAsset {
  std::shared_ptr<const OpenedAsset> opened;
  FlkAssetInfo info;
  FlkMaterial material;       // with the width and colour that were asked for
  FlkFollowStrands follow;
  uint32_t flags = 0;         // FLK_HAIR_...
  std::vector<float> root_pixels;  // what root_image reads
  FlkRootImage root_image{};       // width 0: none
  glm::dvec3 reflectance{0.0};     // mean of the fibres', linear
  double width_mm = 0.0;           // diameter of the widest vertex as drawn, a unit being a metre
  double world_from_hair[16];
};

struct StagedMesh {
  std::shared_ptr<const OpaqueMesh> read;  // as the file has it
  glm::vec3 albedo{0.0f};                  // linear
  double world_from_mesh[16];
  glm::vec3 low{0.0f}, high{0.0f};         // (world, m) of its vertices
};

struct Stage {
  Scene scene;                // size is set, and head
  std::vector<StagedAsset> assets;
  std::vector<StagedMesh> meshes;
  std::vector<glm::vec3> seen;  // points that framing must see: an even sample of the vertices, and the head (world, m)
  double radius = 0.0;          // (m) the widest vertex's
  Legend legend;                // of its colours
  std::vector<std::string> notes;  // for a person: what is not in the picture, what may be meant otherwise

  double aspect() const { return static_cast<double>(scene.width) / static_cast<double>(scene.height); }
};

// What is open already, and need not be read again: a scene's own entries tell which it is.
struct OpenFiles {
  std::vector<std::pair<SceneAsset, std::shared_ptr<const OpenedAsset>>> assets;
  std::vector<std::pair<SceneMesh, std::shared_ptr<const OpaqueMesh>>> meshes;
};
std::shared_ptr<const OpenedAsset> findOpen(const OpenFiles& files, const SceneAsset& wanted);
std::shared_ptr<const OpaqueMesh> findOpen(const OpenFiles& files, const SceneMesh& wanted);

// Shows progress, or tells it to `progress`; prints what the library has to say of the assets that it reads. With the scene's colouring.
// Throws AssetError or UsageError.
Stage openStage(const Scene& scene, const ProgressFunction& progress = {}, const OpenFiles& open = {});

// world_from_hair as the scene places it.
void placeAsset(const SceneAsset& wanted, UpAxis up, StagedAsset& asset);
// Where the scene wants a mesh that was read, and its colour.
void placeMesh(const SceneMesh& wanted, UpAxis up, StagedMesh& mesh);

// A sentence on what a pass goes over: "1,234 segments".
std::string passWork(const FlkPassInfo& pass);

// Material, width and follow strands of an opened asset: its own, and what the scene wants of it. What was decided otherwise than asked
// for goes into `notes`. Throws AssetError.
void stageLook(const SceneAsset& wanted, StagedAsset& asset, std::vector<std::string>& notes);

// View `turn` of `turns` around the hair.
Camera stageCamera(const Stage& stage, uint32_t turn, uint32_t turns);

// Unit vector to a directional light in world space, of a spot against its axis; of a point light none.
glm::dvec3 towardsLight(const SceneLight& light, const Camera& camera);

// The sky's or the scene's own coefficients, before exposure; false: the scene has none.
bool stageHarmonics(const Stage& stage, Harmonics& harmonics);

// The bust, where the scene has it, and its meshes: in their places (world, m), with their colours.
std::vector<OpaqueMesh> opaqueMeshes(const Stage& stage);

// What a plan without a device is to know of them. `shadow`: any, that lives as long as the frame.
void planMeshes(const Stage& stage, const Camera& camera, const FlkHostShadow& shadow, FlkFrame& frame, std::vector<FlkLight>& lights);

// How they are lit: in their own strength, because skin would burn out beside fibres, which reflect little of their light.
OpaqueLook opaqueLook(const Stage& stage, const Camera& camera);

// Hairs of the stage's assets in a context that plans.
std::vector<Hair> planHairs(FlkContext context, const Stage& stage);
FlkHairDesc stagedHairDesc(const StagedAsset& asset);

// One frame: everything but target, depth and numbers. Its pointers live as long as the object, which must not move.
struct StagedFrame {
  // `width` and `height` are the picture's, which may be a reduced one of the stage's.
  StagedFrame(const Stage& stage, const Camera& camera, const std::vector<Hair>& hairs, double exposure, uint32_t width,
              uint32_t height);
  StagedFrame(const StagedFrame&) = delete;
  StagedFrame& operator=(const StagedFrame&) = delete;

  FlkFrame frame;
  std::vector<FlkLight> lights;
  float ambient_sh[27];
  FlkOpacityModifier modifiers[2];
  std::vector<FlkHair> handles;
};

// "core_tail, k 8, k_sort 8" as the frame will use it, and what is not the default.
std::string methodText(const Scene& scene);

}  // namespace forelock::samples
