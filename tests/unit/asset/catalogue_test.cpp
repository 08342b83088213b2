// Every way in which files are known to be malformed, for every reader: what comes of it, and that the sentence names the field. A
// file that loads has a finding instead of a message. None takes a second, and none makes a reader ask for much memory.
#include "rig_kit.h"

#include <chrono>
#include <limits>

using namespace asset_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr FlkResult ok = FLK_SUCCESS, unknown = FLK_ERROR_FORMAT_UNKNOWN, malformed = FLK_ERROR_MALFORMED, empty = FLK_ERROR_EMPTY_ASSET;

struct Cell {
  const char* what;
  Bytes file;
  FlkResult result;
  std::string id;    // of the message, or of the finding; empty: nothing is wrong
  std::string says;  // part of its sentence: the field, mostly with its byte
};

// The asset's or the rig's functions.
struct AssetFunctions {
  using Handle = FlkAsset;
  static FlkResult load(const Bytes& file, const FlkHostAllocator& allocator, Caught& caught, Handle* handle) {
    FlkAssetOptions options = optionsFor(caught, "file");
    options.allocator = &allocator;
    return flkAssetLoadMemory(file.bytes.data(), file.size(), &options, handle);
  }
  static const char* broken(Handle handle) { return brokenPromise(handle); }
  static FlkResult finding(Handle handle, uint32_t i, FlkFinding* finding) { return flkAssetGetFinding(handle, i, finding); }
  static void destroy(Handle handle) { flkAssetDestroy(handle); }
};

struct RigFunctions {
  using Handle = FlkRig;
  static FlkResult load(const Bytes& file, const FlkHostAllocator& allocator, Caught& caught, Handle* handle) {
    FlkRigOptions options{};
    options.type = FLK_TYPE_RIG_OPTIONS;
    options.allocator = &allocator;
    options.message = Caught::receive;
    options.message_user = &caught;
    options.name = "file";
    return flkRigLoadMemory(file.bytes.data(), file.size(), &options, handle);
  }
  static const char* broken(Handle handle) { return brokenRigPromise(handle); }
  static FlkResult finding(Handle handle, uint32_t i, FlkFinding* finding) { return flkRigGetFinding(handle, i, finding); }
  static void destroy(Handle handle) { flkRigDestroy(handle); }
};

template <class Functions> void check(const Cell& cell) {
  SCOPED_TRACE(cell.what);
  CountingAllocator counter;
  Caught caught;
  typename Functions::Handle handle = nullptr;
  const auto begin = std::chrono::steady_clock::now();
  const FlkResult result = Functions::load(cell.file, counter.callbacks(), caught, &handle);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(result, cell.result) << flkResultName(result) << "\n" << caught.text();
  EXPECT_LT(seconds, 1.0);
  EXPECT_LT(counter.largest, size_t{1} << 20) << "64 MiB are the bound, and these files have a few hundred bytes";
  if (handle) {
    EXPECT_EQ(Functions::broken(handle), nullptr);
    std::string codes, text;
    FlkFinding finding{};
    for (uint32_t i = 0; Functions::finding(handle, i, &finding) == FLK_SUCCESS; ++i) {
      // What is said of the undamaged file: it has no widths, and masses of both ends are implied.
      const std::string_view code = finding.code;
      if (code == "WIDTH_DEFAULTED" || code == "INVERSE_MASS_IMPLIED" || code == "BOTH_ENDS_FIXED" || code == "INVERSE_MASS_ALL_ZERO") continue;
      codes += std::string(finding.code) + " ";
      if (cell.id == finding.code) text = finding.text;
    }
    if (cell.id.empty()) EXPECT_EQ(codes, "");
    else EXPECT_NE(text, "") << "there are: " << codes;
    EXPECT_NE(text.find(cell.says), std::string::npos) << text;
  } else {
    EXPECT_EQ(caught.error(), cell.id) << caught.text();
    EXPECT_NE(caught.text().find(cell.says), std::string::npos) << caught.text();
  }
  Functions::destroy(handle);
  EXPECT_EQ(counter.live, 0u);
}

void checkAll(const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) check<AssetFunctions>(cell);
}

void checkRigs(const std::vector<Cell>& cells) {
  for (const Cell& cell : cells) check<RigFunctions>(cell);
}

Bytes swapped(Bytes file, size_t from, size_t to) {
  for (size_t i = from; i + 4 <= to; i += 4) {
    std::swap(file.bytes[i], file.bytes[i + 3]);
    std::swap(file.bytes[i + 1], file.bytes[i + 2]);
  }
  return file;
}

Bytes text(const std::string& value) { return Bytes().text(value); }

const char* const lfs = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 1158720\n";
const char* const html = "<!DOCTYPE html>\n<html><head><title>Not found</title></head></html>\n";

// Coordinates of `strand` of a binary .tfx: x y z of each of its four vertices.
Bytes tfxStrand(size_t strand, std::initializer_list<float> coordinates) {
  Bytes file = smallTfx();
  size_t i = 0;
  for (const float value : coordinates) file.setF32(160 + strand * 64 + i / 3 * 16 + i % 3 * 4, value), ++i;
  return file;
}

}  // namespace

