// Exit statuses, and that what is wrong is said on stderr in one line that names it.
#include "command_run.h"

#include <gtest/gtest.h>

#include <algorithm>

using forelock::test::CommandRun;
using forelock::test::runCommand;
using forelock::test::smallRecipe;
using forelock::test::writeScratch;

namespace {

void expectComplaint(const CommandRun& run, int status, const std::string& part) {
  EXPECT_EQ(run.status, status) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err.rfind("forelock: ", 0), 0u) << run.err;
  EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

}  // namespace

TEST(CommandUsage, HelpOnEveryLevelShowsExamples) {
  for (const char* level : {"", "preview ", "plan ", "inspect ", "convert ", "diff ", "groom ", "report "}) {
    const CommandRun run = runCommand(std::string(level) + "--help");
    EXPECT_EQ(run.status, 0) << level;
    EXPECT_NE(run.out.find("Examples:"), std::string::npos) << level;
    EXPECT_NE(run.out.find(std::string("forelock ") + level), std::string::npos) << level;
    EXPECT_EQ(run.err, "") << level;
  }
}

TEST(CommandUsage, WrongUsageIsTwo) {
  EXPECT_EQ(runCommand("").status, 2);
  expectComplaint(runCommand("comb"), 2, "comb is no subcommand");
  expectComplaint(runCommand("plan"), 2, "needs an ASSET");
  expectComplaint(runCommand("plan x.tfx --frobnicate"), 2, "--frobnicate");
  expectComplaint(runCommand("plan x.tfx --size 12"), 2, "--size is 12, must be WIDTHxHEIGHT");
  expectComplaint(runCommand("plan x.tfx --size 1x20000"), 2, "[1, 16384]");
  expectComplaint(runCommand("plan x.tfx --method best"), 2, "core_tail");
  expectComplaint(runCommand("plan x.tfx --tail short"), 2, "list");
  expectComplaint(runCommand("plan x.tfx --capture rays"), 2, "compute");
  expectComplaint(runCommand("plan x.tfx --follow 1024"), 2, "--follow");
  expectComplaint(runCommand("plan x.tfx --tip-color blond"), 2, "--tip-color is blond");
  expectComplaint(runCommand("plan x.tfx --light 10"), 2, "--light is 10");
  expectComplaint(runCommand("plan x.tfx --light=10,100"), 2, "[-90, 90]");
  expectComplaint(runCommand("plan x.tfx --hair-color brown"), 2, "--hair-color is brown");
  expectComplaint(runCommand("plan x.tfx --k 12 --k-sort 4"), 2, "k-sort is 4");
  expectComplaint(runCommand("plan x.tfx --head --no-head"), 2, "--no-head");
  expectComplaint(runCommand("convert x.tfx y.ply --axes x,y"), 2, "three axes like x,-z,y");
  expectComplaint(runCommand("convert x.tfx y.ply --scale -1"), 2, "--scale");
  expectComplaint(runCommand("convert x.tfx y.ply --resample 1"), 2, "--resample");
  expectComplaint(runCommand("convert x.tfx y.obj"), 2, "no writer for this extension");
  expectComplaint(runCommand("diff x.tfx"), 2, "B is required");
  expectComplaint(runCommand("diff x.tfx y.tfx --tolerance 0"), 2, "--tolerance");
  expectComplaint(runCommand("inspect"), 2, "ASSET is required");
  expectComplaint(runCommand("inspect x.tfx --repair-only ROOT_AT_TIP"), 2, "need --repair OUT");
  expectComplaint(runCommand("inspect x.tfx --repair y.tfx --repair-also UGLY"), 2, "UGLY is nothing that can be repaired; there are STRAND_MICRO");
  expectComplaint(runCommand("inspect x.tfx --repair y.obj"), 2, "no writer for this extension");
  expectComplaint(runCommand("inspect x.tfx y.tfx --repair z.tfx"), 2, "--repair takes one asset");
  expectComplaint(runCommand("preview x.tfx"), 2, "--out");
  expectComplaint(runCommand("report"), 2, "DIR");
  expectComplaint(runCommand("report study --error speed"), 2, "rmse_forward");
  expectComplaint(runCommand("preview x.tfx -o x.jpg"), 2, "x.jpg: no picture format");
  expectComplaint(runCommand("plan " + smallRecipe() + " --camera front"), 2, "stored are: side");
}

TEST(CommandUsage, WhatIsWrongWithAnAssetIsOne) {
  expectComplaint(runCommand("plan nowhere.tfx"), 1, "nowhere.tfx: cannot be opened: No such file or directory; check the path");
  expectComplaint(runCommand("inspect long-wavy"), 1, "there is a groom of this name: write groom:long-wavy");
  expectComplaint(runCommand("report nowhere"), 1, "nowhere: no such folder");
  expectComplaint(runCommand("plan groom:nowhere"), 1, "groom:nowhere: no such groom");
  expectComplaint(runCommand("plan --scene nowhere.json"), 1, "nowhere.json: cannot be read");
  const std::string scene =
      writeScratch("wrong.json", R"({"assets": [{"source": "a.tfx"}], "light": {"elevation": 120}})");
  expectComplaint(runCommand("plan --scene \"" + scene + "\""), 1,
                  "wrong.json: light.elevation is 120, must be a number in [-90, 90] degrees");
}

