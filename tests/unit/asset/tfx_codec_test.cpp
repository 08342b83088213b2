#include "asset_kit.h"

#include <limits>

using namespace asset_test;

namespace {

void expectRefusal(const Bytes& file, FlkResult result, const char* id, const std::string& says = "") {
  expectRefused(file, "broken.tfx", result, id, says);
}

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST(TfxReader, ReadsEveryField) {
  const auto loaded = load(smallTfx());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  const FlkAssetInfo info = loaded->info();
  EXPECT_EQ(info.format, uint32_t{FLK_FORMAT_TFX});
  EXPECT_EQ(info.strand_count, 3u);
  EXPECT_EQ(info.vertex_count, 12u);
  EXPECT_EQ(info.has_radii, 0u);
  const FlkStrands strands = loaded->strands();
  EXPECT_EQ(strands.first_vertex[2], 8u);
  EXPECT_EQ(strands.positions[3 * 7 + 0], 0.25f);
  EXPECT_EQ(strands.positions[3 * 7 + 1], 0.375f);
  EXPECT_EQ(strands.positions[3 * 7 + 2], 0.1875f);
  EXPECT_EQ(strands.inverse_masses[5], 0.0f);
  EXPECT_EQ(strands.inverse_masses[6], 1.0f);
  EXPECT_EQ(strands.root_uvs[2], 0.25f);
  EXPECT_EQ(strands.root_uvs[3], 0.5f);
  EXPECT_FLOAT_EQ(strands.radii[0], 0.5f * 0.5f / 1000) << "the longest side is 0.5, and a strand is longer than a tenth of it";
  EXPECT_EQ(loaded->codes(), "WIDTH_DEFAULTED");
}

TEST(TfxReader, UvOffsetOfZeroMeansNone) {
  const auto loaded = load(smallTfx(false));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->strands().root_uvs, nullptr);
}

TEST(TfxReader, OptionalBlocks) {
  Bytes file = smallTfx();
  const size_t thickness = file.size();
  file.setU32(24, thickness).f32s({0.5f, 0.25f, 0.125f});
  file.setU32(20, file.size()).zeros(12 * 8);
  file.setU32(28, file.size()).zeros(12 * 16);
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().has_radii, 1u);
  EXPECT_EQ(loaded->strands().radii[3], 0.25f);
  EXPECT_EQ(loaded->strands().radii[4], 0.125f);
  EXPECT_EQ(loaded->codes(), "TFX_VERTEX_UV_IGNORED TFX_VERTEX_COLOR_IGNORED");
  // Each of them one byte short.
  for (const size_t field : {20u, 24u, 28u}) {
    Bytes shifted = file;
    uint32_t offset = 0;
    std::memcpy(&offset, shifted.bytes.data() + field, 4);
    shifted.setU32(20, 0).setU32(24, 0).setU32(28, 0).setU32(field, offset);
    const size_t length = field == 24 ? 12 : field == 20 ? 96 : 192;
    expectRefusal(shifted.cut(offset + length - 1), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                  "offset field at byte " + std::to_string(field));
  }
}

TEST(TfxReader, HeaderCut) {
  for (const size_t length : {4u, 12u, 32u, 159u})
    expectRefusal(smallTfx().cut(length), FLK_ERROR_MALFORMED, "TFX_HEADER_TRUNCATED", "byte " + std::to_string(length));
  expectRefusal(smallTfx().cut(0), FLK_ERROR_FORMAT_UNKNOWN, "FILE_EMPTY");
  expectRefusal(smallTfx().cut(1), FLK_ERROR_FORMAT_UNKNOWN, "FORMAT_UNKNOWN");
}

TEST(TfxReader, BodyCut) {
  expectRefusal(smallTfx().cut(160 + 100), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                "broken.tfx: positions (offset field at byte 12) need 192 bytes from byte 160 for 3 strands of 4 vertices "
                "(bytes 4 and 8), but the file ends at byte 260: it is truncated, fetch it again");
  expectRefusal(smallTfx().cut(160 + 192 + 9), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                "strand UVs (offset field at byte 16) need 24 bytes from byte 352");
}

