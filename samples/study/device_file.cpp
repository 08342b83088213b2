// SPDX-License-Identifier: MIT
#include "device_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace forelock::study {

using namespace samples;
using Json = nlohmann::ordered_json;

namespace {

Json parsed(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return file ? Json::parse(file, nullptr, false) : Json();
}

// Through a file beside it, so that a kill leaves the old one whole.
void replaceFile(const std::string& path, const std::string& text) {
  {
    std::ofstream file(path + ".part", std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written, check the folder's permissions and room");
  }
  std::filesystem::rename(path + ".part", path);
}

Json viewJson(const View& v) {
  Json json = {{"name", v.name}, {"width", v.width}, {"height", v.height}, {"fragments", v.fragments}, {"hair_pixels", v.hair_pixels},
               {"mean_overdraw", double(v.fragments) / double(v.hair_pixels)}};
  json["max_overdraw"] = v.max_overdraw ? Json(v.max_overdraw) : Json();
  json["rect"] = {v.rect.x, v.rect.y, v.rect.width, v.rect.height};
  json["scene"] = "scene-" + v.name + ".json";
  return json;
}

}  // namespace

const char* deviceKind(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return "processor";
    default: return "other";
  }
}

bool readCalibration(const std::string& path, const std::string& device, Calibration& calibration) {
  const Json json = parsed(path);
  if (!json.is_object() || !json.contains("device") || json["device"] != device) return false;
  for (const char* key : {"bandwidth_gb_s", "lane_operations_per_s"})
    if (!json.contains(key) || !json[key].is_number() || !(json[key].get<double>() > 0)) return false;
  calibration.bytes_per_s = 1e9 * json["bandwidth_gb_s"].get<double>();
  calibration.operations_per_s = json["lane_operations_per_s"].get<double>();
  calibration.measured = json.value("calibration", "") == "measured";
  return true;
}

void writeDeviceFile(const std::string& path, const DeviceFacts& facts, const std::vector<View>& views) {
  const Json before = parsed(path);
  char date[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  Json json = {{"device", facts.device}, {"driver", facts.driver}, {"type", facts.type},
               {"bandwidth_gb_s", facts.calibration.bytes_per_s / 1e9}, {"lane_operations_per_s", facts.calibration.operations_per_s},
               {"calibration", facts.calibration.measured ? "measured" : "given"}, {"commit", facts.commit}, {"date", date},
               {"asset", facts.asset}, {"command", facts.command}};
  json["views"] = Json::array();
  if (before.is_object() && before.contains("views") && before["views"].is_array())
    for (const Json& old : before["views"]) {
      const bool replaced = std::any_of(views.begin(), views.end(), [&](const View& v) { return old.value("name", "") == v.name; });
      if (!replaced) json["views"].push_back(old);
    }
  for (const View& view : views) json["views"].push_back(viewJson(view));
  replaceFile(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

void writeSceneFile(const std::string& path, const Subject& subject, const View& view, HairColor color, double exposure) {
  Scene scene = subject.scene;
  scene.exposure = exposure;
  scene.camera.placed = view.camera;
  scene.camera.name.clear();
  scene.width = view.scene_width, scene.height = view.scene_height;
  scene.head = false;
  if (!subject.has_setting) {
    constexpr double degree = 3.14159265358979323846 / 180.0;
    scene.ambient = glm::dvec3(0.0);
    SceneLight light;
    const double* l = kConditionLight;
    light.azimuth_deg = std::atan2(l[0], l[2]) / degree;
    light.elevation_deg = std::atan2(l[1], std::hypot(l[0], l[2])) / degree;
    light.color = glm::dvec3(1.0);
    light.shadow_size = kDefaultShadowSize;
    scene.lights = {light};
    for (SceneAsset& asset : scene.assets) {
      asset.material = conditionMaterial(color);
      asset.color_given = true;
      asset.ignore_colors = true;
    }
  }
  replaceFile(path, writeScene(scene));
}

}  // namespace forelock::study
