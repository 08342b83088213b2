// .tfxbone: names and weights, and what is odd about them.
#include "rig_kit.h"

#include <limits>

using namespace asset_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr size_t strands_at = 45, records_at = 49;  // of smallTfxbone()

Bytes small() {
  Bytes file;
  file.bytes = smallTfxbone();
  return file;
}

size_t boneAt(size_t record, size_t i) { return records_at + record * 36 + 4 + i * 8; }
size_t weightAt(size_t record, size_t i) { return boneAt(record, i) + 4; }

// Bones of these names (with what the file has for NUL and length), and one strand on the first.
Bytes named(const std::vector<std::string>& names) {
  Bytes file;
  file.u32(names.size());
  for (size_t i = 0; i < names.size(); ++i) file.u32(i).u32(names[i].size()).text(names[i]);
  file.u32(1).u32(0).u32(0).f32(1);
  return file.zeros(24);
}

const std::string nul(1, '\0');

}  // namespace

TEST(Skin, ReadsNamesBonesAndWeights) {
  const auto loaded = loadRig(small());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  const FlkRigInfo info = loaded->info();
  EXPECT_EQ(info.kind, uint32_t{FLK_RIG_SKIN});
  EXPECT_EQ(info.bone_count, 3u);
  EXPECT_EQ(info.record_count, 3u);
  EXPECT_EQ(info.records_in_source, 3u);
  EXPECT_EQ(info.unattached_count, 0u);
  EXPECT_STREQ(loaded->arrays().bone_names[0], "root");
  EXPECT_STREQ(loaded->arrays().bone_names[2], "ns:jaw") << "namespaces are part of the name";
  EXPECT_EQ(loaded->bones(1), (std::vector<uint32_t>{1, 2, 0, 0}));
  EXPECT_EQ(loaded->weights(1), (std::vector<float>{0.5f, 0.25f, 0.25f, 0}));
  EXPECT_EQ(loaded->codes(), "SKIN_RECORDS_UNALIGNED");
  EXPECT_EQ(loaded->finding("SKIN_RECORDS_UNALIGNED").byte_offset, records_at);
  EXPECT_EQ(loaded->finding("SKIN_RECORDS_UNALIGNED").severity, uint32_t{FLK_SEVERITY_INFO});
  EXPECT_TRUE(loaded->caught.all.empty()) << "infos are listed, not told";
}

TEST(Skin, PlaceholdersAndBonesThatAreNot) {
  Bytes file = small();
  file.setU32(boneAt(0, 1), 0xffffffffu).setU32(boneAt(0, 2), 0xffffffffu);  // -1 without weight
  file.setU32(boneAt(1, 1), 3);                                              // past the table, weight 0.25
  file.setU32(boneAt(2, 1), 0xffffffffu);                                    // -1 with weight 0.25
  const auto loaded = loadRig(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "BONE_OUT_OF_RANGE BONE_PLACEHOLDER SKIN_RECORDS_UNALIGNED");
  EXPECT_EQ(loaded->finding("BONE_PLACEHOLDER").count, 2u);
  EXPECT_EQ(loaded->finding("BONE_PLACEHOLDER").byte_offset, records_at);
  const FlkFinding lost = loaded->finding("BONE_OUT_OF_RANGE");
  EXPECT_EQ(lost.count, 2u);
  EXPECT_EQ(lost.strands[0], 1u);
  EXPECT_EQ(lost.strands[1], 2u);
  EXPECT_EQ(lost.byte_offset, records_at + 36);
  EXPECT_NE(std::string(lost.text).find("the first in strand 1 at byte 85"), std::string::npos) << lost.text;
  const std::vector<float> weights = loaded->weights(1);
  EXPECT_FLOAT_EQ(weights[0], 0.5f / 0.75f) << "the others take its share";
  EXPECT_EQ(weights[1], 0.0f);
  EXPECT_EQ(loaded->bones(1)[1], 0u);
  EXPECT_EQ(loaded->weights(2)[0], 1.0f);
  EXPECT_EQ(loadRig(small().setU32(boneAt(0, 3), 0x7fffffffu))->finding("BONE_OUT_OF_RANGE").count, 1u);
}

