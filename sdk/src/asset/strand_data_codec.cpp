// Research data sets of strands without a header, little endian: 0 i32 strands, then for each strand i32 points and its points.
// USC-HairSalon (Hu et al. 2015, .data) has f32 x 3 a point; CT2Hair (Shen et al. 2023, .bin) has f32 x 7, of which the first
// three are the position. Nothing says which: the file does whose counts end with its last byte. An entry of one point is a root
// without hair.
#include "asset/codec.h"

#include <cinttypes>

namespace forelock {
namespace {

constexpr uint64_t narrow_point = 12, wide_point = 28;

// A walk over the counts with a size of points.
struct Walk {
  uint64_t points = 0;
  uint64_t strand = 0;    // the first that does not fit, if any
  uint64_t at = 0;        // its count's byte; where the walk ended
  int64_t count = 0;
  bool fits = false;
};

Walk walkCounts(std::span<const std::byte> bytes, uint64_t strands, uint64_t point_size) noexcept {
  Walk walk;
  walk.at = 4;
  for (; walk.strand < strands; ++walk.strand) {
    Cursor cursor(bytes, walk.at);
    walk.count = static_cast<int32_t>(cursor.u32());
    if (cursor.failed() || walk.count < 0 || !cursor.holds(static_cast<uint64_t>(walk.count), point_size)) return walk;
    walk.points += static_cast<uint64_t>(walk.count);
    walk.at += 4 + static_cast<uint64_t>(walk.count) * point_size;
  }
  walk.fits = true;
  return walk;
}

FlkResult read(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
               Places& places, Findings& findings) {
  const uint64_t strands = Cursor(bytes).u32();
  const Walk narrow = walkCounts(bytes, strands, narrow_point), wide = walkCounts(bytes, strands, wide_point);
  const bool is_wide = wide.fits && (!narrow.fits || narrow.at != bytes.size());
  const Walk& walk = is_wide ? wide : narrow;
  if (!walk.fits) {
    // The reading that got further is the likelier one.
    const bool wide_is_nearer = wide.strand > narrow.strand;
    const Walk& nearer = wide_is_nearer ? wide : narrow;
    return report.fail(FLK_ERROR_MALFORMED, "DATA_COUNT_PAST_END",
                       "read as strands of USC-HairSalon or CT2Hair, which have no header but a count (byte 0: %" PRIu64
                       " strands), strand %" PRIu64 " has %" PRId64 " points of %" PRIu64 " bytes (byte %" PRIu64
                       "), but the file ends at byte %zu: it is truncated, fetch it again, or it is no strand file",
                       strands, nearer.strand, nearer.count, wide_is_nearer ? wide_point : narrow_point, nearer.at, bytes.size());
  }
  if (strands > limits.strands || walk.points > limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "DATA_TOO_LARGE",
                       "it holds %" PRIu64 " strands (byte 0) and %" PRIu64 " points, beyond the limit of %" PRIu32 " and %" PRIu32
                       ": split it or raise the limit",
                       strands, walk.points, limits.strands, limits.vertices);
  if (walk.at < bytes.size()) findings.note(FindingKind::trailing_bytes, no_strand, walk.at, bytes.size() - walk.at);
  if (is_wide) findings.note(FindingKind::data_values_ignored, no_strand, 8 + narrow_point);

  const uint32_t point_size = is_wide ? wide_point : narrow_point;
  arrays.first_vertex.reserve(strands + 1);
  arrays.positions.resize(walk.points * 3);
  arrays.first_vertex.push_back(0);
  Cursor cursor(bytes, 4);
  uint32_t vertex = 0;
  for (uint64_t strand = 0; strand < strands; ++strand) {
    const uint32_t count = cursor.u32();
    if (count > walk.points - vertex) return fileChanged(report);
    if (!is_wide) {
      cursor.floats({arrays.positions.data() + std::size_t{vertex} * 3, std::size_t{count} * 3});
    } else {
      for (uint32_t point = 0; point < count; ++point) {
        cursor.floats({arrays.positions.data() + (std::size_t{vertex} + point) * 3, 3});
        for (int unused = 0; unused < 4; ++unused) cursor.f32();
      }
    }
    arrays.first_vertex.push_back(vertex += count);
  }
  if (vertex != walk.points) return fileChanged(report);
  places.positions = {4, point_size, false, 4};
  places.bald_roots = true;
  return FLK_SUCCESS;
}

}  // namespace

const Codec strand_data_codec{FLK_FORMAT_STRAND_DATA, read, nullptr, nullptr};

}  // namespace forelock
