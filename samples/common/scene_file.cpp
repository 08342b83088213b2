// SPDX-License-Identifier: MIT
#include "scene_file.h"

#include "groom_recipe.h"
#include "key_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace forelock::samples {

namespace {

void readMaterial(const nlohmann::json& json, const std::string& path, SceneAsset& asset) {
  checkKeys(json, path, {"color", "opacity_root", "opacity_tip", "width_mm", "width_scale", "diffuse", "specular_r", "exponent_r",
                         "specular_trt", "exponent_trt", "cuticle_tilt_deg", "shadow_opacity", "fibre_spacing_mm",
                         "tip_color", "tip_blend"});
  KeyReader reader(json, path);
  FlkMaterial& material = asset.material;
  glm::dvec3 hair(material.color[0], material.color[1], material.color[2]);
  readColor(reader, "color", hair);
  asset.color_given = reader.has("color");
  for (int i = 0; i < 3; ++i) {
    material.color[i] = static_cast<float>(hair[i]);
  }
  readReal(reader, "opacity_root", material.opacity_root, 0.0, 1.0, "");
  readReal(reader, "opacity_tip", material.opacity_tip, 0.0, 1.0, "");
  reader.number("width_mm", asset.width_mm, 0.0, 1e6, "mm");
  readReal(reader, "width_scale", material.width_scale, 0.0, 1e6, "");
  readReal(reader, "diffuse", material.diffuse, 0.0, 1e3, "");
  readReal(reader, "specular_r", material.specular_r, 0.0, 1e3, "");
  readReal(reader, "exponent_r", material.exponent_r, 0.0, 1e6, "");
  readReal(reader, "specular_trt", material.specular_trt, 0.0, 1e3, "");
  readReal(reader, "exponent_trt", material.exponent_trt, 0.0, 1e6, "");
  constexpr double degree = 3.14159265358979323846 / 180.0;
  double tilt_deg = static_cast<double>(material.cuticle_tilt) / degree;
  reader.number("cuticle_tilt_deg", tilt_deg, -45.0, 45.0, "degrees");
  material.cuticle_tilt = static_cast<float>(tilt_deg * degree);
  readReal(reader, "shadow_opacity", material.shadow_opacity, 0.0, 1.0, "");
  double spacing_mm = static_cast<double>(material.fibre_spacing) * 1e3;
  reader.number("fibre_spacing_mm", spacing_mm, 1e-6, 1e9, "mm");
  material.fibre_spacing = static_cast<float>(spacing_mm * 1e-3);
  if (!reader.has("tip_color")) {
    refuseKeys(reader, {"tip_blend"}, "a material with tip_color, which is missing");
    return;
  }
  glm::dvec3 tip;
  readColor(reader, "tip_color", tip);
  for (int i = 0; i < 3; ++i) {
    material.tip_color[i] = static_cast<float>(tip[i]);
  }
  material.tip_blend = 1.0f;
  readReal(reader, "tip_blend", material.tip_blend, 0.0, 1.0, "");
}

void readFollow(const nlohmann::json& json, const std::string& path, SceneFollow& follow) {
  checkKeys(json, path, {"count", "radius_mm", "spread_tip", "seed"});
  KeyReader reader(json, path);
  reader.require("count");
  reader.integer("count", follow.count, 0, 1023);
  reader.number("radius_mm", follow.radius_mm, 0.0, 1e6, "mm");
  reader.number("spread_tip", follow.spread_tip, 0.0, 1e3, "");
  reader.integer("seed", follow.seed, 0, 0xFFFFFFFFu);
}

void readAsset(const nlohmann::json& json, const std::string& path, SceneAsset& asset) {
  checkKeys(json, path, {"source", "material", "position", "turn", "scale", "follow", "root_image", "ignore_colors",
                         "points_per_strand"});
  KeyReader reader(json, path);
  reader.require("source");
  reader.text("source", asset.source);
  reader.vector("position", asset.position, -1e6, 1e6, "m");
  reader.number("turn", asset.turn_deg, -360.0, 360.0, "degrees");
  reader.number("scale", asset.scale, 1e-6, 1e6, "");
  if (reader.has("material")) {
    readMaterial(json.at("material"), reader.fullKey("material"), asset);
  }
  if (reader.has("follow")) {
    readFollow(json.at("follow"), reader.fullKey("follow"), asset.follow);
  }
  reader.text("root_image", asset.root_image);
  readFlag(json, reader, "ignore_colors", asset.ignore_colors);
  reader.integer("points_per_strand", asset.points_per_strand, 2, 65536);
}

void readMeshKeys(const nlohmann::json& json, const std::string& path, SceneMesh& mesh) {
  checkKeys(json, path, {"source", "position", "turn", "scale", "color"});
  KeyReader reader(json, path);
  reader.require("source");
  reader.text("source", mesh.source);
  reader.vector("position", mesh.position, -1e6, 1e6, "m");
  reader.number("turn", mesh.turn_deg, -360.0, 360.0, "degrees");
  reader.number("scale", mesh.scale, 1e-6, 1e6, "");
  if (reader.has("color")) {
    glm::dvec3 color;
    readColor(reader, "color", color);
    mesh.color = color;
  }
}

void readCamera(const nlohmann::json& json, SceneCamera& camera) {
  checkKeys(json, "camera", {"name", "azimuth", "elevation", "up", "vertical_fov", "margin", "eye", "target",
                             "up_vector", "near", "far", "view_height", "reversed_depth"});
  KeyReader reader(json, "camera");
  reader.text("name", camera.name);
  reader.number("azimuth", camera.azimuth_deg, -360.0, 360.0, "degrees");
  reader.number("elevation", camera.elevation_deg, -90.0, 90.0, "degrees");
  camera.up = readChoice(reader, "up", {"y", "z"}, camera.up == UpAxis::Z ? 1 : 0) == 1 ? UpAxis::Z : UpAxis::Y;
  reader.number("vertical_fov", camera.vertical_fov_deg, 1.0, 150.0, "degrees");
  reader.number("margin", camera.margin, 0.1, 100.0, "");
  if (!reader.has("eye")) {
    refuseKeys(reader, {"target", "up_vector", "near", "far", "view_height", "reversed_depth"}, "a camera with eye, which is missing");
    return;
  }
  Camera placed;
  placed.up = camera.up == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  reader.require("target");
  reader.vector("eye", placed.eye, -1e12, 1e12, "m");
  reader.vector("target", placed.target, -1e12, 1e12, "m");
  reader.vector("up_vector", placed.up, -1e6, 1e6, "");
  reader.number("near", placed.near_m, 1e-12, 1e13, "m");
  reader.number("far", placed.far_m, 1e-12, 1e13, "m");
  placed.orthographic = reader.has("view_height");
  reader.number("view_height", placed.view_height, 1e-12, 1e12, "m");
  readFlag(json, reader, "reversed_depth", placed.reversed_depth);
  placed.vertical_fov = camera.vertical_fov_deg * (3.14159265358979323846 / 180.0);
  if (placed.eye == placed.target) {
    throw SceneError("camera.target is the same as camera.eye, must differ");
  }
  if (placed.far_m <= placed.near_m) {
    throw SceneError("camera.far is not beyond camera.near");
  }
  camera.placed = placed;
}

void readLighting(const nlohmann::json& json, KeyReader& top, Scene& scene) {
  if (top.has("light") && top.has("lights")) {
    throw SceneError("light and lights are both given, must be one of them: light is short for lights with one entry");
  }
  if (top.has("light")) {
    scene.lights = {readLight(json.at("light"), "light")};
  } else if (top.has("lights")) {
    scene.lights.clear();
    const nlohmann::json& lights = top.array("lights", 4096);
    for (size_t i = 0; i < lights.size(); ++i) {
      scene.lights.push_back(readLight(lights[i], "lights[" + std::to_string(i) + "]"));
    }
  }
  if (top.has("sky") && top.has("ambient_sh")) {
    throw SceneError("sky and ambient_sh are both given, must be one of them: a sky is turned into ambient_sh");
  }
  if (top.has("sky")) {
    scene.sky = readSky(json.at("sky"));
  }
  if (top.has("ambient_sh")) {
    scene.ambient_sh = readHarmonics(json.at("ambient_sh"));
  }
  if (scene.sky || scene.ambient_sh) {
    scene.ambient = glm::dvec3(0.0);
  }
  top.vector("ambient", scene.ambient, 0.0, 1e3, "");
}

SceneNearFade readNearFade(const nlohmann::json& json) {
  checkKeys(json, "near_fade", {"start_m", "end_m"});
  SceneNearFade fade;
  KeyReader reader(json, "near_fade");
  reader.require("end_m");
  reader.number("start_m", fade.start_m, 0.0, 1e6, "m");
  reader.number("end_m", fade.end_m, 1e-6, 1e6, "m");
  if (fade.end_m <= fade.start_m) {
    throw SceneError("near_fade.end_m is " + json.at("end_m").dump() + ", must be beyond start_m");
  }
  return fade;
}

SceneLens readLens(const nlohmann::json& json) {
  checkKeys(json, "lens", {"center", "radius", "feather", "inside"});
  SceneLens lens;
  KeyReader reader(json, "lens");
  const nlohmann::json& center = reader.array("center", 2);
  if (reader.has("center")) {
    const auto fits = [](const nlohmann::json& v) { return v.is_number() && std::abs(v.get<double>()) <= 10.0; };
    if (center.size() != 2 || !fits(center[0]) || !fits(center[1])) {
      throw SceneError("lens.center is " + center.dump() + ", must be two numbers in [-10, 10]");
    }
    lens.center[0] = center[0].get<double>();
    lens.center[1] = center[1].get<double>();
  }
  reader.number("radius", lens.radius, 0.0, 10.0, "");
  reader.number("feather", lens.feather, 0.001, 10.0, "");
  reader.number("inside", lens.inside, 0.0, 1.0, "");
  return lens;
}

Scene readScene(const nlohmann::json& json) {
  checkKeys(json, "", {"assets", "light", "lights", "ambient", "sky", "ambient_sh", "exposure", "camera", "size",
                       "meshes", "background", "head", "method", "k", "k_sort", "tail", "low_shade", "core_taps", "payload", "capture", "show", "near_fade",
                       "lens"});
  Scene scene;
  KeyReader top(json, "");
  const nlohmann::json& assets = top.array("assets", 63);
  for (size_t i = 0; i < assets.size(); ++i) {
    readAsset(assets[i], "assets[" + std::to_string(i) + "]", scene.assets.emplace_back());
  }
  const nlohmann::json& meshes = top.array("meshes", 63);
  for (size_t i = 0; i < meshes.size(); ++i) {
    readMeshKeys(meshes[i], "meshes[" + std::to_string(i) + "]", scene.meshes.emplace_back());
  }
  readLighting(json, top, scene);
  top.number("exposure", scene.exposure, 0.0, 1e6, "");
  if (top.has("camera")) {
    readCamera(json.at("camera"), scene.camera);
  }
  const nlohmann::json& size = top.array("size", 2);
  if (top.has("size")) {
    const auto fits = [](const nlohmann::json& v) {
      return v.is_number_unsigned() && v.get<uint64_t>() >= 1 && v.get<uint64_t>() <= 16384;
    };
    if (size.size() != 2 || !fits(size[0]) || !fits(size[1])) {
      throw SceneError("size is " + size.dump() + ", must be two whole numbers in [1, 16384]");
    }
    scene.width = size[0].get<uint32_t>();
    scene.height = size[1].get<uint32_t>();
  }
  if (top.has("background")) {
    glm::dvec3 background;
    readColor(top, "background", background);
    scene.background = background;
  }
  if (top.has("head")) {
    bool head = false;
    readFlag(json, top, "head", head);
    scene.head = head;
  }
  scene.method = readChoice(top, "method", methodNames(), scene.method);
  top.integer("k", scene.k, 0, 32);
  if (top.has("k") && scene.k == 0) {
    scene.k = FLK_K_NONE;
  }
  top.integer("k_sort", scene.k_sort, 1, 32);
  scene.payload = readChoice(top, "payload", payloadNames(), scene.payload);
  setShown(scene, readChoice(top, "show", displayNames(), scene.display));
  scene.tail = readChoice(top, "tail", tailNames(), scene.tail);
  scene.low_shade = readChoice(top, "low_shade", lowShadeNames(), scene.low_shade);
  top.integer("core_taps", scene.core_taps, 1, 25);
  if (scene.core_taps != 0 && scene.core_taps != 1 && scene.core_taps != 4 && scene.core_taps != 9 && scene.core_taps != 25) {
    throw SceneError("core_taps is " + std::to_string(scene.core_taps) + ", must be one of 1, 4, 9, 25");
  }
  scene.capture = readChoice(top, "capture", captureNames(), scene.capture);
  if (top.has("near_fade")) {
    scene.near_fade = readNearFade(json.at("near_fade"));
  }
  if (top.has("lens")) {
    scene.lens = readLens(json.at("lens"));
  }
  return scene;
}

}  // namespace

