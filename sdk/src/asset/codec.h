// What a file format has to offer; one line a format in codec.cpp.
#pragma once

#include "asset/cursor.h"
#include "asset/strand_arrays.h"

#include <span>

namespace forelock {

// Before version 4 TressFX files have no masses: a strand's first two vertices are held, and the last two where both ends are.
inline float impliedInverseMass(uint64_t from_root, uint64_t vertices, bool both_ends) noexcept {
  return from_root < 2 || (both_ends && from_root + 2 >= vertices) ? 0.0f : 1.0f;
}

// Bytes of a mapped file may change while they are read: a count that was proven against them is read once, or compared again with
// what was proven.
inline FlkResult fileChanged(const Report& report) {
  return report.fail(FLK_ERROR_IO, "FILE_CHANGED", "it was written into while it was read: try again when that is done");
}

struct Codec {
  uint32_t format;

  // Fills arrays and places, having proven every count against the bytes before it allocates; notes what is odd about the
  // file. A refusal is told to `report`. Throws std::bad_alloc.
  FlkResult (*read)(std::span<const std::byte> bytes, const Limits& limits, const Report& report, StrandArrays& arrays,
                    Places& places, Findings& findings);

  // Both nullptr: the format is only read. Length in bytes of an asset in this format. FLK_ERROR_LIMIT, told to `report`, if the format cannot hold it.
  FlkResult (*measure)(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, uint64_t& bytes);

  // Fills a span of that length and tells what was left out.
  void (*write)(const FlkStrands& strands, const FlkAssetInfo& info, const Report& report, ByteSink& sink);
};

extern const Codec tfx_codec;
extern const Codec hair_codec;
extern const Codec tfx_text_codec;
extern const Codec strand_data_codec;
extern const Codec ply_codec;

// nullptr: no such format.
const Codec* findCodec(uint32_t format) noexcept;

}  // namespace forelock
