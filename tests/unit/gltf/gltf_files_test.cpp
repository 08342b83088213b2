// Files beside a glTF file, recognition by content, and what opening one gives. SPDX-License-Identifier: MIT
#include "gltf_kit.h"

#include <filesystem>
#include <fstream>
#include <sys/stat.h>

namespace forelock::samples {
namespace {

namespace fs = std::filesystem;

class GltfFiles : public testing::Test {
protected:
  void SetUp() override {
    fs::remove_all(root_);
    fs::create_directories(folder_ / "sub");
    maker_.primitive(kLineStrip, maker_.positionsAlongX(3));
    put(folder_ / "a.bin", std::string(maker_.bytes.begin(), maker_.bytes.end()));
    fs::copy(folder_ / "a.bin", folder_ / "sub/with space.bin");
    fs::copy(folder_ / "a.bin", root_ / "outside.bin");
  }
  void TearDown() override { fs::remove_all(root_); }

  static void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }
  std::string refusal(const std::string& uri) { return refusalOf(bytesOf(maker_.gltf(uri)), folder_); }

  // A process of its own: tests of this room may run side by side.
  const fs::path root_ = fs::temp_directory_path() / ("forelock_gltf_test." + std::to_string(::getpid()));
  const fs::path folder_ = root_ / "asset";
  GltfMaker maker_;
};

TEST_F(GltfFiles, FilesInsideTheFolderAreRead) {
  EXPECT_EQ(refusal("a.bin"), "");
  EXPECT_EQ(refusal("./a.bin"), "");
  EXPECT_EQ(refusal("sub/with%20space.bin"), "");
  fs::create_symlink("a.bin", folder_ / "link.bin");
  EXPECT_EQ(refusal("link.bin"), "") << "a link that stays inside";
}

TEST_F(GltfFiles, NothingOutsideIsRead) {
  fs::create_symlink(root_ / "outside.bin", folder_ / "out.bin");
  fs::create_directory_symlink(root_, folder_ / "up");
  for (const std::string uri : {"../outside.bin", "sub/../../outside.bin", "sub/../a.bin", "%2e%2e/outside.bin", "..%2foutside.bin", "/etc/passwd", "//host/a.bin",
                                "file:///etc/passwd", "http://example.com/a.bin", "C:\\\\a.bin", "..\\\\outside.bin", "out.bin", "up/outside.bin", "a%00.bin", "."}) {
    const std::string said = refusal(uri);
    EXPECT_EQ(said.rfind("GLTF_URI: buffers[0].uri is ", 0), 0u) << uri << ": " << said;
  }
  EXPECT_NE(refusal("http://example.com/a.bin").find("nothing from elsewhere"), std::string::npos);
  EXPECT_NE(refusal("out.bin").find("a link that leaves the folder"), std::string::npos);
  EXPECT_EQ(refusalOf(bytesOf(maker_.gltf("a.bin"))).rfind("GLTF_URI: ", 0), 0u) << "no folder, no files";
}

TEST_F(GltfFiles, FilesThatCannotBeReadAreNamed) {
  EXPECT_EQ(refusal("b.bin").rfind("GLTF_FILE: buffers[0].uri names b.bin, which cannot be opened", 0), 0u) << refusal("b.bin");
  EXPECT_EQ(refusal("sub").rfind("GLTF_FILE: ", 0), 0u) << refusal("sub");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal("pipe").rfind("GLTF_FILE: ", 0), 0u) << refusal("pipe");
  put(folder_ / "short.bin", "1234");
  EXPECT_NE(refusal("short.bin").find("buffers[0].byteLength is 36, but short.bin holds 4 bytes"), std::string::npos) << refusal("short.bin");
  put(folder_ / "longer.bin", std::string(100, '\0'));
  EXPECT_EQ(refusal("longer.bin"), "") << "byteLength says how much of it is meant";
}

TEST_F(GltfFiles, DataUris) {
  const std::string bytes = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAQAAAAAAAAAAA";
  EXPECT_EQ(refusal("data:application/octet-stream;base64," + bytes), "");
  EXPECT_EQ(refusal("data:;base64," + bytes), "");
  EXPECT_EQ(refusal("data:application/gltf-buffer;base64," + bytes), "");
  EXPECT_EQ(refusal("data:application/octet-stream," + bytes).rfind("GLTF_URI: ", 0), 0u);
  EXPECT_EQ(refusal("data:").rfind("GLTF_URI: ", 0), 0u);
  EXPECT_NE(refusal("data:;base64,AAAA").find("buffers[0].byteLength is 36"), std::string::npos);
  EXPECT_NE(refusal("data:;base64,AAAA!" + bytes).find("buffers[0].byteLength is 36, but its data: URI holds 3 bytes"), std::string::npos);
}

