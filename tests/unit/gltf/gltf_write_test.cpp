// What is written: read again bit for bit, always the same, and never over what was there. SPDX-License-Identifier: MIT
#include "gltf_kit.h"
#include "gltf_writer.h"
#include "groom.h"
#include "strand_formats.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <unistd.h>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

std::vector<unsigned char> contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class GltfWrite : public testing::Test {
protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  const fs::path folder_ = fs::temp_directory_path() / ("forelock_gltf_write." + std::to_string(::getpid()));
};

enum Has { kRadii = 1, kUvs = 2, kMasses = 4, kColors = 8 };

// Strands of 2 to 9 vertices with values of all bits that an asset may hold.
OpenedAsset randomAsset(uint32_t strands, int has, uint32_t seed = 3) {
  std::mt19937 random(seed);
  const auto between = [&](float low, float high) { return low + (high - low) * float(random()) / 4294967296.0f; };
  EditableStrands made;
  made.first_vertex.push_back(0);
  for (uint32_t i = 0; i < strands; ++i) {
    const uint32_t count = 2 + random() % 8;
    for (uint32_t v = 0; v < count; ++v) {
      for (int axis = 0; axis < 3; ++axis) made.positions.push_back(between(-1e6f, 1e6f) * std::pow(10.0f, -float(random() % 20)));
      if (has & kRadii) made.radii.push_back(random() % 50 == 0 ? 1e-42f : between(0, 0.01f));
      if (has & kMasses) made.inverse_masses.push_back(v < 2 ? 0.0f : between(0, 2));
      for (int c = 0; c < 3 && (has & kColors); ++c) made.colors.push_back(between(0, 1));
    }
    for (int c = 0; c < 2 && (has & kUvs); ++c) made.root_uvs.push_back(between(0, 1));
    made.first_vertex.push_back(made.first_vertex.back() + count);
  }
  return assetOf(made.view(), "random");
}

void expectSame(const OpenedAsset& before, const OpenedAsset& after) {
  FlkStrands a{}, b{};
  FlkAssetInfo info_a{}, info_b{};
  flkAssetGetStrands(before.asset.get(), &a), flkAssetGetStrands(after.asset.get(), &b);
  flkAssetGetInfo(before.asset.get(), &info_a), flkAssetGetInfo(after.asset.get(), &info_b);
  ASSERT_EQ(a.strand_count, b.strand_count);
  ASSERT_EQ(a.vertex_count, b.vertex_count);
  EXPECT_EQ(info_a.has_radii, info_b.has_radii);
  EXPECT_EQ(std::memcmp(a.first_vertex, b.first_vertex, 4 * (size_t(a.strand_count) + 1)), 0);
  const auto same = [](const float* x, const float* y, size_t count) { return (x == nullptr) == (y == nullptr) && (!x || std::memcmp(x, y, 4 * count) == 0); };
  EXPECT_TRUE(same(a.positions, b.positions, 3 * size_t(a.vertex_count)));
  EXPECT_TRUE(same(a.radii, b.radii, a.vertex_count));
  EXPECT_TRUE(same(a.root_uvs, b.root_uvs, 2 * size_t(a.strand_count)));
  EXPECT_TRUE(same(a.inverse_masses, b.inverse_masses, a.vertex_count));
  EXPECT_TRUE(same(a.colors, b.colors, 3 * size_t(a.vertex_count)));
}

TEST_F(GltfWrite, RoundTripsAreBitExactWithEverySetOfAttributes) {
  for (int has = 0; has < 16; ++has)
    for (const char* name : {"a.glb", "a.gltf"}) {
      const OpenedAsset before = randomAsset(40, has);
      EXPECT_TRUE(saveAsset(before, path(name)).empty()) << "nothing is lost";
      const OpenedAsset after = openAsset(path(name));
      SCOPED_TRACE(std::string(name) + " with attributes " + std::to_string(has));
      expectSame(before, after);
      EXPECT_TRUE(after.source_findings.empty());
      fs::remove(path("a.gltf")), fs::remove(path("a.bin"));
    }
}