TEST(Skin, WeightsThatAreNone) {
  Bytes file = small();
  file.setF32(weightAt(0, 1), -0.5f).setF32(weightAt(1, 2), not_a_number).setF32(weightAt(2, 0), infinity);
  const auto loaded = loadRig(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "WEIGHT_INVALID SKIN_RECORDS_UNALIGNED") << "sums are those of what was lost";
  EXPECT_EQ(loaded->finding("WEIGHT_INVALID").count, 3u);
  EXPECT_EQ(loaded->finding("WEIGHT_INVALID").strands_listed, 3u);
  EXPECT_EQ(loaded->weights(0), (std::vector<float>{1, 0, 0, 0}));
  EXPECT_FLOAT_EQ(loaded->weights(1)[0], 2.0f / 3);
  EXPECT_EQ(loaded->weights(2), (std::vector<float>{0, 1, 0, 0}));
  EXPECT_EQ(loaded->bones(2), (std::vector<uint32_t>{2, 1, 0, 0})) << "the bones are those of the file";
}

TEST(Skin, SumsThatAreNotOne) {
  Bytes file = small();
  file.setF32(weightAt(0, 0), 0.8f).setF32(weightAt(1, 0), 0.4f).setF32(weightAt(2, 0), 0.0f).setF32(weightAt(2, 1), 0.0f);
  const auto loaded = loadRig(file);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes(), "WEIGHTS_ALL_ZERO WEIGHTS_NOT_NORMALISED SKIN_RECORDS_UNALIGNED");
  const FlkFinding scaled = loaded->finding("WEIGHTS_NOT_NORMALISED");
  EXPECT_EQ(scaled.count, 2u);
  EXPECT_EQ(scaled.repaired, 1u);
  EXPECT_NE(std::string(scaled.text).find("2 of 3 strands do not make 1, the worst make 0.8 (number 0)"), std::string::npos) << scaled.text;
  EXPECT_EQ(loaded->weights(0), (std::vector<float>{1, 0, 0, 0}));
  EXPECT_EQ(loaded->weights(2), (std::vector<float>(4, 0.0f)));
  EXPECT_EQ(loaded->info().unattached_count, 1u);
  EXPECT_EQ(loaded->finding("WEIGHTS_ALL_ZERO").strands[0], 2u);
  // Within the tolerance nothing is touched; far outside of it everything is scaled.
  const float near = 1.000005f;
  EXPECT_EQ(loadRig(small().setF32(weightAt(0, 0), near))->weights(0)[0], near);
  EXPECT_EQ(loadRig(small().setF32(weightAt(0, 0), 3e38f))->weights(0)[0], 1.0f);
  EXPECT_EQ(loadRig(small().setF32(weightAt(0, 0), 1e-45f))->weights(0)[0], 1.0f);
  EXPECT_EQ(loadRig(small().setF32(weightAt(0, 0), -0.0f))->finding("WEIGHTS_ALL_ZERO").count, 1u) << "-0 is 0";
}

TEST(Skin, Names) {
  const std::string longest(499, 'x');
  const auto loaded = loadRig(named({"a" + nul, "b" + nul, "a" + nul, nul, longest + nul, "kopf\xc3\xbc" + nul, "b" + nul, "b" + nul, "", "\xff\xfe" + nul}));
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->finding("BONE_NAME_EMPTY").count, 2u);
  EXPECT_EQ(loaded->finding("BONE_NAME_EMPTY").strands[0], 3u);
  EXPECT_NE(std::string(loaded->finding("BONE_NAME_EMPTY").text).find("the first in bone 3"), std::string::npos);
  const FlkFinding twice = loaded->finding("BONE_NAME_DUPLICATE");
  EXPECT_EQ(twice.count, 3u);
  EXPECT_EQ(std::vector<uint32_t>(twice.strands, twice.strands + twice.strands_listed), (std::vector<uint32_t>{2, 6, 7}));
  EXPECT_NE(std::string(twice.text).find("\"a\" (bone 2 after bone 0)"), std::string::npos) << twice.text;
  EXPECT_EQ(loaded->finding("BONE_NAME_LONG").strands[0], 4u);
  EXPECT_EQ(loaded->arrays().bone_names[4], longest);
  EXPECT_EQ(loaded->arrays().bone_names[5], std::string("kopf\xc3\xbc"));
  EXPECT_EQ(loaded->arrays().bone_names[9], std::string("\xff\xfe")) << "bytes are kept, whatever they are";
  EXPECT_EQ(loadRig(named({std::string(127, 'x') + nul}))->finding("BONE_NAME_LONG").count, 0u);
  EXPECT_EQ(loadRig(named({std::string(128, 'x') + nul}))->finding("BONE_NAME_LONG").count, 1u);
}

