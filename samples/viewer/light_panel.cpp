// The panel of what lights the scene. SPDX-License-Identifier: MIT
#include "ui.h"
#include "view_session.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

constexpr size_t kMostLights = 8;

void colorOf(const char* label, glm::dvec3& linear, const char* words) {
  float rgb[3] = {static_cast<float>(linear.x), static_cast<float>(linear.y), static_cast<float>(linear.z)};
  if (ui::color(label, rgb, words)) {
    linear = glm::dvec3(rgb[0], rgb[1], rgb[2]);
  }
}

void pointOf(const char* label, glm::dvec3& point, const char* words) {
  const ui::Scope scope(label);
  const char* names[] = {"x", "y", "z"};
  ImGui::TextDisabled("%s", label);
  for (int i = 0; i < 3; ++i) {
    ui::slide(names[i], point[i], -3.0, 3.0, words, "%.3f m");
  }
}

const char* roleOf(const SceneLight& light) {
  if (light.kind != FLK_LIGHT_DIRECTIONAL) {
    return light.kind == FLK_LIGHT_POINT ? "lamp" : "spot";
  }
  return std::abs(light.azimuth_deg) > 100.0 ? "rim" : std::abs(light.azimuth_deg) > 75.0 ? "side" : "key";
}

// False: the light is to go.
bool lightWidgets(SceneLight& light) {
  ui::choose("Kind", light.kind, lightKindNames(), "directional: a sun, seen from the camera; point: a lamp; spot: a lamp with a cone");
  if (light.kind == FLK_LIGHT_DIRECTIONAL) {
    ui::slide("Azimuth (deg)", light.azimuth_deg, -180.0, 180.0, "Seen from the camera: 0 shines along the view, negative comes from the left, beyond 90 from behind", "%.0f");
    ui::slide("Elevation (deg)", light.elevation_deg, -90.0, 90.0, "Above the view", "%.0f");
  } else {
    pointOf("Position", light.position, "Where the lamp is, in the world");
    if (light.kind == FLK_LIGHT_SPOT) {
      pointOf("Target", light.target, "What it shines at");
      ui::slide("Inner angle (deg)", light.inner_angle_deg, 0.0, 85.0, "Full light within, from the axis", "%.0f");
      light.outer_angle_deg = std::max(light.outer_angle_deg, light.inner_angle_deg + 1.0);
      ui::slide("Outer angle (deg)", light.outer_angle_deg, light.inner_angle_deg + 1.0, 90.0, "No light beyond, from the axis", "%.0f");
    }
    ui::slide("Range (m)", light.range_m, 0.0, 20.0, "Nothing arrives beyond; 0 is no end", "%.2f");
    ui::slide("Source (mm)", light.source_radius_mm, 0.1, 500.0, "Radius of what shines: nearer than this it grows no brighter", "%.3g", true);
  }
  ui::slide("Intensity", light.intensity, 0.0, 10.0, "Times the exposure; of a lamp what arrives at one metre", "%.3g");
  colorOf("Colour", light.color, "Of the light");
  ui::checkbox("Casts shadows", light.shadow, "Hair, head and meshes take light from what lies behind them. Costs one shadow map; of a lamp amid the hair six");
  if (light.shadow) {
    const std::vector<uint32_t> sizes{256, 512, 1024, 2048, 4096, 8192};
    uint32_t index = 0;
    while (index + 1 < sizes.size() && sizes[index] < light.shadow_size) {
      ++index;
    }
    const std::vector<std::string> names{"256", "512", "1024", "2048", "4096", "8192"};
    if (ui::choose("Shadow map", index, names, "Texels a side")) {
      light.shadow_size = sizes[index];
    }
    ui::choose("Strands cover", light.shadow_cover, {"texels", "their width"},
               "Of the shadow map: every texel they touch, as in the paper, which is darker the coarser the map is; or as many as their width asks for, "
               "the same light whatever the map's size");
  }
  return !ui::button("Remove", "This light out of the scene");
}

}  // namespace

void lightPanel(ViewSession& session) {
  const ui::Scope scope("Lights");
  Scene& scene = session.scene;
  if (ui::slide("Exposure", scene.exposure, 1e-2, 1e3, "What light on hair is multiplied by. Head and meshes have their own, by which they stay as bright as skin", "%.4g", true)) {
    session.auto_exposure = false;
  }
  if (ui::button("Expose now", "Chooses the exposure for the picture as it is, as for the first one")) {
    scene.exposure = 0.0;
  }
  ImGui::SameLine();
  ui::checkbox("Auto exposure", session.auto_exposure, "Chosen anew whenever lights or materials change; else what they change is seen as it is");
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const std::string name = "Light " + std::to_string(i + 1);
    const bool open = ImGui::TreeNodeEx(name.c_str(), ImGuiTreeNodeFlags_DefaultOpen, "%s, %s", name.c_str(), roleOf(scene.lights[i]));
    ui::noteItem(name, open);
    if (open) {
      const ui::Scope inside(name);
      if (!lightWidgets(scene.lights[i])) {
        scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(i));
      }
      ImGui::TreePop();
    }
  }
  const bool room = scene.lights.size() < kMostLights;
  const auto add = [&](double azimuth, double elevation, double intensity, const glm::dvec3& color) {
    SceneLight light;
    light.azimuth_deg = azimuth;
    light.elevation_deg = elevation;
    light.intensity = intensity;
    light.color = color;
    scene.lights.push_back(light);
  };
  if (ui::button("Add key", "A light from the front left, warm", room)) {
    add(-42.0, 44.0, 1.0, {1.0, 0.97, 0.93});
  }
  ImGui::SameLine();
  if (ui::button("Add rim", "A light from behind, which draws the outline", room)) {
    add(155.0, 35.0, 1.5, {0.9, 0.95, 1.0});
  }
  ImGui::SameLine();
  if (ui::button("Add lamp", "A lamp beside the hair", room)) {
    SceneLight lamp;
    lamp.kind = FLK_LIGHT_POINT;
    lamp.position = session.bounds.high + glm::dvec3(0.3, 0.1, 0.3);
    lamp.intensity = 0.3;
    scene.lights.push_back(lamp);
  }
  ImGui::Separator();
  colorOf("Ambient", scene.ambient, "Light from everywhere");
  bool sky = scene.sky.has_value();
  if (ui::checkbox("Sky", sky, "Light from above, the horizon and below, as radiance over directions")) {
    if (sky) {
      scene.sky = SceneSky{{0.5, 0.7, 1.0}, {0.8, 0.8, 0.8}, {0.25, 0.2, 0.16}, 0.15};
      scene.ambient_sh.reset();
    } else {
      scene.sky.reset();
    }
  }
  if (scene.sky) {
    colorOf("Top", scene.sky->top, "Of the sky");
    colorOf("Horizon", scene.sky->horizon, "Of the sky");
    colorOf("Bottom", scene.sky->bottom, "Of the ground");
    ui::slide("Sky's intensity", scene.sky->intensity, 0.0, 2.0, "As a share of the light's");
  }
  bool ground = scene.background.has_value();
  if (ui::checkbox("Background", ground, "A colour behind it all; without one pictures are transparent there")) {
    if (ground) {
      scene.background = glm::dvec3(0.0144, 0.0176, 0.0212);
    } else {
      scene.background.reset();
    }
  }
  if (scene.background) {
    colorOf("Background's colour", *scene.background, "Behind it all");
  }
}

}  // namespace forelock::samples
