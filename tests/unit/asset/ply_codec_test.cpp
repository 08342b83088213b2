// PLY files with strands.
#include "asset_kit.h"

#include <algorithm>

using namespace asset_test;

namespace {

std::unique_ptr<Loaded> loadText(const std::string& text, uint32_t max_strands = 0, uint32_t max_vertices = 0) {
  return load(Bytes().text(text), "hair.ply", max_strands, max_vertices);
}

void expectRefusal(const std::string& text, FlkResult result, const char* id, const std::string& says) {
  expectRefused(Bytes().text(text), "hair.ply", result, id, says);
}

// Two strands of two vertices with u and v, in either byte order.
Bytes binary(bool big) {
  Bytes file;
  file.text(std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
            "_endian 1.0\r\nelement strand 2\r\nproperty uint8 nsegs\r\nproperty float u\r\nproperty float v\r\n"
            "element vertex 4\r\nproperty int16 ignored\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nend_header\r\n");
  const auto put = [&](unsigned char* bytes, size_t size) {
    if (big) std::reverse(bytes, bytes + size);
    file.bytes.insert(file.bytes.end(), bytes, bytes + size);
  };
  const auto f32 = [&](float value) {
    unsigned char bytes[4];
    std::memcpy(bytes, &value, 4);
    put(bytes, 4);
  };
  for (int strand = 0; strand < 2; ++strand) {
    file.bytes.push_back(1);
    f32(0.25f), f32(0.5f * static_cast<float>(strand));
  }
  for (int vertex = 0; vertex < 4; ++vertex) {
    unsigned char ignored[2] = {0xff, 0xff};
    put(ignored, 2);
    for (int axis = 0; axis < 3; ++axis) f32(0.125f * static_cast<float>(3 * vertex + axis));
  }
  return file;
}

}  // namespace

TEST(Ply, ReadsText) {
  const auto loaded = loadText(smallPlyText());
  ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
  EXPECT_EQ(loaded->info().format, uint32_t{FLK_FORMAT_PLY});
  const FlkStrands strands = loaded->strands();
  ASSERT_EQ(strands.strand_count, 2u);
  ASSERT_EQ(strands.vertex_count, 5u);
  EXPECT_EQ(strands.first_vertex[1], 2u);
  EXPECT_EQ(strands.positions[14], 0.125f);
  EXPECT_EQ(strands.radii[4], 0.0625f) << "thickness is the diameter";
  EXPECT_EQ(strands.colors[0], 1.0f);
  EXPECT_EQ(strands.colors[9], 0.2f);
  EXPECT_EQ(strands.root_uvs, nullptr);
  EXPECT_EQ(loaded->codes(), "PLY_ALPHA_IGNORED");
}

TEST(Ply, ReadsBothByteOrders) {
  for (const bool big : {false, true}) {
    const auto loaded = load(binary(big));
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    EXPECT_EQ(loaded->strands().positions[11], 1.375f);
    EXPECT_EQ(loaded->strands().root_uvs[3], 0.5f);
    EXPECT_EQ(loaded->codes(), "WIDTH_DEFAULTED");
  }
}

TEST(Ply, KeepsWhatTheAssetHas) {
  for (const unsigned flags : {2u, 7u, 63u}) {
    const auto loaded = load(smallHair(flags));
    ASSERT_EQ(loaded->result, FLK_SUCCESS);
    EXPECT_EQ(brokenRoundTrip(loaded->asset.get()), nullptr);
  }
  const auto tfx = load(smallTfx());
  ASSERT_EQ(tfx->result, FLK_SUCCESS);
  EXPECT_EQ(brokenRoundTrip(tfx->asset.get()), nullptr);
  FlkResult result;
  const size_t said = tfx->caught.all.size();
  const std::vector<unsigned char> bytes = saved(tfx->asset.get(), FLK_FORMAT_PLY, result);
  ASSERT_EQ(result, FLK_SUCCESS);
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_NE(text.find("element strand 3\n"), std::string::npos);
  EXPECT_NE(text.find("element edge 9\n"), std::string::npos);
  EXPECT_EQ(tfx->caught.all.size(), said) << "nothing is lost, so nothing is said: " << tfx->caught.text();
}

TEST(Ply, OddButUsable) {
  const auto unused = loadText(replaced(smallPlyText(), "1\n2\n2 0 1", "1\n1\n2 0 1"));
  ASSERT_EQ(unused->result, FLK_SUCCESS) << unused->caught.text();
  EXPECT_EQ(unused->finding("PLY_VERTICES_UNUSED").count, 1u);
  EXPECT_EQ(unused->info().vertex_count, 4u);
  const auto trailing = loadText(smallPlyText() + "1 2 3\n");
  ASSERT_EQ(trailing->result, FLK_SUCCESS);
  EXPECT_GT(trailing->finding("TRAILING_BYTES").count, 0u);
}

