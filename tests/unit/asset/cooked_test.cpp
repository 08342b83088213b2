// The cooked cache: everything comes back bit for bit, damage is named, and a file whose checksums were made to match is not believed.
#include "../../fuzz/cooked_seal.h"
#include "asset/checksum.h"
#include "asset_kit.h"

#include <algorithm>
#include <cstddef>
#include <limits>

using namespace asset_test;

namespace {

Bytes cook(FlkAsset asset) {
  FlkResult result;
  Bytes file;
  file.bytes = saved(asset, FLK_FORMAT_COOKED, result);
  EXPECT_EQ(result, FLK_SUCCESS);
  return file;
}

// A file with something wrong in each of several ways: a NaN strand, one of no length, widths, colours and UVs that must be replaced.
Bytes defectiveHair() {
  Bytes file;
  file.text("HAIR").u32(5).u32(10).u32(55).u32(0).f32s({0.001f, 0, 1, 1, 1}).text("by hand").zeros(81);
  for (int strand = 0; strand < 5; ++strand) file.u16(1);
  for (int point = 0; point < 10; ++point) file.f32s({point / 2 == 3 ? 0.5f : 0.25f * static_cast<float>(point), 30, -0.0f});
  file.setU32(128 + 10 + 12, 0x7fc00000u);
  for (int point = 0; point < 10; ++point) file.f32(point == 5 ? -1.0f : 0.001f);
  for (int point = 0; point < 10; ++point) file.f32s({0.5f, point == 9 ? 2.0f : 0.25f, 1});
  for (int point = 0; point < 10; ++point) file.f32s({2, 0.5f});
  return file;
}

Bytes cookedOf(const Bytes& source) { return cook(load(source)->asset.get()); }

void expectSame(const Loaded& a, const Loaded& b, const char* name) {
  SCOPED_TRACE(name);
  const FlkAssetInfo x = a.info(), y = b.info();
  EXPECT_EQ(y.format, uint32_t{FLK_FORMAT_COOKED});
  EXPECT_EQ(y.source_format, x.source_format);
  // From the counts to the radii.
  constexpr size_t begin = offsetof(FlkAssetInfo, strand_count), end = offsetof(FlkAssetInfo, bytes_host);
  EXPECT_EQ(std::memcmp(reinterpret_cast<const char*>(&x) + begin, reinterpret_cast<const char*>(&y) + begin, end - begin), 0);
  const FlkStrands p = a.strands(), q = b.strands();
  const size_t strands = p.strand_count, vertices = p.vertex_count;
  ASSERT_EQ(q.vertex_count, p.vertex_count);
  EXPECT_EQ(std::memcmp(p.first_vertex, q.first_vertex, (strands + 1) * 4), 0);
  const auto same = [](const float* one, const float* other, size_t count) {
    return one && other ? std::memcmp(one, other, count * 4) == 0 : one == other;
  };
  EXPECT_TRUE(same(p.positions, q.positions, vertices * 3));
  EXPECT_TRUE(same(p.radii, q.radii, vertices));
  EXPECT_TRUE(same(p.root_uvs, q.root_uvs, strands * 2));
  EXPECT_TRUE(same(p.inverse_masses, q.inverse_masses, vertices));
  EXPECT_TRUE(same(p.colors, q.colors, vertices * 3));
  ASSERT_EQ(x.finding_count, y.finding_count);
  for (uint32_t i = 0; i < x.finding_count; ++i) {
    FlkFinding f, g;
    flkAssetGetFinding(a.asset.get(), i, &f);
    flkAssetGetFinding(b.asset.get(), i, &g);
    EXPECT_STREQ(f.code, g.code);
    EXPECT_EQ(f.severity, g.severity);
    EXPECT_EQ(f.repaired, g.repaired);
    EXPECT_EQ(f.count, g.count);
    EXPECT_EQ(f.strands_listed, g.strands_listed);
    EXPECT_EQ(std::memcmp(f.strands, g.strands, sizeof f.strands), 0);
    EXPECT_EQ(g.byte_offset, UINT64_MAX) << "a byte of the source is none of this file";
    std::string text = f.text;
    for (const char* where : {" at byte ", ", from byte "}) {
      const std::string named = where + std::to_string(f.byte_offset) + ")";
      if (const size_t at = text.find(named); at != std::string::npos && f.byte_offset != UINT64_MAX) text.erase(at, named.size() - 1);
    }
    EXPECT_EQ(g.text, text);
    EXPECT_EQ(text.find(" byte "), std::string::npos) << text;
  }
}

struct Source {
  const char* name;
  Bytes bytes;
};

std::vector<Source> sources() {
  return {{"smallest", smallHair(2)},   {"hair", smallHair(63)},      {"tfx", smallTfx()},
          {"tfx 3", smallTfx3()},       {"data", smallStrandData(7)}, {"text", Bytes().text(smallTfxText())},
          {"ply", Bytes().text(smallPlyText())}, {"defective", defectiveHair()}};
}

// Refused with `id`, after the checksums were made to match.
void expectRefusedSealed(Bytes file, const char* id, const std::string& says, FlkResult result = FLK_ERROR_MALFORMED) {
  sealCooked(file.bytes);
  expectRefused(file, "bad.flk", result, id, says);
}

uint64_t blockOffset(const Bytes& file, size_t block) { return littleEndian(&file.bytes[128 + block * 24], 8); }

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST(Cooked, EverythingComesBack) {
  for (const Source& source : sources()) {
    const auto loaded = load(source.bytes);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << source.name << loaded->caught.text();
    const auto again = load(cook(loaded->asset.get()));
    ASSERT_EQ(again->result, FLK_SUCCESS) << source.name << again->caught.text();
    expectSame(*loaded, *again, source.name);
    EXPECT_EQ(loaded->caught.all.size(), again->caught.all.size()) << "warnings of the source are said again";
  }
  const auto defective = load(cookedOf(defectiveHair()));
  EXPECT_EQ(defective->info().strands_in_source, 5u);
  EXPECT_EQ(defective->info().strand_count, 3u);
  EXPECT_EQ(defective->codes(), "POSITION_NOT_FINITE STRAND_ZERO_LENGTH RADIUS_INVALID COLOR_OUTSIDE_UNIT UNIT_SUSPECT ROOT_UV_OUTSIDE_UNIT");
  EXPECT_EQ(defective->finding("STRAND_ZERO_LENGTH").strands[0], 3u) << "numbered as in the source";
}

TEST(Cooked, TheSameAssetGivesTheSameBytes) {
  for (const Source& source : sources()) {
    const Bytes first = cookedOf(source.bytes);
    EXPECT_EQ(cook(load(source.bytes, "another name")->asset.get()).bytes, first.bytes);
    EXPECT_EQ(cookedOf(first).bytes, first.bytes) << "a cooked file cooked again";
    Bytes sealed = first;
    sealCooked(sealed.bytes);
    EXPECT_EQ(sealed.bytes, first.bytes) << "checksums are those of the description";
    for (size_t block = 0; block < 7; ++block) EXPECT_EQ(blockOffset(first, block) % 64, 0u);
  }
}

TEST(Cooked, ArraysOfAProgram) {
  const uint32_t first_vertex[] = {0, 2, 5};
  const float positions[15] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0};
  const FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 2, 5, first_vertex, positions, nullptr, nullptr, nullptr, nullptr};
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&strands, nullptr, &asset), FLK_SUCCESS);
  const auto again = load(cook(asset));
  flkAssetDestroy(asset);
  ASSERT_EQ(again->result, FLK_SUCCESS);
  EXPECT_EQ(again->info().source_format, uint32_t{FLK_FORMAT_UNKNOWN});
  EXPECT_EQ(again->info().has_radii, 0u) << "a default width stays a default";
  EXPECT_EQ(again->codes(), "WIDTH_DEFAULTED");
}

