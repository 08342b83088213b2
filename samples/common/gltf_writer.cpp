// SPDX-License-Identifier: MIT
#include "gltf_writer.h"

#include "strand_formats.h"
#include "whole_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>

namespace forelock::samples {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // component types
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;          // targets
constexpr int kLines = 1;                                                 // mode

// Strands of one mesh, in their order.
struct Group {
  std::string name;
  std::vector<uint32_t> strands;
};

std::vector<Group> groupsOf(const OpenedAsset& opened, const FlkStrands& strands) {
  std::vector<Group> groups;
  if (opened.groups.size() != strands.strand_count) {
    groups.push_back({"hair", {}});
    for (uint32_t i = 0; i < strands.strand_count; ++i) groups[0].strands.push_back(i);
    return groups;
  }
  for (const std::string& name : opened.group_names) groups.push_back({name, {}});
  for (uint32_t i = 0; i < strands.strand_count; ++i) groups.at(opened.groups[i]).strands.push_back(i);
  std::erase_if(groups, [](const Group& group) { return group.strands.empty(); });
  return groups;
}

class Writer {
public:
  explicit Writer(const FlkStrands& strands, bool with_radii) : strands_(strands), with_radii_(with_radii) {}

  void mesh(const Group& group) {
    Json attributes;
    const uint32_t vertices = verticesOf(group);
    attributes["POSITION"] = perVertex(group, 3, [&](uint32_t, uint32_t v, float* to) { std::memcpy(to, strands_.positions + 3 * size_t(v), 12); });
    putBounds(group);
    if (with_radii_) attributes["_WIDTH"] = perVertex(group, 1, [&](uint32_t, uint32_t v, float* to) { *to = 2 * strands_.radii[v]; });
    if (strands_.root_uvs)
      attributes["TEXCOORD_0"] = perVertex(group, 2, [&](uint32_t strand, uint32_t, float* to) { std::memcpy(to, strands_.root_uvs + 2 * size_t(strand), 8); });
    if (strands_.colors) attributes["COLOR_0"] = perVertex(group, 3, [&](uint32_t, uint32_t v, float* to) { std::memcpy(to, strands_.colors + 3 * size_t(v), 12); });
    if (strands_.inverse_masses) attributes["_INVERSE_MASS"] = perVertex(group, 1, [&](uint32_t, uint32_t v, float* to) { *to = strands_.inverse_masses[v]; });
    const size_t indices = pairs(group, vertices);
    meshes_.push_back({{"name", group.name}, {"primitives", {{{"attributes", attributes}, {"indices", indices}, {"mode", kLines}}}}});
    nodes_.push_back({{"name", group.name}, {"mesh", meshes_.size() - 1}});
  }

  std::string document(const std::string& buffer_name) const {
    Json document;
    document["asset"] = {{"version", "2.0"}, {"generator", "Forelock"}};
    document["scene"] = 0;
    Json all = Json::array();
    for (size_t i = 0; i < nodes_.size(); ++i) all.push_back(i);
    document["scenes"] = {{{"nodes", all}}};
    document["nodes"] = nodes_;
    document["meshes"] = meshes_;
    document["accessors"] = accessors_;
    document["bufferViews"] = views_;
    Json buffer{{"byteLength", bytes_.size()}};
    if (!buffer_name.empty()) buffer["uri"] = buffer_name;
    document["buffers"] = Json::array({buffer});
    return document.dump(buffer_name.empty() ? -1 : 1, ' ', false, Json::error_handler_t::replace) + (buffer_name.empty() ? "" : "\n");
  }

  std::vector<unsigned char>& bytes() { return bytes_; }

private:
  uint32_t begin(uint32_t strand) const { return strands_.first_vertex[strand]; }
  uint32_t end(uint32_t strand) const { return strands_.first_vertex[strand + 1]; }

  uint32_t verticesOf(const Group& group) const {
    uint32_t vertices = 0;
    for (const uint32_t strand : group.strands) vertices += end(strand) - begin(strand);
    return vertices;
  }

