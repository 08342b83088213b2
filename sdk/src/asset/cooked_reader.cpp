// Reads a cooked file and proves what it says: one pass over every block, a piece at a time, while the piece is in the first-level cache.
#include "asset/checksum.h"
#include "asset/codec.h"
#include "asset/cooked_format.h"
#include "asset/cooked_layout.h"
#include "asset/sanitise.h"
#include "asset/value_range.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>

namespace forelock {
namespace {

using namespace cooked;

constexpr const char* cook_again = "it is damaged, cook it again from the source";

// A multiple of what Checksum and ValueRange take, which leaves room in a cache of 32 KiB.
constexpr std::size_t piece_floats = 6144;
static_assert(piece_floats * sizeof(float) % Checksum::stripe == 0 && piece_floats % ValueRange::lanes == 0);

struct Reader {
  std::span<const std::byte> bytes;
  const Report& report;
  FlkAsset_T& asset;
  Table table{};
  uint32_t strands = 0, vertices = 0, findings = 0;

  FlkResult malformed(uint64_t at, const char* field, const char* wrong) const {
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_FIELD", "%s (byte %" PRIu64 ") %s: %s", field, at, wrong, cook_again);
  }
  FlkResult checksumFailed(const char* what, uint64_t begin, uint64_t end) const {
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_CHECKSUM", "the checksum of its %s (bytes %" PRIu64 " to %" PRIu64 ") does not match: %s",
                       what, begin, end, cook_again);
  }
  std::span<const std::byte> blockBytes(Block block) const noexcept {
    return bytes.subspan(static_cast<std::size_t>(table[block].offset), static_cast<std::size_t>(table[block].bytes));
  }

  FlkResult readHeader(const Limits& limits);
  FlkResult readPlaces();
  FlkResult readFirstVertex();
  FlkResult readFindings();
  FlkResult checkValues(Block block, std::span<const float> values, float from, float to);
  FlkResult checkPositions(std::span<const float> values);
  bool hasLength(uint32_t strand, const float* values) const noexcept;
  FlkResult badValue(Block block, std::span<const float> values, float from, float to) const;
};

FlkResult Reader::readHeader(const Limits& limits) {
  if (bytes.size() < header_size)
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_HEADER_TRUNCATED",
                       "the header of a cooked file is %" PRIu64 " bytes, but the file ends at byte %zu: it is truncated, fetch it again or cook it again",
                       header_size, bytes.size());
  for (std::size_t i = 0; i < magic.size(); ++i)
    if (std::to_integer<char>(bytes[i]) != magic[i])
      return report.fail(FLK_ERROR_MALFORMED, "COOKED_MAGIC_DAMAGED",
                         "it begins like a cooked file, but byte %zu of its magic is wrong: it was transferred as text, fetch it again as binary", i);
  Cursor header(bytes, version_at);
  if (const uint32_t found = header.u32(); found != version)
    return report.fail(FLK_ERROR_FORMAT_UNKNOWN, "COOKED_VERSION",
                       "it was cooked by %s version of Forelock (version %" PRIu32 " at byte 8, %" PRIu32 " is read): cook it again from the source",
                       found < version ? "an older" : "a newer", found, version);
  const uint32_t written_header_size = header.u32();
  if (const uint64_t size = header.u64(); size != bytes.size())
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_SIZE", "its header counts %" PRIu64 " bytes (byte 16), but it has %zu: %s", size, bytes.size(),
                       size > bytes.size() ? "it is truncated, fetch it again or cook it again from the source" : cook_again);
  if (Checksum::of(bytes.first(checksum_at)) != Cursor(bytes, checksum_at).u64()) return checksumFailed("header", 0, checksum_at);
  // The bytes are those that were written. Whether they make sense, has to be proven all the same.
  if (written_header_size != header_size) return malformed(12, "the size of the header", "is not 320");
  FlkAssetInfo& info = asset.info;
  strands = info.strand_count = header.u32();
  vertices = info.vertex_count = header.u32();
  if (strands > limits.strands || vertices > limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "COOKED_TOO_LARGE",
                       "it holds %" PRIu32 " strands (byte 24) and %" PRIu32 " vertices (byte 28), beyond the limit of %" PRIu32 " and %" PRIu32
                       ": split it or raise the limit", strands, vertices, limits.strands, limits.vertices);
  if (strands == 0) return malformed(strands_at, "the count of strands", "is 0");
  if (vertices / 2 < strands) return malformed(vertices_at, "the count of vertices", "is less than two for each strand");
  info.min_vertices_per_strand = header.u32();
  info.max_vertices_per_strand = header.u32();
  info.format = FLK_FORMAT_COOKED;
  info.source_format = header.u32();
  if (info.source_format != FLK_FORMAT_UNKNOWN && !findCodec(info.source_format)) return malformed(source_format_at, "the source's format", "is none that is read");
  const uint32_t flags = header.u32();
  if (flags & ~flag_radii_from_source) return malformed(flags_at, "the field of flags", "has bits that mean nothing");
  info.has_radii = flags & flag_radii_from_source;
  findings = header.u32();
  info.strands_in_source = header.u32();
  if (info.strands_in_source < strands || info.strands_in_source > limit_strands)
    return malformed(strands_in_source_at, "the count of strands in the source", "does not fit that of the strands");
  for (float& value : info.min_bounds) value = header.f32();
  for (float& value : info.max_bounds) value = header.f32();
  info.min_length = header.f32(), info.mean_length = header.f32(), info.max_length = header.f32();
  // What the lengths are is not computed again, which would take longer than everything else here. The mean is rounded.
  constexpr float rounding = 1e-5f;
  if (!(info.min_length > 0 && info.min_length <= info.max_length && std::isfinite(info.max_length) &&
        info.mean_length >= info.min_length * (1 - rounding) && info.mean_length <= info.max_length * (1 + rounding)))
    return malformed(lengths_at, "the lengths of strands", "are no shortest, mean and longest length");
  info.min_radius = header.f32(), info.max_radius = header.f32();
  for (uint64_t at = reserved_at; at < table_at; at += 4)
    if (header.u32() != 0) return malformed(at, "a reserved word", "is not 0");
  return readPlaces();
}

