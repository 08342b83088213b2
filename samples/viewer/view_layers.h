// What the viewer draws of a stage: the picture, a second one to compare with, and the exact one to measure against.
// SPDX-License-Identifier: MIT
#pragma once

#include "gpu_resources.h"
#include "opaque_scene.h"
#include "picture.h"
#include "strand_pick.h"
#include "view_gpu.h"
#include "view_method.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

enum LayerIndex : uint32_t { kLayerFirst = 0, kLayerSecond = 1, kLayerExact = 2, kLayerCount = 3 };

struct PlanPass {
  std::string name;
  uint32_t stage = 0;
  std::string work;
};
struct PlanResource {
  std::string name, why;
  uint64_t bytes = 0;
  bool transient = false;
};

// What a layer's last frame took.
struct LayerFacts {
  FlkStatistics statistics{};
  FlkPlanInfo plan{};
  std::vector<PlanPass> passes;
  std::vector<PlanResource> resources;
  std::vector<std::string> omissions;
};

struct LayerRequest {
  Camera camera;
  double exposure = 1.0;
  uint32_t width = 1, height = 1;
  std::array<std::optional<MethodChoice>, kLayerCount> methods;  // none: the layer is not drawn
  bool cheap = false;       // small shadow maps: while moving
  bool few_strands = false;
  bool meshes = true;
  bool count_work = false;
};

class ViewLayers {
public:
  ViewLayers(HeadlessHost& host, const ViewGpu& gpu);
  ~ViewLayers();
  ViewLayers(const ViewLayers&) = delete;
  ViewLayers& operator=(const ViewLayers&) = delete;

  // Uploads the stage's hair, which must outlive its use here. Throws AssetError, and then holds no hair.
  void setStage(const Stage& stage);
  // The stage's meshes and head anew, as its scene has them now.
  void renewMeshes();
  // Levels of detail of the stage's assets, one each, for while it moves; empty: none.
  void setFewStrands(const std::vector<std::unique_ptr<OpenedAsset>>& assets);
  bool hasFewStrands() const { return !few_.empty(); }
  // Materials and transforms as the stage has them now.
  void updateLook();
  // Hair `index` anew: follow strands, root image or colours are others.
  void renewHair(size_t index);

  // Makes the pipelines that such a picture needs and that are not there yet, which takes seconds where shaders are compiled slowly. May
  // run in a thread of its own: meanwhile what was drawn can be shown, and of the rest only drawn, facts, opaqueView and hairImage be called.
  // Depths of what is opaque are then to be drawn anew. Throws AssetError.
  void compile(const LayerRequest& request);

  // What tells the exposure that `forelock preview` chooses, and that exposure.
  LayerRequest soundingRequest(const Camera& camera) const;
  double chooseExposure(const Camera& camera);

  // Before record, which goes into one submission with all that is planned. Throws AssetError.
  void plan(const LayerRequest& request);
  void record(VkCommandBuffer cmd);
  // Once that submission has completed. True: lists were too short and should be drawn again.
  bool finish();

  bool drawn(LayerIndex layer) const { return slots_[layer].valid; }
  const LayerFacts& facts(LayerIndex layer) const { return slots_[layer].facts; }
  // Null: there is nothing opaque.
  VkImageView opaqueView() const { return opaque_ && !opaque_->empty() ? opaque_color_.view : VK_NULL_HANDLE; }
  // Box around what is opaque (m); false: nothing is.
  bool opaqueBounds(float low[3], float high[3]) const;
  // View depths (m) of what is opaque in the last picture, for pixels of one of `width` x `height`; empty: nothing is. Reads them back.
  OpaqueDepth opaqueDepths(uint32_t width, uint32_t height);
  const GpuImage& hairImage(LayerIndex layer) const { return slots_[layer].hair; }  // SHADER_READ_ONLY_OPTIMAL once drawn

  // Linear, premultiplied, hair over what is opaque, as `forelock preview` has it before its background.
  Image read(LayerIndex layer);
  // Hair alone: RGBA.
  std::vector<float> readHair(LayerIndex layer);
  // Fragments in a pixel of the last request's picture.
  uint64_t countFragments(uint32_t x, uint32_t y);

private:
  struct Slot {
    View view;
    GpuImage hair;
    FlkPlan plan = nullptr;
    uint64_t frame = 0;
    LayerFacts facts;
    bool valid = false, planned = false;
  };
  void check(FlkResult result, const char* what) const;
  void ensureImage(GpuImage& image, uint32_t width, uint32_t height, VkImageUsageFlags usage);
  void ensureView(Slot& slot);
  Hair upload(const FlkHairDesc& desc, const double world_from_hair[16]);
  void describe(Slot& slot);
  struct Frame;
  void stageFrame(const LayerRequest& request, Frame& frame);
  void planSlot(Slot& slot, FlkFrame frame, const MethodChoice& method, uint32_t width, uint32_t height);

  HeadlessHost& host_;
  const ViewGpu& gpu_;
  const Stage* stage_ = nullptr;
  std::vector<Hair> hairs_, few_;
  std::unique_ptr<OpaqueScene> opaque_, coarse_;  // coarse_: for cheap pictures
  OpaqueScene* opaque_drawn_ = nullptr;           // that was prepared last
  GpuImage opaque_color_;
  bool opaque_planned_ = false;
  std::array<Slot, kLayerCount> slots_;
  Slot counter_;  // of one pixel
  LayerRequest last_;
};

}  // namespace forelock::samples
