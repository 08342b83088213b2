// Pictures of the reference that have been made before, in DIR/references. SPDX-License-Identifier: MIT
#pragma once

#include "picture.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace forelock::study {

// FNV-1a over what a picture depends on.
class Hash {
public:
  template <class T>
    requires std::is_arithmetic_v<T>
  Hash& add(T value) {
    return bytes(&value, sizeof value);
  }
  template <class T>
    requires std::is_arithmetic_v<T>
  Hash& add(std::span<const T> values) {
    add(uint64_t(values.size()));
    return bytes(values.data(), values.size_bytes());
  }
  Hash& add(const std::string& text) {
    add(uint64_t(text.size()));
    return bytes(text.data(), text.size());
  }
  Hash& bytes(const void* data, std::size_t size);
  uint64_t value() const { return value_; }
  std::string text() const;  // 16 hexadecimal digits

private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

class ReferenceCache {
public:
  explicit ReferenceCache(std::string folder) : folder_(std::move(folder)) {}

  // False: not there, cut short or damaged; the file is then as good as absent.
  bool load(const std::string& key, Picture& picture) const;
  bool load(const std::string& key, std::vector<float>& gray) const;
  // A file that cannot be written is only not there the next time.
  void save(const std::string& key, const Picture& picture) const;
  void save(const std::string& key, const std::vector<float>& gray) const;

private:
  bool read(const std::string& key, uint32_t channels, std::vector<uint32_t>& words, uint32_t size[2]) const;
  void write(const std::string& key, uint32_t channels, const std::vector<uint32_t>& words, uint32_t width, uint32_t height) const;
  std::string path(const std::string& key) const { return folder_ + "/" + key + ".ref"; }

  std::string folder_;
};

}  // namespace forelock::study
