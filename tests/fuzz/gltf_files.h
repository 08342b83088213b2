// Small glTF files, as seeds. Lengths of the GLB file are counted when it is made.
#pragma once

#include <cstring>
#include <string>
#include <vector>

namespace asset_test {

inline std::vector<unsigned char> glbOf(std::string json, const std::vector<unsigned char>& bytes) {
  while (json.size() % 4 != 0) json += ' ';
  std::vector<unsigned char> file{'g', 'l', 'T', 'F'};
  const auto word = [&](size_t value) {
    for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<unsigned char>(value >> shift));
  };
  word(2), word(28 + json.size() + bytes.size()), word(json.size());
  file.insert(file.end(), {'J', 'S', 'O', 'N'});
  file.insert(file.end(), json.begin(), json.end());
  word(bytes.size());
  file.insert(file.end(), {'B', 'I', 'N', 0});
  file.insert(file.end(), bytes.begin(), bytes.end());
  return file;
}

// Four positions, eight indices, of two of them quantised, four widths: 48, 16, 16 and 16 bytes.
inline std::vector<unsigned char> gltfBytes() {
  std::vector<unsigned char> bytes(96);
  for (int i = 0; i < 12; ++i) {
    const float value = 0.125f * static_cast<float>((7 * i) % 12);
    std::memcpy(&bytes[static_cast<size_t>(4 * i)], &value, 4);
  }
  const unsigned char indices[16] = {0, 0, 1, 0, 1, 0, 2, 0, 0xff, 0xff, 2, 0, 3, 0, 1, 0}, steps[16] = {0, 1, 2, 0, 9, 7, 8, 0, 50, 60, 70, 0, 1, 1, 200, 0};
  std::memcpy(&bytes[48], indices, 16);
  std::memcpy(&bytes[64], steps, 16);
  for (size_t i = 80; i < 96; i += 4) bytes[i + 2] = 0x80, bytes[i + 3] = 0x3f;
  return bytes;
}

inline std::string gltfJson(const char* primitives, const char* more = "") {
  return std::string(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"scale":[2,2,2]},{"mesh":0,"name":"a"}],"meshes":[{"primitives":)") +
         primitives + R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":4,"type":"SCALAR"},)" +
         R"({"bufferView":2,"componentType":5121,"count":4,"type":"VEC3","normalized":true},{"bufferView":3,"componentType":5126,"count":4,"type":"SCALAR"},)" +
         R"({"bufferView":1,"componentType":5123,"count":7,"type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":1,)" +
         R"("indices":{"bufferView":1,"byteOffset":2,"componentType":5123},"values":{"bufferView":0}}}],"bufferViews":[{"buffer":0,"byteLength":48},)" +
         R"({"buffer":0,"byteOffset":48,"byteLength":16},{"buffer":0,"byteOffset":64,"byteLength":16,"byteStride":4},{"buffer":0,"byteOffset":80,"byteLength":16}],)" +
         R"("buffers":[{"byteLength":96}])" + more + "}";
}

}  // namespace asset_test
