#include "asset_kit.h"

#include <limits>

using namespace asset_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

void expectRefusal(const Bytes& file, FlkResult result, const char* id, const std::string& says = "") {
  expectRefused(file, "broken.hair", result, id, says);
}

// Three strands of three points each: no segment array, default 2.
Bytes uniformHair(float default_thickness = 0) { return smallHair(2).setF32(20, default_thickness); }

}  // namespace

TEST(HairReader, ReadsEveryArray) {
  const auto loaded = load(smallHair(63));
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  const FlkAssetInfo info = loaded->info();
  EXPECT_EQ(info.format, uint32_t{FLK_FORMAT_HAIR});
  EXPECT_EQ(info.strand_count, 3u);
  EXPECT_EQ(info.vertex_count, 9u);
  EXPECT_EQ(info.min_vertices_per_strand, 2u);
  EXPECT_EQ(info.max_vertices_per_strand, 4u);
  EXPECT_EQ(info.has_inverse_masses, 0u);
  const FlkStrands strands = loaded->strands();
  EXPECT_EQ(strands.first_vertex[1], 2u);
  EXPECT_EQ(strands.first_vertex[2], 6u);
  EXPECT_EQ(strands.positions[3 * 5], 0.625f) << "an odd number of strands leaves the points 2-byte aligned";
  EXPECT_EQ(strands.positions[3 * 5 + 2], 1.5625f);
  EXPECT_EQ(strands.radii[3], 0.5f * 0.004f) << "thickness is the diameter";
  EXPECT_EQ(strands.root_uvs[0], 0.0f);
  EXPECT_EQ(strands.root_uvs[2], 0.125f) << "of the first point of strand 1, which is point 2";
  EXPECT_EQ(strands.root_uvs[4], 0.375f);
  ASSERT_NE(strands.colors, nullptr);
  EXPECT_EQ(info.has_colors, 1u);
  EXPECT_EQ(strands.colors[3 * 8], 1.0f);
  EXPECT_EQ(strands.colors[3 * 3], 0.375f);
  EXPECT_EQ(strands.colors[3 * 3 + 1], 0.25f);
  EXPECT_EQ(loaded->codes(), "HAIR_TRANSPARENCY_IGNORED");
}

TEST(HairReader, DefaultColourIsNoArray) {
  const auto withDefault = [](unsigned flags, float red, float green, float blue) {
    return load(smallHair(flags).setF32(28, red).setF32(32, green).setF32(36, blue));
  };
  const auto brown = withDefault(7, 0.5f, 0.25f, 0.125f);
  ASSERT_EQ(brown->result, FLK_SUCCESS);
  EXPECT_EQ(brown->strands().colors, nullptr);
  EXPECT_EQ(brown->info().has_colors, 0u);
  EXPECT_EQ(brown->codes(), "HAIR_DEFAULT_COLOR_IGNORED");
  EXPECT_EQ(brown->finding("HAIR_DEFAULT_COLOR_IGNORED").byte_offset, 28u);
  EXPECT_EQ(brown->finding("HAIR_DEFAULT_COLOR_IGNORED").severity, uint32_t{FLK_SEVERITY_INFO});
  EXPECT_EQ(withDefault(7, not_a_number, 0, 0)->codes(), "HAIR_DEFAULT_COLOR_IGNORED");
  for (const float grey : {0.0f, 0.5f, 1.0f}) EXPECT_EQ(withDefault(7, grey, grey, grey)->codes(), "");
  EXPECT_EQ(withDefault(7 | 16, 0.5f, 0.25f, 0.125f)->codes(), "") << "the array says more";
}

