// Where things are in a cooked file, for its writer and its reader; docs/findings.md has the same as a table.
#pragma once

#include "forelock/asset.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace forelock::cooked {

inline constexpr std::string_view magic{"\x8a" "FLK\r\n\x1a\n", 8};  // no text, and damaged by what converts the ends of lines
inline constexpr uint32_t version = 1;
inline constexpr uint64_t header_size = 320, alignment = 64;
inline constexpr uint32_t flag_radii_from_source = 1;

// Bytes of the header's fields.
inline constexpr uint64_t version_at = 8, file_size_at = 16, strands_at = 24, vertices_at = 28, counts_at = 32, source_format_at = 40,
                          flags_at = 44, findings_at = 48, strands_in_source_at = 52, bounds_at = 56, lengths_at = 80, radii_at = 92,
                          reserved_at = 100, table_at = 128, table_end = 296, checksum_at = 312;

enum Block : std::size_t { first_vertex, positions, radii, root_uvs, inverse_masses, colors, findings, blocks };
inline constexpr const char* block_names[blocks] = {"first_vertex", "positions", "radii", "root_uvs", "inverse_masses", "colors", "findings"};

struct BlockPlace {
  uint64_t offset = 0, bytes = 0, checksum = 0;  // all 0: there is no such block
};
using Table = std::array<BlockPlace, blocks>;

// Blocks follow each other in their order, each at the next multiple of 64, with zeros between. Checksums are left 0. The sum cannot
// overflow: counts are of 32 bits. Returns the size of the file.
inline uint64_t layOut(uint32_t strands, uint32_t vertices, bool has_root_uvs, bool has_inverse_masses, bool has_colors, uint64_t findings_bytes,
                       Table& table) noexcept {
  const uint64_t vertex_bytes = uint64_t{vertices} * 4;
  const uint64_t bytes[blocks] = {(uint64_t{strands} + 1) * 4, vertex_bytes * 3,          vertex_bytes,
                                  has_root_uvs ? uint64_t{strands} * 8 : 0, has_inverse_masses ? vertex_bytes : 0,
                                  has_colors ? vertex_bytes * 3 : 0,        findings_bytes};
  uint64_t end = header_size;
  for (std::size_t block = 0; block < blocks; ++block) {
    table[block] = {};
    if (bytes[block] == 0) continue;
    table[block].offset = (end + alignment - 1) / alignment * alignment;
    table[block].bytes = bytes[block];
    end = table[block].offset + bytes[block];
  }
  return end;
}

}  // namespace forelock::cooked
