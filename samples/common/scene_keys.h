// How scene files read keys, beyond KeyReader. SPDX-License-Identifier: MIT
#pragma once

#include "key_reader.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::samples {

// What is wrong with a scene, as one sentence that names the key, the value and the range.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws SceneError unless `object` is an object that holds only `known` keys. `path` is how messages call it.
void checkKeys(const nlohmann::json& object, const std::string& path, const std::vector<std::string>& known);

// Throws SceneError where one of `keys` is there, which `owner` alone may have.
void refuseKeys(const KeyReader& reader, const std::vector<const char*>& keys, const std::string& owner);

// The index of the key's text in `names`; `value` where the key is absent.
uint32_t readChoice(KeyReader& reader, const char* key, const std::vector<std::string>& names, uint32_t value);
void readFlag(const nlohmann::json& object, const KeyReader& reader, const char* key, bool& value);
// sRGB as text, or three linear numbers.
void readColor(KeyReader& reader, const char* key, glm::dvec3& value);
void readReal(KeyReader& reader, const char* key, float& value, double low, double high, const char* unit);

// "c08040" or "#c08040" to linear. False: not six hexadecimal digits.
bool parseHexColor(const std::string& text, glm::dvec3& linear);
std::string hexColor(const glm::dvec3& linear);

// As readColor reads them back exactly: sRGB where its eight bits hold the colour, else three linear numbers.
nlohmann::ordered_json colorJson(const glm::dvec3& linear);
nlohmann::ordered_json colorJson(const float linear[3]);

// The shortest decimals that give the float back.
double shortest(float value);

}  // namespace forelock::samples