TEST(Cooked, ChecksumIsXxh64) {
  const struct {
    const char* text;
    uint64_t sum;
  } known[] = {{"", 0xef46db3751d8e999}, {"a", 0xd24ec4f1a98c6e5b}, {"abc", 0x44bc2cf5ad770999}, {"Nobody inspects the spammish repetition", 0xfbcea83c8a378bf1}};
  for (const auto& each : known) {
    const std::string text = each.text;
    EXPECT_EQ(xxh64(reinterpret_cast<const unsigned char*>(text.data()), text.size()), each.sum) << text;
    EXPECT_EQ(forelock::Checksum::of(std::as_bytes(std::span(text))), each.sum) << text;
  }
}

TEST(Cooked, EveryTruncationIsNamed) {
  for (const Bytes& file : {cookedOf(smallHair(2)), cookedOf(defectiveHair())}) {
    for (size_t length = 8; length < file.size(); ++length) {
      const auto loaded = load(file.cut(length), "cut.flk");
      EXPECT_EQ(loaded->result, FLK_ERROR_MALFORMED);
      EXPECT_EQ(loaded->caught.error(), length < 320 ? "COOKED_HEADER_TRUNCATED" : "COOKED_SIZE");
      EXPECT_NE(loaded->caught.text().find("truncated"), std::string::npos) << loaded->caught.text();
    }
    Bytes longer = file;
    expectRefused(longer.zeros(1), "long.flk", FLK_ERROR_MALFORMED, "COOKED_SIZE", "cook it again");
  }
}