  // A view of its own for each accessor: none has a stride. Every block is of 4 bytes, and so is where the next one starts.
  size_t accessor(size_t from, int target, int component_type, uint64_t count, const char* type) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(0);
    const size_t element = component_type == kUnsignedShort ? 2 : 4;
    const size_t components = std::strcmp(type, "SCALAR") == 0 ? 1 : size_t(type[3] - '0');
    views_.push_back({{"buffer", 0}, {"byteOffset", from}, {"byteLength", count * element * components}, {"target", target}});
    accessors_.push_back({{"bufferView", views_.size() - 1}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
  }

  template <class Function> size_t perVertex(const Group& group, size_t components, Function&& value) {
    const size_t from = bytes_.size(), vertices = verticesOf(group);
    bytes_.resize(from + vertices * components * 4);
    unsigned char* to = bytes_.data() + from;
    float record[3];
    for (const uint32_t strand : group.strands)
      for (uint32_t v = begin(strand); v < end(strand); ++v, to += 4 * components) {
        value(strand, v, record);
        std::memcpy(to, record, 4 * components);
      }
    return accessor(from, kArrayBuffer, kFloat, vertices, components == 1 ? "SCALAR" : components == 2 ? "VEC2" : "VEC3");
  }

  // Of positions they are required.
  void putBounds(const Group& group) {
    float least[3], most[3];
    std::memcpy(least, strands_.positions + 3 * size_t(begin(group.strands[0])), sizeof least);
    std::memcpy(most, least, sizeof most);
    for (const uint32_t strand : group.strands)
      for (size_t v = begin(strand); v < end(strand); ++v)
        for (size_t axis = 0; axis < 3; ++axis) {
          least[axis] = std::min(least[axis], strands_.positions[3 * v + axis]);
          most[axis] = std::max(most[axis], strands_.positions[3 * v + axis]);
        }
    // As doubles, whose shortest digits give the same float again.
    for (size_t axis = 0; axis < 3; ++axis) {
      accessors_.back()["min"].push_back(double(least[axis]));
      accessors_.back()["max"].push_back(double(most[axis]));
    }
  }

  size_t pairs(const Group& group, uint32_t vertices) {
    // The largest value of a type would restart a primitive.
    const bool is_short = vertices <= 65'535;
    const size_t from = bytes_.size(), element = is_short ? 2 : 4;
    const uint64_t count = 2 * uint64_t(vertices - group.strands.size());
    bytes_.resize(from + count * element);
    unsigned char* to = bytes_.data() + from;
    const auto put = [&](uint32_t index) {
      const uint16_t index_16 = uint16_t(index);
      std::memcpy(to, is_short ? static_cast<const void*>(&index_16) : &index, element);
      to += element;
    };
    uint32_t vertex = 0;
    for (const uint32_t strand : group.strands) {
      for (uint32_t v = begin(strand); v + 1 < end(strand); ++v, ++vertex) put(vertex), put(vertex + 1);
      ++vertex;
    }
    return accessor(from, kElementArrayBuffer, is_short ? kUnsignedShort : kUnsignedInt, count, "SCALAR");
  }

  const FlkStrands strands_;
  const bool with_radii_;
  std::vector<unsigned char> bytes_;
  Json views_ = Json::array(), accessors_ = Json::array(), meshes_ = Json::array(), nodes_ = Json::array();
};

void putWord(std::vector<unsigned char>& bytes, size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<unsigned char>(value >> shift));
}

// Characters that a URI may hold as they are; the others become %XX.
std::string uriOf(const std::string& name) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string uri;
  for (const unsigned char c : name) {
    if (std::isalnum(c) || std::strchr("-._~", c)) uri += static_cast<char>(c);
    else uri += {'%', digits[c >> 4], digits[c & 15]};
  }
  return uri;
}

}  // namespace

GltfFiles writeGltf(const OpenedAsset& opened, const std::string& buffer_name, const std::string& label) {
  FlkStrands strands{};
  FlkAssetInfo info{};
  flkAssetGetStrands(opened.asset.get(), &strands);
  flkAssetGetInfo(opened.asset.get(), &info);
  Writer writer(strands, info.has_radii != 0);
  for (const Group& group : groupsOf(opened, strands)) writer.mesh(group);
  const std::string json = writer.document(buffer_name);
  GltfFiles files;
  if (!buffer_name.empty()) {
    files.main.assign(json.begin(), json.end());
    files.buffer = std::move(writer.bytes());
    return files;
  }
  const size_t json_bytes = (json.size() + 3) / 4 * 4, length = 12 + 8 + json_bytes + 8 + writer.bytes().size();
  if (length > UINT32_MAX)
    throw AssetError(FLK_ERROR_LIMIT, label + ": it would have " + std::to_string(length) + " bytes, and .glb files have at most 4 GiB: write .gltf, .hair or .ply");
  files.main.reserve(length);
  files.main.assign({'g', 'l', 'T', 'F'});
  putWord(files.main, 2);
  putWord(files.main, length);
  putWord(files.main, json_bytes);
  files.main.insert(files.main.end(), {'J', 'S', 'O', 'N'});
  files.main.insert(files.main.end(), json.begin(), json.end());
  files.main.insert(files.main.end(), json_bytes - json.size(), ' ');
  putWord(files.main, writer.bytes().size());
  files.main.insert(files.main.end(), {'B', 'I', 'N', 0});
  files.main.insert(files.main.end(), writer.bytes().begin(), writer.bytes().end());
  return files;
}

std::vector<AssetMessage> gltfLosses(const OpenedAsset& opened, const std::string& label) {
  FlkAssetInfo info{};
  flkAssetGetInfo(opened.asset.get(), &info);
  std::vector<AssetMessage> messages;
  if (opened.groups.size() == info.strand_count && !std::is_sorted(opened.groups.begin(), opened.groups.end()))
    messages.push_back({FLK_SEVERITY_INFO, "WRITE_REORDERS_STRANDS", label + ": strands are written group by group, each group a mesh, so that their order changes"});
  return messages;
}

void saveGltf(const OpenedAsset& opened, const std::string& path) {
  const fs::path buffer_path = gltfBufferPath(path);
  if (buffer_path.empty()) {
    const GltfFiles files = writeGltf(opened, "", path);
    writeWholeFiles({{path, files.main}});
    return;
  }
  // CT2Hair's files are called .bin too: only the buffer of a .gltf file that is replaced may be replaced with it.
  if (buffer_path.filename().string().find('\\') != std::string::npos)
    throw AssetError(FLK_ERROR_IO, path + ": a name with a backslash cannot be referred to from a .gltf file: choose another name, or .glb, which is a single file");
  std::error_code error;
  if (fs::exists(buffer_path, error) && !fs::exists(path, error))
    throw AssetError(FLK_ERROR_IO, path + ": its vertices would go to " + buffer_path.string() +
                                       ", which is there already and belongs to another file: choose another name, or .glb, which is a single file");
  const GltfFiles files = writeGltf(opened, uriOf(buffer_path.filename().string()), path);
  writeWholeFiles({{buffer_path.string(), files.buffer}, {path, files.main}});
}

}  // namespace forelock::samples