// Without properties its records take no bytes, however many there are.
TEST(Ply, RecordsOfNothing) {
  const auto loaded = loadText(replaced(smallPlyText(), "element edge 3\nproperty list uchar int ends", "element edge 4611686018427387904"));
  EXPECT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
}

// Properties of every type, in both byte orders: what is used may have any.
TEST(Ply, EveryType) {
  for (const bool big : {false, true}) {
    Bytes file;
    file.text(std::string("ply\nformat binary_") + (big ? "big" : "little") +
              "_endian 1.0\nelement vertex 2\nproperty int8 a\nproperty uint16 x\nproperty int32 y\nproperty double z\nproperty uint32 b\n"
              "property list int16 short c\nelement strand 1\nproperty int nsegs\nend_header\n");
    const auto put = [&](uint64_t bits, int size) {
      for (int i = 0; i < size; ++i) file.bytes.push_back(static_cast<unsigned char>(bits >> (8 * (big ? size - 1 - i : i))));
    };
    for (int vertex = 0; vertex < 2; ++vertex) {
      put(0x80, 1);
      put(vertex ? 0xffff : 3, 2);
      put(vertex ? 0xfffffffe : 4, 4);
      put(vertex ? 0x4004000000000000 : 0xbfe0000000000000, 8);  // 2.5, -0.5
      put(0xffffffff, 4);
      put(1, 2);
      put(0x8000, 2);
    }
    put(1, 4);
    const auto loaded = load(file);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    const float expected[6] = {3, 4, -0.5f, 65535, -2, 2.5f};
    EXPECT_EQ(std::memcmp(loaded->strands().positions, expected, sizeof expected), 0);
    EXPECT_EQ(load(file.cut(file.size() - 1))->caught.error(), "PLY_PAST_END");
  }
}

// As NeuralHaircut writes them: vertices, and nothing that says which make a strand.
TEST(Ply, BarePoints) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 6; ++i) text += std::to_string(i / 3) + " " + std::to_string(i % 3) + " 0\n";
  const auto loadPoints = [&](const std::string& file, uint32_t points_per_strand, uint32_t max_strands = 0) {
    auto loaded = std::make_unique<Loaded>();
    FlkAssetOptions options = optionsFor(loaded->caught, "points.ply");
    options.points_per_strand = points_per_strand;
    options.max_strands = max_strands;
    FlkAsset asset = nullptr;
    loaded->result = flkAssetLoadMemory(file.data(), file.size(), &options, &asset);
    loaded->asset.reset(asset);
    if (asset) {
      EXPECT_EQ(brokenPromise(asset), nullptr);
      EXPECT_EQ(brokenRoundTrip(asset), nullptr);
    }
    return loaded;
  };
  const auto three = loadPoints(text, 3);
  ASSERT_EQ(three->result, FLK_SUCCESS) << three->caught.text();
  EXPECT_EQ(three->info().strand_count, 2u);
  EXPECT_EQ(three->strands().first_vertex[1], 3u);
  EXPECT_EQ(three->strands().positions[9], 1.0f);
  EXPECT_EQ(three->codes(), "WIDTH_DEFAULTED");
  EXPECT_EQ(loadPoints(text, 2)->info().strand_count, 3u);
  EXPECT_EQ(loadPoints(text, 6)->info().strand_count, 1u);

  const auto refused = [&](const std::string& file, uint32_t points, FlkResult result, const char* id, const char* says) {
    const auto loaded = loadPoints(file, points);
    EXPECT_EQ(loaded->result, result) << loaded->caught.text();
    EXPECT_EQ(loaded->caught.error(), id);
    EXPECT_NE(loaded->caught.text().find(says), std::string::npos) << loaded->caught.text();
  };
  refused(text, 0, FLK_ERROR_FORMAT_UNKNOWN, "PLY_NO_STRANDS", "points_per_strand");
  refused(text, 1, FLK_ERROR_INVALID_ARGUMENT, "INVALID_ARGUMENT", "points_per_strand is 1");
  refused(text, 4, FLK_ERROR_MALFORMED, "PLY_POINTS_DISAGREE", "its 6 points (byte 36) make 1 strands of points_per_strand = 4 and leave 2 over");
  refused(text, 7, FLK_ERROR_MALFORMED, "PLY_POINTS_DISAGREE", "leave 6 over");
  refused(text, UINT32_MAX, FLK_ERROR_MALFORMED, "PLY_POINTS_DISAGREE", "leave 6 over");
  refused(replaced(text, "vertex 6", "vertex 0"), 3, FLK_ERROR_EMPTY_ASSET, "PLY_EMPTY", "0 vertices");
  refused(replaced(text, "vertex 6", "vertex 4611686018427387904"), 2, FLK_ERROR_MALFORMED, "PLY_PAST_END", "truncated");
  refused(replaced(text, "end_header", "element face 2\nproperty list uchar int i\nend_header"), 3, FLK_ERROR_FORMAT_UNKNOWN, "PLY_MESH", "2 faces");
  EXPECT_EQ(loadPoints(text, 2, 2)->caught.error(), "PLY_TOO_LARGE");
  const auto told = loadPoints(smallPlyText(), 3);
  ASSERT_EQ(told->result, FLK_SUCCESS);
  EXPECT_EQ(told->strands().first_vertex[1], 2u) << "the file's own strands count";
}

