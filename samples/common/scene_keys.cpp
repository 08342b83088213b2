// SPDX-License-Identifier: MIT
#include "scene_keys.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace forelock::samples {

namespace {

std::string listOf(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

}  // namespace

// KeyReader words its own complaints for recipes: keys of a scene are checked before it sees them.
void checkKeys(const nlohmann::json& object, const std::string& path, const std::vector<std::string>& known) {
  if (!object.is_object()) {
    throw SceneError((path.empty() ? "the scene" : path) + " must be an object { ... }");
  }
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) == known.end()) {
      throw SceneError((path.empty() ? "" : path + ".") + item.key() + " is no key of a scene; known here: " +
                       listOf(known));
    }
  }
}

void refuseKeys(const KeyReader& reader, const std::vector<const char*>& keys, const std::string& owner) {
  for (const char* key : keys) {
    if (reader.has(key)) {
      throw SceneError(reader.fullKey(key) + " belongs to " + owner);
    }
  }
}

uint32_t readChoice(KeyReader& reader, const char* key, const std::vector<std::string>& names, uint32_t value) {
  std::string text = names[value];
  reader.text(key, text);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw SceneError(reader.fullKey(key) + " is \"" + text + "\", must be one of " + listOf(names));
  }
  return static_cast<uint32_t>(found - names.begin());
}

void readFlag(const nlohmann::json& object, const KeyReader& reader, const char* key, bool& value) {
  const auto found = object.find(key);
  if (found == object.end()) {
    return;
  }
  if (!found->is_boolean()) {
    throw SceneError(reader.fullKey(key) + " is " + found->dump() + ", must be true or false");
  }
  value = found->get<bool>();
}

void readColor(KeyReader& reader, const char* key, glm::dvec3& value) {
  if (reader.isArray(key)) {
    reader.vector(key, value, 0.0, 1.0, "(linear)");
    return;
  }
  std::string text;
  reader.text(key, text);
  if (reader.has(key) && !parseHexColor(text, value)) {
    throw SceneError(reader.fullKey(key) + " is \"" + text + "\", must be sRGB as \"#rrggbb\"");
  }
}

void readReal(KeyReader& reader, const char* key, float& value, double low, double high, const char* unit) {
  double number = static_cast<double>(value);
  reader.number(key, number, low, high, unit);
  value = static_cast<float>(number);
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

nlohmann::ordered_json colorJson(const glm::dvec3& linear) {
  glm::dvec3 back;
  const std::string text = hexColor(linear);
  if (parseHexColor(text, back) && back == linear) {
    return text;
  }
  return {linear.x, linear.y, linear.z};
}

nlohmann::ordered_json colorJson(const float linear[3]) {
  glm::dvec3 back;
  const std::string text = hexColor({linear[0], linear[1], linear[2]});
  const auto isSame = [&](int i) { return static_cast<float>(back[i]) == linear[i]; };
  if (parseHexColor(text, back) && isSame(0) && isSame(1) && isSame(2)) {
    return text;
  }
  return {shortest(linear[0]), shortest(linear[1]), shortest(linear[2])};
}

}  // namespace forelock::samples
