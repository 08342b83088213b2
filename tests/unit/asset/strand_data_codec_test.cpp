// USC-HairSalon and CT2Hair: counts and points, nothing else.
#include "asset_kit.h"

#include <limits>

using namespace asset_test;

TEST(StrandData, TellsPointsOfTwelveAndTwentyEightBytes) {
  for (const int floats : {3, 7}) {
    const auto loaded = load(smallStrandData(floats));
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    EXPECT_EQ(loaded->info().format, uint32_t{FLK_FORMAT_STRAND_DATA});
    EXPECT_EQ(loaded->info().strands_in_source, 3u);
    const FlkStrands strands = loaded->strands();
    ASSERT_EQ(strands.strand_count, 2u) << "one is a root without hair";
    ASSERT_EQ(strands.vertex_count, 5u);
    EXPECT_EQ(strands.positions[0], 0.125f);
    EXPECT_EQ(strands.positions[3], 0.125f * static_cast<float>(floats + 1));
    EXPECT_EQ(strands.positions[6], 0.125f * static_cast<float>(3 * floats + 1));
    EXPECT_EQ(loaded->codes(), floats == 3 ? "STRAND_ROOT_ONLY WIDTH_DEFAULTED" : "STRAND_ROOT_ONLY DATA_VALUES_IGNORED WIDTH_DEFAULTED");
    EXPECT_EQ(loaded->finding("STRAND_ROOT_ONLY").strands[0], 1u);
    EXPECT_EQ(loaded->finding("STRAND_ROOT_ONLY").byte_offset, 4u + 4 + 2 * 4 * uint64_t(floats) + 4);
    EXPECT_TRUE(loaded->caught.all.empty()) << "no warning";
  }
}

TEST(StrandData, DefectsAreFound) {
  Bytes file = smallStrandData();
  file.setF32(4 + 4 + 24 + 4 + 12 + 4, std::numeric_limits<float>::quiet_NaN()).zeros(5);
  const auto loaded = load(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->finding("POSITION_NOT_FINITE").byte_offset, 52u);
  EXPECT_EQ(loaded->finding("TRAILING_BYTES").count, 5u);
}

TEST(StrandData, Refusals) {
  const auto cut = load(smallStrandData().cut(60), "cut.data");
  EXPECT_EQ(cut->result, FLK_ERROR_MALFORMED);
  EXPECT_EQ(cut->caught.error(), "DATA_COUNT_PAST_END");
  EXPECT_NE(cut->caught.text().find("strand 2 has 3 points"), std::string::npos) << cut->caught.text();
  EXPECT_EQ(load(smallStrandData().setU32(4 + 4 + 24, 0x80000001u))->caught.error(), "DATA_COUNT_PAST_END");
  EXPECT_EQ(load(smallStrandData().setU32(4 + 4 + 24, 0x7fffffffu))->caught.error(), "DATA_COUNT_PAST_END");
  EXPECT_EQ(load(smallStrandData(), "many", 2)->caught.error(), "DATA_TOO_LARGE");
  EXPECT_EQ(load(smallStrandData(), "long", 0, 5)->caught.error(), "DATA_TOO_LARGE");
  Bytes bald;
  bald.u32(2).u32(1).f32s({0, 0, 0}).u32(1).f32s({0, 0, 0});
  EXPECT_EQ(load(bald)->result, FLK_ERROR_EMPTY_ASSET);
}
