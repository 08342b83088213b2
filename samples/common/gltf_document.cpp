// SPDX-License-Identifier: MIT
#include "gltf_document.h"

#include "gltf_files.h"
#include "gltf_json.h"
#include "gltf_refusal.h"

#include <algorithm>
#include <cstring>
#include <new>
#include <string_view>

namespace forelock::samples {
namespace {

// tinygltf counts the bytes of the JSON in 32 bits, those of base64 in 31. A tree of JSON takes about 20 times its text.
constexpr uint64_t kLargestJson = uint64_t{256} << 20;

uint32_t word(const std::vector<unsigned char>& bytes, size_t at) {
  return bytes[at] | uint32_t(bytes[at + 1]) << 8 | uint32_t(bytes[at + 2]) << 16 | uint32_t(bytes[at + 3]) << 24;
}

struct Chunks {
  size_t json_begin = 0, json_size = 0;
  bool has_binary = false;
  size_t binary_begin = 0, binary_size = 0;
  uint64_t bytes_unused = 0;
};

Chunks chunksOf(const std::vector<unsigned char>& bytes) {
  Chunks chunks;
  if (bytes.size() < 4 || std::memcmp(bytes.data(), "glTF", 4) != 0) {
    chunks.json_size = bytes.size();
    return chunks;
  }
  const auto truncated = [&](const std::string& what) { refuseGltf("GLTF_TRUNCATED", what + ": it is truncated, fetch or export it again"); };
  if (bytes.size() < 12) truncated("it ends inside the header of a GLB file, after " + std::to_string(bytes.size()) + " of 12 bytes");
  if (const uint32_t version = word(bytes, 4); version != 2)
    refuseGltf("GLTF_VERSION", "its GLB version (byte 4) is " + std::to_string(version) + " where 2 is read: export it as glTF 2.0", FLK_ERROR_FORMAT_UNKNOWN);
  const uint64_t length = word(bytes, 8);
  if (length > bytes.size()) truncated("its length (byte 8) is " + std::to_string(length) + ", but it has " + std::to_string(bytes.size()) + " bytes");
  chunks.bytes_unused = bytes.size() - length;
  uint64_t at = 12;
  for (int chunk = 0; at < length; ++chunk) {
    const std::string where = "chunk " + std::to_string(chunk) + " (byte " + std::to_string(at) + ")";
    if (length - at < 8) truncated(where + " has no room for its header");
    const uint64_t size = word(bytes, at);
    const uint32_t type = word(bytes, at + 4);
    if (size > length - at - 8)
      truncated("the length of " + where + " is " + std::to_string(size) + ", but " + std::to_string(length - at - 8) + " bytes follow");
    const bool json = type == 0x4e4f534a, binary = type == 0x004e4942;
    if ((chunk == 0) != json)
      refuseGltf("GLTF_CHUNK", std::string(chunk == 0 ? "its first chunk (byte 12) is not" : "a second chunk is") + " JSON: it is damaged, export it again");
    if (json) {
      chunks.json_begin = at + 8, chunks.json_size = size;
    } else if (binary && chunk == 1) {
      chunks.has_binary = true, chunks.binary_begin = at + 8, chunks.binary_size = size;
    } else {
      chunks.bytes_unused += size;
    }
    at += 8 + size;
  }
  if (chunks.json_begin == 0) truncated("it ends where its JSON should begin (byte 12)");
  return chunks;
}

void checkExtensions(const nlohmann::json& document) {
  for (const nlohmann::json& entry : document.value("extensionsRequired", nlohmann::json::array())) {
    const std::string& name = entry.get_ref<const std::string&>();
    if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
      refuseGltf("GLTF_COMPRESSED", "it is compressed with " + name + ", which is not read: export it without compression", FLK_ERROR_FORMAT_UNKNOWN);
    // The last ones say how surfaces look, which strands do not have.
    const bool known = name == "KHR_mesh_quantization" || name == "KHR_mesh_primitive_restart" || name == "EXT_mesh_primitive_restart" ||
                       name.rfind("KHR_materials_", 0) == 0 || name.rfind("KHR_texture_", 0) == 0 || name.rfind("EXT_texture_", 0) == 0 ||
                       name == "KHR_lights_punctual";
    if (!known)
      refuseGltf("GLTF_EXTENSION_REQUIRED",
                 "extensionsRequired names " + printable(name) + ", which is not known here, so that its strands could be misread: export it without",
                 FLK_ERROR_FORMAT_UNKNOWN);
  }
}

std::vector<std::vector<unsigned char>> loadBuffers(const CheckedGltf& checked, std::vector<unsigned char>& bytes, const Chunks& chunks,
                                                    const std::filesystem::path& folder) {
  std::vector<std::vector<unsigned char>> buffers(checked.buffer_bytes.size());
  uint64_t all = 0;
  for (size_t i = 0; i < buffers.size(); ++i) {
    const std::string where = "buffers[" + std::to_string(i) + "]";
    const uint64_t size = checked.buffer_bytes[i];
    if (!checked.buffer_uris[i].empty()) {
      buffers[i] = readGltfBuffer(checked.buffer_uris[i], size, folder, where + ".uri");
      // The same file may be named again and again.
      if ((all += buffers[i].size()) > uint64_t{20} << 30) refuseGltf("GLTF_TOO_LARGE", "with " + where + " its buffers are longer than 20 GiB together: split the file", FLK_ERROR_LIMIT);
      continue;
    }
    if (i != 0 || !chunks.has_binary) {
      for (const nlohmann::json& name : checked.document.value("extensionsUsed", nlohmann::json::array()))
        if (name == "EXT_meshopt_compression" || name == "KHR_meshopt_compression")
          refuseGltf("GLTF_COMPRESSED", where + " is left out in favour of " + name.get<std::string>() + ", which is not read: export it without compression",
                     FLK_ERROR_FORMAT_UNKNOWN);
      refuseGltf("GLTF_FIELD", where + ".uri is missing" + (i == 0 ? ", and there is no BIN chunk" : "") + ": export the file again");
    }
    if (size > chunks.binary_size)
      refuseGltf("GLTF_BUFFER_SHORT", where + ".byteLength is " + std::to_string(size) + ", but the BIN chunk (byte " + std::to_string(chunks.binary_begin - 8) +
                                          ") holds " + std::to_string(chunks.binary_size) + " bytes: it is damaged, export it again");
    // Nothing is needed of the file but this, so that it is not held twice.
    bytes.erase(bytes.begin(), bytes.begin() + std::ptrdiff_t(chunks.binary_begin));
    bytes.resize(size);
    buffers[i] = std::move(bytes);
  }
  return buffers;
}

}  // namespace

GltfDocument readGltfDocument(std::vector<unsigned char> bytes, const std::filesystem::path& folder) {
  const Chunks chunks = chunksOf(bytes);
  if (chunks.json_size > kLargestJson)
    refuseGltf("GLTF_TOO_LARGE", "its JSON has " + std::to_string(chunks.json_size) + " bytes, more than " + std::to_string(kLargestJson) +
                                     ": keep the vertices in a .bin file or in a .glb file, and strands in few primitives", FLK_ERROR_LIMIT);
  CheckedGltf checked = checkGltfJson({reinterpret_cast<const char*>(bytes.data()) + chunks.json_begin, chunks.json_size});
  checkExtensions(checked.document);
  std::vector<std::vector<unsigned char>> buffers = loadBuffers(checked, bytes, chunks, folder);
  bytes = {};

  const std::string text = checked.document.dump();
  checked.document = nullptr;
  tinygltf::TinyGLTF parser;
  parser.SetImageLoader([](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char*, int, void*) { return true; }, nullptr);
  // The only files it can ask for are the buffers, each called by its number.
  tinygltf::FsCallbacks files{};
  files.FileExists = [](const std::string&, void*) { return true; };
  files.ExpandFilePath = [](const std::string& name, void*) { return name; };
  files.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
    *out = std::move(static_cast<std::vector<std::vector<unsigned char>>*>(user)->at(std::stoul(name)));
    return true;
  };
  files.user_data = &buffers;
  files.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  parser.SetFsCallbacks(files);

  GltfDocument document;
  document.deforms = checked.deforms;
  document.base_color = checked.base_color;
  document.bytes_unused = chunks.bytes_unused;
  std::string error, warning;
  if (!parser.LoadASCIIFromString(&document.model, &error, &warning, text.c_str(), static_cast<unsigned>(text.size()), "")) {
    if (error == std::bad_alloc().what()) throw std::bad_alloc();  // the parser makes a sentence of it
    refuseGltf("GLTF_PARSER", "its structure cannot be read (" + printable(error, 200) + "): export it again");
  }
  return document;
}

}  // namespace forelock::samples
