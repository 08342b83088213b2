// Skin weights of TressFX 4 (.tfxbone), little endian, without a header: i32 bones; for each i32 number, i32 length with its NUL, the
// name; i32 strands; for each i32 number and four times i32 bone, f32 weight. Names are not padded, so that records lie at any
// byte. The numbers of bones and strands are theirs in the order of the file; AMD's loader goes by the order.
#include "asset/tfxbone_reader.h"

#include "asset/cursor.h"
#include "asset/rig_arrays.h"

#include <algorithm>
#include <cinttypes>
#include <cstring>

namespace forelock {
namespace {

constexpr uint64_t least_bone = 8, record_size = 36;
constexpr uint32_t most_likely_bones = 65'536, longest_likely_name = 4'096;

int64_t i32(Cursor& cursor) noexcept { return static_cast<int32_t>(cursor.u32()); }

// The name of `length` bytes at the cursor without its NUL, which it may lack or have too early.
std::string_view nameAt(std::span<const std::byte> bytes, const Cursor& cursor, uint64_t length) noexcept {
  const std::string_view whole(reinterpret_cast<const char*>(bytes.data()) + cursor.at(), length);
  return whole.substr(0, whole.find('\0'));
}

bool printable(std::string_view name) noexcept {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) >= ' '; });
}

// Bytes of all names as stored here; `table` ends behind the last one.
FlkResult measureNames(std::span<const std::byte> bytes, int64_t bones, const Report& report, Cursor& table, uint64_t& name_bytes) {
  for (int64_t bone = 0; bone < bones; ++bone) {
    const uint64_t at = table.at();
    table.u32();
    const int64_t length = i32(table);
    if (table.failed() || length < 0 || static_cast<uint64_t>(length) > table.left())
      return report.fail(FLK_ERROR_MALFORMED, "BONE_NAME_PAST_END",
                         "read as a .tfxbone file, bone %" PRId64 " of %" PRId64 " (byte %" PRIu64 ") has a name of %" PRId64
                         " bytes (byte %" PRIu64 "), but the file ends at byte %zu: it is truncated, fetch it again, or it is no .tfxbone file",
                         bone, bones, at, length, at + 4, bytes.size());
    name_bytes += nameAt(bytes, table, static_cast<uint64_t>(length)).size();
    table.skip(static_cast<uint64_t>(length));
  }
  return FLK_SUCCESS;
}

void readNames(std::span<const std::byte> bytes, int64_t bones, uint64_t name_bytes, RigArrays& arrays, Findings& findings) {
  arrays.names.reserve(static_cast<std::size_t>(bones), name_bytes);
  Cursor cursor(bytes, 4);
  for (uint32_t bone = 0; bone < bones; ++bone) {
    const uint64_t at = cursor.at();
    if (i32(cursor) != int64_t{bone}) findings.note(FindingKind::rig_index_unexpected, bone, at);
    const uint64_t length = cursor.u32();
    const std::string_view name = nameAt(bytes, cursor, length);
    if (name.size() == length && length != 0) findings.note(FindingKind::bone_name_unterminated, bone, at + 8);
    if (name.size() + 1 < length) findings.note(FindingKind::bone_name_cut, bone, at + 8 + name.size());
    arrays.names.add(name);
    cursor.skip(length);
  }
  arrays.names.finish(findings);
}

}  // namespace

bool looksLikeTfxbone(std::span<const std::byte> head) noexcept {
  Cursor cursor(head);
  const uint32_t bones = cursor.u32();
  if (bones == 0 || bones > most_likely_bones) return false;
  uint32_t seen = 0;
  for (; seen < bones; ++seen) {
    cursor.u32();
    const uint32_t length = cursor.u32();
    if (cursor.failed() || length > cursor.left()) break;
    if (length < 2 || length > longest_likely_name) return false;
    const std::string_view name = nameAt(head, cursor, length);
    if (!printable(name) || name.size() + 1 != length) return false;
    cursor.skip(length);
  }
  return seen != 0;
}

