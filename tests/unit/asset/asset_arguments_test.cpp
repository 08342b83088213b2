#include "asset_kit.h"

using namespace asset_test;

namespace {

const uint32_t first_vertex[] = {0, 2, 5};
const float positions[15] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0};

FlkStrands goodStrands() {
  FlkStrands strands{};
  strands.type = FLK_TYPE_STRANDS;
  strands.strand_count = 2;
  strands.vertex_count = 5;
  strands.first_vertex = first_vertex;
  strands.positions = positions;
  return strands;
}

Owned goodAsset() {
  const FlkStrands strands = goodStrands();
  FlkAsset asset = nullptr;
  EXPECT_EQ(flkAssetCreate(&strands, nullptr, &asset), FLK_SUCCESS);
  return Owned(asset);
}

}  // namespace

TEST(AssetArguments, Version) {
  EXPECT_EQ(flkGetVersion(), FLK_VERSION_MAJOR << 22 | FLK_VERSION_MINOR << 12 | FLK_VERSION_PATCH);
}

TEST(AssetArguments, ResultNames) {
  EXPECT_STREQ(flkResultName(FLK_SUCCESS), "FLK_SUCCESS");
  EXPECT_STREQ(flkResultName(FLK_NOT_READY), "FLK_NOT_READY");
  for (FlkResult result = -1; result >= -13; --result) EXPECT_EQ(std::string(flkResultName(result)).rfind("FLK_ERROR_", 0), 0u);
  for (const FlkResult result : {2, -14, INT32_MIN, INT32_MAX}) EXPECT_STREQ(flkResultName(result), "unknown");
}

TEST(AssetArguments, Strands) {
  const auto refused = [](const FlkStrands* strands, FlkResult expected = FLK_ERROR_INVALID_ARGUMENT) {
    Caught caught;
    const FlkAssetOptions options = optionsFor(caught, "args");
    FlkAsset asset = reinterpret_cast<FlkAsset>(&caught);
    EXPECT_EQ(flkAssetCreate(strands, &options, &asset), expected);
    EXPECT_EQ(asset, nullptr);
    EXPECT_EQ(caught.all.size(), 1u);
    EXPECT_EQ(caught.text().find("args: ") == std::string::npos, false) << caught.text();
  };
  refused(nullptr);
  FlkStrands strands = goodStrands();
  strands.type = FLK_TYPE_ASSET_OPTIONS;
  refused(&strands);
  strands = goodStrands();
  strands.next = &strands;
  refused(&strands);
  strands = goodStrands();
  strands.first_vertex = nullptr;
  refused(&strands);
  strands = goodStrands();
  strands.positions = nullptr;
  refused(&strands);
  strands = goodStrands();
  strands.strand_count = 0;
  refused(&strands);
  strands = goodStrands();
  strands.vertex_count = 0;
  refused(&strands);
  strands = goodStrands();
  strands.vertex_count = 4;
  refused(&strands);
  const uint32_t late[] = {1, 2, 5}, falling[] = {0, 6, 5};
  strands = goodStrands();
  strands.first_vertex = late;
  refused(&strands);
  strands.first_vertex = falling;
  refused(&strands);
  // Beyond the limits nothing is read: these arrays are far shorter than the counts.
  strands = goodStrands();
  strands.strand_count = 4'194'305;
  refused(&strands, FLK_ERROR_LIMIT);
  strands = goodStrands();
  strands.vertex_count = 268'435'457;
  refused(&strands, FLK_ERROR_LIMIT);
}

TEST(AssetArguments, Limits) {
  Caught caught;
  FlkAssetOptions options = optionsFor(caught, "args");
  const FlkStrands strands = goodStrands();
  FlkAsset asset = nullptr;
  options.max_strands = 1;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_ERROR_LIMIT);
  options.max_strands = UINT32_MAX;
  options.max_vertices = 4;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_ERROR_LIMIT);
  options.max_vertices = 5;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_SUCCESS);
  flkAssetDestroy(asset);
}

TEST(AssetArguments, Options) {
  const FlkStrands strands = goodStrands();
  Caught caught;
  FlkAsset asset = reinterpret_cast<FlkAsset>(&caught);
  FlkAssetOptions options = optionsFor(caught, "args");
  options.type = FLK_TYPE_STRANDS;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(asset, nullptr);
  EXPECT_TRUE(caught.all.empty()) << "nothing of a wrong struct is used";
  options = optionsFor(caught, "args");
  options.next = &options;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_ERROR_INVALID_ARGUMENT);
  CountingAllocator counter;
  FlkHostAllocator half = counter.callbacks();
  half.free = nullptr;
  options = optionsFor(caught, "args");
  options.allocator = &half;
  EXPECT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_ERROR_INVALID_ARGUMENT);
  half = counter.callbacks();
  half.allocate = nullptr;
  EXPECT_EQ(flkAssetLoadMemory("HAIR", 4, &options, &asset), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(counter.asked, 0u);
  EXPECT_EQ(caught.all.size(), 3u) << caught.text();
}

TEST(AssetArguments, Nulls) {
  const FlkStrands strands = goodStrands();
  EXPECT_EQ(flkAssetCreate(&strands, nullptr, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetLoadMemory("x", 1, nullptr, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetLoadFile("x", nullptr, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  FlkAsset none = nullptr;
  EXPECT_EQ(flkAssetLoadMemory(nullptr, 1, nullptr, &none), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetLoadMemory(nullptr, 0, nullptr, &none), FLK_ERROR_FORMAT_UNKNOWN);
  EXPECT_EQ(flkAssetLoadFile(nullptr, nullptr, &none), FLK_ERROR_INVALID_ARGUMENT);
  FlkAssetInfo info;
  FlkStrands got;
  FlkFinding finding;
  size_t size = 0;
  EXPECT_EQ(flkAssetGetInfo(nullptr, &info), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetGetStrands(nullptr, &got), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetGetFinding(nullptr, 0, &finding), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetSaveMemory(nullptr, FLK_FORMAT_TFX, nullptr, &size), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetSaveFile(nullptr, FLK_FORMAT_TFX, "x"), FLK_ERROR_INVALID_ARGUMENT);
  flkAssetDestroy(nullptr);

  const Owned asset = goodAsset();
  EXPECT_EQ(flkAssetGetInfo(asset.get(), nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetGetStrands(asset.get(), nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetGetFinding(asset.get(), 0, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetGetFinding(asset.get(), UINT32_MAX, &finding), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetSaveMemory(asset.get(), FLK_FORMAT_HAIR, nullptr, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkAssetSaveFile(asset.get(), FLK_FORMAT_HAIR, nullptr), FLK_ERROR_INVALID_ARGUMENT);
}

TEST(AssetArguments, ReportsTheMemoryItHolds) {
  CountingAllocator counter;
  const FlkHostAllocator allocator = counter.callbacks();
  FlkAssetOptions options{};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.allocator = &allocator;
  options.name = "a name that is too long to be kept inside a string object";
  const FlkStrands strands = goodStrands();
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&strands, &options, &asset), FLK_SUCCESS);
  FlkAssetInfo info;
  flkAssetGetInfo(asset, &info);
  EXPECT_NEAR(static_cast<double>(info.bytes_host), static_cast<double>(counter.live_bytes), 64.0);
  flkAssetDestroy(asset);
  EXPECT_EQ(counter.live, 0u);
  EXPECT_EQ(counter.live_bytes, 0u);
}
