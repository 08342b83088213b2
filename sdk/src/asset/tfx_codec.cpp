// TressFX 3 and 4 binary (.tfx), as laid out by AMD's TressFXFileFormat.h and found in the files that its exporters write.
// Both begin with 0 f32 version | 4 u32 strands | 8 u32 vertices a strand; then
//   version 4: 12 u32 x 5 offsets | 32 u32 x 32 reserved | 160 data
//   version 3: 12 u32 follow strands a guide | 16 u32 both ends fixed | 20 u32 x 31 reserved | 144 u32 x 6 offsets |
//   168 u32 x 32 reserved | 296 data
// Offsets count from the start of the file, 0 is "none". Blocks: positions (f32 a vertex: x y z, in version 4 also the
// inverse mass), UV (f32 x 2 a strand), UV (f32 x 2 a vertex), thickness (f32 a strand), colour (f32 x 4 a vertex), in
// version 3 the guide of a strand (u32).
#include "asset/codec.h"

#include <algorithm>
#include <array>
#include <cinttypes>

namespace forelock {
namespace {

struct Block {
  const char* name;
  uint64_t field;   // byte of the offset field; 0: this version has none
  uint64_t record;  // bytes
  bool per_strand;
  uint64_t offset = 0, count = 0;

  uint64_t end() const noexcept { return saturatingSum(offset, saturatingProduct(count, record)); }
};

enum { positions, strand_uv, vertex_uv, thickness, color, guides, blocks };

struct Bytes {
  uint64_t begin, end;
};

struct Layout {
  uint32_t version;
  uint64_t header_size;
  std::array<Block, blocks> table;
  std::array<Bytes, 2> reserved;
};

constexpr Layout version_3{3,
                           296,
                           {{{"positions", 144, 12, false},
                             {"strand UVs", 152, 8, true},
                             {"vertex UVs", 164, 8, false},
                             {"thicknesses", 148, 4, true},
                             {"colours", 156, 16, false},
                             {"guide numbers", 160, 4, true}}},
                           {{{20, 144}, {168, 296}}}};
constexpr Layout version_4{4,
                           160,
                           {{{"positions", 12, 16, false},
                             {"strand UVs", 16, 8, true},
                             {"vertex UVs", 20, 8, false},
                             {"thicknesses", 24, 4, true},
                             {"colours", 28, 16, false},
                             {"guide numbers", 0, 4, true}}},
                           {{{32, 160}, {160, 160}}}};
constexpr uint64_t written_header_size = version_4.header_size;

// Where the offset fields of a version say that its blocks are, each proven to lie in the file and apart from the others.
FlkResult placeBlocks(std::span<const std::byte> bytes, uint64_t header_size, uint64_t strands, uint64_t vertices_per_strand,
                      const Report& report, std::array<Block, blocks>& table, Findings& findings) {
  const uint64_t vertices = strands * vertices_per_strand;
  for (Block& block : table) {
    if (block.field == 0) continue;
    block.offset = Cursor(bytes, block.field).u32();
    const bool required = &block == &table[positions];
    if (block.offset == 0 && !required) continue;
    block.count = block.per_strand ? strands : vertices;
    if (block.offset < header_size)
      return report.fail(FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER",
                         "%s (offset field at byte %" PRIu64 ") start at byte %" PRIu64 ", inside the %" PRIu64
                         "-byte header: the header is damaged, fetch or export the file again",
                         block.name, block.field, block.offset, header_size);
    if (!Cursor(bytes, block.offset).holds(block.count, block.record) || block.offset > bytes.size())
      return report.fail(FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                         "%s (offset field at byte %" PRIu64 ") need %" PRIu64 " bytes from byte %" PRIu64 " for %" PRIu64
                         " strands of %" PRIu64 " vertices (bytes 4 and 8), but the file ends at byte %zu: it is truncated, "
                         "fetch it again",
                         block.name, block.field, saturatingProduct(block.count, block.record), block.offset, strands,
                         vertices_per_strand, bytes.size());
    if (block.offset % 4 != 0) findings.note(FindingKind::tfx_offset_unaligned, no_strand, block.field);
  }
  for (const Block& a : table)
    for (const Block& b : table)
      if (&a != &b && a.count != 0 && b.count != 0 && a.offset <= b.offset && b.offset < a.end())
        return report.fail(FLK_ERROR_MALFORMED, "TFX_BLOCKS_OVERLAP",
                           "%s (offset field at byte %" PRIu64 ") reach from byte %" PRIu64 " to byte %" PRIu64
                           " and run into the %s at byte %" PRIu64 " (offset field at byte %" PRIu64
                           "): the header counts strands that were not written, export it again without leaving any out",
                           a.name, a.field, a.offset, a.end(), b.name, b.offset, b.field);
  return FLK_SUCCESS;
}

void noteWhatIsNotUsed(std::span<const std::byte> bytes, const Layout& layout, const std::array<Block, blocks>& table,
                       Findings& findings) {
  uint64_t reserved_set = 0, first_reserved = no_byte;
  for (const Bytes& reserved : layout.reserved) {
    Cursor words(bytes, reserved.begin);
    for (uint64_t at = reserved.begin; at < reserved.end; at += 4)
      if (words.u32() != 0 && reserved_set++ == 0) first_reserved = at;
  }
  if (reserved_set) findings.note(FindingKind::tfx_reserved_set, no_strand, first_reserved, reserved_set);
  if (table[vertex_uv].count) findings.note(FindingKind::tfx_vertex_uv_ignored, no_strand, table[vertex_uv].offset);
  if (table[color].count) findings.note(FindingKind::tfx_vertex_color_ignored, no_strand, table[color].offset);

  uint64_t end_of_data = layout.header_size;
  for (const Block& block : table)
    if (block.count) end_of_data = std::max(end_of_data, block.end());
  if (end_of_data < bytes.size())
    findings.note(FindingKind::trailing_bytes, no_strand, end_of_data, bytes.size() - end_of_data);
}

FlkResult read(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
               Places& places, Findings& findings) {
  Cursor header(bytes);
  const Layout& layout = header.f32() == 3.0f ? version_3 : version_4;
  if (bytes.size() < layout.header_size)
    return report.fail(FLK_ERROR_MALFORMED, "TFX_HEADER_TRUNCATED",
                       "the header of a TressFX %" PRIu32 " file is %" PRIu64 " bytes, but the file ends at byte %zu: it is "
                       "truncated, fetch it again",
                       layout.version, layout.header_size, bytes.size());
  const uint64_t strands = header.u32(), vertices_per_strand = header.u32();
  const uint64_t vertices = strands * vertices_per_strand;  // both are below 2^32
  if (vertices == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "TFX_NO_STRANDS",
                       "the header counts %" PRIu64 " strands (byte 4) of %" PRIu64
                       " vertices (byte 8): there is nothing to load, export it again",
                       strands, vertices_per_strand);
  std::array<Block, blocks> table = layout.table;
  const FlkResult placed = placeBlocks(bytes, layout.header_size, strands, vertices_per_strand, report, table, findings);
  if (placed != FLK_SUCCESS) return placed;
  if (strands > limits.strands || vertices > limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "TFX_TOO_LARGE",
                       "it holds %" PRIu64 " strands (byte 4) and %" PRIu64 " vertices (byte 4 times byte 8), beyond the "
                       "limit of %" PRIu32 " and %" PRIu32 ": split it or raise the limit",
                       strands, vertices, limits.strands, limits.vertices);
  noteWhatIsNotUsed(bytes, layout, table, findings);

  arrays.first_vertex.resize(strands + 1);
  for (uint64_t strand = 0; strand <= strands; ++strand)
    arrays.first_vertex[strand] = static_cast<uint32_t>(strand * vertices_per_strand);

  arrays.positions.resize(vertices * 3);
  arrays.inverse_masses.resize(vertices);
  Cursor data(bytes, table[positions].offset);
  places.positions = {table[positions].offset, static_cast<uint32_t>(table[positions].record), false};
  if (layout.version == 3) {
    data.floats(arrays.positions);
    const uint32_t follow_strands = header.u32();
    if (follow_strands) findings.note(FindingKind::tfx_follow_strands_ignored, no_strand, 12, follow_strands);
    const bool both_ends = header.u32() != 0;
    findings.note(FindingKind::inverse_mass_implied, no_strand, no_byte, strands);
    if (both_ends) findings.note(FindingKind::both_ends_fixed, no_strand, 16, strands);
    for (uint64_t vertex = 0; vertex < vertices; ++vertex)
      arrays.inverse_masses[vertex] = impliedInverseMass(vertex % vertices_per_strand, vertices_per_strand, both_ends);
  } else {
    for (uint64_t vertex = 0; vertex < vertices; ++vertex) {
      data.floats({arrays.positions.data() + vertex * 3, 3});
      arrays.inverse_masses[vertex] = data.f32();
    }
    places.inverse_masses = {table[positions].offset + 12, 16, false};
  }

  if (table[strand_uv].count) {
    arrays.root_uvs.resize(strands * 2);
    Cursor(bytes, table[strand_uv].offset).floats(arrays.root_uvs);
    places.root_uvs = {table[strand_uv].offset, 8, true};
  }
  if (table[thickness].count) {
    arrays.radii.resize(vertices);
    Cursor diameters(bytes, table[thickness].offset);
    for (uint64_t strand = 0; strand < strands; ++strand)
      std::fill_n(arrays.radii.data() + strand * vertices_per_strand, vertices_per_strand, 0.5f * diameters.f32());
    places.radii = {table[thickness].offset, 4, true};
  }
  return FLK_SUCCESS;
}

FlkResult measure(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, uint64_t& bytes) {
  if (info.min_vertices_per_strand != info.max_vertices_per_strand)
    return report.fail(FLK_ERROR_LIMIT, "WRITE_TFX_UNEQUAL_COUNTS",
                       "its strands have from %" PRIu32 " to %" PRIu32 " vertices, but a .tfx file needs as many in each: "
                       "resample the strands or write .ply or .hair",
                       info.min_vertices_per_strand, info.max_vertices_per_strand);
  const uint64_t uv_offset = written_header_size + uint64_t{strands.vertex_count} * 16;
  bytes = uv_offset + (strands.root_uvs ? uint64_t{strands.strand_count} * 8 : 0);
  if (strands.root_uvs && uv_offset > UINT32_MAX)
    return report.fail(FLK_ERROR_LIMIT, "WRITE_TFX_TOO_LARGE",
                       "its root UVs would start beyond the 4 GiB that a .tfx offset can name: split the asset");
  return FLK_SUCCESS;
}

void write(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, ByteSink& sink) {
  const uint32_t vertices_per_strand = info.max_vertices_per_strand;
  const uint64_t uv_offset = written_header_size + uint64_t{strands.vertex_count} * 16;
  sink.f32(4.0f);
  sink.u32(strands.strand_count);
  sink.u32(vertices_per_strand);
  sink.u32(written_header_size);
  sink.u32(strands.root_uvs ? static_cast<uint32_t>(uv_offset) : 0);
  for (int i = 0; i < 3 + 32; ++i) sink.u32(0);

  for (uint32_t vertex = 0; vertex < strands.vertex_count; ++vertex) {
    for (std::size_t axis = 0; axis < 3; ++axis) sink.f32(strands.positions[std::size_t{vertex} * 3 + axis]);
    // Without masses the first two vertices are pinned, which keeps the root and its direction as AMD's exporter does.
    sink.f32(strands.inverse_masses ? strands.inverse_masses[vertex] : vertex % vertices_per_strand < 2 ? 0.0f : 1.0f);
  }
  if (strands.root_uvs)
    for (std::size_t i = 0; i < std::size_t{strands.strand_count} * 2; ++i) sink.f32(strands.root_uvs[i]);

  if (info.has_radii)
    report.say(FLK_SEVERITY_WARNING, "WRITE_DROPS_RADII",
               "its widths (radius %s to %s) are not in the .tfx file, which has no place for them: write .ply, .hair or a cache to keep them",
               Number(double{info.min_radius}, 6).text, Number(double{info.max_radius}, 6).text);
  if (strands.colors)
    report.say(FLK_SEVERITY_WARNING, "WRITE_DROPS_COLORS",
               "its colours are not in the .tfx file, whose block for them TressFX does not read: write .ply, .hair or a cache to keep them");
  if (!strands.inverse_masses)
    report.say(FLK_SEVERITY_INFO, "WRITE_FILLS_INVERSE_MASSES",
               "it has no inverse masses: the first two vertices of each strand are written as pinned, the rest as free");
  const bool usual = vertices_per_strand >= 4 && vertices_per_strand <= 64 && std::has_single_bit(vertices_per_strand);
  if (!usual)
    report.say(FLK_SEVERITY_INFO, "WRITE_TFX_UNUSUAL_COUNT",
               "its strands have %" PRIu32 " vertices; AMD's loader takes 4, 8, 16, 32 or 64: resample for use with TressFX",
               vertices_per_strand);
}

}  // namespace

const Codec tfx_codec{FLK_FORMAT_TFX, read, measure, write};

}  // namespace forelock
