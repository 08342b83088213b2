// glTF files made by hand, and what reading them gives. SPDX-License-Identifier: MIT
#pragma once

#include "gltf_reader.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace forelock::samples {

using Json = nlohmann::ordered_json;

constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kPoints = 0, kLines = 1, kLineLoop = 2, kLineStrip = 3, kTriangles = 4;

// One mesh in one node, in one buffer; anything in `json` may be changed before it is written.
struct GltfMaker {
  Json json = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": []}],
                              "accessors": [], "bufferViews": []})");
  std::vector<unsigned char> bytes;

  template <class T> int accessor(int component_type, const char* type, size_t count, const std::vector<T>& values, size_t stride = 0) {
    const size_t from = bytes.size();
    bytes.resize(from + values.size() * sizeof(T));
    std::memcpy(bytes.data() + from, values.data(), values.size() * sizeof(T));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", from}, {"byteLength", bytes.size() - from}});
    if (stride) json["bufferViews"].back()["byteStride"] = stride;
    while (bytes.size() % 4) bytes.push_back(0);
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return int(json["accessors"].size()) - 1;
  }
  int positions(const std::vector<float>& values) { return accessor(kFloat, "VEC3", values.size() / 3, values); }
  // Vertex i at (i, 0, 0), so that strands can be told by their x.
  int positionsAlongX(size_t count) {
    std::vector<float> values;
    for (size_t i = 0; i < count; ++i) values.insert(values.end(), {float(i), 0.0f, 0.0f});
    return positions(values);
  }
  int indices(const std::vector<uint16_t>& values) { return accessor(kUnsignedShort, "SCALAR", values.size(), values); }
  // indices < 0: none. Gives the primitive.
  Json& primitive(int mode, int position, int index = -1) {
    Json& primitives = json["meshes"][0]["primitives"];
    primitives.push_back({{"attributes", {{"POSITION", position}}}, {"mode", mode}});
    if (index >= 0) primitives.back()["indices"] = index;
    return primitives.back();
  }
  Json& primitiveAlongX(int mode, size_t count, const std::vector<uint16_t>& index_values) {
    const int position = positionsAlongX(count);
    return primitive(mode, position, indices(index_values));
  }

  std::vector<unsigned char> glb() const {
    Json document = json;
    if (!document.contains("buffers")) document["buffers"] = Json::array({Json{{"byteLength", bytes.size()}}});
    return glbOf(document.dump());
  }
  std::vector<unsigned char> glbOf(std::string text) const {
    while (text.size() % 4) text += ' ';
    std::vector<unsigned char> file{'g', 'l', 'T', 'F'};
    const auto word = [&](size_t value) {
      for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<unsigned char>(value >> shift));
    };
    word(2), word(12 + 8 + text.size() + 8 + bytes.size()), word(text.size());
    file.insert(file.end(), {'J', 'S', 'O', 'N'});
    file.insert(file.end(), text.begin(), text.end());
    word(bytes.size());
    file.insert(file.end(), {'B', 'I', 'N', 0});
    file.insert(file.end(), bytes.begin(), bytes.end());
    return file;
  }
  // The text of a .gltf file whose buffer is in `uri`.
  std::string gltf(const std::string& uri) const {
    Json document = json;
    document["buffers"] = Json::array({Json{{"byteLength", bytes.size()}, {"uri", uri}}});
    return document.dump();
  }
};

inline std::vector<unsigned char> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

inline GltfStrands readBytes(std::vector<unsigned char> bytes) { return readGltf(std::move(bytes), "made.glb", ""); }
inline GltfStrands readMade(const GltfMaker& maker) { return readBytes(maker.glb()); }

// "ID: sentence" of a refusal; "" if the file is read.
inline std::string refusalOf(std::vector<unsigned char> bytes, const std::filesystem::path& folder = "") {
  try {
    readGltf(std::move(bytes), "made.glb", folder);
  } catch (const GltfError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("made.glb: ", 0), 0u) << error.what();
    return error.id + ": " + (error.what() + std::strlen("made.glb: "));
  }
  return "";
}

// The x of the vertices of each strand: "0 1 2 | 3 4".
inline std::string xOf(const GltfStrands& read) {
  std::string text;
  for (uint32_t strand = 0; strand < read.strands.strands(); ++strand) {
    text += strand ? " |" : "";
    for (uint32_t v = read.strands.first_vertex[strand]; v < read.strands.first_vertex[strand + 1]; ++v)
      text.append(text.empty() ? "" : " ").append(std::to_string(int(read.strands.positions[3 * size_t(v)])));
  }
  return text;
}

inline const AssetFinding* findingIn(const GltfStrands& read, const std::string& code) {
  for (const AssetFinding& finding : read.findings)
    if (finding.code == code) return &finding;
  return nullptr;
}

// All codes, in their order.
inline std::string codesOf(const GltfStrands& read) {
  std::string codes;
  for (const AssetFinding& finding : read.findings) codes.append(codes.empty() ? "" : " ").append(finding.code);
  return codes;
}

}  // namespace forelock::samples
