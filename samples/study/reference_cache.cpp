// SPDX-License-Identifier: MIT
#include "reference_cache.h"

#include <bit>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace forelock::study {
namespace {

// What a file begins with; the words follow.
struct Header {
  char magic[8];
  uint64_t key, checksum;
  uint32_t channels, width, height, words;
};
static_assert(sizeof(Header) == 40);
constexpr char kMagic[8] = {'F', 'L', 'K', 'R', 'E', 'F', '1', '\n'};

Header headerOf(const std::string& key, uint32_t channels, const std::vector<uint32_t>& words, uint32_t width, uint32_t height) {
  Header header{{}, Hash().add(key).value(), Hash().add(std::span<const uint32_t>(words)).value(), channels, width, height, uint32_t(words.size())};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  return header;
}

}  // namespace

Hash& Hash::bytes(const void* data, std::size_t size) {
  const auto* byte = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ byte[i]) * 0x100000001b3u;
  return *this;
}

std::string Hash::text() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
  return text;
}

bool ReferenceCache::read(const std::string& key, uint32_t channels, std::vector<uint32_t>& words, uint32_t size[2]) const {
  std::error_code error;
  const uint64_t bytes = std::filesystem::file_size(path(key), error);
  if (error || bytes < sizeof(Header)) return false;
  std::ifstream file(path(key), std::ios::binary);
  Header header{};
  if (!file.read(reinterpret_cast<char*>(&header), sizeof header)) return false;
  if (header.channels != channels || bytes != sizeof header + uint64_t(header.words) * 4 ||
      header.words != uint64_t(header.width) * header.height * channels)
    return false;
  words.resize(header.words);
  if (!file.read(reinterpret_cast<char*>(words.data()), std::streamsize(words.size() * 4))) return false;
  size[0] = header.width, size[1] = header.height;
  const Header expected = headerOf(key, channels, words, header.width, header.height);
  return std::memcmp(&header, &expected, sizeof header) == 0;
}

void ReferenceCache::write(const std::string& key, uint32_t channels, const std::vector<uint32_t>& words, uint32_t width, uint32_t height) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  const std::string made = path(key) + ".part";
  {
    std::ofstream file(made, std::ios::binary);
    const Header header = headerOf(key, channels, words, width, height);
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    file.write(reinterpret_cast<const char*>(words.data()), std::streamsize(words.size() * 4));
    if (!file.flush()) return;
  }
  std::filesystem::rename(made, path(key), error);
}

bool ReferenceCache::load(const std::string& key, Picture& picture) const {
  std::vector<uint32_t> words;
  uint32_t size[2];
  if (!read(key, 5, words, size)) return false;
  picture = {};
  picture.width = size[0], picture.height = size[1];
  for (std::size_t i = 0; i < words.size(); i += 5) {
    for (std::size_t c = 0; c < 3; ++c) picture.rgb.push_back(std::bit_cast<float>(words[i + c]));
    picture.transmittance.push_back(std::bit_cast<float>(words[i + 3]));
    picture.fragments.push_back(words[i + 4]);
  }
  return true;
}

bool ReferenceCache::load(const std::string& key, std::vector<float>& gray) const {
  std::vector<uint32_t> words;
  uint32_t size[2];
  if (!read(key, 1, words, size)) return false;
  gray.clear();
  for (const uint32_t word : words) gray.push_back(std::bit_cast<float>(word));
  return true;
}

void ReferenceCache::save(const std::string& key, const Picture& picture) const {
  std::vector<uint32_t> words;
  words.reserve(picture.pixels() * 5);
  for (std::size_t i = 0; i < picture.pixels(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) words.push_back(std::bit_cast<uint32_t>(picture.rgb[i * 3 + c]));
    words.push_back(std::bit_cast<uint32_t>(picture.transmittance[i]));
    words.push_back(picture.fragments[i]);
  }
  write(key, 5, words, picture.width, picture.height);
}

void ReferenceCache::save(const std::string& key, const std::vector<float>& gray) const {
  std::vector<uint32_t> words;
  for (const float v : gray) words.push_back(std::bit_cast<uint32_t>(v));
  write(key, 1, words, uint32_t(gray.size()), 1);
}

}  // namespace forelock::study