TEST(Catalogue, TfxHeader) {
  checkAll({
      {"0 bytes", smallTfx().cut(0), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", smallTfx().cut(1), unknown, "FORMAT_UNKNOWN", "00 at byte 0"},
      {"4 bytes", smallTfx().cut(4), malformed, "TFX_HEADER_TRUNCATED", "ends at byte 4"},
      {"12 bytes", smallTfx().cut(12), malformed, "TFX_HEADER_TRUNCATED", "ends at byte 12"},
      {"32 bytes", smallTfx().cut(32), malformed, "TFX_HEADER_TRUNCATED", "ends at byte 32"},
      {"159 bytes", smallTfx().cut(159), malformed, "TFX_HEADER_TRUNCATED", "ends at byte 159"},
      {"cut in a vertex", smallTfx().cut(160 + 7), malformed, "TFX_BLOCK_PAST_END", "positions (offset field at byte 12)"},
      {"cut in a UV", smallTfx().cut(355), malformed, "TFX_BLOCK_PAST_END", "strand UVs (offset field at byte 16)"},
      {"version 0", smallTfx().setF32(0, 0), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is 0"},
      {"version 3 on a header of 4", smallTfx().setF32(0, 3), malformed, "TFX_OFFSET_IN_HEADER", "(offset field at byte 144)"},
      {"version NaN", smallTfx().setF32(0, not_a_number), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is nan"},
      {"version Inf", smallTfx().setF32(0, infinity), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is inf"},
      {"version -4", smallTfx().setF32(0, -4), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is -4"},
      {"version 1e30", smallTfx().setF32(0, 1e30f), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is 1e+30"},
      {"version 4.1", smallTfx().setF32(0, 4.1f), unknown, "TFX_VERSION_UNKNOWN", "version (byte 0) is 4.1"},
      {"byte swapped", swapped(smallTfx(), 0, 376), malformed, "TFX_BYTE_SWAPPED", "version at byte 0"},
      {"byte swapped 3", swapped(smallTfx3(), 0, 464), malformed, "TFX_BYTE_SWAPPED", "version at byte 0"},
      {"LFS pointer", text(lfs), unknown, "GIT_LFS_POINTER", "git lfs pull"},
      {"HTML", text(html), unknown, "HTML_PAGE", "web page"},
      {"text of TressFX 2", text(smallTfxText()), ok, "", ""},
      {"trailing bytes", smallTfx().zeros(5), ok, "TRAILING_BYTES", "(5, from byte 376)"},
      {"reserved words", smallTfx().setU32(40, 9), ok, "TFX_RESERVED_SET", "from byte 40"},
      {"version 3, 0 bytes of body", smallTfx3().cut(295), malformed, "TFX_HEADER_TRUNCATED", "296 bytes"},
      {"version 3, cut in a vertex", smallTfx3().cut(300), malformed, "TFX_BLOCK_PAST_END", "positions (offset field at byte 144)"},
      {"version 3, trailing bytes", smallTfx3().zeros(1), ok, "TRAILING_BYTES", "from byte 464"},
  });
}

TEST(Catalogue, TfxCountsAndOffsets) {
  const std::string positions = "positions (offset field at byte 12)", uvs = "strand UVs (offset field at byte 16)";
  checkAll({
      {"strands 0xFFFFFFFF", smallTfx().setU32(4, 0xffffffffu), malformed, "TFX_BLOCK_PAST_END", "4294967295 strands of 4 vertices (bytes 4 and 8)"},
      {"strands 0x80000001", smallTfx().setU32(4, 0x80000001u), malformed, "TFX_BLOCK_PAST_END", "2147483649 strands"},
      {"vertices 0xFFFFFFFF", smallTfx().setU32(8, 0xffffffffu), malformed, "TFX_BLOCK_PAST_END", "of 4294967295 vertices"},
      {"vertices 0x80000001", smallTfx().setU32(8, 0x80000001u), malformed, "TFX_BLOCK_PAST_END", "of 2147483649 vertices"},
      {"both 0xFFFFFFFF", smallTfx().setU32(4, 0xffffffffu).setU32(8, 0xffffffffu), malformed, "TFX_BLOCK_PAST_END", positions},
      {"n m 16 = 256 mod 2^32", smallTfx().setU32(4, 0x10000001u).setU32(8, 16), malformed, "TFX_BLOCK_PAST_END", positions},
      {"n m = 0 mod 2^32", smallTfx().setU32(4, 0x10000u).setU32(8, 0x10000u), malformed, "TFX_BLOCK_PAST_END", positions},
      {"n m 16 = 0 mod 2^64", smallTfx().setU32(4, 0x80000000u).setU32(8, 0x20000000u), malformed, "TFX_BLOCK_PAST_END", positions},
      {"version 3, n m 12 = 8 mod 2^32", smallTfx3().setU32(4, 0x15555556u).setU32(8, 1), malformed, "TFX_BLOCK_PAST_END", "(offset field at byte 144)"},
      {"0 strands", smallTfx().setU32(4, 0), empty, "TFX_NO_STRANDS", "0 strands (byte 4)"},
      {"0 vertices", smallTfx().setU32(8, 0), empty, "TFX_NO_STRANDS", "0 vertices (byte 8)"},
      {"1 vertex", smallTfx(false).setU32(8, 1), empty, "NO_STRAND_LEFT", "3 have fewer than two vertices"},
      {"2 vertices", smallTfx(false).setU32(8, 2), ok, "TRAILING_BYTES", "(96, from byte 256)"},
      {"1 strand", smallTfx(false).setU32(4, 1), ok, "TRAILING_BYTES", "from byte 224"},
      {"more strands counted than written", smallTfx().setU32(4, 4).zeros(64), malformed, "TFX_BLOCKS_OVERLAP", "run into the strand UVs at byte 352"},
      {"offset 0 of the positions", smallTfx().setU32(12, 0), malformed, "TFX_OFFSET_IN_HEADER", positions + " start at byte 0"},
      {"offset 0 of the UVs", smallTfx(false), ok, "", ""},
      {"offset in the header", smallTfx().setU32(12, 159), malformed, "TFX_OFFSET_IN_HEADER", positions + " start at byte 159"},
      {"UVs in the header", smallTfx().setU32(16, 16), malformed, "TFX_OFFSET_IN_HEADER", uvs + " start at byte 16"},
      {"offset 163", smallTfx(false).zeros(3).setU32(12, 163), ok, "TFX_OFFSET_UNALIGNED", "from byte 12"},
      {"offset at the end", smallTfx().setU32(16, 376), malformed, "TFX_BLOCK_PAST_END", uvs},
      {"offset past the end", smallTfx().setU32(12, 4096), malformed, "TFX_BLOCK_PAST_END", "from byte 4096"},
      {"offset that wraps", smallTfx().setU32(12, 0xffffff40u), malformed, "TFX_BLOCK_PAST_END", "from byte 4294967104"},
      {"blocks overlap", smallTfx().setU32(16, 350), malformed, "TFX_BLOCKS_OVERLAP", "(offset field at byte 16)"},
      {"blocks at one place", smallTfx().setU32(16, 160), malformed, "TFX_BLOCKS_OVERLAP", "(offset field at byte 12)"},
      {"version 3, offset 0", smallTfx3().setU32(144, 0), malformed, "TFX_OFFSET_IN_HEADER", "(offset field at byte 144)"},
      {"version 3, offset 299", smallTfx3(false).zeros(3).setU32(144, 299), ok, "TFX_OFFSET_UNALIGNED", "from byte 144"},
      {"version 3, offset that wraps", smallTfx3().setU32(152, 0xfffffff8u), malformed, "TFX_BLOCK_PAST_END", "strand UVs (offset field at byte 152)"},
  });
}

TEST(Catalogue, TfxNumbersAndGeometry) {
  checkAll({
      {"NaN", tfxStrand(1, {not_a_number}), ok, "POSITION_NOT_FINITE", "the first in strand 1 at byte 224"},
      {"Inf", tfxStrand(1, {0, infinity}), ok, "POSITION_NOT_FINITE", "strand 1"},
      {"3e38", tfxStrand(1, {3e38f}), ok, "POSITION_OUT_OF_RANGE", "strand 1"},
      {"denormal", tfxStrand(1, {1e-40f}), ok, "", ""},
      {"-0", tfxStrand(0, {-0.0f}), ok, "", ""},
      {"mass NaN", smallTfx().setF32(172, not_a_number), ok, "INVERSE_MASS_INVALID", "strand 0 at byte 172"},
      {"UV NaN", smallTfx().setF32(360, not_a_number), ok, "ROOT_UV_NOT_FINITE", "strand 1 at byte 360"},
      {"UV 2", smallTfx().setF32(360, 2), ok, "ROOT_UV_OUTSIDE_UNIT", "strand 1"},
      {"duplicate points", tfxStrand(1, {0.25f, 0, 0, 0.25f, 0, 0, 0.25f, 0.5f, 0, 0.25f, 0.5f, 0}), ok, "SEGMENT_ZERO_LENGTH", "(2, the first in strand 1"},
      {"collapsed strand", tfxStrand(1, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), ok, "STRAND_ZERO_LENGTH", "strand 1 at byte 224"},
      {"micro strand", tfxStrand(1, {0, 0, 0, 1e-6f, 0, 0, 2e-6f, 0, 0, 3e-6f, 0, 0}), ok, "STRAND_MICRO", "strand 1"},
      {"all strands lost", smallTfx(false).setU32(8, 12).setU32(4, 1).setF32(160, infinity), empty, "NO_STRAND_LEFT", "1 hold NaN or infinite coordinates"},
      {"centimetres", tfxStrand(0, {170}), ok, "UNIT_SUSPECT", "centimetres"},
  });
}

TEST(Catalogue, TfxText) {
  const std::string file = smallTfxText();
  checkAll({
      {"0 bytes", text(""), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", text(file.substr(0, 1)), unknown, "FORMAT_UNKNOWN", "76 at byte 0"},
      {"4 bytes", text(file.substr(0, 4)), unknown, "FORMAT_UNKNOWN", "76 65 72 73 at byte 0"},
      {"8 bytes", text(file.substr(0, 8)), malformed, "TFX_TEXT_TRUNCATED", "line 1 (byte 8), where the version"},
      {"12 bytes", text(file.substr(0, 12)), empty, "TFX_TEXT_NO_STRANDS", "counts no strands"},
      {"32 bytes", text(file.substr(0, 32)), malformed, "TFX_TEXT_TRUNCATED", "\"rotation\""},
      {"159 bytes", text(file.substr(0, 159)), empty, "TFX_TEXT_NO_STRANDS", "counts no strands"},
      {"cut in a vertex", text(file.substr(0, file.find("000000 0.5"))), malformed, "TFX_TEXT_TRUNCATED", "where a coordinate should be"},
      {"version 0", text(replaced(file, "version 2.0", "version 0")), unknown, "TFX_TEXT_VERSION", "TressFX 0 (byte 8)"},
      {"version 3", text(replaced(file, "version 2.0", "version 3")), unknown, "TFX_PROJECT", "TressFX 3 (byte 8)"},
      {"version NaN", text(replaced(file, "version 2.0", "version nan")), unknown, "TFX_TEXT_VERSION", "TressFX nan"},
      {"version Inf", text(replaced(file, "version 2.0", "version inf")), unknown, "TFX_TEXT_VERSION", "TressFX inf"},
      {"version -4", text(replaced(file, "version 2.0", "version -4")), unknown, "TFX_TEXT_VERSION", "TressFX -4"},
      {"version 1e30", text(replaced(file, "version 2.0", "version 1e30")), unknown, "TFX_TEXT_VERSION", "TressFX 1e+30"},
      {"version 4.1", text(replaced(file, "version 2.0", "version 4.1")), unknown, "TFX_TEXT_VERSION", "TressFX 4.1"},
      {"strands 0xFFFFFFFF", text(replaced(file, "numStrands 2", "numStrands 4294967295")), FLK_ERROR_LIMIT, "TFX_TEXT_TOO_LARGE", "numStrands is 4294967295"},
      {"strands 0x80000001", text(replaced(file, "numStrands 2", "numStrands 2147483649")), FLK_ERROR_LIMIT, "TFX_TEXT_TOO_LARGE", "2147483649"},
      {"strands beyond 64 bits", text(replaced(file, "numStrands 2", "numStrands 99999999999999999999")), malformed, "TFX_TEXT_NOT_A_NUMBER", "\"numStrands\""},
      {"more strands than follow", text(replaced(file, "numStrands 2", "numStrands 3")), malformed, "TFX_TEXT_TRUNCATED", "numStrands is 3"},
      {"vertices 0xFFFFFFFF", text(replaced(file, "numVerts 3", "numVerts 4294967295")), malformed, "TFX_TEXT_TRUNCATED", "strand 1 has 4294967295 vertices"},
      {"vertices 0x80000001", text(replaced(file, "numVerts 3", "numVerts 2147483649")), malformed, "TFX_TEXT_TRUNCATED", "2147483649 vertices"},
      {"vertices x 12 = 8 mod 2^32", text(replaced(file, "numVerts 3", "numVerts 357913942")), malformed, "TFX_TEXT_TRUNCATED", "357913942 vertices"},
      {"vertices -1", text(replaced(file, "numVerts 3", "numVerts -1")), malformed, "TFX_TEXT_TRUNCATED", "-1 vertices"},
      {"0 strands", text(replaced(file, "numStrands 2", "numStrands 0")), empty, "TFX_TEXT_NO_STRANDS", "counts no strands"},
      {"0 vertices", text(replaced(file, "numVerts 2 texcoord 0.25 0.5\n0.0 0.125 0.25\n000000 0.5 1e-1", "numVerts 0")), ok, "STRAND_TOO_SHORT", "strand 0"},
      {"1 vertex", text(replaced(file, "numVerts 2 texcoord 0.25 0.5\n0.0 0.125 0.25\n000000 0.5 1e-1", "numVerts 1\n0 0 0")), ok, "STRAND_TOO_SHORT", "strand 0"},
      {"NaN", text(replaced(file, "0.0 0.125", "nan 0.125")), ok, "POSITION_NOT_FINITE", "strand 0"},
      {"Inf", text(replaced(file, "0.0 0.125", "-inf 0.125")), ok, "POSITION_NOT_FINITE", "strand 0"},
      {"3e38", text(replaced(file, "0.0 0.125", "3e38 0.125")), ok, "POSITION_OUT_OF_RANGE", "strand 0"},
      {"denormal", text(replaced(file, "0.0 0.125", "1e-40 0.125")), ok, "", ""},
      {"-0", text(replaced(file, "0.0 0.125", "-0.0 0.125")), ok, "", ""},
      {"duplicate points", text(replaced(file, "1.5, +2, -3", "1, 2, 3")), ok, "SEGMENT_ZERO_LENGTH", "strand 1"},
      {"collapsed strand", text(replaced(file, "000000 0.5 1e-1", "0 0.125 0.25")), ok, "STRAND_ZERO_LENGTH", "strand 0"},
      {"micro strand", text(replaced(file, "000000 0.5 1e-1", "1e-6 0.125 0.25")), ok, "STRAND_MICRO", "strand 0"},
      {"trailing bytes", text(file + "more\n"), ok, "TRAILING_BYTES", "from byte " + std::to_string(file.size())},
      {"a line of 1 MB", text(replaced(file, "is sorted 1", "comment " + std::string(1 << 20, 'x'))), ok, "TFX_TEXT_KEY_UNKNOWN", "from byte 178"},
  });
}

TEST(Catalogue, Hair) {
  const auto flags = [](unsigned value) { return smallHair().setU32(12, value); };
  Bytes one_point = smallHair();
  one_point.bytes[128] = 0;
  Bytes more_segments = smallHair(), fewer_segments = smallHair();
  more_segments.bytes[128] = 2, fewer_segments.bytes[132] = 1;
  Bytes all_one = smallHair();
  all_one.bytes[128] = all_one.bytes[130] = all_one.bytes[132] = 0;
  Bytes x = smallHair(), small = smallHair();
  x.bytes[3] = 'X';
  std::memcpy(small.bytes.data(), "hair", 4);
  std::vector<Cell> cells = {
      {"0 bytes", smallHair().cut(0), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", smallHair().cut(1), unknown, "FORMAT_UNKNOWN", "48 at byte 0"},
      {"3 bytes", smallHair().cut(3), unknown, "FORMAT_UNKNOWN", "48 41 49 at byte 0"},
      {"4 bytes", smallHair().cut(4), malformed, "HAIR_HEADER_TRUNCATED", "ends at byte 4"},
      {"12 bytes", smallHair().cut(12), malformed, "HAIR_HEADER_TRUNCATED", "ends at byte 12"},
      {"32 bytes", smallHair().cut(32), malformed, "HAIR_HEADER_TRUNCATED", "ends at byte 32"},
      {"127 bytes", smallHair().cut(127), malformed, "HAIR_HEADER_TRUNCATED", "ends at byte 127"},
      {"cut in the segments", smallHair().cut(131), malformed, "HAIR_ARRAY_PAST_END", "segment counts (bit 0 of the flags at byte 12)"},
      {"cut in the points", smallHair().cut(159), malformed, "HAIR_ARRAY_PAST_END", "points (bit 1 of the flags at byte 12)"},
      {"cut in the thickness", smallHair().cut(270), malformed, "HAIR_ARRAY_PAST_END", "thicknesses (bit 2"},
      {"HAIX", x, unknown, "FORMAT_UNKNOWN", "48 41 49 58 at byte 0"},
      {"hair", small, unknown, "FORMAT_UNKNOWN", "68 61 69 72 at byte 0"},
      {"byte swapped", swapped(smallHair(), 4, 40), malformed, "HAIR_BYTE_SWAPPED", "flags (byte 12)"},
      {"byte swapped magic", swapped(smallHair(), 0, 40), malformed, "HAIR_BYTE_SWAPPED", "magic at byte 0"},
      {"strands 0xFFFFFFFF", smallHair().setU32(4, 0xffffffffu), malformed, "HAIR_ARRAY_PAST_END", "4294967295 strands (byte 4)"},
      {"strands 0x80000001", smallHair().setU32(4, 0x80000001u), malformed, "HAIR_ARRAY_PAST_END", "2147483649 strands (byte 4)"},
      {"points 0xFFFFFFFF", smallHair().setU32(8, 0xffffffffu), malformed, "HAIR_ARRAY_PAST_END", "4294967295 points (byte 8)"},
      {"points 0x80000001", smallHair().setU32(8, 0x80000001u), malformed, "HAIR_ARRAY_PAST_END", "2147483649 points (byte 8)"},
      {"points x 3 = 2 mod 2^32", smallHair().setU32(8, 0x55555556u), malformed, "HAIR_ARRAY_PAST_END", "points (byte 8)"},
      {"points x 12 = 8 mod 2^32", smallHair().setU32(8, 0x15555556u), malformed, "HAIR_ARRAY_PAST_END", "points (byte 8)"},
      {"too many segments", more_segments, malformed, "HAIR_SEGMENTS_DISAGREE", "(array at byte 128) make 10 points"},
      {"too few segments", fewer_segments, ok, "HAIR_POINTS_UNUSED", "from byte 230"},
      {"default segments disagree", smallHair(2).setU32(16, 3), malformed, "HAIR_SEGMENTS_DISAGREE", "default at byte 16"},
      {"default segments + 1 = 0 mod 2^32", smallHair(2).setU32(16, 0xffffffffu), malformed, "HAIR_SEGMENTS_DISAGREE", "default at byte 16"},
      {"0 strands", smallHair().setU32(4, 0), empty, "HAIR_NO_STRANDS", "0 strands (byte 4)"},
      {"0 points", smallHair().setU32(8, 0), empty, "HAIR_NO_STRANDS", "0 points (byte 8)"},
      {"0 segments", one_point, ok, "STRAND_TOO_SHORT", "strand 0 at byte 134"},
      {"all of 1 point", all_one, empty, "NO_STRAND_LEFT", "3 have fewer than two vertices"},
      {"no points bit", flags(5), malformed, "HAIR_NO_POINTS", "flags (byte 12) are 0x5"},
      {"NaN point", smallHair().setF32(134 + 24, not_a_number), ok, "POSITION_NOT_FINITE", "strand 1 at byte 158"},
      {"Inf point", smallHair().setF32(134, infinity), ok, "POSITION_NOT_FINITE", "strand 0 at byte 134"},
      {"3e38", smallHair().setF32(134, 3e38f), ok, "POSITION_OUT_OF_RANGE", "strand 0"},
      {"denormal", smallHair().setF32(134, 1e-40f), ok, "", ""},
      {"-0", smallHair().setF32(134, -0.0f), ok, "", ""},
      {"NaN thickness", smallHair().setF32(242, not_a_number), ok, "RADIUS_INVALID", "strand 0 at byte 242"},
      {"thickness < 0", smallHair().setF32(246, -1), ok, "RADIUS_INVALID", "strand 0 at byte 246"},
      {"default thickness < 0", smallHair(2).setF32(20, -1), ok, "RADIUS_INVALID", "from byte 20"},
      {"transparency 2", smallHair(2 | 8).setF32(128 + 108, 2), ok, "HAIR_TRANSPARENCY_IGNORED", "from byte 236"},
      {"bit 5 without its UVs", flags(7 | 32), malformed, "HAIR_ARRAY_PAST_END", "UVs (bit 5 of the flags at byte 12)"},
      {"bit 5 with its UVs", smallHair(7 | 32), ok, "", ""},
      {"duplicate points", smallHair().setF32(134 + 24, 0.375f).setF32(134 + 32, 0.5625f), ok, "SEGMENT_ZERO_LENGTH", "strand 1"},
      {"collapsed strand", smallHair().setF32(134 + 12, 0).setF32(134 + 20, 0), ok, "STRAND_ZERO_LENGTH", "strand 0 at byte 134"},
      {"micro strand", smallHair().setF32(134 + 12, 1e-6f).setF32(134 + 20, 0), ok, "STRAND_MICRO", "strand 0"},
      {"trailing bytes", smallHair().zeros(7), ok, "TRAILING_BYTES", "(7, from byte 278)"},
  };
  for (unsigned bit = 6; bit < 32; ++bit) cells.push_back({"reserved bit", flags(7 | 1u << bit), ok, "HAIR_FLAGS_RESERVED", "from byte 12"});
  checkAll(cells);
}

TEST(Catalogue, StrandData) {
  Bytes bald, none, wide_cut = smallStrandData(7).cut(120);
  bald.u32(2).u32(1).f32s({0, 0, 0}).u32(2).f32s({0, 0, 0, 0, 1, 0});
  none.u32(2).u32(2).f32s({0, 0, 0, 0, 1, 0}).u32(0);
  Bytes all_bald;
  all_bald.u32(1).u32(1).f32s({0, 0, 0});
  checkAll({
      {"0 bytes", smallStrandData().cut(0), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", smallStrandData().cut(1), unknown, "FORMAT_UNKNOWN", "03 at byte 0"},
      {"3 bytes", smallStrandData().cut(3), unknown, "FORMAT_UNKNOWN", "03 00 00 at byte 0"},
      {"4 bytes", smallStrandData().cut(4), unknown, "FORMAT_UNKNOWN", "03 00 00 00 at byte 0"},
      {"12 bytes", smallStrandData().cut(12), malformed, "DATA_COUNT_PAST_END", "strand 0 has 2 points"},
      {"32 bytes", smallStrandData().cut(32), malformed, "DATA_COUNT_PAST_END", "strand 1"},
      {"cut in a strand", smallStrandData().cut(87), malformed, "DATA_COUNT_PAST_END", "strand 2 has 3 points of 12 bytes (byte 48)"},
      {".bin cut in a strand", wide_cut, malformed, "DATA_COUNT_PAST_END", "points of"},
      {".bin", smallStrandData(7), ok, "DATA_VALUES_IGNORED", "from byte 20"},
      {"strands 0xFFFFFFFF", smallStrandData().setU32(0, 0xffffffffu), unknown, "FORMAT_UNKNOWN", "ff ff ff ff at byte 0"},
      {"strands 0x80000001", smallStrandData().setU32(0, 0x80000001u), unknown, "FORMAT_UNKNOWN", "01 00 00 80 at byte 0"},
      {"strands 4,000,000", smallStrandData().setU32(0, 4'000'000), malformed, "DATA_COUNT_PAST_END", "(byte 0: 4000000 strands)"},
      {"points 0xFFFFFFFF", smallStrandData().setU32(48, 0xffffffffu), malformed, "DATA_COUNT_PAST_END", "has -1 points of 12 bytes (byte 48)"},
      {"points 0x80000001", smallStrandData().setU32(48, 0x80000001u), malformed, "DATA_COUNT_PAST_END", "has -2147483647 points"},
      {"points x 12 = 8 mod 2^32", smallStrandData().setU32(48, 0x15555556u), malformed, "DATA_COUNT_PAST_END", "has 357913942 points"},
      {"points x 28 = 24 mod 2^32", smallStrandData(7).setU32(96, 0x09249250u), malformed, "DATA_COUNT_PAST_END", "153391696 points of 28 bytes (byte 96)"},
      {"0 strands", smallStrandData().setU32(0, 0), unknown, "FORMAT_UNKNOWN", "00 00 00 00 at byte 0"},
      {"0 points", none, ok, "STRAND_TOO_SHORT", "strand 1"},
      {"1 point", bald, ok, "STRAND_ROOT_ONLY", "strand 0 at byte 8"},
      {"all of 1 point", all_bald, empty, "NO_STRAND_LEFT", "fewer than two vertices"},
      {"NaN", smallStrandData().setF32(52, not_a_number), ok, "POSITION_NOT_FINITE", "strand 2 at byte 52"},
      {"Inf", smallStrandData().setF32(52, infinity), ok, "POSITION_NOT_FINITE", "strand 2"},
      {"3e38", smallStrandData().setF32(52, 3e38f), ok, "POSITION_OUT_OF_RANGE", "strand 2"},
      {"denormal", smallStrandData().setF32(52, 1e-40f), ok, "STRAND_ROOT_ONLY", ""},
      {"-0", smallStrandData().setF32(52, -0.0f), ok, "STRAND_ROOT_ONLY", ""},
      {"collapsed strand", smallStrandData().setF32(20, 0.125f).setF32(24, 0.25f).setF32(28, 0.375f), ok, "STRAND_ZERO_LENGTH", "strand 0 at byte 8"},
      {"micro strand", smallStrandData().setF32(20, 0.125001f).setF32(24, 0.25f).setF32(28, 0.375f), ok, "STRAND_MICRO", "strand 0"},
      {"trailing bytes", smallStrandData().zeros(3), ok, "TRAILING_BYTES", "(3, from byte 88)"},
  });
}

TEST(Catalogue, Ply) {
  const std::string file = smallPlyText();
  const auto vertices = [&](const char* count) { return text(replaced(file, "element vertex 5", std::string("element vertex ") + count)); };
  const auto strands = [&](const char* count) { return text(replaced(file, "element strand 2", std::string("element strand ") + count)); };
  const std::string points = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n0 1 0\n";
  checkAll({
      {"0 bytes", text(""), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", text(file.substr(0, 1)), unknown, "FORMAT_UNKNOWN", "70 at byte 0"},
      {"4 bytes", text(file.substr(0, 4)), malformed, "PLY_HEADER", "line 2 of the header (byte 4) \"format\" should be"},
      {"12 bytes", text(file.substr(0, 12)), malformed, "PLY_HEADER", "(byte 11)"},
      {"32 bytes", text(file.substr(0, 32)), malformed, "PLY_HEADER", "line"},
      {"159 bytes", text(file.substr(0, 159)), malformed, "PLY_HEADER", "line"},
      {"cut in the vertices", text(file.substr(0, file.find("1 1 0 51"))), malformed, "PLY_PAST_END", "5 vertices"},
      {"version 0", text(replaced(file, "ascii 1.0", "ascii 0")), malformed, "PLY_HEADER", "version 1.0 should be, but there is \"0\""},
      {"version NaN", text(replaced(file, "ascii 1.0", "ascii nan")), malformed, "PLY_HEADER", "\"nan\""},
      {"an unknown encoding", text(replaced(file, "ascii", "binary_middle_endian")), malformed, "PLY_HEADER", "binary_middle_endian"},
      {"vertices 0xFFFFFFFF", vertices("4294967295"), malformed, "PLY_PAST_END", "4294967295 vertices"},
      {"vertices 0x80000001", vertices("2147483649"), malformed, "PLY_PAST_END", "2147483649 vertices"},
      {"vertices x 12 = 8 mod 2^32", vertices("357913942"), malformed, "PLY_PAST_END", "357913942 vertices"},
      {"vertices x 16 = 0 mod 2^64", vertices("1152921504606846976"), malformed, "PLY_PAST_END", "1152921504606846976 vertices"},
      {"vertices beyond 64 bits", vertices("99999999999999999999"), malformed, "PLY_HEADER", "an element's count"},
      {"vertices -1", vertices("-1"), malformed, "PLY_HEADER", "\"-1\""},
      {"strands 0xFFFFFFFF", strands("4294967295"), malformed, "PLY_PAST_END", "records"},
      {"0 vertices", vertices("0"), empty, "PLY_EMPTY", "0 vertices"},
      {"0 strands", strands("0"), empty, "PLY_EMPTY", "0 strands"},
      {"0 segments", text(replaced(file, "1\n2\n2 0 1", "0\n2\n2 0 1")), ok, "STRAND_TOO_SHORT", "strand 0"},
      {"too many segments", text(replaced(file, "1\n2\n2 0 1", "4\n2\n2 0 1")), malformed, "PLY_SEGMENTS_DISAGREE", "strand 1"},
      {"too few segments", text(replaced(file, "1\n2\n2 0 1", "1\n1\n2 0 1")), ok, "PLY_VERTICES_UNUSED", "1"},
      {"no x", text(replaced(file, "property float x", "property float a")), malformed, "PLY_NO_POSITIONS", "element vertex with x, y and z"},
      {"bare points", text(points), unknown, "PLY_NO_STRANDS", "2 points (byte 36)"},
      {"faces", text(replaced(points, "end_header", "element face 1\nproperty list uchar int i\nend_header")), unknown, "PLY_MESH", "1 faces"},
      {"NaN", text(replaced(file, "0 1 0 0 255", "0 nan 0 0 255")), ok, "POSITION_NOT_FINITE", "strand 0"},
      {"Inf", text(replaced(file, "0 1 0 0 255", "0 inf 0 0 255")), ok, "POSITION_NOT_FINITE", "strand 0"},
      {"3e38", text(replaced(file, "0 1 0 0 255", "0 3e38 0 0 255")), ok, "POSITION_OUT_OF_RANGE", "strand 0"},
      {"denormal", text(replaced(file, "0 1 0 0 255", "1e-40 1 0 0 255")), ok, "PLY_ALPHA_IGNORED", "alpha"},
      {"-0", text(replaced(file, "0 1 0 0 255", "-0 1 0 0 255")), ok, "PLY_ALPHA_IGNORED", "alpha"},
      {"thickness < 0", text(replaced(file, "0 1 0 0 255 0 255 0.25", "0 1 0 0 255 0 255 -1")), ok, "RADIUS_INVALID", "strand 0"},
      {"colour 300", text(replaced(replaced(file, "uchar red", "int red"), "0 0 0 255 0", "0 0 0 300 0")), ok, "COLOR_OUTSIDE_UNIT", "strand 0"},
      {"duplicate points", text(replaced(file, "1 1 0 51", "1 0 0 51")), ok, "SEGMENT_ZERO_LENGTH", "strand 1"},
      {"collapsed strand", text(replaced(file, "0 1 0 0 255", "0 0 0 0 255")), ok, "STRAND_ZERO_LENGTH", "strand 0"},
      {"micro strand", text(replaced(file, "0 1 0 0 255", "0 1e-6 0 0 255")), ok, "STRAND_MICRO", "strand 0"},
      {"a list that is longer than the file", text(replaced(file, "2 3 4\n", "9999999 3 4\n")), malformed, "PLY_PAST_END", "records with lists"},
      {"a list of negative length", text(replaced(file, "2 3 4\n", "-1 3 4\n")), malformed, "PLY_PAST_END", "records with lists"},
      {"trailing bytes", text(file + "1 2 3\n"), ok, "TRAILING_BYTES", "from byte"},
      {"LFS pointer", text(lfs), unknown, "GIT_LFS_POINTER", "git lfs pull"},
      {"HTML", text(html), unknown, "HTML_PAGE", "web page"},
  });
}

TEST(Catalogue, Tfxbone) {
  Bytes file;
  file.bytes = smallTfxbone();
  const auto u32 = [&](size_t at, uint64_t value) { return Bytes(file).setU32(at, value); };
  const auto f32 = [&](size_t at, float value) { return Bytes(file).setF32(at, value); };
  constexpr size_t bone = 53, weight = 57;  // of strand 0; the next ones are 8 bytes away, strand 1 is 36 bytes away
  Bytes twice = file;
  std::memcpy(twice.bytes.data() + 25, "root", 4);
  Bytes no_nul = file;
  no_nul.bytes[16] = 'x';
  checkRigs({
      {"0 bytes", file.cut(0), unknown, "FILE_EMPTY", "0 bytes"},
      {"1 byte", file.cut(1), malformed, "BONE_TABLE_PAST_END", "byte 1"},
      {"3 bytes", file.cut(3), malformed, "BONE_TABLE_PAST_END", "byte 3"},
      {"cut in a name", file.cut(28), malformed, "BONE_NAME_PAST_END", "bone 1 of 3 (byte 17)"},
      {"cut in a record", file.cut(60), malformed, "SKIN_PAST_END", "3 strands (byte 45)"},
      {"bones 0xFFFFFFFF", u32(0, 0xffffffffu), malformed, "BONE_TABLE_PAST_END", "(byte 0: -1 bones"},
      {"bones 2^31 - 1", u32(0, 0x7fffffffu), malformed, "BONE_TABLE_PAST_END", "(byte 0: 2147483647 bones"},
      {"strands -1", u32(45, 0xffffffffu), malformed, "SKIN_PAST_END", "-1 strands (byte 45)"},
      {"strands 2^31 - 1", u32(45, 0x7fffffffu), malformed, "SKIN_PAST_END", "2147483647 strands (byte 45)"},
      {"strands x 36 = 32 mod 2^32", u32(45, 0x071c71c8u), malformed, "SKIN_PAST_END", "(byte 45)"},
      {"name of -1", u32(8, 0xffffffffu), malformed, "BONE_NAME_PAST_END", "-1 bytes (byte 8)"},
      {"name of 2^31 - 1", u32(21, 0x7fffffffu), malformed, "BONE_NAME_PAST_END", "bone 1 of 3 (byte 17) has a name of 2147483647 bytes (byte 21)"},
      {"0 bones", u32(0, 0), empty, "RIG_NO_BONES", "0 bones (byte 0)"},
      {"0 strands", u32(45, 0), empty, "RIG_NO_RECORDS", "0 strands (byte 45)"},
      {"NaN", f32(weight, not_a_number), ok, "WEIGHT_INVALID", "strand 0 at byte 49"},
      {"negative", f32(weight + 36, -0.5f), ok, "WEIGHT_INVALID", "strand 1 at byte 85"},
      {"sum 0", f32(weight, 0), ok, "WEIGHTS_ALL_ZERO", "strand 0 at byte 49"},
      {"sum 0.8", f32(weight, 0.8f), ok, "WEIGHTS_NOT_NORMALISED", "the worst make 0.8 (number 0)"},
      {"placeholder", u32(bone + 24, 0xffffffffu), ok, "BONE_PLACEHOLDER", "strand 0 at byte 49"},
      {"past the table", u32(bone, 3), ok, "BONE_OUT_OF_RANGE", "strand 0 at byte 49"},
      {"the same name twice", twice, ok, "BONE_NAME_DUPLICATE", "\"root\" (bone 1 after bone 0)"},
      {"no NUL", no_nul, ok, "BONE_NAME_UNTERMINATED", "bone 0 at byte 12"},
      {"records at an odd byte", file, ok, "SKIN_RECORDS_UNALIGNED", "byte 49"},
      {"trailing bytes", Bytes(file).zeros(2), ok, "TRAILING_BYTES", "(2, from byte 157)"},
      {"hair", smallTfx(), unknown, "STRANDS_NOT_RIG", "TressFX hair"},
  });
}

TEST(Catalogue, Tfxmesh) {
  const std::string file = smallTfxmesh();
  const auto with = [&](const char* what, const std::string& by) { return text(replaced(file, what, by)); };
  checkRigs({
      {"0 bytes", text(""), unknown, "FILE_EMPTY", "0 bytes"},
      {"4 bytes", text(file.substr(0, 4)), unknown, "FORMAT_UNKNOWN", "numOfBones"},
      {"32 bytes", text(file.substr(0, 32)), malformed, "MESH_TRUNCATED", "2 bones (numOfBones at byte 22)"},
      {"cut in the vertices", text(file.substr(0, file.find("2 1 1 0"))), malformed, "MESH_TRUNCATED", "4 vertices (numOfVertices at byte"},
      {"bones 0xFFFFFFFF", with("numOfBones 2", "numOfBones 4294967295"), malformed, "MESH_TRUNCATED", "4294967295 bones (numOfBones at byte 22)"},
      {"vertices -1", with("numOfVertices 4", "numOfVertices -1"), malformed, "MESH_ROW", "a count of vertices"},
      {"triangles 2^31 - 1", with("numOfTriangles 2", "numOfTriangles 2147483647"), malformed, "MESH_TRUNCATED", "2147483647 triangles"},
      {"0 bones", with("numOfBones 2", "numOfBones 0"), empty, "RIG_NO_BONES", "0 bones"},
      {"0 vertices", with("numOfVertices 4", "numOfVertices 0"), empty, "RIG_NO_RECORDS", "0 vertices"},
      {"more rows counted than there are", with("numOfTriangles 2", "numOfTriangles 3"), malformed, "MESH_TRUNCATED", "3 triangles"},
      {"NaN", with("3 0 1e0 0", "3 nan 1e0 0"), ok, "MESH_POSITION_INVALID", "vertex 3"},
      {"sum 0.8", with("0.5 0.5 0 0", "0.5 0.3 0 0"), ok, "WEIGHTS_NOT_NORMALISED", "1 of 4 vertices do not make 1, the worst make 0.8"},
      {"negative", with("0.5 0.5 0 0", "0.5 -0.5 0 0"), ok, "WEIGHT_INVALID", "vertex 1"},
      {"bone past the table", with("0 1 0 0 0.5", "0 2 0 0 0.5"), ok, "BONE_OUT_OF_RANGE", "vertex 1"},
      {"triangle past the vertices", with("1 0 2 3", "1 0 2 4"), ok, "TRIANGLE_OUT_OF_RANGE", "triangle 1"},
      {"a word for a number", with("3 0 1e0 0", "3 x 1e0 0"), malformed, "MESH_ROW", "\"x\""},
      {"trailing bytes", text(file + "more\n"), ok, "TRAILING_BYTES", "from byte"},
  });
}