TEST(Cooked, EveryChangedByteIsNoticed) {
  for (const Bytes& file : {cookedOf(smallHair(63)), cookedOf(defectiveHair())}) {
    ASSERT_LE(file.size(), 2048u);
    for (size_t at = 0; at < file.size(); ++at)
      for (const int change : {0x01, 0x80, 0xff}) {
        Bytes damaged = file;
        damaged.bytes[at] = static_cast<unsigned char>(damaged.bytes[at] ^ change);
        const auto loaded = load(damaged, "damaged.flk");
        EXPECT_NE(loaded->result, FLK_SUCCESS) << at;
        if (HasFailure()) return;
      }
  }
}

// load() holds whatever is accepted to the promises of asset.h.
TEST(Cooked, NoSealedFileBreaksAPromise) {
  for (const Bytes& file : {cookedOf(smallHair(63)), cookedOf(defectiveHair())}) {
    size_t accepted = 0;
    const auto attempt = [&](Bytes damaged) {
      sealCooked(damaged.bytes);
      const auto loaded = load(damaged, "hostile.flk");
      if (loaded->result != FLK_SUCCESS) return;
      ++accepted;
      const char* broken = brokenRoundTrip(loaded->asset.get());
      EXPECT_EQ(broken, nullptr) << broken;
    };
    for (size_t at = 0; at < file.size() && !HasFailure(); ++at)
      for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff, file.bytes[at] + 1}) {
        Bytes damaged = file;
        damaged.bytes[at] = static_cast<unsigned char>(value);
        attempt(std::move(damaged));
      }
    for (size_t at = 0; at + 4 <= file.size() && !HasFailure(); at += 4)
      for (const uint32_t value : {0u, 1u, 2u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x7f800000u, 0x7fc00000u, 0xff800000u, 0x49742401u, 0x10000001u}) {
        Bytes damaged = file;
        attempt(damaged.setU32(at, value));
      }
    EXPECT_GT(accepted, 0u) << "some values may be others";
  }
}

TEST(Cooked, HeaderFields) {
  const Bytes file = cookedOf(smallHair(63));
  const auto with = [&](size_t at, uint64_t value) { return Bytes(file).setU32(at, value); };
  const auto withFloat = [&](size_t at, float value) { return Bytes(file).setF32(at, value); };
  expectRefusedSealed(with(4, 0x0a1a0a0au), "COOKED_MAGIC_DAMAGED", "as text");
  expectRefusedSealed(with(8, 0), "COOKED_VERSION", "an older version of Forelock", FLK_ERROR_FORMAT_UNKNOWN);
  expectRefusedSealed(with(8, 2), "COOKED_VERSION", "a newer version of Forelock (version 2 at byte 8, 1 is read): cook it again", FLK_ERROR_FORMAT_UNKNOWN);
  expectRefusedSealed(with(12, 384), "COOKED_FIELD", "the size of the header (byte 12)");
  expectRefusedSealed(with(16, file.size() + 1), "COOKED_SIZE", "truncated");
  expectRefusedSealed(with(20, 1), "COOKED_SIZE", "truncated");
  expectRefusedSealed(with(24, 0), "COOKED_FIELD", "the count of strands (byte 24)");
  expectRefusedSealed(with(24, 5), "COOKED_FIELD", "the count of vertices (byte 28)");
  expectRefusedSealed(with(24, 0xffffffffu), "COOKED_TOO_LARGE", "4294967295 strands (byte 24)", FLK_ERROR_LIMIT);
  expectRefusedSealed(with(24, 2), "COOKED_BLOCK_PLACE", "first_vertex");
  expectRefusedSealed(with(28, 0), "COOKED_FIELD", "the count of vertices (byte 28)");
  expectRefusedSealed(with(28, 268'435'456), "COOKED_BLOCK_PLACE", "positions");
  expectRefusedSealed(with(28, 268'435'457), "COOKED_TOO_LARGE", "split it", FLK_ERROR_LIMIT);
  expectRefusedSealed(with(32, 1), "COOKED_FIELD", "(byte 32)");
  expectRefusedSealed(with(36, 5), "COOKED_FIELD", "(byte 32)");
  expectRefusedSealed(with(40, FLK_FORMAT_COOKED), "COOKED_FIELD", "the source's format (byte 40)");
  expectRefusedSealed(with(40, 77), "COOKED_FIELD", "the source's format (byte 40)");
  expectRefusedSealed(with(44, 3), "COOKED_FIELD", "(byte 44)");
  expectRefusedSealed(with(48, 0), "COOKED_FIELD", "goes on after the last");
  expectRefusedSealed(with(48, 200), "COOKED_FIELD", "the count of findings (byte 48)");
  expectRefusedSealed(with(48, 0xffffffffu), "COOKED_FIELD", "the count of findings (byte 48)");
  expectRefusedSealed(with(52, 2), "COOKED_FIELD", "(byte 52)");
  expectRefusedSealed(with(52, 4'194'305), "COOKED_FIELD", "(byte 52)");
  for (size_t axis = 0; axis < 6; ++axis)
    for (const float value : {not_a_number, 7.0f}) expectRefusedSealed(withFloat(56 + axis * 4, value), "COOKED_FIELD", "the bounds");
  for (size_t which = 0; which < 3; ++which)
    for (const float value : {not_a_number, infinity, 0.0f, -1.0f}) expectRefusedSealed(withFloat(80 + which * 4, value), "COOKED_FIELD", "lengths");
  for (size_t which = 0; which < 2; ++which) expectRefusedSealed(withFloat(92 + which * 4, 0.5f), "COOKED_FIELD", "radius (byte 92)");
  for (size_t at = 100; at < 128; ++at) {
    Bytes reserved = file;
    reserved.bytes[at] = 1;
    expectRefusedSealed(reserved, "COOKED_FIELD", "reserved");
  }
  expectRefusedSealed(with(296, 1), "COOKED_FIELD", "reserved");
}