TEST_F(GltfFiles, KnownByContentWhateverTheName) {
  const std::string text = maker_.gltf("a.bin");
  put(folder_ / "hair.json", text);
  EXPECT_EQ(openAsset((folder_ / "hair.json").string()).format, "gltf");
  put(folder_ / "late.txt", "\xef\xbb\xbf {\"extras\": \"" + std::string(200'000, 'x') + "\", " + text.substr(1));
  EXPECT_EQ(openAsset((folder_ / "late.txt").string()).format, "gltf") << "a byte order mark, and an asset that comes last";
  const std::vector<unsigned char> glb = maker_.glb();
  put(folder_ / "hair.tfx", std::string(glb.begin(), glb.end()));
  EXPECT_EQ(openAsset((folder_ / "hair.tfx").string()).format, "gltf");

  put(folder_ / "recipe.json", R"({"strands": 7, "vertices": 5, "name": "asset"})");
  EXPECT_EQ(openAsset((folder_ / "recipe.json").string()).format, "groom");
  put(folder_ / "pointer.glb", "version https://git-lfs.github.com/spec/v1\n");
  try {
    openAsset((folder_ / "pointer.glb").string());
    ADD_FAILURE();
  } catch (const AssetError& error) {
    EXPECT_NE(std::string(error.what()).find("Git LFS"), std::string::npos) << error.what();
  }
}

TEST_F(GltfFiles, AnAssetCarriesFindingsWarningsAndGroupsOfTheStrandsThatAreLeft) {
  GltfMaker maker;
  maker.primitive(kLineStrip, maker.positions({1, 1, 1, 1, 1, 1}));  // of zero length
  maker.json["meshes"].push_back(Json{{"primitives", Json::array()}});
  const int positions = maker.positionsAlongX(3);
  maker.primitive(kLineLoop, positions);
  maker.json["meshes"][1]["primitives"].push_back({{"attributes", {{"POSITION", maker.positionsAlongX(4)}}}, {"mode", kLineStrip}});
  maker.json["nodes"] = Json::parse(R"([{"mesh": 0, "name": "a"}, {"mesh": 1, "name": "b"}])");
  maker.json["scenes"][0]["nodes"] = {0, 1};
  const std::vector<unsigned char> glb = maker.glb();
  const std::string path = (folder_ / "two.glb").string();
  put(path, std::string(glb.begin(), glb.end()));
  const OpenedAsset opened = openAsset(path);
  EXPECT_EQ(opened.groups, (std::vector<uint32_t>{0, 1})) << "strand 0 of group a was dropped";
  EXPECT_EQ(opened.group_names, (std::vector<std::string>{"a", "b"}));
  std::vector<std::string> codes, warned;
  for (const AssetFinding& finding : findingsOf(opened)) codes.push_back(finding.code);
  for (const AssetMessage& message : *opened.messages) {
    warned.push_back(message.id);
    EXPECT_EQ(message.text.rfind(path + ": ", 0), 0u) << message.text;
  }
  EXPECT_EQ(codes, (std::vector<std::string>{"GLTF_LOOP_OPENED", "STRAND_ZERO_LENGTH", "WIDTH_DEFAULTED"}));
  EXPECT_EQ(warned, (std::vector<std::string>{"GLTF_LOOP_OPENED", "STRAND_ZERO_LENGTH"}));
}

TEST_F(GltfFiles, ErrorsBeginWithThePath) {
  const std::string path = (folder_ / "bad.gltf").string();
  put(path, R"({"asset": {"version": "2.0"}, "meshes": 5})");
  try {
    openAsset(path);
    ADD_FAILURE();
  } catch (const AssetError& error) {
    EXPECT_EQ(std::string(error.what()).rfind(path + ": meshes is 5", 0), 0u) << error.what();
    EXPECT_EQ(error.result, FLK_ERROR_MALFORMED);
  }
}

}  // namespace
}  // namespace forelock::samples
