// SPDX-License-Identifier: MIT
#include "view_layers.h"

#include "coarse_mesh.h"
#include "commands.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr uint64_t kPoolBudget = uint64_t{1} << 30;  // as `forelock preview`: the same picture where lists are long
constexpr uint32_t kSoundingSize = 320;              // likewise
constexpr uint32_t kCompileSize = 16;
constexpr uint32_t kCheapShadow = 512;  // taps and methods stay: others are other pipelines, which take time to compile

constexpr VkImageUsageFlags kHairUsage =
    VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

}  // namespace

ViewLayers::ViewLayers(HeadlessHost& host, const ViewGpu& gpu) : host_(host), gpu_(gpu) {}

ViewLayers::~ViewLayers() {
  for (Slot& slot : slots_) {
    host_.resources().destroy(slot.hair);
  }
  host_.resources().destroy(counter_.hair);
  host_.resources().destroy(opaque_color_);
}

void ViewLayers::check(FlkResult result, const char* what) const {
  if (result == FLK_SUCCESS) {
    return;
  }
  std::string text = std::string(what) + " failed with " + flkResultName(result);
  if (!host_.messages().empty()) {
    text += " (" + host_.messages().back() + ")";
  }
  throw AssetError(result, text);
}

Hair ViewLayers::upload(const FlkHairDesc& desc, const double world_from_hair[16]) {
  FlkHair handle = nullptr;
  check(host_.createHair(desc, &handle), "uploading the hair");
  Hair hair(handle);
  check(flkHairSetTransform(hair, world_from_hair), "placing the hair");
  return hair;
}

void ViewLayers::setStage(const Stage& stage) {
  for (Slot& slot : slots_) {
    slot.plan = nullptr;
    slot.valid = slot.planned = false;
  }
  few_.clear();
  hairs_.clear();
  stage_ = nullptr;
  std::vector<Hair> hairs;
  for (const StagedAsset& asset : stage.assets) {
    hairs.push_back(upload(stagedHairDesc(asset), asset.world_from_hair));
  }
  hairs_ = std::move(hairs);
  stage_ = &stage;
  renewMeshes();
}

void ViewLayers::renewMeshes() {
  std::string error;
  opaque_drawn_ = nullptr;
  opaque_.reset();
  coarse_.reset();
  std::vector<OpaqueMesh> meshes = opaqueMeshes(*stage_), coarse;
  for (const OpaqueMesh& mesh : meshes) {
    coarse.push_back(coarseMesh(mesh));
  }
  opaque_ = OpaqueScene::create(host_, std::move(meshes), error);
  coarse_ = opaque_ ? OpaqueScene::create(host_, std::move(coarse), error) : nullptr;
  if (!coarse_) {
    throw AssetError(FLK_ERROR_OUT_OF_DEVICE_MEMORY, error);
  }
}

bool ViewLayers::opaqueBounds(float low[3], float high[3]) const {
  if (!opaque_ || opaque_->empty()) {
    return false;
  }
  opaque_->bounds(low, high);
  return true;
}