TEST(Cooked, PlacesOfBlocks) {
  const Bytes file = cookedOf(smallHair(63));
  for (size_t block = 0; block < 7; ++block) {
    if (block == 4) continue;  // .hair has no masses
    const size_t at = 128 + block * 24;
    const uint64_t offset = blockOffset(file, block), bytes = littleEndian(&file.bytes[at + 8], 8);
    const auto refused = [&](uint64_t new_offset, uint64_t new_bytes, const char* id = "COOKED_BLOCK_PLACE") {
      Bytes damaged = file;
      putLittleEndian(damaged.bytes, at, new_offset, 8);
      putLittleEndian(damaged.bytes, at + 8, new_bytes, 8);
      sealCooked(damaged.bytes);
      const auto loaded = load(damaged, "place.flk");
      EXPECT_EQ(loaded->result, FLK_ERROR_MALFORMED) << block << ": " << new_offset << " " << new_bytes;
      EXPECT_TRUE(!id || loaded->caught.error() == id) << loaded->caught.text();
    };
    refused(offset + 4, bytes);                    // not aligned
    refused(offset - 64, bytes);                   // overlaps what is before
    refused(offset + 64, bytes);                   // leaves a gap
    refused(0, bytes);                             // in the header
    refused(file.size(), bytes);                   // past the end
    refused(UINT64_MAX - 63, bytes);               // wraps
    refused(offset, UINT64_MAX - offset + 1, block == 6 ? "COOKED_SIZE" : "COOKED_BLOCK_PLACE");
    refused(offset, UINT64_MAX, block == 6 ? "COOKED_SIZE" : "COOKED_BLOCK_PLACE");
    refused(offset, bytes + 4, nullptr);
    refused(offset, bytes - 4, nullptr);
    refused(0, 0, nullptr);                        // gone
  }
  Bytes absent = file;
  putLittleEndian(absent.bytes, 128 + 4 * 24 + 16, 1, 8);
  expectRefusedSealed(absent, "COOKED_BLOCK_PLACE", "inverse_masses");
  Bytes between = file;
  between.bytes[static_cast<size_t>(blockOffset(file, 0)) + 16] = 1;
  expectRefusedSealed(between, "COOKED_FIELD", "the space between two blocks (byte 336)");
}

