// The JSON of a glTF file, checked field by field before a parser that trusts it sees it. SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace forelock::samples {

// What is left of a document: the fields that strands are made of, each of the right type, each whole number small enough for
// the parser's `int`s where it has them, each index inside the array that it points into.
struct CheckedGltf {
  nlohmann::json document;
  std::vector<std::string> buffer_uris;  // taken out of the document; empty: none
  std::vector<uint64_t> buffer_bytes;    // byteLength
  bool deforms = false;                  // skins or morph targets, which are not read
  std::optional<std::array<float, 3>> base_color;  // of the first material (linear)
};

// Throws GltfRefusal, which names the field.
CheckedGltf checkGltfJson(std::string_view text);

}  // namespace forelock::samples
