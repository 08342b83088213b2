// SPDX-License-Identifier: MIT
#include "picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace forelock::samples {

namespace {

constexpr uint64_t kPoolBudget = uint64_t{1} << 30;
constexpr uint32_t kMostAttempts = 4;
constexpr uint32_t kSoundingSize = 320;  // pixels of the longer side of the first picture

double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

}  // namespace

// Hair of the brown of pictureMaterial is to come out at a mean of 0.065; lighter and darker hair keeps half (on a log
// scale) of its difference to that, so that black stays black and blond is not white. Highlights may not burn out over
// more than one pixel in 200.
double exposureOf(const std::vector<float>& rgba, const Stage& stage) {
  std::vector<double> values;
  for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
    if (rgba[i + 3] > 0.25f) {
      values.push_back(luminance({rgba[i], rgba[i + 1], rgba[i + 2]}) / static_cast<double>(rgba[i + 3]));
    }
  }
  if (values.empty()) {
    return 1.0;
  }
  double mean = 0.0;
  for (const double value : values) {
    mean += value / static_cast<double>(values.size());
  }
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 199 / 200);
  std::nth_element(values.begin(), high, values.end());
  const FlkMaterial brown = pictureMaterial();
  const double lightness = std::max(luminance(stage.assets[0].reflectance), 0.004) / luminance(glm::dvec3(
      brown.color[0], brown.color[1], brown.color[2]));
  const double wanted = 0.065 * std::sqrt(lightness);
  const double scale = std::min(wanted / std::max(mean, 1e-9), 0.95 / std::max(*high, 1e-9));
  return std::clamp(scale, 1e-6, 1e6);
}

Painter::Painter(HeadlessHost& host, const Stage& stage) : host_(host), stage_(stage) {
  std::string error;
  opaque_ = OpaqueScene::create(host, opaqueMeshes(stage), error);
  if (!opaque_) {
    throw AssetError(FLK_ERROR_OUT_OF_DEVICE_MEMORY, error);
  }
  for (const StagedAsset& asset : stage.assets) {
    FlkHair hair = nullptr;
    check(host_.createHair(stagedHairDesc(asset), &hair), "uploading the hair");
    hairs_.emplace_back(hair);
    check(flkHairSetTransform(hair, asset.world_from_hair), "placing the hair");
  }
  FlkViewDesc desc = viewDesc();
  desc.pool_budget = kPoolBudget;
  check(create(host_.context(), desc, view_), "making the view");
}

void Painter::check(FlkResult result, const char* what) const {
  if (result == FLK_SUCCESS) {
    return;
  }
  std::string text = stage_.assets[0].opened->label + ": " + what + " failed with " + flkResultName(result);
  if (!host_.messages().empty()) {
    text += " (" + host_.messages().back() + ")";
  }
  throw AssetError(result, text);
}

Painter::~Painter() { host_.resources().destroy(opaque_color_); }

// Whatever the meshes hide: an exposure that followed it would change as they are turned on and off.
double Painter::soundExposure(const Camera& camera) {
  const Scene& scene = stage_.scene;
  const uint32_t longer = std::max(scene.width, scene.height);
  const auto reduced = [&](uint32_t side) {
    return longer <= kSoundingSize ? side : std::max(1u, static_cast<uint32_t>(uint64_t{side} * kSoundingSize / longer));
  };
  const uint32_t width = reduced(scene.width), height = reduced(scene.height);
  StagedFrame staged(stage_, camera, hairs_, 1.0, width, height);
  Picture picture;
  if (!host_.resize(width, height)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  drawUntilWhole(staged, false, picture);
  return exposureOf(host_.readColor(), stage_);
}

void Painter::readyMeshes(const Camera& camera) {
  const uint32_t width = stage_.scene.width, height = stage_.scene.height;
  if (!opaque_->prepare(camera, stage_.aspect(), width, height, opaqueLook(stage_, camera))) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  if (opaque_->empty() || (opaque_color_.width == width && opaque_color_.height == height)) {
    return;
  }
  host_.resources().destroy(opaque_color_);
  if (!host_.resources().createImage({width, height, 1, VK_IMAGE_VIEW_TYPE_2D, VK_FORMAT_R16G16B16A16_SFLOAT,
                                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                      VK_IMAGE_ASPECT_COLOR_BIT},
                                     opaque_color_)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
}

void Painter::drawUntilWhole(StagedFrame& staged, bool with_meshes, Picture& picture) {
  HeadlessHost::Around around;
  if (with_meshes) {
    around.fill = [&](FlkFrame& frame) { opaque_->fillFrame(frame, staged.lights); };
    around.before = [&](VkCommandBuffer cmd) { opaque_->recordDepth(cmd); };
    around.after = [&](VkCommandBuffer cmd) { opaque_->recordColor(cmd, view_, opaque_color_); };
  }
  for (picture.attempts = 1;; ++picture.attempts) {
    FlkPlan plan = nullptr;
    check(host_.render(view_, staged.frame, &plan, around), "drawing");
    check(host_.statistics(view_, picture.statistics), "reading the statistics");
    if (picture.statistics.overflow_fragments > 0 && picture.attempts < kMostAttempts) {
      continue;  // the next plan knows how many fragments there are
    }
    check(flkPlanGetInfo(plan, &picture.plan), "asking the plan");
    for (uint32_t i = 0; const char* omission = flkPlanGetOmission(plan, i); ++i) {
      picture.omissions.emplace_back(omission);
    }
    return;
  }
}

Picture Painter::draw(const Camera& camera, double exposure) {
  const Scene& scene = stage_.scene;
  const bool shaded = scene.display == FLK_DISPLAY_SHADED && scene.coloring == StrandColoring::none;
  Picture picture;
  picture.exposure = exposure > 0.0 ? exposure : shaded ? soundExposure(camera) : 1.0;
  StagedFrame staged(stage_, camera, hairs_, picture.exposure, scene.width, scene.height);
  if (!host_.resize(scene.width, scene.height)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  readyMeshes(camera);
  drawUntilWhole(staged, !opaque_->empty(), picture);
  picture.image = Image(scene.width, scene.height);
  picture.image.rgba = host_.readColor();
  std::vector<float> opaque;
  if (!opaque_->empty()) {
    opaque = host_.readImage(opaque_color_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
  if (picture.image.rgba.empty() || opaque.empty() != opaque_->empty()) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "reading the image back");
  }
  // Meshes are put under the hair here and not before it is drawn, so that alpha still tells where hair is.
  for (size_t i = 0; i < picture.image.rgba.size(); i += 4) {
    float* pixel = &picture.image.rgba[i];
    picture.hair_pixels += pixel[3] > 0.0f ? 1 : 0;
    if (!opaque.empty()) {
      const float through = 1.0f - pixel[3];
      for (size_t channel = 0; channel < 4; ++channel) {
        pixel[channel] += through * opaque[i + channel];
      }
    }
  }
  if (scene.background) {
    const glm::vec3 background(*scene.background);
    picture.image = over(picture.image, &background[0]);
  }
  return picture;
}

}  // namespace forelock::samples
