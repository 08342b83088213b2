// `forelock preview` on the best device there is.
#include "command_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using forelock::test::readAll;
using forelock::test::runCommand;
using forelock::test::scratchFolder;
using forelock::test::smallRecipe;
using forelock::test::writeScratch;

namespace {

nlohmann::json previewOf(const std::string& name, const std::string& arguments) {
  const auto run = runCommand("preview --json --validation -o " + (scratchFolder() / name).string() + " " + arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

// Of a PNG's header.
uint32_t bigEndian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

// A triangle before the camera of a framed groom, as the text of a .gltf file.
std::string triangleFile(int mode) {
  const std::string positions = "AAAAvwAAAL8AAIA+AAAAPwAAAL8AAIA+AAAAAAAAAD8AAIA+";  // (-0.5, -0.5, 0.25), (0.5, -0.5, 0.25), (0, 0.5, 0.25)
  return writeScratch("triangle" + std::to_string(mode) + ".gltf",
                      R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": )" + std::to_string(mode) + R"(}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" + positions + R"("}]})");
}

}  // namespace

TEST(PreviewCommand, AMeshHidesHair) {
  const std::string arguments = smallRecipe() + " --size 64x64 --azimuth 0 ";
  const nlohmann::json bare = previewOf("bare.png", arguments);
  const nlohmann::json hidden = previewOf("hidden.png", arguments + "--mesh " + triangleFile(4));
  ASSERT_TRUE(bare.is_object() && hidden.is_object());
  EXPECT_LT(hidden.at("hair_pixels"), bare.at("hair_pixels")) << "the triangle is before the head";
  EXPECT_NE(readAll(scratchFolder() / "bare.png"), readAll(scratchFolder() / "hidden.png"));
}

TEST(PreviewCommand, HairIsNoMesh) {
  const auto run = runCommand("preview -o " + (scratchFolder() / "no.png").string() + " " + smallRecipe() + " --mesh " + triangleFile(3));
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("it is hair, not a mesh; name it as ASSET"), std::string::npos) << run.err;
}

TEST(PreviewCommand, DrawsHairOverTheBust) {
  const nlohmann::json said = previewOf("hair.png", smallRecipe() + " --size 96x64");
  ASSERT_TRUE(said.is_object());
  EXPECT_GT(said.at("hair_pixels"), 100);
  EXPECT_GE(said.at("fragments"), said.at("hair_pixels"));  // a pixel of hair has at least one fragment
  EXPECT_EQ(said.at("overflow_fragments"), 0);
  EXPECT_GT(said.at("exposure"), 0.0);
  const std::string png = readAll(scratchFolder() / "hair.png");
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(bigEndian(png, 16), 96u);
  EXPECT_EQ(bigEndian(png, 20), 64u);
  EXPECT_EQ(png[25], 6) << "colour type: with alpha";
}

TEST(PreviewCommand, SameCommandSamePicture) {
  const std::string arguments = smallRecipe() + " --size 64x64 --method exact --no-head";
  previewOf("one.png", arguments);
  previewOf("two.png", arguments);
  EXPECT_EQ(readAll(scratchFolder() / "one.png"), readAll(scratchFolder() / "two.png"));
}

TEST(PreviewCommand, EveryColorModeMethodAndFormat) {
  for (const char* more : {"--color strand", "--color root-tip", "--color width", "--color depth", "--color layers",
                           "--method forward", "--method forward --payload paper", "--k 0", "--no-shadow",
                           "--method core_only", "--method all_low --tail list", "--method hard --tip-color d8a860",
                           "--capture compute --follow 2",
                           "--hair-color 101010 --alpha 1 --width 2 --light=60,20 --background ffffff --up z"}) {
    const nlohmann::json said = previewOf("mode.exr", smallRecipe() + " --size 48x48 " + more);
    ASSERT_TRUE(said.is_object()) << more;
    EXPECT_GT(said.at("hair_pixels"), 0) << more;
  }
}

TEST(PreviewCommand, LightsSkyLensAndScalp) {
  smallRecipe();
  const std::string scene = writeScratch("lit.json", R"({"assets": [{"source": "small.json", "scale": 1}], "size": [48, 48],
      "lights": [{"kind": "point", "position": [0.3, 0, 0.3], "intensity": 0.1, "shadow_size": 128},
                 {"kind": "point", "position": [0, 0, 0.05], "intensity": 0.001, "shadow_size": 64},
                 {"kind": "spot", "position": [-0.4, 0.6, -0.6], "color": "#9fc6ff", "shadow_size": 128},
                 {"azimuth": 120, "shadow_size": 128}],
      "sky": {"top": "#ffffff", "bottom": "#000000"}, "near_fade": {"end_m": 0.1},
      "lens": {"center": [0.5, 0.4], "inside": 0}})");
  const nlohmann::json with = previewOf("lit.png", "--head --scene " + scene);
  ASSERT_TRUE(with.is_object());
  EXPECT_EQ(with.at("lights"), 4);
  EXPECT_GT(with.at("hair_pixels"), 0);
  const std::string dark = writeScratch("unlit.json", R"({"assets": [{"source": "small.json"}], "size": [48, 48],
      "lights": [], "ambient": [0, 0, 0]})");
  EXPECT_TRUE(previewOf("unlit.png", "--scene " + dark).is_object()) << "black, but no failure";
}

TEST(PreviewCommand, TurntableWritesViewsAndSheet) {
  previewOf("turn.png", smallRecipe() + " --size 32x40 --turntable 3");
  for (const char* name : {"turn-000.png", "turn-001.png", "turn-002.png"}) {
    EXPECT_TRUE(std::filesystem::exists(scratchFolder() / name)) << name;
  }
  const std::string sheet = readAll(scratchFolder() / "turn.png");
  ASSERT_GT(sheet.size(), 33u);
  EXPECT_EQ(bigEndian(sheet, 16), 64u);  // two columns, two rows
  EXPECT_EQ(bigEndian(sheet, 20), 80u);
}

TEST(PreviewCommand, APictureThatCannotBeWrittenIsOne) {
  const auto run = runCommand("preview " + smallRecipe() + " --size 16x16 -o /nonexistent/x.png");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.err.rfind("forelock: /nonexistent/x.png: ", 0), 0u) << run.err;
}

TEST(PreviewCommand, AnInlineSceneIsTheSamePicture) {
  const std::string camera = R"("camera": {"eye": [0.3, 0.1, 0.6], "target": [0, 0, 0], "near": 0.01, "far": 4)";
  const std::string rest = R"(, "size": [64, 48], "exposure": 3, "background": [0.01, 0.02, 0.03], "head": false, "assets": [{"source": ")" +
                           smallRecipe() + R"(", "material": {"color": [0.3, 0.2, 0.1]}}]})";
  std::string pictures[4];
  const char* kinds[4] = {"}", R"(, "reversed_depth": true})", R"(, "view_height": 0.4})", R"(, "view_height": 0.4, "reversed_depth": true})"};
  for (int i = 0; i < 4; ++i) {
    const std::string scene = "{" + camera + kinds[i] + rest;
    EXPECT_GT(previewOf("text.png", "--scene '" + scene + "'").at("hair_pixels"), 100) << kinds[i];
    previewOf("file.png", "--scene " + writeScratch("scene.json", scene));
    pictures[i] = readAll(scratchFolder() / "text.png");
    EXPECT_EQ(pictures[i], readAll(scratchFolder() / "file.png"));
  }
  EXPECT_NE(pictures[0], pictures[2]) << "in perspective and not";
}