TEST(TfxReader, Versions) {
  for (const float version : {0.0f, -4.0f, 1e30f, 4.1f, 5.0f, infinity, not_a_number})
    expectRefusal(smallTfx().setF32(0, version), FLK_ERROR_FORMAT_UNKNOWN, "TFX_VERSION_UNKNOWN", "version (byte 0)");
  for (const float version : {2.0f, 3.1f, 6.0f, not_a_number})
    expectRefusal(smallTfx3().setF32(0, version), FLK_ERROR_FORMAT_UNKNOWN, "TFX_VERSION_UNKNOWN", "where 3 and 4 are read");
  // The one's header with the other's version.
  expectRefusal(smallTfx().setF32(0, 3.0f), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "(offset field at byte 144)");
  expectRefusal(smallTfx3().setF32(0, 4.0f), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "(offset field at byte 12)");
}

TEST(TfxReader, ByteSwapped) {
  for (Bytes file : {smallTfx(), smallTfx3()}) {
    for (size_t i = 0; i + 4 <= file.size(); i += 4) {
      std::swap(file.bytes[i], file.bytes[i + 3]);
      std::swap(file.bytes[i + 1], file.bytes[i + 2]);
    }
    expectRefusal(file, FLK_ERROR_MALFORMED, "TFX_BYTE_SWAPPED", "big-endian");
  }
}

TEST(TfxReader, HugeCountsAskForNoMemory) {
  const std::pair<uint64_t, uint64_t> counts[] = {
      {0xffffffffu, 4}, {0x80000001u, 4}, {3, 0xffffffffu}, {0xffffffffu, 0xffffffffu},
      {0x10000001u, 16},            // x 16 bytes = 4 GiB + 256: 256 in 32 bits
      {0x80000000u, 0x20000000u},   // x 16 bytes = 2^64: 0 in 64 bits
      {0x15555556u, 1},             // x 12 bytes = 4 GiB + 8: 8 in 32 bits
  };
  for (size_t i = 0; i < 2 * std::size(counts); ++i) {
    const auto& [strands, vertices] = counts[i / 2];
    Bytes file = i % 2 ? smallTfx3() : smallTfx();
    file.setU32(4, strands).setU32(8, vertices);
    expectRefusal(file, FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                  i % 2 ? "positions (offset field at byte 144)" : "positions (offset field at byte 12)");

    CountingAllocator counter;
    const FlkHostAllocator allocator = counter.callbacks();
    FlkAssetOptions options{};
    options.type = FLK_TYPE_ASSET_OPTIONS;
    options.allocator = &allocator;
    FlkAsset asset = nullptr;
    EXPECT_EQ(flkAssetLoadMemory(file.bytes.data(), file.size(), &options, &asset), FLK_ERROR_MALFORMED);
    EXPECT_LT(counter.largest, 8192u);
    EXPECT_EQ(counter.live, 0u);
  }
}

TEST(TfxReader, ZeroAndOne) {
  expectRefusal(smallTfx().setU32(4, 0), FLK_ERROR_EMPTY_ASSET, "TFX_NO_STRANDS", "0 strands (byte 4)");
  expectRefusal(smallTfx().setU32(8, 0), FLK_ERROR_EMPTY_ASSET, "TFX_NO_STRANDS", "0 vertices (byte 8)");
  expectRefusal(smallTfx(false).setU32(8, 1), FLK_ERROR_EMPTY_ASSET, "NO_STRAND_LEFT", "3 have fewer than two vertices");
  const auto two = load(smallTfx(false).setU32(8, 2));
  EXPECT_EQ(two->result, FLK_SUCCESS);
  EXPECT_EQ(two->finding("TRAILING_BYTES").count, 96u);
}

