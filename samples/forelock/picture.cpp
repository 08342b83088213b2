// SPDX-License-Identifier: MIT
#include "picture.h"

#include "bust.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace forelock::samples {

namespace {

constexpr uint64_t kPoolBudget = uint64_t{1} << 30;
constexpr uint32_t kMostAttempts = 4;
constexpr uint32_t kSoundingSize = 320;  // pixels of the longer side of the first picture

double luminance(const glm::dvec3& rgb) { return 0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z; }

float depthValue(const float projection[16], float depth) {
  const float z = projection[10] * -depth + projection[14];
  const float w = projection[11] * -depth + projection[15];
  return std::clamp(z / w, 0.0f, 1.0f);
}

// docs/methods.md section 4 for a point of the bust, averaged over a disc: the map's strands are a texel wide and would
// draw their pattern on the skin.
struct HairShadow {
  struct Face {
    FlkShadowMap map;
    std::vector<float> depth;  // map values
  };
  std::vector<Face> faces;     // none: nothing is shadowed
  glm::dvec3 position{0.0};    // of a point or spot light
  float fibres_per_metre = 0.0f;
  float log2_transmittance = 0.0f;

  float operator()(const glm::vec3& p) const {
    const Face* face = nullptr;
    glm::dvec4 at(0.0);
    for (const Face& other : faces) {  // of six the one that the point lies before
      const glm::dvec4 there = glm::make_mat4(other.map.texels_from_world) * glm::dvec4(p, 1.0);
      if (!face || there.z > at.z) {
        face = &other;
        at = there;
      }
    }
    if (!face || (face->map.perspective && at.z <= 0.0)) {
      return 1.0f;
    }
    const FlkShadowMap& map = face->map;
    double texel = static_cast<double>(map.texel);
    double distance = at.z;
    if (map.perspective) {
      texel *= at.z;
      distance = glm::length(glm::dvec3(p) - position);
      at /= at.w;
    }
    float light = 0.0f, sum = 0.0f;
    const int size = static_cast<int>(map.size);
    const int reach = static_cast<int>(std::clamp(0.004 / texel, 2.0, 16.0));  // 4 mm
    const int middle_x = static_cast<int>(std::clamp(at.x, -1e6, 1e6));
    const int middle_y = static_cast<int>(std::clamp(at.y, -1e6, 1e6));
    for (int j = -reach; j <= reach; ++j) {
      for (int i = -reach; i <= reach; ++i) {
        if (i * i + j * j > reach * reach) {
          continue;
        }
        const int x = middle_x + i, y = middle_y + j;
        sum += 1.0f;
        const bool outside = x < 0 || y < 0 || x >= size || y >= size;
        const float front = outside ? 1.0f : face->depth[static_cast<size_t>(y) * map.size + static_cast<size_t>(x)];
        const float behind = front >= 1.0f ? 0.0f : static_cast<float>(distance) - front * map.depth_range;
        light += std::exp2(std::max(behind, 0.0f) * fibres_per_metre * log2_transmittance);
      }
    }
    return light / sum;
  }
};

constexpr size_t kMostBustShadows = 8;  // lights whose shadow maps are read back for the bust

// Skin is lit for its own picture: beside fibres, which reflect little of their light, it would burn out. So the lights
// keep their colours and what they are to each other, but come to 2.2 at the head's centre, or less where the light
// around is most of it. Light from behind counts for less: it would leave the side that is seen in the dark.
BustLook litBust(const Stage& stage, const Camera& camera) {
  const Scene& scene = stage.scene;
  const auto strongest = [](const glm::dvec3& c) { return std::max({c.x, c.y, c.z}); };
  Harmonics harmonics{};
  stageHarmonics(stage, harmonics);
  const glm::dvec3 back = cameraBasis(camera).back;
  double direct = 0.0;
  for (const SceneLight& light : scene.lights) {
    const glm::dvec3 towards = light.kind == FLK_LIGHT_DIRECTIONAL ? towardsLight(light, camera) : light.position;
    const double facing = glm::dot(towards, back) / std::max(glm::length(towards), 1e-9);
    direct += strongest(light.color) * light.intensity * lightFalloff(light, glm::dvec3(0.0)) *
              std::clamp((facing + 0.2) / 0.7, 0.3, 1.0);
  }
  const double around = strongest(scene.ambient + 0.282095 * harmonics[0]);
  const double scale = 2.2 / std::max({direct, 4.0 * around, 1e-9});
  BustLook look;
  look.lights.clear();
  for (const SceneLight& wanted : scene.lights) {
    BustLight& light = look.lights.emplace_back();
    light.color = glm::vec3(wanted.color * (wanted.intensity * scale));
    light.to_light = glm::vec3(towardsLight(wanted, camera));
    light.placed = wanted.kind != FLK_LIGHT_DIRECTIONAL;
    light.position = glm::vec3(wanted.position);
    light.range = static_cast<float>(wanted.range_m);
    light.source_radius = static_cast<float>(wanted.source_radius_mm * 1e-3);
    if (wanted.kind == FLK_LIGHT_SPOT) {
      light.cos_inner = static_cast<float>(std::cos(glm::radians(wanted.inner_angle_deg)));
      light.cos_outer = static_cast<float>(std::cos(glm::radians(wanted.outer_angle_deg)));
    }
  }
  constexpr double around_skin = 0.76;  // of the lights' scale: 2.4 times what is physical, so that no side is black
  look.ambient = glm::vec3(scene.ambient * (scale * around_skin));
  for (size_t i = 0; i < harmonics.size(); ++i) {
    look.ambient_sh[i] = glm::vec3(harmonics[i] * (scale * around_skin));
  }
  return look;
}

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

// What a small picture without a head tells.
struct Painter::Sounding {
  double exposure = 1.0;
  std::vector<std::shared_ptr<const HairShadow>> shadows;  // by light
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
  StagedFrame staged(stage_, camera, hairs_, 1.0, width, height);
  Picture picture;
  drawUntilWhole(staged.frame, picture);
  sounding.exposure = exposureOf(host_.readColor(), stage_);
  const size_t shadowing = *scene.head ? std::min(scene.lights.size(), kMostBustShadows) : 0;
  for (size_t i = 0; i < shadowing; ++i) {
    const auto shadow = std::make_shared<HairShadow>();
    FlkShadowMap map = {};
    for (uint32_t face = 0; flkViewGetShadowMap(view_, static_cast<uint32_t>(i), face, &map) == FLK_SUCCESS; ++face) {
      shadow->faces.push_back({map, host_.readShadowMap(map)});
      if (face + 1 >= map.face_count || shadow->faces.back().depth.empty()) {
        break;
      }
    }
    std::erase_if(shadow->faces, [](const HairShadow::Face& face) { return face.depth.empty(); });
    const FlkMaterial& material = stage_.assets[0].material;
    shadow->position = scene.lights[i].position;
    shadow->fibres_per_metre = 1.0f / material.fibre_spacing;
    shadow->log2_transmittance = std::log2(std::max(1.0f - material.shadow_opacity, 1e-6f));
    sounding.shadows.push_back(shadow);
  }
  return sounding;
}

Picture Painter::draw(const Camera& camera, double exposure) {
  const Scene& scene = stage_.scene;
  const bool shaded = scene.display == FLK_DISPLAY_SHADED && scene.coloring == StrandColoring::none;
  Picture picture;
  picture.exposure = exposure > 0.0 ? exposure : 1.0;
  Sounding sounding;
  if (shaded && (exposure <= 0.0 || *scene.head)) {
    sounding = sound(camera);
    picture.exposure = exposure > 0.0 ? exposure : sounding.exposure;
  }
  StagedFrame staged(stage_, camera, hairs_, picture.exposure, scene.width, scene.height);
  if (!host_.resize(scene.width, scene.height)) {
    check(FLK_ERROR_OUT_OF_DEVICE_MEMORY, "making an image");
  }
  Image bust;
  if (*scene.head) {
    BustLook look = litBust(stage_, camera);
    if (!shaded) {
      look.albedo = glm::vec3(0.10f);
    }
    for (size_t i = 0; i < sounding.shadows.size(); ++i) {
      look.lights[i].light_through_hair = [shadow = sounding.shadows[i]](const glm::vec3& p) { return (*shadow)(p); };
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
