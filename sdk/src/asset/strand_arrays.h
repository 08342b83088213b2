// Strands as a source gave them: what readers fill in and sanitise() puts in order.
#pragma once

#include "asset/findings.h"
#include "forelock/asset.h"

#include <cstdint>
#include <memory_resource>
#include <vector>

namespace forelock {

inline constexpr uint32_t limit_strands = 4'194'304;
inline constexpr uint32_t limit_vertices = 268'435'456;

struct Limits {
  uint32_t strands = limit_strands;
  uint32_t vertices = limit_vertices;
  uint32_t points_per_strand = 0;  // no limit, but the caller's word on bare points; 0: none

  // No file within these limits is longer: text takes some 25 bytes a number at most, binary forms 40 bytes a vertex. The rest is room
  // for headers and for bytes at the end that belong to nothing.
  uint64_t largestFile() const noexcept { return uint64_t{strands} * 128 + uint64_t{vertices} * 256 + (1u << 20); }
};

// Leaves new elements as they are: readers fill every one, and zeros first would cost a pass over memory of their own.
template <class T> struct UnfilledAllocator : std::pmr::polymorphic_allocator<T> {
  using std::pmr::polymorphic_allocator<T>::polymorphic_allocator;
  template <class U> void construct(U* place) noexcept { ::new (static_cast<void*>(place)) U; }
  template <class U> void construct(U* place, const U& value) noexcept { ::new (static_cast<void*>(place)) U(value); }
};
using FloatArray = std::vector<float, UnfilledAllocator<float>>;

struct StrandArrays {
  explicit StrandArrays(std::pmr::memory_resource* memory)
      : first_vertex(memory), positions(memory), radii(memory), root_uvs(memory), inverse_masses(memory),
        colors(memory), dropped_strands(memory) {}

  uint32_t strandCount() const noexcept { return static_cast<uint32_t>(first_vertex.size() - 1); }
  uint32_t vertexCount() const noexcept { return first_vertex.back(); }

  std::pmr::vector<uint32_t> first_vertex;   // strands + 1, never falling
  FloatArray positions;                      // 3 a vertex
  FloatArray radii;                          // 1 a vertex; empty: none
  FloatArray root_uvs;                       // 2 a strand; empty: none
  FloatArray inverse_masses;                 // 1 a vertex; empty: none
  FloatArray colors;                         // 3 a vertex; empty: none
  std::pmr::vector<uint32_t> dropped_strands;  // by sanitise(), numbered as in the source, rising
};

// Where in the file the values of an array lie, so that a finding can say at which byte to look.
struct Place {
  uint64_t offset = no_byte;  // of the first record
  uint32_t stride = 0;        // bytes from record to record
  bool per_strand = false;    // a record a strand rather than a vertex
  uint32_t gap = 0;           // bytes before the vertices of each strand

  uint64_t byte(uint32_t strand, uint32_t vertex) const noexcept {
    return offset == no_byte ? no_byte : offset + uint64_t{gap} * (uint64_t{strand} + 1) + uint64_t{stride} * (per_strand ? strand : vertex);
  }
};

struct Places {
  Place positions, radii, root_uvs, inverse_masses, colors;
  bool bald_roots = false;    // a strand of one vertex is a root without hair, and no defect
};

}  // namespace forelock
