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

using Json = nlohmann::ordered_json;

// KeyReader words its own complaints for recipes: keys of a scene are checked before it sees them.
void checkKeys(const nlohmann::json& object, const std::string& path, const std::vector<std::string>& known) {
  if (!object.is_object()) {
    throw SceneError((path.empty() ? "the scene" : path) + " must be an object { ... }");
  }
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
      std::string list;
      for (const std::string& key : known) {
        list += (list.empty() ? "" : ", ") + key;
      }
      throw SceneError((path.empty() ? "" : path + ".") + item.key() + " is no key of a scene; known here: " + list);
    }
  }
}

uint32_t choice(KeyReader& reader, const char* key, const std::vector<std::string>& names, uint32_t value) {
  std::string text = names[value];
  reader.text(key, text);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    std::string list;
    for (const std::string& name : names) {
      list += (list.empty() ? "" : ", ") + name;
    }
    throw SceneError(reader.fullKey(key) + " is \"" + text + "\", must be one of " + list);
  }
  return static_cast<uint32_t>(found - names.begin());
}

void flag(const nlohmann::json& object, const KeyReader& reader, const char* key, bool& value) {
  const auto found = object.find(key);
  if (found == object.end()) {
    return;
  }
  if (!found->is_boolean()) {
    throw SceneError(reader.fullKey(key) + " is " + found->dump() + ", must be true or false");
  }
  value = found->get<bool>();
}

void color(KeyReader& reader, const char* key, glm::dvec3& value) {
  std::string text;
  reader.text(key, text);
  if (reader.has(key) && !parseHexColor(text, value)) {
    throw SceneError(reader.fullKey(key) + " is \"" + text + "\", must be sRGB as \"#rrggbb\"");
  }
}

void real(KeyReader& reader, const char* key, float& value, double low, double high, const char* unit) {
  double number = static_cast<double>(value);
  reader.number(key, number, low, high, unit);
  value = static_cast<float>(number);
}

void readMaterial(const nlohmann::json& json, const std::string& path, SceneAsset& asset) {
  checkKeys(json, path, {"color", "opacity_root", "opacity_tip", "width_mm", "diffuse", "specular_r", "exponent_r",
                         "specular_trt", "exponent_trt", "cuticle_tilt_deg", "shadow_opacity", "fibre_spacing_mm"});
  KeyReader reader(json, path);
  FlkMaterial& material = asset.material;
  glm::dvec3 hair(material.color[0], material.color[1], material.color[2]);
  color(reader, "color", hair);
  for (int i = 0; i < 3; ++i) {
    material.color[i] = static_cast<float>(hair[i]);
  }
  real(reader, "opacity_root", material.opacity_root, 0.0, 1.0, "");
  real(reader, "opacity_tip", material.opacity_tip, 0.0, 1.0, "");
  reader.number("width_mm", asset.width_mm, 0.0, 1e6, "mm");
  real(reader, "diffuse", material.diffuse, 0.0, 1e3, "");
  real(reader, "specular_r", material.specular_r, 0.0, 1e3, "");
  real(reader, "exponent_r", material.exponent_r, 0.0, 1e6, "");
  real(reader, "specular_trt", material.specular_trt, 0.0, 1e3, "");
  real(reader, "exponent_trt", material.exponent_trt, 0.0, 1e6, "");
  constexpr double degree = 3.14159265358979323846 / 180.0;
  double tilt_deg = static_cast<double>(material.cuticle_tilt) / degree;
  reader.number("cuticle_tilt_deg", tilt_deg, -45.0, 45.0, "degrees");
  material.cuticle_tilt = static_cast<float>(tilt_deg * degree);
  real(reader, "shadow_opacity", material.shadow_opacity, 0.0, 1.0, "");
  double spacing_mm = static_cast<double>(material.fibre_spacing) * 1e3;
  reader.number("fibre_spacing_mm", spacing_mm, 1e-6, 1e9, "mm");
  material.fibre_spacing = static_cast<float>(spacing_mm * 1e-3);
}

void readAsset(const nlohmann::json& json, const std::string& path, SceneAsset& asset) {
  checkKeys(json, path, {"source", "material", "position", "turn", "scale"});
  KeyReader reader(json, path);
  reader.require("source");
  reader.text("source", asset.source);
  reader.vector("position", asset.position, -1e6, 1e6, "m");
  reader.number("turn", asset.turn_deg, -360.0, 360.0, "degrees");
  reader.number("scale", asset.scale, 1e-6, 1e6, "");
  if (reader.has("material")) {
    readMaterial(json.at("material"), reader.fullKey("material"), asset);
  }
}

