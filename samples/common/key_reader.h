// Reads a JSON object key by key; complains about what is out of range or was never asked for.
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

// Every function throws RecipeError with the full key, the value and what is allowed. An absent key leaves the value
// that was there, which is its default; require() turns that into an error.
class KeyReader {
 public:
  // `object` must outlive the reader. `path` is how messages call it, "" at the top.
  KeyReader(const nlohmann::json& object, std::string path);

  bool has(const char* key) const;
  bool isArray(const char* key) const;
  void require(const char* key) const;
  void number(const char* key, double& value, double low, double high, const char* unit);
  void integer(const char* key, uint32_t& value, uint32_t low, uint32_t high);
  void integer(const char* key, uint64_t& value);
  void text(const char* key, std::string& value);
  void vector(const char* key, glm::dvec3& value, double low, double high, const char* unit);

  // The object or array behind a key; an empty one of that type when the key is absent.
  KeyReader object(const char* key);
  const nlohmann::json& array(const char* key, size_t most);

  // Call last: a key that nobody asked for is an error.
  void finish() const;

  std::string fullKey(const std::string& key) const;

 private:
  const nlohmann::json* find(const char* key);

  const nlohmann::json& object_;
  std::string path_;
  std::vector<std::string> asked_;
};

}  // namespace forelock::samples