FlkMaterial pictureMaterial() {
  FlkMaterial material;
  flkMaterialDefault(&material);
  const float brown[3] = {0.105f, 0.056f, 0.030f};
  std::copy(brown, brown + 3, material.color);
  material.specular_r = 0.022f;
  material.exponent_r = 60.0f;
  material.specular_trt = 0.22f;
  material.exponent_trt = 20.0f;
  material.cuticle_tilt = 0.07f;
  material.fibre_spacing = 4e-3f;  // light fades over locks, not over single strands
  return material;
}

Scene parseScene(const std::string& text) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min<size_t>(error.byte, text.size()));
    throw SceneError("not valid JSON (line " + std::to_string(1 + std::count(text.begin(), end, '\n')) + ", byte " +
                     std::to_string(error.byte) + ")");
  }
  try {
    return readScene(json);
  } catch (const RecipeError& error) {
    throw SceneError(error.what());
  }
}

Scene loadScene(const std::string& path) {
  std::string text;
  try {
    text = readSmallText(path, "scene");
  } catch (const RecipeError& wrong) {
    throw SceneError(wrong.what());
  }
  Scene scene = parseScene(text);
  const auto fromHere = [&](std::string& name) {
    if (std::filesystem::path(name).is_relative()) {
      name = (std::filesystem::path(path).parent_path() / name).string();
    }
  };
  for (SceneMesh& mesh : scene.meshes) {
    fromHere(mesh.source);
  }
  for (SceneAsset& asset : scene.assets) {
    if (asset.source.rfind("groom:", 0) != 0) {
      fromHere(asset.source);
    }
    if (!asset.root_image.empty()) {
      fromHere(asset.root_image);
    }
  }
  return scene;
}

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> names{"core_tail", "exact", "forward", "core_only", "all_low", "hard"};
  return names;
}

