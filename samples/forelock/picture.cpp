// SPDX-License-Identifier: MIT
#include "picture.h"

#include "bust.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr uint64_t kPoolBudget = uint64_t{1} << 30;
constexpr uint32_t kMostAttempts = 4;
constexpr uint32_t kSoundingSize = 320;  // pixels of the longer side of the first picture

double luminance(const float* rgb) {
  return 0.2126 * static_cast<double>(rgb[0]) + 0.7152 * static_cast<double>(rgb[1]) +
         0.0722 * static_cast<double>(rgb[2]);
}

// Hair of the brown of pictureMaterial is to come out at a mean of 0.065; lighter and darker hair keeps half (on a log
// scale) of its difference to that, so that black stays black and blond is not white. Highlights may not burn out over
// more than one pixel in 200.
double chooseExposure(const std::vector<float>& rgba, double radiance, const Stage& stage) {
  std::vector<double> values;
  for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
    if (rgba[i + 3] > 0.25f) {
      values.push_back(luminance(&rgba[i]) / static_cast<double>(rgba[i + 3]));
    }
  }
  if (values.empty()) {
    return radiance;
  }
  double mean = 0.0;
  for (const double value : values) {
    mean += value / static_cast<double>(values.size());
  }
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 199 / 200);
  std::nth_element(values.begin(), high, values.end());
  const FlkMaterial brown = pictureMaterial();
  const double lightness = std::max(luminance(stage.assets[0].material.color), 0.004) / luminance(brown.color);
  const double wanted = 0.065 * std::sqrt(lightness);
  const double scale = std::min(wanted / std::max(mean, 1e-9), 0.95 / std::max(*high, 1e-9));
  return radiance * std::clamp(scale, 1e-6, 1e6);
}

float depthValue(const float projection[16], float depth) {
  const float z = projection[10] * -depth + projection[14];
  const float w = projection[11] * -depth + projection[15];
  return std::clamp(z / w, 0.0f, 1.0f);
}

// docs/methods.md section 4 for a point of the bust, averaged over a disc: the map's strands are a texel wide and would
// draw their pattern on the skin.
struct HairShadow {
  std::vector<float> depth;  // map values
  FlkShadowMap map{};
  float fibres_per_metre = 0.0f;
  float log2_transmittance = 0.0f;

  float operator()(const glm::vec3& p) const {
    const double* m = map.texels_from_world;
    double at[3];
    for (int row = 0; row < 3; ++row) {
      at[row] = m[row] * static_cast<double>(p.x) + m[4 + row] * static_cast<double>(p.y) +
                m[8 + row] * static_cast<double>(p.z) + m[12 + row];
    }
    float light = 0.0f, sum = 0.0f;
    const int size = static_cast<int>(map.size);
    const int reach = std::clamp(static_cast<int>(0.004 / static_cast<double>(map.texel)), 2, 16);  // 4 mm
    const int middle_x = static_cast<int>(std::clamp(at[0], -1e6, 1e6));
    const int middle_y = static_cast<int>(std::clamp(at[1], -1e6, 1e6));
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (i * i + j * j > reach * reach) {
          continue;
        }
        const int x = middle_x + i, y = middle_y + j;
        sum += 1.0f;
        const bool outside = x < 0 || y < 0 || x >= size || y >= size;
        const float front = outside ? 1.0f : depth[static_cast<size_t>(y) * map.size + static_cast<size_t>(x)];
        const float behind = front >= 1.0f ? 0.0f : static_cast<float>(at[2]) - front * map.depth_range;
        light += std::exp2(std::max(behind, 0.0f) * fibres_per_metre * log2_transmittance);
      }
    }
    return light / sum;
  }
};

}  // namespace

// What a small picture without a head tells.
struct Painter::Sounding {
  double exposure = 1.0;
  HairShadow shadow;
};

Painter::Painter(HeadlessHost& host, const Stage& stage) : host_(host), stage_(stage) {
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
  std::string text = stage_.assets[0].opened.label + ": " + what + " failed with " + flkResultName(result);
  if (!host_.messages().empty()) {
    text += " (" + host_.messages().back() + ")";
  }
  throw AssetError(result, text);
}