TEST_F(GltfWrite, IndicesOf16And32BitsNeverUseTheLargestValue) {
  for (const uint32_t vertices : {65'535u, 65'536u}) {
    EditableStrands strands;
    strands.first_vertex = {0, vertices - 2, vertices};
    for (uint32_t v = 0; v < vertices; ++v) strands.positions.insert(strands.positions.end(), {float(v), float(v % 7), 0});
    const OpenedAsset before = assetOf(strands.view(), "long");
    const std::vector<unsigned char> file = writeGltf(before, "", "long").main;
    const std::string text(file.begin(), file.begin() + 2'000);
    EXPECT_NE(text.find(vertices == 65'535 ? "\"componentType\":5123" : "\"componentType\":5125"), std::string::npos) << text;
    saveAsset(before, path("long.glb"));
    expectSame(before, openAsset(path("long.glb")));
  }
}

TEST_F(GltfWrite, TheSameAssetGivesTheSameBytes) {
  const OpenedAsset asset = randomAsset(20, 15), again = randomAsset(20, 15);
  EXPECT_EQ(writeGltf(asset, "", "a").main, writeGltf(again, "", "b").main);
  saveAsset(asset, path("a.glb"));
  saveAsset(openAsset(path("a.glb")), path("b.glb"));
  EXPECT_EQ(contents(path("a.glb")), contents(path("b.glb"))) << "read and written again";
}

TEST_F(GltfWrite, GroupsBecomeMeshesAndComeBack) {
  OpenedAsset asset = randomAsset(6, kRadii);
  asset.groups = {0, 0, 1, 1, 1, 3};
  asset.group_names = {"fringe", "back \"of\" head", "none", "\xff"};
  EXPECT_TRUE(saveAsset(asset, path("a.glb")).empty());
  const OpenedAsset again = openAsset(path("a.glb"));
  expectSame(asset, again);
  EXPECT_EQ(again.groups, (std::vector<uint32_t>{0, 0, 1, 1, 1, 2}));
  EXPECT_EQ(again.group_names, (std::vector<std::string>{"fringe", "back \"of\" head", "\xef\xbf\xbd"})) << "what is no UTF-8 is replaced";

  asset.groups = {1, 0, 1, 1, 1, 3};
  const std::vector<AssetMessage> said = saveAsset(asset, path("b.glb"));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].id, "WRITE_REORDERS_STRANDS");
  EXPECT_EQ(said[0].severity, uint32_t{FLK_SEVERITY_INFO});
}

TEST_F(GltfWrite, OtherFormatsSayThatGroupsAreLost) {
  OpenedAsset asset = randomAsset(2, 0);
  asset.groups = {0, 1};
  asset.group_names = {"a", "b"};
  for (const auto& said : {rehearseSave(asset, path("a.ply")), saveAsset(asset, path("a.ply"))}) {
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].id, "WRITE_DROPS_GROUPS");
    EXPECT_EQ(said[0].text.rfind("random: ", 0), 0u);
  }
  EXPECT_TRUE(rehearseSave(asset, path("a.glb")).empty());
  EXPECT_FALSE(fs::exists(path("a.glb"))) << "a rehearsal writes nothing";
}

TEST_F(GltfWrite, NamesOfBuffersAreUris) {
  saveAsset(randomAsset(2, 0), path("my hair (2).gltf"));
  const std::vector<unsigned char> text = contents(path("my hair (2).gltf"));
  EXPECT_NE(std::string(text.begin(), text.end()).find("\"my%20hair%20%282%29.bin\""), std::string::npos);
  EXPECT_NO_THROW(openAsset(path("my hair (2).gltf")));
}

TEST_F(GltfWrite, AFileOfAnotherProgramIsNotOverwritten) {
  std::ofstream(path("hair.bin")) << "CT2Hair";
  try {
    saveAsset(randomAsset(2, 0), path("hair.gltf"));
    ADD_FAILURE();
  } catch (const AssetError& error) {
    EXPECT_NE(std::string(error.what()).find("hair.bin, which is there already"), std::string::npos) << error.what();
  }
  EXPECT_EQ(contents(path("hair.bin")).size(), 7u);
  EXPECT_FALSE(fs::exists(path("hair.gltf")));
  saveAsset(randomAsset(2, 0), path("other.gltf"));
  EXPECT_NO_THROW(saveAsset(randomAsset(3, 0), path("other.gltf"))) << "one that it replaces it may replace whole";
}

TEST_F(GltfWrite, AFailureLeavesWhatWasThereAndNothingElse) {
  fs::create_directories(path("taken.glb"));
  EXPECT_THROW(saveAsset(randomAsset(2, 0), path("taken.glb")), AssetError);
  EXPECT_THROW(saveAsset(randomAsset(2, 0), path("no-such-folder/a.glb")), AssetError);
  saveAsset(randomAsset(2, 0), path("pair.gltf"));
  const std::vector<unsigned char> before = contents(path("pair.gltf"));
  fs::remove(path("pair.bin"));
  fs::create_directories(path("pair.bin"));
  EXPECT_THROW(saveAsset(randomAsset(5, 0), path("pair.gltf")), AssetError);
  EXPECT_EQ(contents(path("pair.gltf")), before);
  size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++entries;
  EXPECT_EQ(entries, 3u) << "no temporary files";
}

TEST(StrandFormats, OneTableOfExtensions) {
  EXPECT_EQ(writableExtensions(), ".flk, .glb, .gltf, .hair, .ply or .tfx");
  EXPECT_STREQ(writableFormatOf("A.GLB")->extension, ".glb");
  EXPECT_EQ(writableFormatOf("a.tfx")->library, uint32_t{FLK_FORMAT_TFX});
  EXPECT_EQ(writableFormatOf("a.abc"), nullptr);
  EXPECT_EQ(writableFormatOf("glb"), nullptr);
}

}  // namespace
}  // namespace forelock::samples