TEST(TfxReader, Offsets) {
  expectRefusal(smallTfx().setU32(12, 0), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "at byte 12");
  expectRefusal(smallTfx().setU32(16, 159), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "at byte 16");
  expectRefusal(smallTfx().setU32(12, 0xfffffff0u), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END", "from byte 4294967280");
  expectRefusal(smallTfx().setU32(16, 376), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END");
  expectRefusal(smallTfx().setU32(16, 353), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END");
  expectRefusal(smallTfx().setU32(16, 351), FLK_ERROR_MALFORMED, "TFX_BLOCKS_OVERLAP", "run into the strand UVs at byte 351");
  expectRefusal(smallTfx().setU32(24, 352), FLK_ERROR_MALFORMED, "TFX_BLOCKS_OVERLAP");
  // Odd, but all there: read as it says.
  Bytes odd = smallTfx(false);
  odd.bytes.insert(odd.bytes.begin() + 160, 3, 0);
  const auto loaded = load(odd.setU32(12, 163));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->strands().positions[3 * 7 + 1], 0.375f);
  EXPECT_EQ(loaded->finding("TFX_OFFSET_UNALIGNED").count, 1u);
}

TEST(TfxReader, MoreStrandsCountedThanWritten) {
  // AMD's Maya exporter with a start offset: positions of 3 strands, 4 in the header.
  expectRefusal(smallTfx().zeros(64).setU32(4, 4), FLK_ERROR_MALFORMED, "TFX_BLOCKS_OVERLAP", "export it again");
  expectRefusal(smallTfx(false).setU32(4, 4), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END");
}

TEST(TfxReader, Limits) {
  const auto strands = load(smallTfx(), "big.tfx", 2);
  EXPECT_EQ(strands->result, FLK_ERROR_LIMIT);
  EXPECT_EQ(strands->caught.error(), "TFX_TOO_LARGE");
  EXPECT_EQ(load(smallTfx(), "big.tfx", 0, 11)->result, FLK_ERROR_LIMIT);
  EXPECT_EQ(load(smallTfx(), "big.tfx", 3, 12)->result, FLK_SUCCESS);
}

TEST(TfxReader, TrailingBytesAndReservedWords) {
  const auto loaded = load(smallTfx().zeros(5).setU32(36, 7));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->codes(), "TRAILING_BYTES TFX_RESERVED_SET WIDTH_DEFAULTED");
  EXPECT_EQ(loaded->finding("TRAILING_BYTES").count, 5u);
  EXPECT_EQ(loaded->finding("TRAILING_BYTES").byte_offset, 376u);
  EXPECT_EQ(loaded->finding("TFX_RESERVED_SET").byte_offset, 36u);
  EXPECT_NE(loaded->caught.find("TRAILING_BYTES"), nullptr) << "warnings reach the host";
  EXPECT_EQ(loaded->caught.find("WIDTH_DEFAULTED"), nullptr) << "infos do not";
}

TEST(TfxReader, NumbersThatAreNone) {
  Bytes file = smallTfx();
  file.setF32(160 + 64 + 16 * 2 + 4, not_a_number);  // strand 1, vertex 2, y
  file.setF32(160 + 128 + 16 * 3 + 12, -1.0f);       // strand 2, vertex 3, inverse mass
  file.setF32(352 + 16, infinity);                   // strand 2, u
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "POSITION_NOT_FINITE ROOT_UV_NOT_FINITE INVERSE_MASS_INVALID BOTH_ENDS_FIXED WIDTH_DEFAULTED");
  const FlkFinding dropped = loaded->finding("POSITION_NOT_FINITE");
  EXPECT_EQ(dropped.count, 1u);
  EXPECT_EQ(dropped.repaired, 1u);
  EXPECT_EQ(dropped.strands_listed, 1u);
  EXPECT_EQ(dropped.strands[0], 1u);
  EXPECT_EQ(dropped.byte_offset, 160u + 64 + 32);
  const FlkFinding mass = loaded->finding("INVERSE_MASS_INVALID");
  EXPECT_EQ(mass.strands[0], 2u) << "numbered as in the file, not as kept";
  EXPECT_EQ(mass.byte_offset, 160u + 128 + 48 + 12);
  EXPECT_EQ(loaded->finding("ROOT_UV_NOT_FINITE").byte_offset, 352u + 16);
  EXPECT_EQ(loaded->info().strand_count, 2u);
  EXPECT_EQ(loaded->info().strands_in_source, 3u);
  const FlkStrands strands = loaded->strands();
  EXPECT_EQ(strands.positions[3 * 4], 0.5f) << "strand 2 of the file has moved up unchanged";
  EXPECT_EQ(strands.inverse_masses[6], 1.0f);
  EXPECT_EQ(strands.inverse_masses[7], 0.0f);
  EXPECT_EQ(strands.root_uvs[2], 0.0f);
  EXPECT_EQ(strands.root_uvs[3], 0.5f);
}

TEST(Tfx3Reader, ReadsEveryField) {
  const auto loaded = load(smallTfx3());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  const FlkAssetInfo info = loaded->info();
  EXPECT_EQ(info.format, uint32_t{FLK_FORMAT_TFX});
  EXPECT_EQ(info.strand_count, 3u);
  EXPECT_EQ(info.vertex_count, 12u);
  EXPECT_EQ(info.has_radii, 0u);
  EXPECT_EQ(info.has_inverse_masses, 1u) << "implied by the format";
  EXPECT_EQ(loaded->codes(), "INVERSE_MASS_IMPLIED WIDTH_DEFAULTED");
  // Version 4 of the same strands gives the same asset, so that saving gives the same bytes.
  FlkResult result;
  EXPECT_EQ(saved(loaded->asset.get(), FLK_FORMAT_TFX, result), smallTfx().bytes);
  EXPECT_EQ(saved(load(smallTfx3(false))->asset.get(), FLK_FORMAT_TFX, result), smallTfx(false).bytes);
}

TEST(Tfx3Reader, BothEndsFixed) {
  for (const uint64_t flag : {uint64_t{1}, uint64_t{0xffffffffu}}) {
    const auto loaded = load(smallTfx3().setU32(4, 2).setU32(8, 6).setU32(152, 0).setU32(16, flag));
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    const float expected[12] = {0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0};
    EXPECT_EQ(std::memcmp(loaded->strands().inverse_masses, expected, sizeof expected), 0);
  }
  // Strands that are shorter than what is fixed at their ends.
  for (const unsigned vertices : {2u, 3u}) {
    const auto loaded = load(smallTfx3(false).setU32(8, vertices).setU32(16, 1));
    ASSERT_EQ(loaded->result, FLK_SUCCESS);
    for (uint32_t i = 0; i < 3 * vertices; ++i) EXPECT_EQ(loaded->strands().inverse_masses[i], 0.0f);
  }
}

TEST(Tfx3Reader, OptionalBlocks) {
  const struct {
    unsigned field, bytes;
  } fields[] = {{148, 12}, {156, 192}, {160, 12}, {164, 96}};
  Bytes file = smallTfx3().setU32(12, 4);
  file.setU32(148, file.size()).f32s({0.5f, 0.25f, 0.125f});
  for (const auto& [field, bytes] : fields)
    if (field != 148) file.setU32(field, file.size()).zeros(bytes);
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->strands().radii[3], 0.25f);
  EXPECT_EQ(loaded->strands().radii[4], 0.125f);
  EXPECT_EQ(loaded->strands().root_uvs[2], 0.25f);
  EXPECT_EQ(loaded->codes(), "TFX_FOLLOW_STRANDS_IGNORED TFX_VERTEX_UV_IGNORED TFX_VERTEX_COLOR_IGNORED INVERSE_MASS_IMPLIED");
  EXPECT_EQ(loaded->finding("TFX_FOLLOW_STRANDS_IGNORED").count, 4u);
  EXPECT_EQ(loaded->finding("TFX_FOLLOW_STRANDS_IGNORED").byte_offset, 12u);
  for (const auto& [field, bytes] : fields) {
    Bytes shifted = file;
    uint32_t offset = 0;
    std::memcpy(&offset, shifted.bytes.data() + field, 4);
    for (const auto& other : fields) shifted.setU32(other.field, 0);
    expectRefusal(shifted.setU32(field, offset).cut(offset + bytes - 1), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                  "offset field at byte " + std::to_string(field));
    expectRefusal(shifted.setU32(field, 295), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "inside the 296-byte header");
    expectRefusal(shifted.setU32(field, 296), FLK_ERROR_MALFORMED, "TFX_BLOCKS_OVERLAP");
  }
}