void readCamera(const nlohmann::json& json, SceneCamera& camera) {
  checkKeys(json, "camera", {"name", "azimuth", "elevation", "up", "vertical_fov", "margin", "eye", "target",
                             "up_vector", "near", "far"});
  KeyReader reader(json, "camera");
  reader.text("name", camera.name);
  reader.number("azimuth", camera.azimuth_deg, -360.0, 360.0, "degrees");
  reader.number("elevation", camera.elevation_deg, -90.0, 90.0, "degrees");
  camera.up = choice(reader, "up", {"y", "z"}, camera.up == UpAxis::Z ? 1 : 0) == 1 ? UpAxis::Z : UpAxis::Y;
  reader.number("vertical_fov", camera.vertical_fov_deg, 1.0, 150.0, "degrees");
  reader.number("margin", camera.margin, 0.1, 100.0, "");
  if (!reader.has("eye")) {
    for (const char* key : {"target", "up_vector", "near", "far"}) {
      if (reader.has(key)) {
        throw SceneError(std::string("camera.") + key + " belongs to a camera with eye, which is missing");
      }
    }
    return;
  }
  Camera placed;
  placed.up = camera.up == UpAxis::Z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  reader.require("target");
  reader.vector("eye", placed.eye, -1e6, 1e6, "m");
  reader.vector("target", placed.target, -1e6, 1e6, "m");
  reader.vector("up_vector", placed.up, -1.0, 1.0, "");
  reader.number("near", placed.near_m, 1e-6, 1e6, "m");
  reader.number("far", placed.far_m, 1e-6, 1e7, "m");
  placed.vertical_fov = camera.vertical_fov_deg * (3.14159265358979323846 / 180.0);
  if (placed.eye == placed.target) {
    throw SceneError("camera.target is the same as camera.eye, must differ");
  }
  if (placed.far_m <= placed.near_m) {
    throw SceneError("camera.far is not beyond camera.near");
  }
  camera.placed = placed;
}

Scene readScene(const nlohmann::json& json) {
  checkKeys(json, "", {"assets", "light", "ambient", "exposure", "camera", "size", "background", "head", "method", "k",
                       "k_sort", "payload", "show"});
  Scene scene;
  KeyReader top(json, "");
  const nlohmann::json& assets = top.array("assets", 63);
  for (size_t i = 0; i < assets.size(); ++i) {
    readAsset(assets[i], "assets[" + std::to_string(i) + "]", scene.assets.emplace_back());
  }
  if (top.has("light")) {
    const nlohmann::json& light = json.at("light");
    checkKeys(light, "light", {"azimuth", "elevation", "color", "shadow", "shadow_size"});
    KeyReader reader(light, "light");
    reader.number("azimuth", scene.light.azimuth_deg, -360.0, 360.0, "degrees");
    reader.number("elevation", scene.light.elevation_deg, -90.0, 90.0, "degrees");
    color(reader, "color", scene.light.color);
    flag(light, reader, "shadow", scene.light.shadow);
    reader.integer("shadow_size", scene.light.shadow_size, 64, 8192);
    scene.light.shadow_size -= scene.light.shadow_size % 2;
  }
  top.vector("ambient", scene.ambient, 0.0, 1e3, "");
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
    color(top, "background", background);
    scene.background = background;
  }
  if (top.has("head")) {
    bool head = false;
    flag(json, top, "head", head);
    scene.head = head;
  }
  scene.method = choice(top, "method", methodNames(), scene.method);
  top.integer("k", scene.k, 0, 32);
  if (top.has("k") && scene.k == 0) {
    scene.k = FLK_K_NONE;
  }
  top.integer("k_sort", scene.k_sort, 1, 32);
  scene.payload = choice(top, "payload", payloadNames(), scene.payload);
  scene.display = choice(top, "show", displayNames(), scene.display);
  return scene;
}

