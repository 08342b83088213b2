// A rig as its readers fill it in: every record is put in order as it is read, because the byte of a text row is known only then.
#pragma once

#include "asset/findings.h"
#include "asset/report.h"
#include "forelock/rig.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

namespace forelock {

inline constexpr uint32_t limit_bones = 4'096;
inline constexpr uint32_t limit_records = 4'194'304;

struct RigLimits {
  uint32_t bones = limit_bones;
  uint32_t records = limit_records;

  // No file within these limits is longer: a vertex as text is 15 words of some 25 bytes, a name is rarely beyond a hundred. The rest
  // is room for comments and for bytes at the end that belong to nothing.
  uint64_t largestFile() const noexcept { return uint64_t{records} * 512 + uint64_t{bones} * 4096 + (1u << 20); }
};

class BoneNames {
public:
  explicit BoneNames(std::pmr::memory_resource* memory) : text_(memory), starts_(memory), pointers_(memory) {}

  void reserve(std::size_t bones, std::size_t bytes);
  void add(std::string_view name);
  // After the last one: notes what an engine that looks names up trips over.
  void finish(Findings& findings);

  uint32_t size() const noexcept { return static_cast<uint32_t>(starts_.size()); }
  const char* const* pointers() const noexcept { return pointers_.data(); }
  uint64_t bytes() const noexcept;

private:
  std::pmr::vector<char> text_;
  std::pmr::vector<std::size_t> starts_;
  std::pmr::vector<const char*> pointers_;
};

struct RigArrays {
  explicit RigArrays(std::pmr::memory_resource* memory)
      : names(memory), bones(memory), weights(memory), positions(memory), normals(memory), triangles(memory) {}

  uint32_t recordCount() const noexcept { return static_cast<uint32_t>(bones.size() / 4); }

  BoneNames names;
  std::pmr::vector<uint32_t> bones;      // 4 a record
  std::pmr::vector<float> weights;       // 4 a record
  std::pmr::vector<float> positions;     // 3 a vertex; empty: a skin
  std::pmr::vector<float> normals;       // 3 a vertex; empty: a skin
  std::pmr::vector<uint32_t> triangles;  // 3 each
};

// What exporters write where a record has fewer than four bones.
inline constexpr int64_t bone_placeholder = -1;

struct Attachment {
  int64_t bones[4];
  float weights[4];
};

// Puts the weights of record after record in order.
class Weights {
public:
  Weights(RigArrays& arrays, Findings& findings) noexcept : arrays_(arrays), findings_(findings) {}

  // Appends what rig.h promises of a record; `byte` is where it lies.
  void add(const Attachment& attachment, uint64_t byte);
  // After the last record.
  void finish(const char* plural) noexcept;

private:
  RigArrays& arrays_;
  Findings& findings_;
  double worst_sum_ = 1;
  uint32_t worst_record_ = 0;
};

// Both fill `arrays`, having proven every count against the bytes before they allocate, and note what is odd. A refusal is told to
// `report`. Throw std::bad_alloc.
FlkResult readTfxbone(std::span<const std::byte> bytes, const RigLimits& limits, const Report& report, RigArrays& arrays,
                      Findings& findings);
FlkResult readTfxmesh(std::span<const std::byte> bytes, const RigLimits& limits, const Report& report, RigArrays& arrays,
                      Findings& findings, uint32_t& triangles_in_source);

}  // namespace forelock