TEST(Tfx3Reader, HeaderAndBodyCut) {
  for (const size_t length : {4u, 12u, 160u, 295u})
    expectRefusal(smallTfx3().cut(length), FLK_ERROR_MALFORMED, "TFX_HEADER_TRUNCATED",
                  "the header of a TressFX 3 file is 296 bytes, but the file ends at byte " + std::to_string(length));
  expectRefusal(smallTfx3().cut(400), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                "broken.tfx: positions (offset field at byte 144) need 144 bytes from byte 296 for 3 strands of 4 vertices "
                "(bytes 4 and 8), but the file ends at byte 400: it is truncated, fetch it again");
  expectRefusal(smallTfx3().cut(463), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END",
                "strand UVs (offset field at byte 152) need 24 bytes from byte 440");
  expectRefusal(smallTfx3().setU32(144, 0), FLK_ERROR_MALFORMED, "TFX_OFFSET_IN_HEADER", "at byte 144");
  expectRefusal(smallTfx3().setU32(144, 0xfffffff0u), FLK_ERROR_MALFORMED, "TFX_BLOCK_PAST_END", "from byte 4294967280");
  expectRefusal(smallTfx3().setU32(4, 0), FLK_ERROR_EMPTY_ASSET, "TFX_NO_STRANDS", "0 strands (byte 4)");
  EXPECT_EQ(load(smallTfx3(), "big.tfx", 2)->caught.error(), "TFX_TOO_LARGE");
  EXPECT_EQ(load(smallTfx3(), "big.tfx", 3, 12)->result, FLK_SUCCESS);
}

