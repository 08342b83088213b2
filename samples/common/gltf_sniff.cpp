// SPDX-License-Identifier: MIT
#include "gltf_reader.h"

#include <cstdio>
#include <string_view>

namespace forelock::samples {
namespace {

bool namesAsset(std::string_view text) {
  constexpr std::string_view spaces = " \t\r\n";
  for (size_t at = 0; (at = text.find("\"asset\"", at)) != std::string_view::npos;) {
    at = text.find_first_not_of(spaces, at + 7);
    if (at == std::string_view::npos || text[at] != ':') continue;
    at = text.find_first_not_of(spaces, at + 1);
    if (at != std::string_view::npos && text[at] == '{') return true;
  }
  return false;
}

std::string_view textOf(std::span<const unsigned char> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

}  // namespace

bool looksLikeGltf(std::span<const unsigned char> head, std::span<const unsigned char> tail) {
  std::string_view text = textOf(head);
  if (text.starts_with("glTF")) return true;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  const size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text[begin] == '{' && (namesAsset(text) || namesAsset(textOf(tail)));
}

bool isGltfFile(const std::string& path) {
  constexpr size_t kLooked = 65'536;  // "asset" comes first or last, whatever lies between
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return false;
  std::vector<unsigned char> head(kLooked), tail;
  head.resize(std::fread(head.data(), 1, head.size(), file));
  if (head.size() == kLooked && head[0] != 'g' && std::fseek(file, -long(kLooked), SEEK_END) == 0) {
    tail.resize(kLooked);
    tail.resize(std::fread(tail.data(), 1, tail.size(), file));
  }
  std::fclose(file);
  return looksLikeGltf(head, tail);
}

}  // namespace forelock::samples
