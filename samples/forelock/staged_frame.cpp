// SPDX-License-Identifier: MIT
#include "stage.h"

#include <algorithm>

namespace forelock::samples {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

}  // namespace

StagedFrame::StagedFrame(const Stage& stage, const Camera& camera, const std::vector<Hair>& hairs, double exposure,
                         uint32_t width, uint32_t height)
    : frame(frameDesc()), ambient_sh{}, modifiers{} {
  const Scene& scene = stage.scene;
  const bool lit = scene.coloring == StrandColoring::none;  // else colours are seen as they are
  for (const SceneLight& wanted : lit ? scene.lights : std::vector<SceneLight>()) {
    FlkLight& light = lights.emplace_back();
    light.kind = wanted.kind;
    const glm::dvec3 towards = towardsLight(wanted, camera);
    for (int i = 0; i < 3; ++i) {
      light.direction[i] = static_cast<float>(towards[i]);
      light.radiance[i] = static_cast<float>(wanted.color[i] * wanted.intensity * exposure);
      light.position[i] = wanted.position[i];
    }
    light.range = static_cast<float>(wanted.range_m);
    light.source_radius = static_cast<float>(wanted.source_radius_mm * 1e-3);
    light.inner_angle = static_cast<float>(wanted.inner_angle_deg * kDegree);
    light.outer_angle = static_cast<float>(wanted.outer_angle_deg * kDegree);
    light.casts_shadow = wanted.shadow ? 1 : 0;
    light.shadow_size = wanted.shadow_size;
    light.shadow_cover = wanted.shadow_cover;
  }
  Harmonics harmonics;
  if (lit && stageHarmonics(stage, harmonics)) {
    for (size_t i = 0; i < 27; ++i) {
      ambient_sh[i] = static_cast<float>(harmonics[i / 3][static_cast<int>(i % 3)] * exposure);
    }
    frame.ambient_sh = ambient_sh;
  }
  if (scene.near_fade) {
    FlkOpacityModifier& fade = modifiers[frame.opacity_modifier_count++];
    fade.kind = FLK_OPACITY_NEAR_FADE;
    fade.start = static_cast<float>(scene.near_fade->start_m);
    fade.end = static_cast<float>(scene.near_fade->end_m);
  }
  if (scene.lens) {
    FlkOpacityModifier& lens = modifiers[frame.opacity_modifier_count++];
    lens.kind = FLK_OPACITY_LENS;
    lens.center[0] = static_cast<float>(scene.lens->center[0] * width);
    lens.center[1] = static_cast<float>(scene.lens->center[1] * height);
    lens.radius = static_cast<float>(scene.lens->radius * height);
    lens.feather = static_cast<float>(scene.lens->feather * height);
    lens.inside = static_cast<float>(scene.lens->inside);
  }
  frame.opacity_modifiers = modifiers;
  for (int i = 0; i < 3; ++i) {
    frame.ambient[i] = lit ? static_cast<float>(scene.ambient[i] * exposure) : 1.0f;
  }
  for (const Hair& hair : hairs) {
    handles.push_back(hair);
  }
  viewMatrix(camera, frame.view_from_world);
  projectionMatrix(camera, stage.aspect(), frame.clip_from_view);
  frame.reversed_depth = camera.reversed_depth ? 1 : 0;
  frame.hairs = handles.data();
  frame.hair_count = static_cast<uint32_t>(handles.size());
  frame.lights = lights.data();
  frame.light_count = static_cast<uint32_t>(lights.size());
  frame.method = scene.method;
  frame.k = scene.k;
  frame.k_sort = scene.k_sort;
  frame.payload = scene.payload;
  frame.display = scene.display;
  frame.tail = scene.tail;
  frame.core_taps = scene.core_taps;
  frame.low_shade = scene.low_shade;
  frame.capture = scene.capture;
  frame.timestamps = 1;
}

std::string methodText(const Scene& scene) {
  const std::string capture = scene.capture == FLK_CAPTURE_DEFAULT ? "" : ", capture by " + captureNames()[scene.capture];
  if (scene.display != FLK_DISPLAY_SHADED || scene.coloring != StrandColoring::none) {
    return "colours show " + shownName(scene) + capture;
  }
  std::string text = methodNames()[scene.method];
  const uint32_t k = scene.k == FLK_K_NONE ? 0 : scene.k == 0 ? 8 : scene.k;
  const uint32_t k_sort = scene.k_sort == 0 ? std::max(8u, k) : scene.k_sort;
  const bool has_core = scene.method == FLK_METHOD_CORE_TAIL || scene.method == FLK_METHOD_CORE_ONLY;
  const bool has_tail = scene.method == FLK_METHOD_CORE_TAIL || scene.method == FLK_METHOD_ALL_LOW;
  if (has_core) {
    text += ", k " + std::to_string(k);
  }
  if (has_core || has_tail || scene.method == FLK_METHOD_FORWARD) {
    text += ", k_sort " + std::to_string(k_sort);
  }
  if (has_tail && scene.tail == FLK_TAIL_LIST) {
    text += ", tail in list order";
  }
  if (has_tail && scene.tail == FLK_TAIL_ONCE) {
    text += ", tail shaded once";
  }
  if (has_tail && scene.low_shade != FLK_LOW_SHADE_DEFAULT) {
    text += ", cheap shade with " + lowShadeNames()[scene.low_shade];
  }
  if (scene.core_taps != 0 && scene.core_taps != 25 && scene.method != FLK_METHOD_ALL_LOW) {
    text += ", " + std::to_string(scene.core_taps) + (scene.core_taps == 1 ? " tap" : " taps");
  }
  if (scene.payload == FLK_PAYLOAD_PAPER && scene.method != FLK_METHOD_HARD) {
    text += ", payload of the paper";
  }
  return text + capture;
}

}  // namespace forelock::samples