const std::vector<std::string>& payloadNames() {
  static const std::vector<std::string> names{"default", "paper"};
  return names;
}

const std::vector<std::string>& tailNames() {
  static const std::vector<std::string> names{"default", "deterministic", "list", "once"};
  return names;
}

const std::vector<std::string>& lowShadeNames() {
  static const std::vector<std::string> names{"diffuse", "mean-lobes", "lobes"};
  return names;
}

const std::vector<std::string>& captureNames() {
  static const std::vector<std::string> names{"default", "raster", "compute"};
  return names;
}

const std::vector<std::string>& displayNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"shaded", "strand", "root-tip", "width", "depth", "layers"};
    all.insert(all.end(), coloringNames().begin() + 1, coloringNames().end());
    return all;
  }();
  return names;
}

void setShown(Scene& scene, uint32_t index) {
  const bool display = index <= FLK_DISPLAY_LAYERS;
  scene.display = display ? index : uint32_t{FLK_DISPLAY_SHADED};
  scene.coloring = display ? StrandColoring::none : static_cast<StrandColoring>(index - FLK_DISPLAY_LAYERS);
}

const std::string& shownName(const Scene& scene) {
  return scene.coloring == StrandColoring::none ? displayNames()[scene.display] : coloringNames()[static_cast<size_t>(scene.coloring)];
}

}  // namespace forelock::samples