bool fitsTfxbone(std::span<const std::byte> bytes) noexcept {
  Cursor cursor(bytes);
  const int64_t bones = i32(cursor);
  if (bones <= 0 || !cursor.holds(static_cast<uint64_t>(bones), least_bone)) return false;
  for (int64_t bone = 0; bone < bones; ++bone) {
    cursor.u32();
    const int64_t length = i32(cursor);
    if (cursor.failed() || length < 1 || static_cast<uint64_t>(length) > cursor.left()) return false;
    cursor.skip(static_cast<uint64_t>(length));
  }
  const int64_t strands = i32(cursor);
  return strands > 0 && cursor.left() % record_size == 0 && cursor.left() / record_size == static_cast<uint64_t>(strands);
}

FlkResult readTfxbone(std::span<const std::byte> bytes, const RigLimits& limits, const Report& report, RigArrays& arrays,
                      Findings& findings) {
  Cursor table(bytes);
  const int64_t bones = i32(table);
  if (table.failed() || bones < 0 || !table.holds(static_cast<uint64_t>(bones), least_bone))
    return report.fail(FLK_ERROR_MALFORMED, "BONE_TABLE_PAST_END",
                       "read as a .tfxbone file, which begins with nothing but a count (byte 0: %" PRId64
                       " bones of 8 bytes or more), it ends too early at byte %zu: it is truncated, fetch it again, or it is no .tfxbone file",
                       bones, bytes.size());
  if (bones == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "RIG_NO_BONES", "it counts 0 bones (byte 0): there is nothing that hair could hang on, export it again");
  if (bones > int64_t{limits.bones})
    return report.fail(FLK_ERROR_LIMIT, "RIG_TOO_LARGE", "it counts %" PRId64 " bones (byte 0), beyond the limit of %" PRIu32
                       ": leave joints out of the export or raise the limit", bones, limits.bones);
  uint64_t name_bytes = 0;
  const FlkResult measured = measureNames(bytes, bones, report, table, name_bytes);
  if (measured != FLK_SUCCESS) return measured;

  const uint64_t count_at = table.at();
  const int64_t strands = i32(table);
  if (table.failed() || strands < 0 || !table.holds(static_cast<uint64_t>(strands), record_size))
    return report.fail(FLK_ERROR_MALFORMED, "SKIN_PAST_END", "after %" PRId64 " bones it counts %" PRId64 " strands (byte %" PRIu64
                       ") of 36 bytes, but the file ends at byte %zu: it is truncated, fetch it again", bones, strands, count_at, bytes.size());
  if (strands == 0)
    return report.fail(FLK_ERROR_EMPTY_ASSET, "RIG_NO_RECORDS", "it counts 0 strands (byte %" PRIu64 "): there is nothing to attach, export it again", count_at);
  if (strands > int64_t{limits.records})
    return report.fail(FLK_ERROR_LIMIT, "RIG_TOO_LARGE", "it counts %" PRId64 " strands (byte %" PRIu64 "), beyond the limit of %" PRIu32
                       ": split it or raise the limit", strands, count_at, limits.records);

  readNames(bytes, bones, name_bytes, arrays, findings);
  if (table.at() % 4 != 0) findings.note(FindingKind::skin_records_unaligned, no_strand, table.at());
  arrays.bones.reserve(static_cast<std::size_t>(strands) * 4);
  arrays.weights.reserve(static_cast<std::size_t>(strands) * 4);
  Weights weights(arrays, findings);
  for (uint32_t strand = 0; strand < strands; ++strand) {
    const uint64_t at = table.at();
    if (i32(table) != int64_t{strand}) findings.note(FindingKind::rig_index_unexpected, strand, at);
    Attachment attachment;
    for (int i = 0; i < 4; ++i) {
      attachment.bones[i] = i32(table);
      attachment.weights[i] = table.f32();
    }
    weights.add(attachment, at);
  }
  weights.finish("strands");
  if (table.left() != 0) findings.note(FindingKind::trailing_bytes, no_strand, table.at(), table.left());
  return FLK_SUCCESS;
}

}  // namespace forelock