TEST(Ply, Refusals) {
  const std::string text = smallPlyText();
  expectRefusal("ply\n", FLK_ERROR_MALFORMED, "PLY_HEADER", "format");
  expectRefusal(replaced(text, "ascii", "utf8"), FLK_ERROR_MALFORMED, "PLY_HEADER", "utf8");
  expectRefusal(replaced(text, "ascii 1.0", "ascii 2.0"), FLK_ERROR_MALFORMED, "PLY_HEADER", "2.0");
  expectRefusal(replaced(text, "element vertex 5", "element vertex -5"), FLK_ERROR_MALFORMED, "PLY_HEADER", "-5");
  expectRefusal(replaced(text, "property double z", "property real z"), FLK_ERROR_MALFORMED, "PLY_HEADER", "real");
  expectRefusal(replaced(text, "list uchar", "list float"), FLK_ERROR_MALFORMED, "PLY_HEADER", "float");
  expectRefusal(replaced(text, "comment", "remark"), FLK_ERROR_MALFORMED, "PLY_HEADER", "remark");
  expectRefusal("ply\nformat ascii 1.0\nproperty float x\n", FLK_ERROR_MALFORMED, "PLY_HEADER", "element should come before");
  expectRefusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float", FLK_ERROR_MALFORMED, "PLY_HEADER", "name");
  std::string many = "ply\nformat ascii 1.0\n", wide = "ply\nformat ascii 1.0\nelement vertex 1\n";
  for (int i = 0; i < 17; ++i) many += "element e 0\n";
  for (int i = 0; i < 65; ++i) wide += "property float p\n";
  expectRefusal(many, FLK_ERROR_MALFORMED, "PLY_HEADER", "16 elements");
  expectRefusal(wide, FLK_ERROR_MALFORMED, "PLY_HEADER", "64 properties");
  expectRefusal(replaced(text, "property double z", "property double depth"), FLK_ERROR_MALFORMED, "PLY_NO_POSITIONS", "x, y and z");
  expectRefusal(replaced(text, "nsegs", "segments"), FLK_ERROR_FORMAT_UNKNOWN, "PLY_NO_STRANDS", "5 points");
  expectRefusal(replaced(text, "element vertex 5", "element vertex 0"), FLK_ERROR_EMPTY_ASSET, "PLY_EMPTY", "nothing to load");
  expectRefusal(replaced(text, "element vertex 5", "element vertex 4611686018427387904"), FLK_ERROR_MALFORMED, "PLY_PAST_END", "truncated");
  expectRefusal(replaced(text, "1\n2\n2 0 1", "1\n3\n2 0 1"), FLK_ERROR_MALFORMED, "PLY_SEGMENTS_DISAGREE", "3 segments");
  expectRefusal(replaced(text, "1\n2\n2 0 1", "1\n-2\n2 0 1"), FLK_ERROR_MALFORMED, "PLY_SEGMENTS_DISAGREE", "-2 segments");
  expectRefusal(replaced(text, "2 3 4\n", "9999 3 4\n"), FLK_ERROR_MALFORMED, "PLY_PAST_END", "records");
  expectRefusal(replaced(text, "0 0 0 255", "0 0 zero 255"), FLK_ERROR_MALFORMED, "PLY_PAST_END", "no number");
  EXPECT_EQ(loadText(text, 1)->caught.error(), "PLY_TOO_LARGE");
  EXPECT_EQ(loadText(text, 0, 4)->caught.error(), "PLY_TOO_LARGE");
  const Bytes file = binary(false);
  EXPECT_EQ(load(file.cut(file.size() - 1))->caught.error(), "PLY_PAST_END");
}

TEST(Ply, HeldByTheFormat) {
  const uint32_t first[] = {0, 65'537};
  std::vector<float> positions(65'537 * 3);
  for (size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<float>(i) * 1e-5f;
  const FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 1, 65'537, first, positions.data(), nullptr, nullptr, nullptr, nullptr};
  Caught caught;
  const FlkAssetOptions options = optionsFor(caught, "long");
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_SUCCESS);
  const Owned owned(asset);
  size_t size = 0;
  EXPECT_EQ(flkAssetSaveMemory(asset, FLK_FORMAT_PLY, nullptr, &size), FLK_ERROR_LIMIT);
  EXPECT_EQ(caught.error(), "WRITE_PLY_STRAND_TOO_LONG");
  EXPECT_EQ(flkAssetSaveMemory(asset, FLK_FORMAT_STRAND_DATA, nullptr, &size), FLK_ERROR_INVALID_ARGUMENT) << "it is only read";
}