TEST(Cooked, HostileValues) {
  const uint32_t first_vertex[] = {0, 2, 5};
  const float positions[15] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0}, values[15] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  const FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 2, 5, first_vertex, positions, values, values, values, values};
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&strands, nullptr, &asset), FLK_SUCCESS);
  const Bytes file = cook(asset);
  flkAssetDestroy(asset);
  const auto at = [&](size_t block, size_t index) { return static_cast<size_t>(blockOffset(file, block)) + index * 4; };

  for (const uint32_t middle : {0u, 1u, 4u, 5u, 6u, 0xffffffffu, 0x80000000u})
    expectRefusedSealed(Bytes(file).setU32(at(0, 1), middle), "COOKED_FIRST_VERTEX", "two or more of 5");
  expectRefusedSealed(Bytes(file).setU32(at(0, 0), 1), "COOKED_FIRST_VERTEX", "strand 0");
  expectRefusedSealed(Bytes(file).setU32(at(0, 2), 4), "COOKED_FIELD", "the last entry of first_vertex");
  for (size_t i = 0; i < 15; ++i)
    for (const float bad : {not_a_number, infinity, -infinity, 1.1e6f, -3e38f})
      expectRefusedSealed(Bytes(file).setF32(at(1, i), bad), "COOKED_VALUE", "(byte " + std::to_string(at(1, i)) + ")");
  for (size_t i = 0; i < 5; ++i) {
    for (const float bad : {not_a_number, infinity, -1e-30f, 1.1e6f}) expectRefusedSealed(Bytes(file).setF32(at(2, i), bad), "COOKED_VALUE", "radii");
    for (const float bad : {not_a_number, infinity, -1.0f}) expectRefusedSealed(Bytes(file).setF32(at(4, i), bad), "COOKED_VALUE", "inverse_masses");
  }
  for (size_t i = 0; i < 4; ++i)
    for (const float bad : {not_a_number, infinity, -infinity}) expectRefusedSealed(Bytes(file).setF32(at(3, i), bad), "COOKED_VALUE", "root_uvs");
  for (size_t i = 0; i < 15; ++i)
    for (const float bad : {not_a_number, infinity, -0.1f, 1.1f}) expectRefusedSealed(Bytes(file).setF32(at(5, i), bad), "COOKED_VALUE", "colors");
  // No length: the strands collapse to a point inside the bounds, or to one that vanishes in 32-bit floats.
  Bytes collapsed = file;
  collapsed.setF32(at(1, 4), 0);
  expectRefusedSealed(collapsed, "COOKED_VALUE", "strand 0 (positions, byte " + std::to_string(at(1, 0)) + ") has no length");
  expectRefusedSealed(Bytes(collapsed).setF32(at(1, 4), 1e-19f), "COOKED_VALUE", "has no length");
  for (const size_t axis : {9u, 10u, 12u, 13u}) collapsed.setF32(at(1, axis), axis % 3 == 0 ? 1.0f : 0.0f);
  expectRefusedSealed(Bytes(collapsed).setF32(at(1, 4), 1), "COOKED_VALUE", "strand 1");
}

TEST(Cooked, HostileFindings) {
  const Bytes file = cookedOf(defectiveHair());
  const size_t first = static_cast<size_t>(blockOffset(file, 6));
  const auto refused = [&](size_t at, uint64_t value) { expectRefusedSealed(Bytes(file).setU32(first + at, value), "COOKED_FIELD", "a finding (byte "); };
  refused(0, 0);             // count
  refused(8, 2);             // severity: errors refuse an asset, they are not findings
  refused(12, 2);            // repaired
  refused(16, 9);            // strands listed
  refused(20, 5);            // a strand that the source does not have
  refused(52, 0);            // no code
  refused(52, 0xffffffffu);
  refused(52, 65);
  refused(56, 0);            // no sentence
  refused(56, 0xffffffffu);
  refused(60, 1);
  refused(64, 0x1b5b4150u);  // control characters in the code
  const size_t sentence = 64 + static_cast<size_t>(littleEndian(&file.bytes[first + 52], 4));
  refused(sentence, 0x6d31335bu << 8 | 0x1b);  // an escape sequence for the terminal in the sentence
  refused(sentence, 0);
  // A code that is not known is one of a later version.
  Bytes later = file;
  later.bytes[first + 64] = 'X';
  sealCooked(later.bytes);
  const auto loaded = load(later);
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->codes().rfind("XOSITION_NOT_FINITE ", 0), 0u) << loaded->codes();
}

TEST(Cooked, LimitsOfTheOptions) {
  const Bytes file = cookedOf(smallHair(7));
  EXPECT_EQ(load(file, "few.flk", 2, 0)->caught.error(), "COOKED_TOO_LARGE");
  EXPECT_EQ(load(file, "few.flk", 0, 8)->result, FLK_ERROR_LIMIT);
  EXPECT_EQ(load(file, "few.flk", 3, 9)->result, FLK_SUCCESS);
}