TEST(Skin, NamesWithoutTheirNul) {
  const auto loaded = loadRig(named({"root", "ne" + nul + "ck" + nul, "jaw" + nul}));
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_STREQ(loaded->arrays().bone_names[0], "root");
  EXPECT_STREQ(loaded->arrays().bone_names[1], "ne");
  EXPECT_STREQ(loaded->arrays().bone_names[2], "jaw");
  EXPECT_EQ(loaded->finding("BONE_NAME_UNTERMINATED").byte_offset, 12u);
  EXPECT_EQ(loaded->finding("BONE_NAME_CUT").strands[0], 1u);
  EXPECT_EQ(loaded->finding("BONE_NAME_CUT").byte_offset, 26u);
}

TEST(Skin, NumbersOutOfOrder) {
  const auto loaded = loadRig(small().setU32(4, 9).setU32(records_at + 36, 2).setU32(records_at + 72, 1));
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->finding("RIG_INDEX_UNEXPECTED").count, 3u);
  EXPECT_EQ(loaded->finding("RIG_INDEX_UNEXPECTED").byte_offset, 4u);
  EXPECT_EQ(loaded->bones(1), (std::vector<uint32_t>{1, 2, 0, 0})) << "the order of the file counts";
}

TEST(Skin, Refusals) {
  for (const size_t length : {1u, 2u, 3u})
    expectRigRefused(small().cut(length), FLK_ERROR_MALFORMED, "BONE_TABLE_PAST_END", "ends too early at byte " + std::to_string(length));
  expectRigRefused(Bytes(), FLK_ERROR_FORMAT_UNKNOWN, "FILE_EMPTY", "empty");
  for (const uint64_t count : {0xffffffffu, 0x80000001u, 0x7fffffffu, 0x20000001u})
    expectRigRefused(small().setU32(0, count), FLK_ERROR_MALFORMED, "BONE_TABLE_PAST_END", "(byte 0: " + std::to_string(static_cast<int32_t>(count)) + " bones");
  expectRigRefused(small().setU32(0, 0), FLK_ERROR_EMPTY_ASSET, "RIG_NO_BONES", "0 bones (byte 0)");
  for (const uint64_t length : {0xffffffffu, 0x7fffffffu, 0x80000000u, 150u})
    expectRigRefused(small().setU32(8, length), FLK_ERROR_MALFORMED, "BONE_NAME_PAST_END",
                     "bone 0 of 3 (byte 4) has a name of " + std::to_string(static_cast<int32_t>(length)) + " bytes (byte 8)");
  expectRigRefused(small().cut(14), FLK_ERROR_MALFORMED, "BONE_TABLE_PAST_END", "byte 14");
  expectRigRefused(small().cut(40), FLK_ERROR_MALFORMED, "BONE_NAME_PAST_END", "bone 2 of 3 (byte 30) has a name of 7 bytes (byte 34), but the file ends at byte 40");
  expectRigRefused(small().cut(47), FLK_ERROR_MALFORMED, "SKIN_PAST_END", "(byte 45)");
  expectRigRefused(small().cut(100), FLK_ERROR_MALFORMED, "SKIN_PAST_END", "3 strands (byte 45) of 36 bytes, but the file ends at byte 100");
  for (const uint64_t count : {0xffffffffu, 0x80000001u, 0x7fffffffu, 0x071c71c8u, 4u})  // x 36 bytes = 32 in 32 bits
    expectRigRefused(small().setU32(strands_at, count), FLK_ERROR_MALFORMED, "SKIN_PAST_END",
                     "counts " + std::to_string(static_cast<int32_t>(count)) + " strands (byte 45)");
  expectRigRefused(small().setU32(strands_at, 0), FLK_ERROR_EMPTY_ASSET, "RIG_NO_RECORDS", "0 strands (byte 45)");
  EXPECT_EQ(loadRig(small(), nullptr, 2)->caught.error(), "RIG_TOO_LARGE");
  EXPECT_EQ(loadRig(small(), nullptr, 3, 2)->caught.error(), "RIG_TOO_LARGE");
  EXPECT_EQ(loadRig(small(), nullptr, 3, 3)->result, FLK_SUCCESS);
  EXPECT_EQ(loadRig(small().setU32(strands_at, 2))->finding("TRAILING_BYTES").count, 36u);
  EXPECT_EQ(loadRig(small().zeros(5))->finding("TRAILING_BYTES").byte_offset, small().size());
}