TEST(HairReader, ColoursThatAreNone) {
  Bytes file = smallHair(7 | 16);
  const size_t colors = 128 + 6 + 9 * 16;
  file.setF32(colors + 12 * 2 + 4, not_a_number);  // strand 1, its first point
  file.setF32(colors + 12 * 7, -0.25f).setF32(colors + 12 * 7 + 4, 2.0f);
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "COLOR_NOT_FINITE COLOR_OUTSIDE_UNIT");
  EXPECT_EQ(loaded->finding("COLOR_NOT_FINITE").byte_offset, colors + 24);
  EXPECT_EQ(loaded->finding("COLOR_NOT_FINITE").strands[0], 1u);
  EXPECT_EQ(loaded->finding("COLOR_OUTSIDE_UNIT").byte_offset, colors + 84);
  EXPECT_EQ(loaded->finding("COLOR_OUTSIDE_UNIT").count, 1u) << "a vertex counts once";
}

TEST(HairReader, EveryCombinationOfArrays) {
  for (unsigned flags = 2; flags < 64; ++flags) {
    if (!(flags & 2)) continue;
    const Bytes file = smallHair(flags);
    const auto loaded = load(file);
    EXPECT_EQ(loaded->result, FLK_SUCCESS) << flags << " " << loaded->caught.text();
    EXPECT_EQ(loaded->finding("TRAILING_BYTES").count, 0u) << flags;
    EXPECT_EQ(load(file.cut(file.size() - 1))->caught.error(), "HAIR_ARRAY_PAST_END") << flags;
  }
}

TEST(HairReader, DefaultThickness) {
  const auto wide = load(uniformHair(0.25f));
  ASSERT_EQ(wide->result, FLK_SUCCESS);
  EXPECT_EQ(wide->info().has_radii, 1u);
  EXPECT_EQ(wide->strands().radii[8], 0.125f);

  const auto unset = load(uniformHair(0));
  ASSERT_EQ(unset->result, FLK_SUCCESS);
  EXPECT_EQ(unset->codes(), "WIDTH_DEFAULTED");

  for (const float thickness : {-1.0f, not_a_number, infinity}) {
    const auto wrong = load(uniformHair(thickness));
    ASSERT_EQ(wrong->result, FLK_SUCCESS);
    EXPECT_EQ(wrong->codes(), "RADIUS_INVALID WIDTH_DEFAULTED");
    EXPECT_EQ(wrong->finding("RADIUS_INVALID").byte_offset, 20u);
  }
}

TEST(HairReader, DefaultThicknessOfZeroBesideAnArray) {
  const auto loaded = load(smallHair().setF32(20, 0));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->codes(), "HAIR_DEFAULT_THICKNESS_ZERO");
  EXPECT_EQ(loaded->finding("HAIR_DEFAULT_THICKNESS_ZERO").byte_offset, 20u);
  EXPECT_FLOAT_EQ(loaded->strands().radii[8], 0.0045f);
  FlkResult result;
  const std::vector<unsigned char> written = saved(loaded->asset.get(), FLK_FORMAT_HAIR, result);
  float thickness = 0;
  std::memcpy(&thickness, written.data() + 20, 4);
  EXPECT_FLOAT_EQ(thickness, 0.009f) << "our own files do not have it";
}

TEST(HairReader, HeaderCutAndMagic) {
  for (const size_t length : {4u, 127u})
    expectRefusal(smallHair().cut(length), FLK_ERROR_MALFORMED, "HAIR_HEADER_TRUNCATED", "byte " + std::to_string(length));
  expectRefusal(smallHair().cut(0), FLK_ERROR_FORMAT_UNKNOWN, "FILE_EMPTY");
  expectRefusal(smallHair().cut(3), FLK_ERROR_FORMAT_UNKNOWN, "FORMAT_UNKNOWN", "48 41 49 at byte 0");
  for (const char* magic : {"HAIX", "hair", "Hair"}) {
    Bytes file = smallHair();
    std::memcpy(file.bytes.data(), magic, 4);
    expectRefusal(file, FLK_ERROR_FORMAT_UNKNOWN, "FORMAT_UNKNOWN");
  }
}