OpaqueDepth ViewLayers::opaqueDepths(uint32_t width, uint32_t height) {
  if (!opaque_drawn_ || opaque_drawn_->empty() || !last_.meshes) {
    return {};
  }
  const GpuImage& image = opaque_drawn_->depth();
  const std::vector<float> depths = host_.readImage(image, VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
  if (depths.size() != size_t{image.width} * image.height) {
    return {};
  }
  const Camera camera = last_.camera;
  const double across = static_cast<double>(image.width) / width, down = static_cast<double>(image.height) / height;
  return [=, w = image.width, h = image.height](const glm::dvec2& pixel) {
    const auto x = static_cast<uint32_t>(std::clamp(pixel.x * across, 0.0, w - 1.0)), y = static_cast<uint32_t>(std::clamp(pixel.y * down, 0.0, h - 1.0));
    return viewDepth(camera, static_cast<double>(depths[size_t{y} * w + x]));
  };
}

void ViewLayers::setFewStrands(const std::vector<std::unique_ptr<OpenedAsset>>& assets) {
  few_.clear();
  for (size_t i = 0; stage_ && i < std::min(assets.size(), stage_->assets.size()); ++i) {
    const StagedAsset& whole = stage_->assets[i];
    FlkHairDesc desc = stagedHairDesc(whole);
    desc.asset = assets[i] ? assets[i]->asset.get() : desc.asset;
    few_.push_back(upload(desc, whole.world_from_hair));
  }
}

void ViewLayers::updateLook() {
  for (std::vector<Hair>* hairs : {&hairs_, &few_}) {
    for (size_t i = 0; i < hairs->size(); ++i) {
      check(flkHairSetMaterial((*hairs)[i], &stage_->assets[i].material), "setting a material");
      check(flkHairSetTransform((*hairs)[i], stage_->assets[i].world_from_hair), "placing the hair");
    }
  }
}

void ViewLayers::renewHair(size_t index) {
  const StagedAsset& asset = stage_->assets[index];
  hairs_[index] = upload(stagedHairDesc(asset), asset.world_from_hair);
  few_.clear();  // of other follow strands or colours
}

void ViewLayers::ensureImage(GpuImage& image, uint32_t width, uint32_t height, VkImageUsageFlags usage) {
  if (image.view && image.width == width && image.height == height) {
    return;
  }
  host_.resources().destroy(image);
  GpuImageShape shape;
  shape.width = width;
  shape.height = height;
  shape.usage = usage;
  if (!host_.resources().createImage(shape, image)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
}

void ViewLayers::ensureView(Slot& slot) {
  if (!slot.view) {
    FlkViewDesc desc = viewDesc();
    desc.pool_budget = kPoolBudget;
    check(create(host_.context(), desc, slot.view), "making a view");
  }
}

LayerRequest ViewLayers::soundingRequest(const Camera& camera) const {
  const Scene& scene = stage_->scene;
  const uint32_t longer = std::max(scene.width, scene.height);
  LayerRequest request;
  request.camera = camera;
  const auto reduced = [&](uint32_t side) {
    return longer <= kSoundingSize ? side : std::max(1u, static_cast<uint32_t>(uint64_t{side} * kSoundingSize / longer));
  };
  request.width = reduced(scene.width);
  request.height = reduced(scene.height);
  request.methods[kLayerFirst] = methodOf(scene);
  request.meshes = false;  // an exposure that followed them would change as they are turned on and off
  return request;
}

double ViewLayers::chooseExposure(const Camera& camera) {
  const LayerRequest request = soundingRequest(camera);
  for (int attempt = 0; attempt < 4; ++attempt) {
    plan(request);
    if (!host_.submit([&](VkCommandBuffer cmd) { record(cmd); })) {
      check(FLK_ERROR_DEVICE_LOST, "drawing");
    }
    if (!finish()) {
      break;
    }
  }
  return exposureOf(readHair(kLayerFirst), *stage_);
}

// A frame of a request without target and method. What it points to lives in it.
struct ViewLayers::Frame {
  Stage cheap;  // of a scene alone: what a frame reads of a stage besides its hairs
  std::optional<StagedFrame> staged;
};

void ViewLayers::stageFrame(const LayerRequest& request, Frame& frame) {
  const Stage* stage = stage_;
  if (request.cheap) {
    frame.cheap.scene = stage_->scene;
    for (SceneLight& light : frame.cheap.scene.lights) {
      light.shadow_size = std::min(light.shadow_size, kCheapShadow);
    }
    stage = &frame.cheap;
  }
  const std::vector<Hair>& hairs = request.few_strands && few_.size() == hairs_.size() ? few_ : hairs_;
  StagedFrame& staged = frame.staged.emplace(*stage, request.camera, hairs, request.exposure, request.width, request.height);
  if (request.meshes && !opaque_->empty()) {
    OpaqueLook look = opaqueLook(*stage_, request.camera);
    for (OpaqueLight& light : look.lights) {
      light.casts_shadow = light.casts_shadow && !request.cheap;  // meshes' shadows are a map of four million texels a light
    }
    opaque_drawn_ = request.cheap ? coarse_.get() : opaque_.get();
    if (!opaque_drawn_->prepare(request.camera, stage->aspect(), request.width, request.height, look)) {
      check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
    }
    opaque_drawn_->fillFrame(staged.frame, staged.lights);
  }
  staged.frame.count_work = request.count_work ? 1 : 0;
}

void ViewLayers::planSlot(Slot& slot, FlkFrame frame, const MethodChoice& method, uint32_t width, uint32_t height) {
  ensureView(slot);
  ensureImage(slot.hair, width, height, kHairUsage);
  applyMethod(method, frame);
  frame.frame_number = slot.frame + 1;
  frame.completed_frame = slot.frame;
  frame.target = {slot.hair.image,
                  slot.hair.view,
                  slot.hair.format,
                  VK_SAMPLE_COUNT_1_BIT,
                  slot.hair.range,
                  width,
                  height,
                  {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                  {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}};
  check(flkPlanFrame(slot.view, &frame, &slot.plan), "planning a frame");
  ++slot.frame;
}

void ViewLayers::compile(const LayerRequest& request) {
  LayerRequest small = request;  // pipelines do not depend on sizes
  small.width = small.height = kCompileSize;
  Frame frame;
  stageFrame(small, frame);
  for (const std::optional<MethodChoice>& method : small.methods) {
    if (method) {
      Slot slot;
      const auto drop = [&] { host_.resources().destroy(slot.hair); };
      try {
        planSlot(slot, frame.staged->frame, *method, small.width, small.height);
      } catch (...) {
        drop();
        throw;
      }
      slot.view = {};  // before its target
      drop();
    }
  }
}

void ViewLayers::plan(const LayerRequest& request) {
  last_ = request;
  Frame frame;
  stageFrame(request, frame);
  opaque_planned_ = request.meshes && !opaque_->empty();
  if (opaque_planned_) {
    ensureImage(opaque_color_, request.width, request.height,
                VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
  }
  for (uint32_t i = 0; i < kLayerCount; ++i) {
    Slot& slot = slots_[i];
    slot.planned = false;
    if (!request.methods[i]) {
      slot.valid = false;
      continue;
    }
    planSlot(slot, frame.staged->frame, *request.methods[i], request.width, request.height);
    slot.planned = true;
  }
}

void ViewLayers::record(VkCommandBuffer cmd) {
  if (opaque_planned_) {
    opaque_drawn_->recordDepth(cmd);
  }
  for (Slot& slot : slots_) {
    if (!slot.planned) {
      continue;
    }
    const VkClearColorValue transparent{};
    host_.resources().transition(cmd, slot.hair, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    gpu_.vkCmdClearColorImage(cmd, slot.hair.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &transparent, 1, &slot.hair.range);
    flkCmdRender(cmd, slot.plan);
  }
  if (opaque_planned_) {  // with the hair's shadow of the first layer: what lights are does not depend on methods
    opaque_drawn_->recordColor(cmd, slots_[kLayerFirst].view, opaque_color_);
    opaque_planned_ = false;
  }
}

bool ViewLayers::finish() {
  bool again = false;
  for (Slot& slot : slots_) {
    if (!slot.planned) {
      continue;
    }
    check(flkViewGetStatistics(slot.view, slot.frame, &slot.facts.statistics), "reading the statistics");
    again = again || slot.facts.statistics.overflow_fragments > 0;
    describe(slot);
    slot.valid = true;
    slot.planned = false;
  }
  return again;
}

void ViewLayers::describe(Slot& slot) {
  LayerFacts& facts = slot.facts;
  facts.passes.clear();
  facts.resources.clear();
  facts.omissions.clear();
  check(flkPlanGetInfo(slot.plan, &facts.plan), "asking the plan");
  for (uint32_t i = 0; i < facts.plan.pass_count; ++i) {
    FlkPassInfo pass = {};
    check(flkPlanGetPass(slot.plan, i, &pass), "asking the plan");
    facts.passes.push_back({pass.name, pass.stage, passWork(pass)});
  }
  for (uint32_t i = 0; i < facts.plan.resource_count; ++i) {
    FlkResourceInfo resource = {};
    check(flkPlanGetResource(slot.plan, i, &resource), "asking the plan");
    facts.resources.push_back({resource.name, resource.why, resource.bytes, resource.transient != 0});
  }
  for (uint32_t i = 0; const char* omission = flkPlanGetOmission(slot.plan, i); ++i) {
    facts.omissions.emplace_back(omission);
  }
}

std::vector<float> ViewLayers::readHair(LayerIndex layer) {
  return host_.readImage(slots_[layer].hair, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

Image ViewLayers::read(LayerIndex layer) {
  Image image(slots_[layer].hair.width, slots_[layer].hair.height);
  image.rgba = readHair(layer);
  std::vector<float> opaque;
  if (opaqueView()) {
    opaque = host_.readImage(opaque_color_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  if (image.rgba.empty() || (opaqueView() && opaque.size() != image.rgba.size())) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "reading the picture back");
  }
  for (size_t i = 0; i < opaque.size(); i += 4) {
    const float through = 1.0f - image.rgba[i + 3];
    for (size_t channel = 0; channel < 4; ++channel) {
      image.rgba[i + channel] += through * opaque[i + channel];
    }
  }
  return image;
}

// The pixel's own frustum, drawn into a target of one pixel, and only counted: widths in pixels are as in the picture.
uint64_t ViewLayers::countFragments(uint32_t x, uint32_t y) {
  StagedFrame staged(*stage_, last_.camera, hairs_, last_.exposure, last_.width, last_.height);
  FlkFrame& frame = staged.frame;
  const auto crop = [&](int row, uint32_t at, uint32_t size) {
    const float middle = 2.0f * (static_cast<float>(at) + 0.5f) / static_cast<float>(size) - 1.0f;
    for (int column = 0; column < 4; ++column) {
      float& value = frame.clip_from_view[4 * column + row];
      value = static_cast<float>(size) * (value - middle * frame.clip_from_view[4 * column + 3]);
    }
  };
  crop(0, x, last_.width);
  crop(1, y, last_.height);
  Slot& slot = counter_;
  ensureView(slot);
  ensureImage(slot.hair, 1, 1, kHairUsage);
  frame.display = FLK_DISPLAY_SHADED;
  frame.light_count = 0;
  frame.count_only = 1;
  frame.timestamps = FLK_TIMESTAMPS_NONE;
  frame.frame_number = slot.frame + 1;
  frame.completed_frame = slot.frame;
  const FlkImageState state{VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
  frame.target = {slot.hair.image, slot.hair.view, slot.hair.format, VK_SAMPLE_COUNT_1_BIT, slot.hair.range, 1, 1, state, state};
  check(flkPlanFrame(slot.view, &frame, &slot.plan), "planning a frame");
  ++slot.frame;
  const bool done = host_.submit([&](VkCommandBuffer cmd) {
    host_.resources().transition(cmd, slot.hair, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    flkCmdRender(cmd, slot.plan);
  });
  check(done ? FLK_SUCCESS : FLK_ERROR_DEVICE_LOST, "counting fragments");
  FlkStatistics statistics{};
  check(flkViewGetStatistics(slot.view, slot.frame, &statistics), "reading the statistics");
  return statistics.fragments;
}

}  // namespace forelock::samples