FlkResult Reader::readPlaces() {
  Cursor cursor(bytes, table_at);
  for (BlockPlace& place : table) place = {cursor.u64(), cursor.u64(), cursor.u64()};
  for (uint64_t at = table_end; at < checksum_at; at += 4)
    if (cursor.u32() != 0) return malformed(at, "a reserved word", "is not 0");
  Table expected;
  const uint64_t size = layOut(strands, vertices, table[root_uvs].bytes != 0, table[inverse_masses].bytes != 0, table[colors].bytes != 0,
                               table[Block::findings].bytes, expected);
  for (std::size_t block = 0; block < blocks; ++block)
    if (table[block].offset != expected[block].offset || table[block].bytes != expected[block].bytes || (table[block].bytes == 0 && table[block].checksum != 0))
      return report.fail(FLK_ERROR_MALFORMED, "COOKED_BLOCK_PLACE",
                         "the block %s has %" PRIu64 " bytes from byte %" PRIu64 " (entry at byte %" PRIu64 "), where %" PRIu64 " from byte %" PRIu64
                         " belong for %" PRIu32 " strands of %" PRIu32 " vertices: %s", block_names[block], table[block].bytes, table[block].offset,
                         table_at + block * 24, expected[block].bytes, expected[block].offset, strands, vertices, cook_again);
  // The places are those of a file of this size, so that no sum or product of them can pass its end. Findings are the last block and may
  // have announced any length: they wrap or they end elsewhere.
  if (table[Block::findings].bytes > bytes.size() || size != bytes.size())
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_SIZE", "its blocks end at byte %" PRIu64 ", but it has %zu bytes: %s", size, bytes.size(), cook_again);
  uint64_t end = header_size;
  for (const BlockPlace& place : table) {
    for (; end < place.offset; ++end)
      if (bytes[static_cast<std::size_t>(end)] != std::byte{0}) return malformed(end, "the space between two blocks", "is not 0");
    end = std::max(end, place.offset + place.bytes);
  }
  return FLK_SUCCESS;
}

// A copy even of a mapped file: these are the numbers that others index with, so they must not change any more.
FlkResult Reader::readFirstVertex() {
  std::pmr::vector<uint32_t>& first = asset.arrays.first_vertex;
  first.resize(std::size_t{strands} + 1);
  Cursor(bytes, table[first_vertex].offset).u32s(first);
  if (Checksum::of(blockBytes(first_vertex)) != table[first_vertex].checksum)
    return checksumFailed("first_vertex", table[first_vertex].offset, table[first_vertex].offset + table[first_vertex].bytes);
  uint32_t least = UINT32_MAX, most = 0;
  for (uint32_t strand = 0; strand < strands; ++strand) {
    const uint32_t begin = first[strand], end = first[strand + 1];
    if (end < begin || end - begin < 2 || end > vertices || (strand == 0 && begin != 0))
      return report.fail(FLK_ERROR_MALFORMED, "COOKED_FIRST_VERTEX",
                         "strand %" PRIu32 " goes from vertex %" PRIu32 " to %" PRIu32 " (first_vertex, byte %" PRIu64 "), which are not two or more of %" PRIu32
                         ": %s", strand, begin, end, table[first_vertex].offset + uint64_t{strand} * 4, vertices, cook_again);
    least = std::min(least, end - begin);
    most = std::max(most, end - begin);
  }
  if (first[strands] != vertices) return malformed(table[first_vertex].offset + uint64_t{strands} * 4, "the last entry of first_vertex", "is not the count of vertices");
  if (least != asset.info.min_vertices_per_strand || most != asset.info.max_vertices_per_strand)
    return malformed(counts_at, "the least and the most vertices of a strand", "are not those of the strands");
  return FLK_SUCCESS;
}

