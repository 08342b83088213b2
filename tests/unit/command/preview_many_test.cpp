// `forelock preview` of folders, sheets and colourings.
#include "command_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

using forelock::test::readAll;
using forelock::test::runCommand;
using forelock::test::scratchFolder;
using forelock::test::smallRecipe;
using forelock::test::writeScratch;

namespace fs = std::filesystem;

namespace {

uint32_t bigEndian(const std::string& bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

void append(std::string& bytes, const void* value, size_t size) { bytes.append(static_cast<const char*>(value), size); }

// A .hair file of straight strands along y, each from `roots` on, three vertices a strand.
std::string hairFile(const std::vector<std::array<float, 3>>& roots, float length = 0.3f) {
  std::string bytes("HAIR");
  const uint32_t counts[4] = {uint32_t(roots.size()), uint32_t(3 * roots.size()), 2u | 4u, 2u};
  append(bytes, counts, sizeof counts);
  bytes.resize(128);
  for (const auto& root : roots)
    for (int i = 0; i < 3; ++i) {
      const float p[3] = {root[0], root[1] - length * float(i) / 2, root[2]};
      append(bytes, p, sizeof p);
    }
  const float width = 0.004f;
  for (size_t i = 0; i < 3 * roots.size(); ++i) append(bytes, &width, sizeof width);
  return bytes;
}

std::vector<std::array<float, 3>> row(int count) {
  std::vector<std::array<float, 3>> roots;
  for (int i = 0; i < count; ++i) roots.push_back({0.01f * float(i), 0, 0});
  return roots;
}

// No device is needed to plan.
nlohmann::json planOf(const std::string& arguments) {
  const auto run = runCommand("plan --json --size 64x64 " + arguments);
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

}  // namespace

TEST(PreviewSheet, LabelsTwelveTiles) {
  const std::string out = (scratchFolder() / "sheet.png").string();
  const auto run = runCommand("preview --sheet --validation --size 64x64 --json -o " + out + " " + smallRecipe());
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string png = readAll(out);
  ASSERT_GT(png.size(), 33u);
  EXPECT_EQ(bigEndian(png, 16), 4u * 64 + 5 * 2);                          // gaps of 2 pixels
  EXPECT_EQ(bigEndian(png, 20), 28u + 3u * (64 + 12) + 4 * 2);             // title 14 x 2, labels of 12
  EXPECT_GT(nlohmann::json::parse(run.out).at("exposure"), 0.0);
}

TEST(PreviewMany, OneBadFileStopsNothing) {
  const fs::path in = scratchFolder() / "many", out = scratchFolder() / "pictures";
  fs::create_directories(in / "deep");
  writeScratch("many/good.hair", hairFile(row(20)));
  writeScratch("many/cut.hair", hairFile(row(20)).substr(0, 200));
  writeScratch("many/deep/good.hair", hairFile(row(5)));
  writeScratch("many/notes.txt", "no hair");
  writeScratch("many/scene.json", R"({"assets": [{"source": "good.hair"}]})");
  const auto run = runCommand("preview --validation --json --size 48x48 --recursive -o " + out.string() + " " + in.string());
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("cut.hair: "), std::string::npos) << run.err;
  EXPECT_EQ(run.err.find("validation"), std::string::npos) << run.err;
  const nlohmann::json said = nlohmann::json::parse(run.out, nullptr, false);
  ASSERT_TRUE(said.is_object()) << run.out;
  EXPECT_EQ(said.at("failed"), 1);
  ASSERT_EQ(said.at("pictures").size(), 3u) << "neither the notes nor the scene";
  EXPECT_EQ(said.at("pictures")[1].at("strands"), 5);
  for (const char* name : {"good.hair.png", "deep/good.hair.png", "overview.png"}) EXPECT_TRUE(fs::exists(out / name)) << name;
  EXPECT_FALSE(fs::exists(out / "cut.hair.png"));
  EXPECT_EQ(bigEndian(readAll(out / "overview.png"), 16), 2u * 256 + 3 * 4);
}

TEST(PreviewMany, SaysWhatIsWrongWithTheCall) {
  const std::string folder = scratchFolder().string(), recipe = smallRecipe();
  fs::create_directories(scratchFolder() / "empty");
  const auto status = [](const std::string& arguments, const char* words, int expected) {
    const auto run = runCommand("preview " + arguments);
    EXPECT_EQ(run.status, expected) << arguments;
    EXPECT_NE(run.err.find(words), std::string::npos) << arguments << ": " << run.err;
  };
  status(folder + " -o x.png", "must be a folder", 2);
  status(recipe + " " + recipe + " -o x.png", "must be a folder", 2);
  status(recipe + " -o x.png --recursive", "looks through a folder", 2);
  status(folder + " -o y --watch", "--watch draws one asset", 2);
  status(recipe + " -o x.png --watch --json", "leave out --json", 2);
  status(recipe + " -o x.png --sheet --turntable 4", "use one of them", 2);
  status(recipe + " -o x.png --sheet --color bad", "leave out --color", 2);
  status(recipe + " -o x.png --thumbnail 256 --size 9x9", "use one of them", 2);
  status(recipe + " -o x.png --thumbnail 300", "--thumbnail", 2);
  status(folder + "/empty -o y", "no strand file or recipe in this folder", 1);
  status(recipe + " -o x.png --color colour", "curvature", 2);
}

TEST(PreviewColor, BadStrandsAreAHairOfTheirOwn) {
  std::vector<std::array<float, 3>> roots = row(30);
  roots.push_back(roots[3]);
  const std::string path = writeScratch("twice.hair", hairFile(roots));
  const nlohmann::json said = planOf(path + " --color bad");
  EXPECT_EQ(said.at("show"), "bad");
  ASSERT_EQ(said.at("assets").size(), 2u);
  EXPECT_EQ(said.at("assets")[0].at("strands"), 30);
  EXPECT_EQ(said.at("assets")[1].at("strands"), 1);
  EXPECT_EQ(planOf(smallRecipe() + " --color bad").at("assets").size(), 1u) << "none is bad";
}

TEST(PreviewColor, GuidesLieOverTheirFollowStrands) {
  EXPECT_EQ(planOf(smallRecipe() + " --color guides --follow 3").at("assets").size(), 2u);
  EXPECT_EQ(planOf(smallRecipe() + " --color guides").at("assets").size(), 1u);
}

// Colours are seen as they are: what is drawn of a wide strand has the colour of the legend's middle.
TEST(PreviewColor, EveryColoringDrawsAndHasALegend) {
  const std::string path = writeScratch("row.hair", hairFile(row(12)));
  for (const char* coloring : {"curvature", "length", "segments", "thickness", "groups", "guides", "bad"})
    EXPECT_EQ(planOf(path + " --color " + coloring).at("show"), coloring);
  const auto run = runCommand("preview --json --validation --size 200x200 --color length -o " + (scratchFolder() / "length.png").string() + " " + path);
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json said = nlohmann::json::parse(run.out);
  EXPECT_GT(said.at("hair_pixels"), 100);
  EXPECT_EQ(said.at("legend").at("marks")[1][1], "0.3") << "all are alike";
}

TEST(PreviewFraming, StrayStrandsAreLeftOutsideAndSaid) {
  std::vector<std::array<float, 3>> roots = row(40);
  roots.push_back({1e5f, 0, 0});
  const std::string path = writeScratch("stray.hair", hairFile(roots));
  const std::string out = (scratchFolder() / "stray.png").string();
  const auto run = runCommand("preview --json --validation --size 64x64 -o " + out + " " + path);
  ASSERT_EQ(run.status, 0) << run.err;
  const nlohmann::json said = nlohmann::json::parse(run.out);
  // 0.4 x 0.3 of hair in a square: three quarters of the picture less the margin, of strands that cover 0.4 of it.
  EXPECT_GT(said.at("hair_pixels"), 64 * 64 / 5);
  ASSERT_EQ(said.at("notes").size(), 1u) << said.at("notes");
  EXPECT_NE(std::string(said.at("notes")[0]).find("1 strand lies so far off"), std::string::npos);
  EXPECT_NE(std::string(said.at("notes")[0]).find("strand 40"), std::string::npos);
}

TEST(PreviewFraming, AnotherUpAxisIsProposed) {
  // Strands along z, a row of them.
  std::string bytes = hairFile(row(20), 0.5f);
  for (size_t at = 128; at < 128 + 20 * 3 * 12; at += 12) {
    char swapped[8];
    std::memcpy(swapped, bytes.data() + at + 8, 4);
    std::memcpy(swapped + 4, bytes.data() + at + 4, 4);
    std::memcpy(bytes.data() + at + 4, swapped, 8);
  }
  const std::string path = writeScratch("zup.hair", bytes);
  const std::string options = "preview --size 32x32 -o " + (scratchFolder() / "zup.png").string() + " " + path;
  EXPECT_NE(runCommand(options).out.find("use --up z"), std::string::npos);
  EXPECT_EQ(runCommand(options + " --up z").out.find("use --up"), std::string::npos);
}
