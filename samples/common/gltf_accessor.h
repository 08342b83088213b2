// Accessors of a glTF file as numbers: every byte that they name is proven to be there. SPDX-License-Identifier: MIT
#pragma once

#include "tinygltf_import.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace forelock::samples {

class GltfAccessor {
public:
  uint64_t count() const { return count_; }
  int components() const { return components_; }
  int componentType() const { return component_type_; }  // TINYGLTF_COMPONENT_TYPE_...
  bool normalized() const { return normalized_; }
  bool isFloat() const { return component_type_ == TINYGLTF_COMPONENT_TYPE_FLOAT; }
  // As glTF counts it: floats bit for bit, normalised integers as fractions of their largest value. element < count().
  float number(uint64_t element, int component) const;
  // Of an integer accessor.
  uint32_t integer(uint64_t element) const;
  uint64_t largestInteger() const;  // of its type: where it is an index, the value that restarts a strip

private:
  friend class GltfAccessors;
  const unsigned char* data_ = nullptr;
  uint64_t count_ = 0, stride_ = 0;
  int components_ = 0, component_type_ = 0;
  bool normalized_ = false;
  std::vector<unsigned char> dense_;  // of a sparse accessor
};

// Each is proven once, when it is first asked for.
class GltfAccessors {
public:
  explicit GltfAccessors(const tinygltf::Model& model);
  // `role`: what it is for, as messages say it. Throws GltfRefusal.
  const GltfAccessor& get(int accessor, const std::string& role);

private:
  struct Span {
    const unsigned char* data = nullptr;
    uint64_t stride = 0;
  };
  Span prove(int view, uint64_t offset, uint64_t count, uint64_t element, const std::string& who) const;
  void applySparse(const tinygltf::Accessor& from, GltfAccessor& to, const std::string& who) const;

  const tinygltf::Model& model_;
  uint64_t buffer_bytes_ = 0;
  std::map<int, GltfAccessor> proven_;
  mutable uint64_t sparse_bytes_ = 0;  // copies made for sparse accessors, all together
};

}  // namespace forelock::samples