TEST(Skin, HugeCountsAskForNoMemory) {
  for (const auto& [at, value] : {std::pair<size_t, uint64_t>{0, 0x7fffffffu}, {8, 0x7fffffffu}, {strands_at, 0x071c71c8u}, {strands_at, 0x7fffffffu}}) {
    CountingAllocator counter;
    const FlkHostAllocator allocator = counter.callbacks();
    FlkRigOptions options{};
    options.type = FLK_TYPE_RIG_OPTIONS;
    options.allocator = &allocator;
    FlkRig rig = nullptr;
    const Bytes file = small().setU32(at, value);
    EXPECT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, &rig), FLK_ERROR_MALFORMED);
    EXPECT_LT(counter.largest, 8192u);
    EXPECT_EQ(counter.live, 0u);
  }
}

TEST(Skin, IsFittedToItsHair) {
  const auto hair = load(smallTfx());
  const auto same = loadRig(small(), hair->asset.get());
  EXPECT_EQ(same->codes(), "SKIN_RECORDS_UNALIGNED");
  EXPECT_EQ(same->info().record_count, 3u);

  const auto fewer = load(smallTfx(false).setU32(4, 2));
  const auto surplus = loadRig(small(), fewer->asset.get());
  ASSERT_EQ(surplus->result, FLK_SUCCESS);
  EXPECT_EQ(surplus->info().record_count, 2u);
  EXPECT_EQ(surplus->info().records_in_source, 3u);
  EXPECT_EQ(surplus->finding("SKIN_STRANDS_SURPLUS").count, 1u);
  EXPECT_EQ(surplus->finding("SKIN_STRANDS_SURPLUS").strands[0], 2u);
  EXPECT_NE(std::string(surplus->finding("SKIN_STRANDS_SURPLUS").text).find("for 3 strands, but the hair has 2"), std::string::npos);

  const auto missing = loadRig(small().setU32(strands_at, 1).cut(records_at + 36), hair->asset.get());
  ASSERT_EQ(missing->result, FLK_SUCCESS);
  EXPECT_EQ(missing->info().record_count, 3u);
  EXPECT_EQ(missing->info().unattached_count, 2u);
  EXPECT_EQ(missing->finding("SKIN_STRANDS_MISSING").count, 2u);
  EXPECT_EQ(missing->weights(0)[0], 1.0f);

  const auto gap = load(smallTfx().setF32(160 + 64, not_a_number));
  ASSERT_EQ(gap->info().strand_count, 2u);
  const auto moved = loadRig(small(), gap->asset.get());
  ASSERT_EQ(moved->result, FLK_SUCCESS);
  EXPECT_EQ(moved->info().record_count, 2u);
  EXPECT_EQ(moved->finding("SKIN_STRANDS_DROPPED").strands[0], 1u);
  EXPECT_EQ(moved->bones(1), (std::vector<uint32_t>{2, 1, 0, 0})) << "of strand 2 of the file, which is strand 1 of the asset";
}

TEST(Skin, EachLoaderKnowsTheOthersFiles) {
  const struct {
    Bytes file;
    const char* says;
  } hairs[] = {{smallTfx(), "TressFX hair (.tfx)"}, {smallTfx3(), "TressFX hair (.tfx)"}, {smallHair(), ".hair"}, {smallStrandData(), "USC-HairSalon"},
               {Bytes().text(smallTfxText()), "as text"}, {Bytes().text(smallPlyText()), "PLY"}};
  for (const auto& hair : hairs) expectRigRefused(hair.file, FLK_ERROR_FORMAT_UNKNOWN, "STRANDS_NOT_RIG", hair.says);
  expectRefused(small(), "rig", FLK_ERROR_FORMAT_UNKNOWN, "RIG_NOT_STRANDS", "give the .tfx beside it");
  // Known by its structure where its first bytes could be strands as well.
  expectRefused(small().setU32(4, 1).setU32(8, 5).setU32(12, 0), "rig", FLK_ERROR_FORMAT_UNKNOWN, "RIG_NOT_STRANDS", "flkRigLoadFile");
  expectRefused(Bytes().text(smallTfxmesh()), "rig", FLK_ERROR_FORMAT_UNKNOWN, "RIG_NOT_STRANDS", ".tfxmesh");
  expectRigRefused(Bytes().text("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n"), FLK_ERROR_FORMAT_UNKNOWN, "GIT_LFS_POINTER", "git lfs pull");
  expectRigRefused(Bytes().text("<!DOCTYPE html>\n"), FLK_ERROR_FORMAT_UNKNOWN, "HTML_PAGE", "web page");
  expectRigRefused(Bytes().text("prose that goes on\n"), FLK_ERROR_FORMAT_UNKNOWN, "FORMAT_UNKNOWN", "numOfBones");
}
