// `forelock inspect` of skins and collision meshes, and --points-per-strand.
#include "../../fuzz/rig_files.h"
#include "command_run.h"

#include <gtest/gtest.h>

using forelock::test::CommandRun;
using forelock::test::runCommand;
using forelock::test::writeScratch;

namespace {

std::string quoted(const std::string& path) { return "\"" + path + "\""; }

std::string smallSkin() {
  const std::vector<unsigned char> bytes = asset_test::smallTfxbone();
  return {bytes.begin(), bytes.end()};
}

std::string points() {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 6; ++i) text += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n";
  return text;
}

}  // namespace

TEST(CommandInspect, SaysWhatIsInARig) {
  const std::string skin = writeScratch("a.tfxbone", smallSkin()), mesh = writeScratch("a.tfxmesh", asset_test::smallTfxmesh());
  const CommandRun text = runCommand("inspect --strict " + quoted(skin));
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_NE(text.out.find("bones       3, of which 3 are used"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("ns:jaw: 2 strands"), std::string::npos) << text.out;
  const CommandRun json = runCommand("inspect --json " + quoted(mesh));
  EXPECT_EQ(json.status, 0) << json.err;
  EXPECT_NE(json.out.find("\"format\": \"tfxmesh\""), std::string::npos) << json.out;
  EXPECT_NE(json.out.find("\"triangles\": 2"), std::string::npos) << json.out;
  EXPECT_NE(json.out.find("BONE_PLACEHOLDER"), std::string::npos) << json.out;
  std::string odd = smallSkin();
  odd[60] = 0x3f, odd[59] = 0x40;  // the weight of strand 0 is 0.75
  EXPECT_EQ(runCommand("inspect --strict " + quoted(writeScratch("odd.bin", odd))).status, 1) << "known by its bytes";
  const CommandRun cut = runCommand("inspect " + quoted(writeScratch("cut.tfxbone", smallSkin().substr(0, 40))));
  EXPECT_EQ(cut.status, 1);
  EXPECT_NE(cut.err.find("bone 2 of 3 (byte 30)"), std::string::npos) << cut.err;
  EXPECT_NE(runCommand("convert " + quoted(skin) + " x.ply").err.find("the skin weights of strands"), std::string::npos);
}

TEST(CommandInspect, ChecksHairAndBonesTogether) {
  const std::string skin = writeScratch("b.tfxbone", smallSkin()), ply = writeScratch("points.ply", points());
  const CommandRun fits = runCommand("inspect " + quoted(ply) + " --points-per-strand 2 --strict --bones " + quoted(skin));
  EXPECT_EQ(fits.status, 0) << fits.err;
  EXPECT_NE(fits.out.find("of which 3 are used"), std::string::npos) << fits.out;
  const CommandRun fewer = runCommand("inspect " + quoted(ply) + " --points-per-strand 3 --strict --json --bones " + quoted(skin));
  EXPECT_EQ(fewer.status, 1) << fewer.err;
  EXPECT_NE(fewer.out.find("SKIN_STRANDS_SURPLUS"), std::string::npos) << fewer.out;
  EXPECT_NE(runCommand("inspect " + quoted(ply) + " --points-per-strand 2 --bones " + quoted(ply)).err.find("it is a PLY file"), std::string::npos);
  EXPECT_EQ(runCommand("inspect " + quoted(ply) + " --points-per-strand 1").status, 2);
  EXPECT_NE(runCommand("inspect " + quoted(ply)).err.find("--points-per-strand N"), std::string::npos);
  EXPECT_NE(runCommand("plan " + quoted(ply) + " --points-per-strand 4").err.find("leave 2 over"), std::string::npos);
  EXPECT_EQ(runCommand("plan " + quoted(ply) + " --points-per-strand 3").status, 0);
  EXPECT_EQ(runCommand("convert " + quoted(ply) + " " + quoted(ply + ".hair") + " --points-per-strand 3").status, 0);
}
