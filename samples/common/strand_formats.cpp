// SPDX-License-Identifier: MIT
#include "strand_formats.h"

#include <forelock/asset.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

namespace forelock::samples {
namespace {

constexpr WritableFormat formats[] = {
    {".flk", "Forelock's cache", FLK_FORMAT_COOKED, false},
    {".glb", "glTF, a single file", FLK_FORMAT_UNKNOWN, true},
    {".gltf", "glTF with a .bin file beside it", FLK_FORMAT_UNKNOWN, true},
    {".hair", "Cem Yuksel's .hair", FLK_FORMAT_HAIR, false},
    {".ply", "PLY with strands", FLK_FORMAT_PLY, false},
    {".tfx", "TressFX 4", FLK_FORMAT_TFX, false},
};

}  // namespace

std::span<const WritableFormat> writableFormats() { return formats; }

const WritableFormat* writableFormatOf(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const WritableFormat& format : formats)
    if (extension == format.extension) return &format;
  return nullptr;
}

std::string writableExtensions() {
  std::string list;
  for (const WritableFormat& format : formats) list += (list.empty() ? "" : &format == std::end(formats) - 1 ? " or " : ", ") + std::string(format.extension);
  return list;
}

std::string gltfBufferPath(const std::string& path) {
  const WritableFormat* format = writableFormatOf(path);
  return format && format->extension == std::string_view(".gltf") ? std::filesystem::path(path).replace_extension(".bin").string() : "";
}

}  // namespace forelock::samples