TEST(HairReader, BodyCut) {
  expectRefusal(smallHair().cut(131), FLK_ERROR_MALFORMED, "HAIR_ARRAY_PAST_END",
                "segment counts (bit 0 of the flags at byte 12) need 6 bytes from byte 128");
  expectRefusal(smallHair().cut(200), FLK_ERROR_MALFORMED, "HAIR_ARRAY_PAST_END",
                "broken.hair: points (bit 1 of the flags at byte 12) need 108 bytes from byte 134 for 9 points (byte 8), but "
                "the file ends at byte 200: it is truncated, fetch it again");
  expectRefusal(smallHair().cut(250), FLK_ERROR_MALFORMED, "HAIR_ARRAY_PAST_END", "thicknesses");
}

TEST(HairReader, ByteSwapped) {
  Bytes file = smallHair();
  for (size_t i = 4; i + 4 <= 40; i += 4) {
    std::swap(file.bytes[i], file.bytes[i + 3]);
    std::swap(file.bytes[i + 1], file.bytes[i + 2]);
  }
  expectRefusal(file, FLK_ERROR_MALFORMED, "HAIR_BYTE_SWAPPED", "byte order");
  std::memcpy(file.bytes.data(), "RIAH", 4);
  expectRefusal(file, FLK_ERROR_MALFORMED, "HAIR_BYTE_SWAPPED", "byte order");
}

TEST(HairReader, HugeCountsAskForNoMemory) {
  const struct {
    uint64_t strands, points, segments;
    unsigned flags;
  } headers[] = {
      {0xffffffffu, 9, 2, 7}, {0x80000001u, 9, 2, 7}, {3, 0xffffffffu, 2, 7}, {3, 0x80000001u, 2, 2},
      {3, 0x15555556u, 2, 2},          // x 12 bytes = 8 in 32 bits
      {0xffffffffu, 9, 0, 2},          // more strands than points
      {3, 9, 0xffffffffu, 2},          // segments + 1 = 0 in 32 bits
      {0xffffffffu, 9, 0xffffffffu, 2},
  };
  for (const auto& header : headers) {
    Bytes file = smallHair(header.flags);
    file.setU32(4, header.strands).setU32(8, header.points).setU32(16, header.segments);
    CountingAllocator counter;
    const FlkHostAllocator allocator = counter.callbacks();
    FlkAssetOptions options{};
    options.type = FLK_TYPE_ASSET_OPTIONS;
    options.allocator = &allocator;
    FlkAsset asset = nullptr;
    EXPECT_EQ(flkAssetLoadMemory(file.bytes.data(), file.size(), &options, &asset), FLK_ERROR_MALFORMED);
    EXPECT_LT(counter.largest, 8192u);
    EXPECT_EQ(counter.live, 0u);
    EXPECT_EQ(load(file)->result, FLK_ERROR_MALFORMED);
  }
}

TEST(HairReader, SegmentsDisagreeWithPoints) {
  Bytes more = smallHair();
  more.bytes[128] = 2;
  expectRefusal(more, FLK_ERROR_MALFORMED, "HAIR_SEGMENTS_DISAGREE", "make 10 points of 3 strands (byte 4)");
  expectRefusal(uniformHair().setU32(16, 3), FLK_ERROR_MALFORMED, "HAIR_SEGMENTS_DISAGREE", "default at byte 16");
  expectRefusal(uniformHair().setU32(16, 1), FLK_ERROR_MALFORMED, "HAIR_SEGMENTS_DISAGREE");

  Bytes fewer = smallHair();
  fewer.bytes[132] = 1;
  const auto loaded = load(fewer);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().vertex_count, 8u);
  EXPECT_EQ(loaded->strands().radii[7], 0.004f) << "the array behind the points is found by the header's count";
  EXPECT_EQ(loaded->finding("HAIR_POINTS_UNUSED").count, 1u);
  EXPECT_EQ(loaded->finding("HAIR_POINTS_UNUSED").byte_offset, 134u + 8 * 12);
}