TEST(Tfx3Reader, ReservedWordsAndTrailingBytes) {
  const auto loaded = load(smallTfx3().zeros(5).setU32(140, 7).setU32(168, 7).setU32(292, 7));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->codes(), "TRAILING_BYTES TFX_RESERVED_SET INVERSE_MASS_IMPLIED WIDTH_DEFAULTED");
  EXPECT_EQ(loaded->finding("TRAILING_BYTES").byte_offset, 464u);
  EXPECT_EQ(loaded->finding("TFX_RESERVED_SET").byte_offset, 140u);
  EXPECT_EQ(loaded->finding("TFX_RESERVED_SET").count, 3u);
}

TEST(Tfx3Reader, NumbersThatAreNone) {
  Bytes file = smallTfx3();
  file.setF32(296 + 48 + 12 * 2 + 4, not_a_number);  // strand 1, vertex 2, y
  file.setF32(440 + 16, infinity);                   // strand 2, u
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "POSITION_NOT_FINITE ROOT_UV_NOT_FINITE INVERSE_MASS_IMPLIED WIDTH_DEFAULTED");
  EXPECT_EQ(loaded->finding("POSITION_NOT_FINITE").byte_offset, 296u + 48 + 24);
  EXPECT_EQ(loaded->finding("ROOT_UV_NOT_FINITE").byte_offset, 456u);
  EXPECT_EQ(loaded->strands().positions[3 * 4], 0.5f) << "strand 2 of the file has moved up unchanged";
}