// Whether any segment is long enough to be one. The first nearly always is, as one comparison shows.
bool Reader::hasLength(uint32_t strand, const float* values) const noexcept {
  const uint32_t begin = asset.arrays.first_vertex[strand], end = asset.arrays.first_vertex[strand + 1];
  for (uint32_t vertex = begin; vertex + 1 < end; ++vertex) {
    const float* a = values + std::size_t{vertex} * 3;
    const double x = double{a[3]} - a[0], y = double{a[4]} - a[1], z = double{a[5]} - a[2];
    if (std::fabs(x) + std::fabs(y) + std::fabs(z) > 2 * vanishing_length || std::sqrt(x * x + y * y + z * z) > vanishing_length) return true;
  }
  return false;
}

FlkResult Reader::badValue(Block block, std::span<const float> values, float from, float to) const {
  std::size_t at = 0;
  while (at + 1 < values.size() && values[at] >= from && values[at] <= to) ++at;
  return report.fail(FLK_ERROR_MALFORMED, "COOKED_VALUE", "a value of %s is %s (byte %" PRIu64 "), where %s to %s are possible: %s", block_names[block],
                     Number(double{values[at]}, 6).text, table[block].offset + at * 4, Number(double{from}, 6).text, Number(double{to}, 6).text, cook_again);
}

// Calls `look` for pieces of the values, having added the same piece of the file to the checksum. True: it matches.
template <class Look>
bool walk(std::span<const std::byte> bytes, std::span<const float> values, uint64_t expected, Look&& look) {
  Checksum sum;
  std::size_t at = 0;
  for (; values.size() - at >= piece_floats; at += piece_floats) {
    sum.add(bytes.subspan(at * sizeof(float), piece_floats * sizeof(float)));
    look(values.subspan(at, piece_floats), at);
  }
  const std::span<const std::byte> rest = bytes.subspan(at * sizeof(float));
  const std::size_t whole = rest.size() / Checksum::stripe * Checksum::stripe;
  sum.add(rest.first(whole));
  if (at < values.size()) look(values.subspan(at), at);
  return sum.finish(rest.subspan(whole)) == expected;
}

FlkResult Reader::checkValues(Block block, std::span<const float> values, float from, float to) {
  if (values.empty()) return FLK_SUCCESS;
  ValueRange range;
  if (!walk(blockBytes(block), values, table[block].checksum, [&](std::span<const float> piece, std::size_t) { range.add(piece); }))
    return checksumFailed(block_names[block], table[block].offset, table[block].offset + table[block].bytes);
  if (!range.within(from, to)) return badValue(block, values, from, to);
  if (block == radii && (range.least() != asset.info.min_radius || range.greatest() != asset.info.max_radius))
    return malformed(radii_at, "the least and the greatest radius", "are not those of the radii");
  return FLK_SUCCESS;
}

FlkResult Reader::checkPositions(std::span<const float> values) {
  ValueRange range;
  uint32_t strand = 0, without_length = no_strand;
  const std::pmr::vector<uint32_t>& first = asset.arrays.first_vertex;
  const bool matches = walk(blockBytes(positions), values, table[positions].checksum, [&](std::span<const float> piece, std::size_t at) {
    range.add(piece);
    for (; strand < strands && std::size_t{first[strand]} * 3 < at + piece.size(); ++strand)
      if (!hasLength(strand, values.data()) && without_length == no_strand) without_length = strand;
  });
  if (!matches) return checksumFailed("positions", table[positions].offset, table[positions].offset + table[positions].bytes);
  if (!range.within(-largest_coordinate, largest_coordinate)) return badValue(positions, values, -largest_coordinate, largest_coordinate);
  if (without_length != no_strand)
    return report.fail(FLK_ERROR_MALFORMED, "COOKED_VALUE", "strand %" PRIu32 " (positions, byte %" PRIu64 ") has no length: %s", without_length,
                       table[positions].offset + uint64_t{first[without_length]} * 12, cook_again);
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (range.least(axis, 3) != asset.info.min_bounds[axis] || range.greatest(axis, 3) != asset.info.max_bounds[axis])
      return malformed(bounds_at + axis * 4, "the bounds", "are not those of the positions");
  return FLK_SUCCESS;
}

bool isCode(std::string_view code) noexcept {
  return !code.empty() && std::all_of(code.begin(), code.end(), [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; });
}

