// SPDX-License-Identifier: MIT
#include "key_reader.h"

#include "groom_recipe.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace forelock::samples {

namespace {

const nlohmann::json empty_object = nlohmann::json::object();
const nlohmann::json empty_array = nlohmann::json::array();

std::string shortDump(const nlohmann::json& value) {
  std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > 40) {
    text = text.substr(0, 37) + "...";
  }
  return text;
}

std::string range(double low, double high, const char* unit) {
  std::ostringstream out;
  out << "[" << low << ", " << high << "]";
  if (*unit != '\0') {
    out << " " << unit;
  }
  return out.str();
}

bool isWithin(const nlohmann::json& value, double low, double high) {
  return value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
}

}  // namespace

KeyReader::KeyReader(const nlohmann::json& object, std::string path) : object_(object), path_(std::move(path)) {
  if (!object_.is_object()) {
    throw RecipeError((path_.empty() ? std::string("the recipe") : path_) + " is " + shortDump(object_) +
                      ", must be an object { ... }");
  }
}

std::string KeyReader::fullKey(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

bool KeyReader::has(const char* key) const { return object_.contains(key); }

bool KeyReader::isArray(const char* key) const {
  const auto found = object_.find(key);
  return found != object_.end() && found->is_array();
}

void KeyReader::require(const char* key) const {
  if (!has(key)) {
    throw RecipeError(fullKey(key) + " is missing");
  }
}

const nlohmann::json* KeyReader::find(const char* key) {
  asked_.emplace_back(key);
  const auto found = object_.find(key);
  return found == object_.end() ? nullptr : &*found;
}

void KeyReader::number(const char* key, double& value, double low, double high, const char* unit) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return;
  }
  if (!isWithin(*found, low, high)) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be a number in " + range(low, high, unit));
  }
  value = found->get<double>();
}

void KeyReader::integer(const char* key, uint32_t& value, uint32_t low, uint32_t high) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_number_unsigned() || found->get<uint64_t>() < low || found->get<uint64_t>() > high) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be a whole number in [" +
                      std::to_string(low) + ", " + std::to_string(high) + "]");
  }
  value = found->get<uint32_t>();
}

void KeyReader::integer(const char* key, uint64_t& value) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_number_unsigned()) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be a whole number in [0, 2^64)");
  }
  value = found->get<uint64_t>();
}

void KeyReader::text(const char* key, std::string& value) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return;
  }
  if (!found->is_string()) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be a string");
  }
  value = found->get<std::string>();
}

void KeyReader::vector(const char* key, glm::dvec3& value, double low, double high, const char* unit) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return;
  }
  const auto fits = [&](const nlohmann::json& v) { return isWithin(v, low, high); };
  if (!found->is_array() || found->size() != 3 || !std::all_of(found->begin(), found->end(), fits)) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be three numbers in " +
                      range(low, high, unit));
  }
  for (int axis = 0; axis < 3; ++axis) {
    value[axis] = (*found)[static_cast<size_t>(axis)].get<double>();
  }
}

KeyReader KeyReader::object(const char* key) {
  const nlohmann::json* found = find(key);
  return KeyReader(found ? *found : empty_object, fullKey(key));
}

const nlohmann::json& KeyReader::array(const char* key, size_t most) {
  const nlohmann::json* found = find(key);
  if (!found) {
    return empty_array;
  }
  if (!found->is_array() || found->size() > most) {
    throw RecipeError(fullKey(key) + " is " + shortDump(*found) + ", must be an array of at most " +
                      std::to_string(most) + " entries");
  }
  return *found;
}

void KeyReader::finish() const {
  for (const auto& item : object_.items()) {
    if (std::find(asked_.begin(), asked_.end(), item.key()) == asked_.end()) {
      std::string known;
      for (const std::string& key : asked_) {
        known += (known.empty() ? "" : ", ") + key;
      }
      throw RecipeError(fullKey(item.key()) + " is no key of a recipe; known here: " + known);
    }
  }
}

}  // namespace forelock::samples
