// SPDX-License-Identifier: MIT
#include "gltf_accessor.h"

#include "gltf_refusal.h"

#include <algorithm>
#include <cstring>

namespace forelock::samples {
namespace {

// 0: not a type that glTF has.
uint64_t componentBytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return 4;
    default: return 0;
  }
}

int componentsOf(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR: return 1;
    case TINYGLTF_TYPE_VEC2: return 2;
    case TINYGLTF_TYPE_VEC3: return 3;
    case TINYGLTF_TYPE_VEC4: return 4;
    default: return 0;
  }
}

template <class T> T load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

uint32_t loadInteger(const unsigned char* from, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return *from;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return load<uint16_t>(from);
    default: return load<uint32_t>(from);
  }
}

bool isUnsignedType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

}  // namespace

float GltfAccessor::number(uint64_t element, int component) const {
  const unsigned char* from = data_ + element * stride_ + uint64_t(component) * componentBytes(component_type_);
  const auto scaled = [&](float value, float largest) { return normalized_ ? std::max(value / largest, -1.0f) : value; };
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(load<int8_t>(from), 127.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(*from, 255.0f);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(load<int16_t>(from), 32767.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled(load<uint16_t>(from), 65535.0f);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return scaled(static_cast<float>(load<uint32_t>(from)), 4294967295.0f);
    default: return load<float>(from);
  }
}

uint32_t GltfAccessor::integer(uint64_t element) const { return loadInteger(data_ + element * stride_, component_type_); }

uint64_t GltfAccessor::largestInteger() const { return (uint64_t{1} << (8 * componentBytes(component_type_))) - 1; }

GltfAccessors::GltfAccessors(const tinygltf::Model& model) : model_(model) {
  for (const tinygltf::Buffer& buffer : model.buffers) buffer_bytes_ += buffer.data.size();
}

GltfAccessors::Span GltfAccessors::prove(int view_index, uint64_t offset, uint64_t count, uint64_t element, const std::string& who) const {
  const std::string view_name = "bufferViews[" + std::to_string(view_index) + "]";
  if (view_index < 0 || size_t(view_index) >= model_.bufferViews.size()) refuseGltf("GLTF_REFERENCE", who + " asks for " + view_name + ", which is not there");
  const tinygltf::BufferView& view = model_.bufferViews[size_t(view_index)];
  const std::string buffer_name = "buffers[" + std::to_string(view.buffer) + "]";
  if (view.buffer < 0 || size_t(view.buffer) >= model_.buffers.size()) refuseGltf("GLTF_REFERENCE", view_name + " asks for " + buffer_name + ", which is not there");
  const std::vector<unsigned char>& data = model_.buffers[size_t(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
    refuseGltf("GLTF_VIEW_PAST_END", view_name + " asks for " + std::to_string(view.byteLength) + " bytes from byteOffset " + std::to_string(view.byteOffset) +
                                         " on, but " + buffer_name + " has " + std::to_string(data.size()) + ": the file is damaged, export it again");
  const uint64_t stride = view.byteStride != 0 ? view.byteStride : element;
  if (stride < element)
    refuseGltf("GLTF_FIELD", view_name + ".byteStride is " + std::to_string(stride) + ", less than the " + std::to_string(element) + " bytes of an element of " +
                                 who + ": export the file again");
  // Divisions, so that no product can wrap around.
  const bool fits = count > 0 && offset <= view.byteLength && element <= view.byteLength - offset && count - 1 <= (view.byteLength - offset - element) / stride;
  if (!fits)
    refuseGltf("GLTF_ACCESSOR_PAST_END", who + " asks for " + std::to_string(count) + " elements of " + std::to_string(element) + " bytes, " +
                                             std::to_string(stride) + " apart, from byteOffset " + std::to_string(offset) + " on, but " + view_name + " has " +
                                             std::to_string(view.byteLength) + " bytes: the file is truncated or its count is damaged, export it again");
  return {data.data() + view.byteOffset + offset, stride};
}

void GltfAccessors::applySparse(const tinygltf::Accessor& from, GltfAccessor& to, const std::string& who) const {
  const uint64_t element = uint64_t(to.components_) * componentBytes(to.component_type_);
  // Zeros cost nothing in the file: no more of them than it has bytes.
  if (from.bufferView < 0 && to.count_ > buffer_bytes_)
    refuseGltf("GLTF_FIELD", who + ".count is " + std::to_string(to.count_) + " with nothing but zeros below its sparse values: export the file again");
  // Many accessors over the same bytes: what their copies take together is bounded by the file too.
  sparse_bytes_ += to.count_ * element;
  if (sparse_bytes_ > 64 * buffer_bytes_ + (uint64_t{1} << 20))
    refuseGltf("GLTF_TOO_LARGE", "its sparse accessors unfold to more than 64 times its buffers: export it again without sparse accessors", FLK_ERROR_LIMIT);
  to.dense_.resize(to.count_ * element);
  for (uint64_t i = 0; to.data_ && i < to.count_; ++i) std::memcpy(&to.dense_[i * element], to.data_ + i * to.stride_, element);

  const auto& sparse = from.sparse;
  const uint64_t index_bytes = isUnsignedType(sparse.indices.componentType) ? componentBytes(sparse.indices.componentType) : 0;
  if (index_bytes == 0) refuseGltf("GLTF_FIELD", who + ".sparse.indices.componentType is " + std::to_string(sparse.indices.componentType) + ": it has to be an unsigned integer type");
  if (sparse.count < 1 || uint64_t(sparse.count) > to.count_)
    refuseGltf("GLTF_FIELD", who + ".sparse.count is " + std::to_string(sparse.count) + ", more than the " + std::to_string(to.count_) + " elements of the accessor");
  const uint64_t count = uint64_t(sparse.count);
  const Span indices = prove(sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset), count, index_bytes, who + ".sparse.indices");
  const Span values = prove(sparse.values.bufferView, uint64_t(sparse.values.byteOffset), count, element, who + ".sparse.values");
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t index = loadInteger(indices.data + i * indices.stride, sparse.indices.componentType);
    if (index >= to.count_)
      refuseGltf("GLTF_INDEX_STRAY", who + ".sparse.indices holds " + std::to_string(index) + " at its element " + std::to_string(i) + ", but the accessor has " +
                                         std::to_string(to.count_) + " elements: the file is damaged, export it again");
    std::memcpy(&to.dense_[index * element], values.data + i * values.stride, element);
  }
  to.data_ = to.dense_.data();
  to.stride_ = element;
}

const GltfAccessor& GltfAccessors::get(int index, const std::string& role) {
  if (const auto found = proven_.find(index); found != proven_.end()) return found->second;
  const std::string name = "accessors[" + std::to_string(index) + "]", who = name + " (" + role + ")";
  if (index < 0 || size_t(index) >= model_.accessors.size()) refuseGltf("GLTF_REFERENCE", who + " is not there");
  const tinygltf::Accessor& from = model_.accessors[size_t(index)];
  GltfAccessor made;
  made.count_ = from.count;
  made.components_ = componentsOf(from.type);
  made.component_type_ = from.componentType;
  made.normalized_ = from.normalized;
  const uint64_t bytes = componentBytes(from.componentType);
  if (made.components_ == 0 || bytes == 0)
    refuseGltf("GLTF_FIELD", who + (bytes == 0 ? ".componentType is " + std::to_string(from.componentType) : std::string(".type is a matrix")) +
                                 ", which no attribute of strands can be: export the file again");
  if (from.bufferView >= 0) {
    const Span span = prove(from.bufferView, from.byteOffset, from.count, bytes * uint64_t(made.components_), who);
    made.data_ = span.data, made.stride_ = span.stride;
  } else if (!from.sparse.isSparse) {
    refuseGltf("GLTF_FIELD", who + ".bufferView is missing, so that there are no values: export the file again, without compression");
  }
  if (from.sparse.isSparse) applySparse(from, made, who);
  return proven_.emplace(index, std::move(made)).first->second;
}

}  // namespace forelock::samples