FlkResult Reader::readFindings() {
  constexpr uint64_t record = 64;
  constexpr uint32_t longest_code = 64, longest_text = 512, most_findings = 256;
  const std::span<const std::byte> block = blockBytes(Block::findings);
  if (!block.empty() && Checksum::of(block) != table[Block::findings].checksum)
    return checksumFailed("findings", table[Block::findings].offset, table[Block::findings].offset + block.size());
  Cursor cursor(block);
  if (findings > most_findings || !cursor.holds(findings, record)) return malformed(findings_at, "the count of findings", "does not fit their block");
  asset.findings.reserve(findings);
  for (uint32_t i = 0; i < findings; ++i) {
    const uint64_t at = table[Block::findings].offset + cursor.at();
    FlkFinding finding{};
    finding.count = cursor.u64();
    finding.severity = cursor.u32();
    finding.repaired = cursor.u32();
    finding.strands_listed = cursor.u32();
    for (uint32_t& strand : finding.strands) strand = cursor.u32();
    finding.byte_offset = no_byte;
    const uint32_t code_size = cursor.u32(), text_size = cursor.u32(), zero = cursor.u32();
    if (cursor.failed() || !cursor.holds(uint64_t{code_size} + text_size, 1)) return malformed(at, "a finding", "reaches past its block");
    const std::string_view code(reinterpret_cast<const char*>(block.data() + cursor.at()), code_size);
    const std::string_view text(code.data() + code_size, text_size);
    cursor.skip(uint64_t{code_size} + text_size);
    const bool strands_exist = std::all_of(finding.strands, finding.strands + 8, [&](uint32_t strand) {
      return strand < asset.info.strands_in_source;  // entries that are not set are 0
    });
    if (finding.count == 0 || finding.severity > FLK_SEVERITY_WARNING || finding.repaired > 1 || finding.strands_listed > 8 || !strands_exist || zero != 0)
      return malformed(at, "a finding", "has a count, severity or strand that no finding has");
    if (code_size > longest_code || text_size == 0 || text_size > longest_text || !isCode(code) || !isSentence(text))
      return malformed(at, "a finding", "has a code or sentence that no finding has");
    asset.findings.restore(finding, code, text);
  }
  if (cursor.left() != 0) return malformed(table[Block::findings].offset + cursor.at(), "the block of findings", "goes on after the last");
  return FLK_SUCCESS;
}

}  // namespace

FlkResult readCooked(std::span<const std::byte> bytes, Mapping* mapping, const Limits& limits, const Report& report, FlkAsset_T& asset) {
  Reader reader{bytes, report, asset};
  FlkResult result = reader.readHeader(limits);
  if (result != FLK_SUCCESS) return result;
  const bool stays = mapping && !mapping->bytes().empty() && std::endian::native == std::endian::little;
  result = reader.readFirstVertex();
  if (result != FLK_SUCCESS) return result;

  constexpr float most = std::numeric_limits<float>::max();
  const struct {
    Block block;
    FloatArray& array;
    const float*& view;
    float from, to;
  } arrays[] = {{positions, asset.arrays.positions, asset.strands.positions, -largest_coordinate, largest_coordinate},
                {radii, asset.arrays.radii, asset.strands.radii, 0, largest_coordinate},
                {root_uvs, asset.arrays.root_uvs, asset.strands.root_uvs, -most, most},
                {inverse_masses, asset.arrays.inverse_masses, asset.strands.inverse_masses, 0, most},
                {colors, asset.arrays.colors, asset.strands.colors, 0, 1}};
  for (const auto& each : arrays) {
    const std::span<const std::byte> block = reader.blockBytes(each.block);
    std::span<const float> values;
    if (stays) {
      values = {reinterpret_cast<const float*>(block.data()), block.size() / sizeof(float)};  // a multiple of 64 in pages
    } else {
      each.array.resize(block.size() / sizeof(float));
      Cursor(bytes, reader.table[each.block].offset).floats(each.array);
      values = each.array;
    }
    each.view = values.empty() ? nullptr : values.data();
    result = each.block == positions ? reader.checkPositions(values) : reader.checkValues(each.block, values, each.from, each.to);
    if (result != FLK_SUCCESS) return result;
  }
  result = reader.readFindings();
  if (result != FLK_SUCCESS) return result;
  asset.info.has_root_uvs = asset.strands.root_uvs != nullptr;
  asset.info.has_inverse_masses = asset.strands.inverse_masses != nullptr;
  asset.info.has_colors = asset.strands.colors != nullptr;
  asset.strands.type = FLK_TYPE_STRANDS;
  asset.strands.strand_count = reader.strands;
  asset.strands.vertex_count = reader.vertices;
  if (stays) asset.file = std::move(*mapping);
  return FLK_SUCCESS;
}

}  // namespace forelock
