// Why a glTF file cannot be read, without its name, which the reader puts before it. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/forelock.h>

#include <stdexcept>
#include <string>

namespace forelock::samples {

struct GltfRefusal : std::runtime_error {
  GltfRefusal(FlkResult why, const char* code, const std::string& text) : std::runtime_error(text), result(why), id(code) {}
  FlkResult result;
  const char* id;  // as in docs/findings.md
};

[[noreturn]] inline void refuseGltf(const char* id, const std::string& text, FlkResult result = FLK_ERROR_MALFORMED) {
  throw GltfRefusal(result, id, text);
}

// Words of the file as they may be printed: no control characters, at most `longest` bytes.
inline std::string printable(std::string text, size_t longest = 80) {
  const bool cut = text.size() > longest;
  if (cut) {
    text.resize(longest);
    // No half character at the end.
    while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xc0) == 0x80) text.pop_back();
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xc0) text.pop_back();
  }
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return cut ? text + "..." : text;
}

}  // namespace forelock::samples