void Painter::drawUntilWhole(FlkFrame& frame, Picture& picture) {
  for (picture.attempts = 1;; ++picture.attempts) {
    FlkPlan plan = nullptr;
    check(host_.render(view_, frame, &plan), "drawing");
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

Painter::Sounding Painter::sound(const Camera& camera) {
  Sounding sounding;
  const Scene& scene = stage_.scene;
  const uint32_t longer = std::max(scene.width, scene.height);
  const auto reduced = [&](uint32_t side) {
    return longer <= kSoundingSize ? side : std::max(1u, static_cast<uint32_t>(uint64_t{side} * kSoundingSize / longer));
  };
  const uint32_t width = reduced(scene.width), height = reduced(scene.height);
  if (!host_.resize(width, height)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  StagedFrame staged(stage_, camera, hairs_, 1.0, stage_.aspect());
  Picture picture;
  drawUntilWhole(staged.frame, picture);
  sounding.exposure = chooseExposure(host_.readColor(), 1.0, stage_);
  if (*scene.head && flkViewGetShadowMap(view_, 0, 0, &sounding.shadow.map) == FLK_SUCCESS) {
    sounding.shadow.depth = host_.readShadowMap(sounding.shadow.map);
    const FlkMaterial& material = stage_.assets[0].material;
    sounding.shadow.fibres_per_metre = 1.0f / material.fibre_spacing;
    sounding.shadow.log2_transmittance = std::log2(std::max(1.0f - material.shadow_opacity, 1e-6f));
  }
  return sounding;
}

Picture Painter::draw(const Camera& camera, double exposure) {
  const Scene& scene = stage_.scene;
  const bool shaded = scene.display == FLK_DISPLAY_SHADED;
  Picture picture;
  picture.exposure = exposure > 0.0 ? exposure : 1.0;
  Sounding sounding;
  if (shaded && (exposure <= 0.0 || *scene.head)) {
    sounding = sound(camera);
    picture.exposure = exposure > 0.0 ? exposure : sounding.exposure;
  }
  StagedFrame staged(stage_, camera, hairs_, picture.exposure, stage_.aspect());
  if (!host_.resize(scene.width, scene.height)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  Image bust;
  if (*scene.head) {
    BustLook look;
    const glm::dvec3 to_light = stageLight(stage_, camera);
    look.to_light = glm::vec3(to_light);
    // Skin is lit for its own picture: beside fibres, which reflect little of their light, it would burn out.
    look.light = glm::vec3(scene.light.color) * 2.2f;
    look.ambient = glm::vec3(0.10f, 0.11f, 0.125f);
    if (!shaded) {
      look.albedo = glm::vec3(0.10f);
    }
    if (!sounding.shadow.depth.empty()) {
      look.light_through_hair = sounding.shadow;
    }
    BustImage drawn = drawBust(camera, scene.width, scene.height, look);
    bust = std::move(drawn.color);
    for (float& depth : drawn.depth) {
      const float off = camera.reversed_depth ? 0.0f : 1.0f;
      depth = std::isfinite(depth) ? depthValue(staged.frame.clip_from_view, depth) : off;
    }
    host_.setDepth(std::move(drawn.depth));
  }
  drawUntilWhole(staged.frame, picture);
  picture.image = Image(scene.width, scene.height);
  picture.image.rgba = host_.readColor();
  if (picture.image.rgba.empty()) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "reading the image back");
  }
  // The bust is put under the hair here and not before it is drawn, so that alpha still tells where hair is.
  for (size_t i = 0; i < picture.image.rgba.size(); i += 4) {
    float* pixel = &picture.image.rgba[i];
    picture.hair_pixels += pixel[3] > 0.0f ? 1 : 0;
    if (!bust.rgba.empty()) {
      const float through = 1.0f - pixel[3];
      for (size_t channel = 0; channel < 4; ++channel) {
        pixel[channel] += through * bust.rgba[i + channel];
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
