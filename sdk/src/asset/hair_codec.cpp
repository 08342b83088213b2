// Cem Yuksel's .hair (cemyuksel.com, "HAIR file format"): 128-byte header
//   0 "HAIR" | 4 u32 strands | 8 u32 points | 12 u32 flags | 16 u32 default segments | 20 f32 default thickness |
//   24 f32 default transparency | 28 f32 x 3 default colour | 40 88 characters of text
// then, each only if its flag is set: u16 segments a strand; a point: f32 x 3 position, f32 thickness, f32 transparency,
// f32 x 3 colour, f32 x 2 UV (bit 5, LuxCoreRender's addition). A strand has one point more than it has segments.
// Thickness is the diameter.
#include "asset/codec.h"

#include <array>
#include <cinttypes>
#include <cmath>

namespace forelock {
namespace {

constexpr uint64_t header_size = 128;
constexpr uint32_t largest_segment_count = 65'535;  // what u16 holds

struct Array {
  const char* name;
  uint64_t record;  // bytes
  bool per_strand;
  uint64_t offset = 0;
  bool present = false;
};

enum { segments, points, thickness, transparency, color, uv, arrays_known };

FlkResult read(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
               Places& places, Findings& findings) {
  if (bytes.size() < header_size)
    return report.fail(FLK_ERROR_MALFORMED, "HAIR_HEADER_TRUNCATED",
                       "the header of a .hair file is 128 bytes, but the file ends at byte %zu: it is truncated, fetch it again",
                       bytes.size());
  Cursor header(bytes, 4);
  const uint64_t strands = header.u32(), point_count = header.u32();
  const uint32_t flags = header.u32();
  const uint64_t default_segments = header.u32();
  const float default_thickness = header.f32();
  header.f32();  // transparency
  const float default_color[3] = {header.f32(), header.f32(), header.f32()};

  if ((flags & 0x00ffffffu) == 0 && (flags >> 24 & 2u) != 0)
    return report.fail(FLK_ERROR_MALFORMED, "HAIR_BYTE_SWAPPED",
                       "the flags (byte 12) are 0x%08" PRIx32 ", which makes sense only in swapped byte order: write it in "
                       "little-endian order",
                       flags);
  if ((flags & 1u << points) == 0)
    return report.fail(FLK_ERROR_MALFORMED, "HAIR_NO_POINTS",
                       "the flags (byte 12) are 0x%" PRIx32 ": without bit 1 the file holds no points, export it again", flags);
  if (strands == 0 || point_count == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "HAIR_NO_STRANDS",
                       "the header counts %" PRIu64 " strands (byte 4) and %" PRIu64
                       " points (byte 8): there is nothing to load, export it again",
                       strands, point_count);

  std::array<Array, arrays_known> table{{{"segment counts", 2, true},
                                         {"points", 12, false},
                                         {"thicknesses", 4, false},
                                         {"transparencies", 4, false},
                                         {"colours", 12, false},
                                         {"UVs", 8, false}}};
  uint64_t end = header_size;
  for (std::size_t bit = 0; bit < table.size(); ++bit) {
    Array& array = table[bit];
    array.present = flags >> bit & 1u;
    array.offset = end;
    if (!array.present) continue;
    const uint64_t count = array.per_strand ? strands : point_count;
    if (!Cursor(bytes, end).holds(count, array.record))
      return report.fail(FLK_ERROR_MALFORMED, "HAIR_ARRAY_PAST_END",
                         "%s (bit %zu of the flags at byte 12) need %" PRIu64 " bytes from byte %" PRIu64 " for %" PRIu64
                         " %s (byte %d), but the file ends at byte %zu: it is truncated, fetch it again",
                         array.name, bit, saturatingProduct(count, array.record), end, count,
                         array.per_strand ? "strands" : "points", array.per_strand ? 4 : 8, bytes.size());
    end += count * array.record;
  }
  uint64_t used_points = 0;
  if (table[segments].present) {
    Cursor counts(bytes, table[segments].offset);
    for (uint64_t strand = 0; strand < strands; ++strand) used_points += uint64_t{counts.u16()} + 1;
  } else {
    used_points = saturatingProduct(strands, default_segments + 1);
  }
  // Too few segments in the array leave points over, with every strand still where it belongs; a wrong default puts every
  // strand but the first in the wrong place.
  if (used_points > point_count || (!table[segments].present && used_points != point_count))
    return report.fail(FLK_ERROR_MALFORMED, "HAIR_SEGMENTS_DISAGREE",
                       "the segments (%s) make %" PRIu64 " points of %" PRIu64
                       " strands (byte 4), but the header counts %" PRIu64
                       " points (byte 8): the file is damaged, export it again",
                       table[segments].present ? "array at byte 128" : "default at byte 16", used_points, strands,
                       point_count);

  if (strands > limits.strands || point_count > limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "HAIR_TOO_LARGE",
                       "it holds %" PRIu64 " strands (byte 4) and %" PRIu64 " points (byte 8), beyond the limit of %" PRIu32
                       " and %" PRIu32 ": split it or raise the limit",
                       strands, point_count, limits.strands, limits.vertices);

  if (used_points < point_count)
    findings.note(FindingKind::hair_points_unused, no_strand, table[points].offset + used_points * 12,
                  point_count - used_points);
  if (flags >> arrays_known) findings.note(FindingKind::hair_flags_reserved, no_strand, 12);
  if (table[transparency].present)
    findings.note(FindingKind::hair_transparency_ignored, no_strand, table[transparency].offset);
  // One colour for everything is the material's to say, so it does not become an array. Black, greys and white are what
  // exporters write unasked.
  if (!table[color].present && !(default_color[0] == default_color[1] && default_color[1] == default_color[2]))
    findings.note(FindingKind::hair_default_color_ignored, no_strand, 28);
  if (end < bytes.size()) findings.note(FindingKind::trailing_bytes, no_strand, end, bytes.size() - end);

  // A strand has at least one point, so the proven points bound the strands too.
  arrays.first_vertex.resize(strands + 1);
  Cursor counts(bytes, table[segments].offset);
  uint64_t vertex = 0;
  for (uint64_t strand = 0; strand < strands; ++strand) {
    arrays.first_vertex[strand] = static_cast<uint32_t>(vertex);
    vertex += static_cast<uint32_t>(table[segments].present ? counts.u16() : default_segments) + 1;
    if (vertex > used_points) return fileChanged(report);
  }
  arrays.first_vertex[strands] = static_cast<uint32_t>(vertex);
  if (vertex != used_points) return fileChanged(report);

  arrays.positions.resize(used_points * 3);
  Cursor(bytes, table[points].offset).floats(arrays.positions);
  places.positions = {table[points].offset, 12, false};

  if (table[thickness].present) {
    arrays.radii.resize(used_points);
    Cursor(bytes, table[thickness].offset).floats(arrays.radii);
    for (float& radius : arrays.radii) radius *= 0.5f;
    places.radii = {table[thickness].offset, 4, false};
    if (default_thickness == 0) findings.note(FindingKind::hair_default_thickness_zero, no_strand, 20);
  } else if (default_thickness > 0 && std::isfinite(default_thickness)) {
    arrays.radii.assign(used_points, 0.5f * default_thickness);
    places.radii = {20, 0, false};
  } else if (default_thickness != 0) {
    // Zero is how exporters say "not set"; anything else here was meant as a width and is none.
    findings.note(FindingKind::radius_invalid, no_strand, 20);
  }
  if (table[color].present) {
    arrays.colors.resize(used_points * 3);
    Cursor(bytes, table[color].offset).floats(arrays.colors);
    places.colors = {table[color].offset, 12, false};
  }
  if (table[uv].present) {
    arrays.root_uvs.resize(strands * 2);
    for (uint64_t strand = 0; strand < strands; ++strand) {
      Cursor root(bytes, table[uv].offset + uint64_t{arrays.first_vertex[strand]} * 8);
      arrays.root_uvs[strand * 2] = root.f32();
      arrays.root_uvs[strand * 2 + 1] = root.f32();
    }
    places.root_uvs = {table[uv].offset, 8, false};
  }
  return FLK_SUCCESS;
}

FlkResult measure(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, uint64_t& bytes) {
  if (info.max_vertices_per_strand - 1 > largest_segment_count)
    return report.fail(FLK_ERROR_LIMIT, "WRITE_HAIR_STRAND_TOO_LONG",
                       "its longest strand has %" PRIu32 " vertices, but a .hair file holds at most 65,536: resample it",
                       info.max_vertices_per_strand);
  const bool equal = info.min_vertices_per_strand == info.max_vertices_per_strand;
  bytes = header_size + (equal ? 0 : uint64_t{strands.strand_count} * 2) + uint64_t{strands.vertex_count} * 12 +
          (info.has_radii ? uint64_t{strands.vertex_count} * 4 : 0) +
          (info.has_colors ? uint64_t{strands.vertex_count} * 12 : 0);
  return FLK_SUCCESS;
}

void write(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, ByteSink& sink) {
  const bool equal = info.min_vertices_per_strand == info.max_vertices_per_strand;
  sink.text("HAIR", 4);
  sink.u32(strands.strand_count);
  sink.u32(strands.vertex_count);
  sink.u32((equal ? 0u : 1u << segments) | 1u << points | (info.has_radii ? 1u << thickness : 0u) |
           (info.has_colors ? 1u << color : 0u));
  sink.u32(equal ? info.max_vertices_per_strand - 1 : 0);
  // Thickness: 0 is "not set", so that a default width stays a default. With an array it is for programs that do not read that.
  sink.f32(info.has_radii ? 2.0f * info.max_radius : 0);
  sink.f32(0);  // transparency
  for (int i = 0; i < 3; ++i) sink.f32(0.5f);
  sink.text("Forelock", 88);

  if (!equal)
    for (uint32_t strand = 0; strand < strands.strand_count; ++strand)
      sink.u16(static_cast<uint16_t>(strands.first_vertex[strand + 1] - strands.first_vertex[strand] - 1));
  for (std::size_t i = 0; i < std::size_t{strands.vertex_count} * 3; ++i) sink.f32(strands.positions[i]);
  if (info.has_radii)
    for (uint32_t vertex = 0; vertex < strands.vertex_count; ++vertex) sink.f32(2.0f * strands.radii[vertex]);
  if (info.has_colors)
    for (std::size_t i = 0; i < std::size_t{strands.vertex_count} * 3; ++i) sink.f32(strands.colors[i]);

  if (strands.root_uvs)
    report.say(FLK_SEVERITY_WARNING, "WRITE_DROPS_ROOT_UVS",
               "its root UVs are not in the .hair file, which has no place for them: write .ply, .tfx or a cache to keep them");
  if (strands.inverse_masses)
    report.say(FLK_SEVERITY_WARNING, "WRITE_DROPS_INVERSE_MASSES",
               "its inverse masses are not in the .hair file, which has no place for them: write .ply, .tfx or a cache to keep them");
}

}  // namespace

const Codec hair_codec{FLK_FORMAT_HAIR, read, measure, write};

}  // namespace forelock