TEST(HairReader, StrandsOfOnePointAreDropped) {
  Bytes file = smallHair();
  file.bytes[128] = 0;  // strand 0 keeps one point, the other strands begin one point earlier
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().strand_count, 2u);
  EXPECT_EQ(loaded->strands().positions[0], 0.125f);
  EXPECT_EQ(loaded->strands().radii[0], 0.001f);
  const FlkFinding finding = loaded->finding("STRAND_TOO_SHORT");
  EXPECT_EQ(finding.count, 1u);
  EXPECT_EQ(finding.strands[0], 0u);
  EXPECT_EQ(finding.byte_offset, 134u);

  Bytes all = smallHair();
  all.bytes[128] = all.bytes[130] = all.bytes[132] = 0;
  expectRefusal(all, FLK_ERROR_EMPTY_ASSET, "NO_STRAND_LEFT", "3 have fewer than two vertices");
  expectRefusal(smallHair(2).setU32(8, 3).setU32(16, 0), FLK_ERROR_EMPTY_ASSET, "NO_STRAND_LEFT");
}

TEST(HairReader, ZeroCountsAndMissingPoints) {
  expectRefusal(smallHair().setU32(4, 0), FLK_ERROR_EMPTY_ASSET, "HAIR_NO_STRANDS", "0 strands (byte 4)");
  expectRefusal(smallHair().setU32(8, 0), FLK_ERROR_EMPTY_ASSET, "HAIR_NO_STRANDS", "0 points (byte 8)");
  for (const unsigned flags : {0u, 1u, 4u, 0x3du, 0xfffffffdu})
    expectRefusal(smallHair().setU32(12, flags), FLK_ERROR_MALFORMED, "HAIR_NO_POINTS", "byte 12");
}

TEST(HairReader, ReservedBitsAndTrailingBytes) {
  const auto loaded = load(smallHair().zeros(3).setU32(12, 7 | 0x40));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->codes(), "HAIR_FLAGS_RESERVED TRAILING_BYTES");
  EXPECT_EQ(loaded->finding("HAIR_FLAGS_RESERVED").byte_offset, 12u);
  EXPECT_EQ(loaded->finding("TRAILING_BYTES").byte_offset, smallHair().size());
}

TEST(HairReader, Limits) {
  EXPECT_EQ(load(smallHair(), "big.hair", 2)->caught.error(), "HAIR_TOO_LARGE");
  EXPECT_EQ(load(smallHair(), "big.hair", 0, 8)->result, FLK_ERROR_LIMIT);
  EXPECT_EQ(load(smallHair(), "big.hair", 3, 9)->result, FLK_SUCCESS);
}

TEST(HairReader, NumbersThatAreNone) {
  const size_t points = 134, thicknesses = points + 108;
  Bytes file = smallHair();
  file.setF32(points + 12 * 3, infinity);         // strand 1
  file.setF32(thicknesses + 4 * 4, -1);           // strand 1, which is dropped: no finding
  file.setF32(thicknesses + 4 * 7, not_a_number); // strand 2
  file.setF32(thicknesses + 4 * 8, -0.5f);
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "POSITION_NOT_FINITE RADIUS_INVALID");
  EXPECT_EQ(loaded->finding("POSITION_NOT_FINITE").byte_offset, points + 36);
  const FlkFinding radius = loaded->finding("RADIUS_INVALID");
  EXPECT_EQ(radius.count, 2u);
  EXPECT_EQ(radius.strands_listed, 1u);
  EXPECT_EQ(radius.strands[0], 2u);
  EXPECT_EQ(radius.byte_offset, thicknesses + 28);
  const FlkAssetInfo kept = loaded->info();
  EXPECT_FLOAT_EQ(loaded->strands().radii[3], 0.5f * (kept.max_bounds[2] - kept.min_bounds[2]) / 1000) << "the default of what is left";
}