TEST(CommandUsage, LightTurnsOnlyWhatHasADirection) {
  const std::string scene = writeScratch(
      "lamp.json", R"({"assets": [{"source": "small.json"}], "lights": [{"kind": "point", "position": [0, 0, 1]}]})");
  smallRecipe();
  expectComplaint(runCommand("plan --scene \"" + scene + "\" --light=10,20"), 2,
                  "--light turns the scene's first directional light, but it has none");
  EXPECT_EQ(runCommand("plan --scene \"" + scene + "\"").status, 0);
}

TEST(CommandUsage, RootImagesNeedAFileAndRootUvs) {
  const std::string folder = forelock::test::scratchFolder().string();
  smallRecipe();
  // 2 x 1 pixels, red and a grey of 128.
  const std::string png(
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00\x00\x01\x08\x02"
      "\x00\x00\x00\x7b\x40\xe8\xdd\x00\x00\x00\x0f\x49\x44\x41\x54\x78\x9c\x63\xf8\xcf\xc0\xd0\xd0\xd0\x00\x00"
      "\x09\x01\x02\x80\x99\xc4\x69\x32\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
      72);
  writeScratch("scalp.png", png);
  writeScratch("broken.png", png.substr(0, 40));
  writeScratch("text.png", "a picture");
  const auto planned = [&](const std::string& source, const std::string& image) {
    return runCommand("plan --scene \"" + writeScratch("root.json", "{\"assets\": [{\"source\": \"" + source +
                                                                       "\", \"root_image\": \"" + image + "\"}]}") + "\"");
  };
  const CommandRun good = planned("small.json", "scalp.png");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find("16 bytes for each fragment"), std::string::npos) << "colours vary from strand to strand";
  expectComplaint(planned("small.json", "nowhere.png"), 1, "nowhere.png: cannot be read as a picture");
  // libpng has its own say on stderr before ours.
  const CommandRun broken = planned("small.json", "broken.png");
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.err.find("broken.png: cannot be read as a picture"), std::string::npos) << broken.err;
  expectComplaint(planned("small.json", "text.png"), 1, "text.png: cannot be read as a picture");
  expectComplaint(planned("small.json", "small.json"), 1, "small.json: no picture that can be read");
  const std::string bare = folder + "/bare.hair";
  ASSERT_EQ(runCommand("convert \"" + smallRecipe() + "\" \"" + bare + "\"").status, 0);
  expectComplaint(planned("bare.hair", "scalp.png"), 1, "bare.hair: has no root UVs");
}

TEST(CommandUsage, NoDeviceIsThree) {
  const std::string nothing = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent ";
  const std::string out = (forelock::test::scratchFolder() / "none.png").string();
  const CommandRun run = runCommand("preview " + smallRecipe() + " -o " + out, nothing);
  expectComplaint(run, 3, "no usable device");
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(runCommand("preview " + smallRecipe() + " -o " + out + " --device no-such-device").status, 3);
}

TEST(CommandInspect, NamesColours) {
  // One strand of two points with a colour each.
  std::string hair("HAIR\x01\0\0\0\x02\0\0\0\x12\0\0\0\x01\0\0\0", 20);
  hair.resize(128 + 2 * 12 + 2 * 12);
  const unsigned char a_tenth[] = {0xcd, 0xcc, 0xcc, 0x3d};
  std::copy(a_tenth, a_tenth + 4, hair.begin() + 128 + 12);
  const std::string path = writeScratch("colored.hair", hair);
  const CommandRun text = runCommand("inspect \"" + path + "\"");
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("attributes  positions, colours\n"), std::string::npos) << text.out;
  EXPECT_NE(runCommand("inspect --json \"" + path + "\"").out.find("\"colors\": true"), std::string::npos);
  EXPECT_NE(runCommand("inspect --json " + smallRecipe()).out.find("\"colors\": false"), std::string::npos);
  const CommandRun strict = runCommand("convert --strict \"" + path + "\" \"" + path + ".tfx\"");
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(strict.err.find("its colours are not in the .tfx file"), std::string::npos) << strict.err;
}

// A cooked file by any name, with the findings of its source; damaged, it says what to do.
TEST(CommandConvert, Cooked) {
  const std::string folder = forelock::test::scratchFolder().string(), cooked = folder + "/small.flk", other = folder + "/cooked.tfx";
  const CommandRun convert = runCommand("convert --strict \"" + smallRecipe() + "\" \"" + cooked + "\"");
  EXPECT_EQ(convert.status, 0) << convert.err;
  EXPECT_EQ(convert.err, "") << "nothing is left out";
  std::filesystem::rename(cooked, other);
  const CommandRun inspect = runCommand("inspect \"" + other + "\"");
  EXPECT_EQ(inspect.status, 0) << inspect.err;
  EXPECT_NE(inspect.out.find("cooked, from arrays"), std::string::npos) << inspect.out;
  const CommandRun json = runCommand("inspect --json \"" + other + "\"");
  EXPECT_NE(json.out.find("\"format\": \"cooked\",\n  \"source_format\": \"arrays\","), std::string::npos) << json.out;
  writeScratch("cut.flk", forelock::test::readAll(other).substr(0, 1000));
  expectComplaint(runCommand("inspect \"" + folder + "/cut.flk\""), 1, "truncated, fetch it again or cook it again from the source");
}
