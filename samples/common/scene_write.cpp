// Scenes as text. SPDX-License-Identifier: MIT
#include "scene_file.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

using Json = nlohmann::ordered_json;

Json triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Degrees from which the reader makes exactly these radians: there are some for all that came from degrees, and for any others
// some that miss by the last bit.
double degreesOf(double radian) {
  constexpr double degree = 3.14159265358979323846 / 180.0;
  double below = radian / degree, above = below;
  for (int step = 0; step < 4; ++step) {
    if (below * degree == radian) {
      return below;
    }
    if (above * degree == radian) {
      return above;
    }
    below = std::nextafter(below, 0.0);
    above = std::nextafter(above, 1e3);
  }
  return radian / degree;
}

Json assetJson(const SceneAsset& asset) {
  const FlkMaterial& m = asset.material;
  const FlkMaterial brown = pictureMaterial();
  Json material;
  if (asset.color_given || !std::equal(m.color, m.color + 3, brown.color)) {
    material["color"] = colorJson(m.color);
  }
  material["opacity_root"] = shortest(m.opacity_root);
  material["opacity_tip"] = shortest(m.opacity_tip);
  material["width_mm"] = asset.width_mm;
  if (m.width_scale != brown.width_scale) {
    material["width_scale"] = shortest(m.width_scale);
  }
  material["diffuse"] = shortest(m.diffuse);
  material["specular_r"] = shortest(m.specular_r);
  material["exponent_r"] = shortest(m.exponent_r);
  material["specular_trt"] = shortest(m.specular_trt);
  material["exponent_trt"] = shortest(m.exponent_trt);
  material["cuticle_tilt_deg"] = static_cast<double>(m.cuticle_tilt) * (180.0 / 3.14159265358979323846);
  material["shadow_opacity"] = shortest(m.shadow_opacity);
  material["fibre_spacing_mm"] = static_cast<double>(m.fibre_spacing) * 1e3;
  if (m.tip_blend > 0.0f || !std::equal(m.tip_color, m.tip_color + 3, brown.tip_color)) {
    material["tip_color"] = colorJson(m.tip_color);
    material["tip_blend"] = shortest(m.tip_blend);
  }
  Json json = {{"source", asset.source}, {"position", triple(asset.position)}, {"turn", asset.turn_deg},
               {"scale", asset.scale}};
  if (asset.follow != SceneFollow{}) {
    json["follow"] = {{"count", asset.follow.count}, {"radius_mm", asset.follow.radius_mm},
                      {"spread_tip", asset.follow.spread_tip}, {"seed", asset.follow.seed}};
  }
  if (!asset.root_image.empty()) {
    json["root_image"] = asset.root_image;
  }
  if (asset.points_per_strand > 0) {
    json["points_per_strand"] = asset.points_per_strand;
  }
  if (asset.ignore_colors) {
    json["ignore_colors"] = true;
  }
  json["material"] = std::move(material);
  return json;
}

}  // namespace

std::string writeScene(const Scene& scene, bool one_line) {
  Json json;
  json["assets"] = Json::array();
  for (const SceneAsset& asset : scene.assets) {
    json["assets"].push_back(assetJson(asset));
  }
  for (const SceneMesh& mesh : scene.meshes) {
    Json& entry = json["meshes"].emplace_back();
    entry = {{"source", mesh.source}, {"position", triple(mesh.position)}, {"turn", mesh.turn_deg}, {"scale", mesh.scale}};
    if (mesh.color) {
      entry["color"] = colorJson(*mesh.color);
    }
  }
  if (scene.lights.size() == 1) {
    json["light"] = lightJson(scene.lights[0]);
  } else {
    json["lights"] = Json::array();
    for (const SceneLight& light : scene.lights) {
      json["lights"].push_back(lightJson(light));
    }
  }
  json["ambient"] = triple(scene.ambient);
  if (scene.sky) {
    json["sky"] = skyJson(*scene.sky);
  }
  if (scene.ambient_sh) {
    for (const glm::dvec3& coefficient : *scene.ambient_sh) {
      json["ambient_sh"].push_back(triple(coefficient));
    }
  }
  json["exposure"] = scene.exposure;
  const SceneCamera& camera = scene.camera;
  json["camera"] = {{"azimuth", camera.azimuth_deg}, {"elevation", camera.elevation_deg},
                    {"up", camera.up == UpAxis::Z ? "z" : "y"}, {"vertical_fov", camera.vertical_fov_deg},
                    {"margin", camera.margin}};
  if (!camera.name.empty()) {
    json["camera"]["name"] = camera.name;
  }
  if (camera.placed) {
    json["camera"]["vertical_fov"] = degreesOf(camera.placed->vertical_fov);
    json["camera"]["eye"] = triple(camera.placed->eye);
    json["camera"]["target"] = triple(camera.placed->target);
    json["camera"]["up_vector"] = triple(camera.placed->up);
    json["camera"]["near"] = camera.placed->near_m;
    json["camera"]["far"] = camera.placed->far_m;
    if (camera.placed->orthographic) {
      json["camera"]["view_height"] = camera.placed->view_height;
    }
    if (camera.placed->reversed_depth) {
      json["camera"]["reversed_depth"] = true;
    }
  }
  if (scene.width > 0) {
    json["size"] = {scene.width, scene.height};
  }
  if (scene.background) {
    json["background"] = colorJson(*scene.background);
  }
  if (scene.head) {
    json["head"] = *scene.head;
  }
  json["method"] = methodNames()[scene.method];
  if (scene.k != 0) {
    json["k"] = scene.k == FLK_K_NONE ? 0 : scene.k;
  }
  if (scene.k_sort != 0) {
    json["k_sort"] = scene.k_sort;
  }
  json["payload"] = payloadNames()[scene.payload];
  json["show"] = shownName(scene);
  json["tail"] = tailNames()[scene.tail];
  json["low_shade"] = lowShadeNames()[scene.low_shade];
  if (scene.core_taps != 0) {
    json["core_taps"] = scene.core_taps;
  }
  json["capture"] = captureNames()[scene.capture];
  if (scene.near_fade) {
    json["near_fade"] = {{"start_m", scene.near_fade->start_m}, {"end_m", scene.near_fade->end_m}};
  }
  if (scene.lens) {
    json["lens"] = {{"center", {scene.lens->center[0], scene.lens->center[1]}}, {"radius", scene.lens->radius},
                    {"feather", scene.lens->feather}, {"inside", scene.lens->inside}};
  }
  try {
    return one_line ? json.dump() : json.dump(2) + "\n";
  } catch (const nlohmann::json::exception&) {  // numbers cannot fail
    throw SceneError("the name of a source, an image or a camera is not UTF-8, so that no scene can hold it");
  }
}

}  // namespace forelock::samples
