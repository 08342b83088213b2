// Formats that the tools write, by the extension of a file. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace forelock::samples {

struct WritableFormat {
  const char* extension;  // with its dot, in small letters
  const char* name;
  uint32_t library;       // FLK_FORMAT_...; FLK_FORMAT_UNKNOWN: the tools write it, not the library
  bool keeps_groups;
};

// Sorted by extension.
std::span<const WritableFormat> writableFormats();

// Of a path, whatever the case of its letters; nullptr: none.
const WritableFormat* writableFormatOf(const std::string& path);

// ".flk, .glb, .gltf, .hair, .ply or .tfx"
std::string writableExtensions();

// The .bin file that lies beside a .gltf file; "" of other formats.
std::string gltfBufferPath(const std::string& path);

}  // namespace forelock::samples