Json triple(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Floats as the shortest decimals that give them back.
double shortest(float value) {
  char text[32];
  for (int digits = 1; digits < 10; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(value));
    if (std::strtof(text, nullptr) == value) {
      break;
    }
  }
  return std::strtod(text, nullptr);
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
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw SceneError("cannot be read as a scene file");
  }
  Scene scene = parseScene(text.str());
  for (SceneAsset& asset : scene.assets) {
    const std::filesystem::path source(asset.source);
    if (asset.source.rfind("groom:", 0) != 0 && source.is_relative()) {
      asset.source = (std::filesystem::path(path).parent_path() / source).string();
    }
  }
  return scene;
}

std::string writeScene(const Scene& scene) {
  constexpr double radian = 180.0 / 3.14159265358979323846;
  Json json;
  json["assets"] = Json::array();
  for (const SceneAsset& asset : scene.assets) {
    const FlkMaterial& m = asset.material;
    json["assets"].push_back(
        {{"source", asset.source}, {"position", triple(asset.position)}, {"turn", asset.turn_deg},
         {"scale", asset.scale},
         {"material", {{"color", hexColor({m.color[0], m.color[1], m.color[2]})},
                       {"opacity_root", shortest(m.opacity_root)}, {"opacity_tip", shortest(m.opacity_tip)},
                       {"width_mm", asset.width_mm}, {"diffuse", shortest(m.diffuse)},
                       {"specular_r", shortest(m.specular_r)}, {"exponent_r", shortest(m.exponent_r)},
                       {"specular_trt", shortest(m.specular_trt)}, {"exponent_trt", shortest(m.exponent_trt)},
                       {"cuticle_tilt_deg", static_cast<double>(m.cuticle_tilt) * radian},
                       {"shadow_opacity", shortest(m.shadow_opacity)},
                       {"fibre_spacing_mm", static_cast<double>(m.fibre_spacing) * 1e3}}}});
  }
  json["light"] = {{"azimuth", scene.light.azimuth_deg}, {"elevation", scene.light.elevation_deg},
                   {"color", hexColor(scene.light.color)}, {"shadow", scene.light.shadow},
                   {"shadow_size", scene.light.shadow_size}};
  json["ambient"] = triple(scene.ambient);
  json["exposure"] = scene.exposure;
  const SceneCamera& camera = scene.camera;
  json["camera"] = {{"azimuth", camera.azimuth_deg}, {"elevation", camera.elevation_deg},
                    {"up", camera.up == UpAxis::Z ? "z" : "y"}, {"vertical_fov", camera.vertical_fov_deg},
                    {"margin", camera.margin}};
  if (!camera.name.empty()) {
    json["camera"]["name"] = camera.name;
  }
  if (camera.placed) {
    json["camera"]["vertical_fov"] = camera.placed->vertical_fov * radian;
    json["camera"]["eye"] = triple(camera.placed->eye);
    json["camera"]["target"] = triple(camera.placed->target);
    json["camera"]["up_vector"] = triple(camera.placed->up);
    json["camera"]["near"] = camera.placed->near_m;
    json["camera"]["far"] = camera.placed->far_m;
  }
  if (scene.width > 0) {
    json["size"] = {scene.width, scene.height};
  }
  if (scene.background) {
    json["background"] = hexColor(*scene.background);
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
  json["show"] = displayNames()[scene.display];
  return json.dump(2) + "\n";
}

const std::vector<std::string>& methodNames() {
  static const std::vector<std::string> names{"core_tail", "exact", "forward"};
  return names;
}

const std::vector<std::string>& payloadNames() {
  static const std::vector<std::string> names{"default", "paper"};
  return names;
}

const std::vector<std::string>& displayNames() {
  static const std::vector<std::string> names{"shaded", "strand", "root-tip", "width", "depth", "layers"};
  return names;
}

bool parseHexColor(const std::string& text, glm::dvec3& linear) {
  const std::string digits = !text.empty() && text[0] == '#' ? text.substr(1) : text;
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) {
    return false;
  }
  for (int i = 0; i < 3; ++i) {
    const double x = std::stoi(digits.substr(static_cast<size_t>(2 * i), 2), nullptr, 16) / 255.0;
    linear[i] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  }
  return true;
}

std::string hexColor(const glm::dvec3& linear) {
  std::string text = "#";
  for (int i = 0; i < 3; ++i) {
    const double x = std::clamp(linear[i], 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    char pair[8];
    std::snprintf(pair, sizeof pair, "%02x", static_cast<unsigned>(encoded * 255.0 + 0.5));
    text += pair;
  }
  return text;
}

}  // namespace forelock::samples
