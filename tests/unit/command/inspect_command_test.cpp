// `forelock inspect`: its JSON as docs/inspect-json.md has it, folders, and repairs that say what they did.
#include "strand_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using namespace forelock::test;
using Json = nlohmann::ordered_json;

namespace {

std::vector<std::string> keysOf(const Json& json) {
  std::vector<std::string> keys;
  for (const auto& entry : json.items()) keys.push_back(entry.key());
  return keys;
}

// The tuft with a copy of strand 3, a vertex that strand 5 has twice, and a micro strand.
std::string faulty() {
  std::vector<Strand> strands = tuft();
  strands.push_back(strands[3]);
  strands[5].insert(strands[5].begin() + 2, strands[5][2]);
  strands.push_back({{0, 0, 0}, {0.000005, 0, 0}});
  return writeScratch("faulty.ply", plyText(strands));
}

}  // namespace

TEST(CommandInspect, JsonIsWhatItsDocumentSays) {
  const Json json = Json::parse(runCommand("inspect --json " + quoted(writeScratch("tuft.ply", plyText(tuft())))).out);
  const std::vector<std::string> keys = keysOf(json);
  EXPECT_EQ(json["schema"], "forelock.inspect/1");
  EXPECT_EQ(json["strands"], 12);
  EXPECT_EQ(json["vertices_per_strand"], Json({{"min", 4.0}, {"median", 4.0}, {"mean", 4.0}, {"max", 4.0}}));
  EXPECT_EQ(json["width"]["source"], "default");
  EXPECT_EQ(json["unit_guess"]["value"], "m");
  EXPECT_EQ(json["longest"].size(), 5u);
  EXPECT_EQ(json["bytes_device"], 48 * 16 + 36 * 4);
  // The document has a heading row of each key, in this order.
  const std::string document = readAll(fs::path(FORELOCK_SOURCE_DIR) / "docs/inspect-json.md");
  size_t at = 0;
  for (const std::string& key : keys) {
    const size_t found = document.find("| `" + key + "` |", at);
    ASSERT_NE(found, std::string::npos) << key << " is not documented, or not in its place";
    at = found;
  }
  for (const std::string& key : keysOf(Json::parse(runCommand("inspect --json " + quoted(faulty())).out)["findings"][0]))
    EXPECT_NE(document.find("| `findings[]." + key + "` |"), std::string::npos) << key;
}

TEST(CommandInspect, DeviceBytesAreThoseOfThePlan) {
  const std::string recipe = smallRecipe();
  const Json inspected = Json::parse(runCommand("inspect --json " + quoted(recipe)).out), plan = Json::parse(runCommand("plan --json --no-head " + quoted(recipe)).out);
  EXPECT_EQ(inspected["bytes_device"], plan["bytes_persistent"]);
}

TEST(CommandInspect, FoldersGoOnAfterABadFile) {
  const fs::path folder = scratchFolder() / "grooms";
  fs::create_directories(folder / "deep");
  const auto write = [&](const std::string& name, const std::string& text) { std::ofstream(folder / name, std::ios::binary) << text; };
  write("b.ply", plyText(tuft()));
  write("deep/c,1.ply", plyText(tuft()));
  write("a.hair", "HAIR and no more");
  write("notes.txt", "no strands");
  write("scene.json", "{}");
  const std::string csv = (scratchFolder() / "out.csv").string();
  const CommandRun run = runCommand("inspect " + quoted(folder.string()) + " --csv " + quoted(csv));
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("3 strand files, 1 of them failed; 2 other files left alone"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("WIDTH_DEFAULTED"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("a.hair: the header of a .hair file is 128 bytes"), std::string::npos) << run.err;
  const std::string table = readAll(csv);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
  EXPECT_NE(table.find("/c,1.ply\",ply,12,12,0,48,"), std::string::npos) << table;
  EXPECT_NE(table.find("a.hair,,,,"), std::string::npos) << table;
  const CommandRun json = runCommand("inspect --json " + quoted(folder.string()));
  const Json list = Json::parse(json.out);
  EXPECT_EQ(list["schema"], "forelock.inspect-list/1");
  ASSERT_EQ(list["assets"].size(), 3u);
  EXPECT_TRUE(list["assets"][0].contains("error"));
  EXPECT_EQ(list["assets"][1]["strands"], 12);
  fs::remove(folder / "a.hair");
  EXPECT_EQ(runCommand("inspect " + quoted(folder.string())).status, 0);
  EXPECT_EQ(runCommand("inspect --strict " + quoted(folder.string())).status, 0) << "infos are no failure";
  const CommandRun two = runCommand("inspect " + quoted((folder / "b.ply").string()) + " nowhere.tfx");
  EXPECT_EQ(two.status, 1);
  EXPECT_NE(two.out.find("b.ply"), std::string::npos);
  fs::create_directories(scratchFolder() / "bare");
  const CommandRun bare = runCommand("inspect " + quoted((scratchFolder() / "bare").string()));
  EXPECT_EQ(bare.status, 1);
  EXPECT_NE(bare.err.find("no strand file is in it"), std::string::npos) << bare.err;
}

TEST(CommandInspect, RepairsAndListsEachChange) {
  const std::string in = faulty(), before = readAll(in), out = (scratchFolder() / "mended.ply").string();
  const CommandRun run = runCommand("inspect " + quoted(in) + " --repair " + quoted(out));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("changed     STRAND_MICRO x 1: strands removed\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("changed     STRAND_DUPLICATE x 1: copies of strands removed\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("changed     SEGMENT_ZERO_LENGTH x 1: repeated vertices removed\n"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("mended.ply: 12 strands, 48 vertices\n"), std::string::npos) << run.out;
  EXPECT_EQ(readAll(in), before);
  const Json diff = Json::parse(runCommand("diff --json " + quoted(writeScratch("tuft.ply", plyText(tuft()))) + " " + quoted(out)).out);
  EXPECT_EQ(diff["distance"]["max"], 0.0) << "what is left is the tuft";
  EXPECT_EQ(diff["matched"], 12);

  const Json only = Json::parse(runCommand("inspect --json " + quoted(in) + " --repair " + quoted(out) + " --repair-only STRAND_DUPLICATE").out);
  ASSERT_EQ(only["repairs"].size(), 1u);
  EXPECT_EQ(only["repairs"][0]["code"], "STRAND_DUPLICATE");
  EXPECT_EQ(only["written"], out);
  EXPECT_EQ(runCommand("inspect --strict " + quoted(in)).status, 1);
  EXPECT_EQ(runCommand("inspect --strict " + quoted(out)).status, 0);

  // .tfx cannot hold strands of different counts, which taking vertices away makes of equal ones.
  std::vector<Strand> twice = tuft();
  twice[5][2] = twice[5][1];
  const CommandRun uneven = runCommand("inspect " + quoted(writeScratch("twice.ply", plyText(twice))) + " --repair " + quoted(out + ".tfx"));
  EXPECT_EQ(uneven.status, 1);
  EXPECT_NE(uneven.err.find("without SEGMENT_ZERO_LENGTH"), std::string::npos) << uneven.err;
}

TEST(CommandInspect, NeverWritesOverItsInputUnlessAsked) {
  const std::string in = faulty(), before = readAll(in);
  fs::create_symlink(in, scratchFolder() / "link.ply");
  for (const std::string& out : {in, (scratchFolder() / "link.ply").string(), (scratchFolder() / "." / "faulty.ply").string()}) {
    const CommandRun run = runCommand("inspect " + quoted(in) + " --repair " + quoted(out));
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("is the input itself"), std::string::npos) << run.err;
    EXPECT_EQ(readAll(in), before);
  }
  EXPECT_EQ(runCommand("inspect " + quoted(in) + " --repair " + quoted(in) + " --overwrite-input").status, 0);
  EXPECT_NE(readAll(in), before);
  fs::remove(scratchFolder() / "link.ply");
}

// TressFX 3 keeps the follow strands of a file in the project beside it.
TEST(CommandInspect, ProjectsNameFollowStrands) {
  const fs::path folder = scratchFolder() / "project";
  fs::create_directories(folder);
  const std::string pony = (folder / "pony.tfx").string();
  ASSERT_EQ(runCommand("convert " + quoted(writeScratch("tuft.ply", plyText(tuft()))) + " " + quoted(pony)).status, 0);
  EXPECT_EQ(runCommand("inspect " + quoted(pony)).out.find("TFX_PROJECT"), std::string::npos);
  std::ofstream(folder / "a.tfxproj") << "version 3.0\n# pony.tfx 9 9 9\nother.tfx 3 0.5 2 other.tfxsim\npony.tfx 4 0.25 5 pony.tfxsim pony\n";
  const std::string said = runCommand("inspect " + quoted(pony)).out;
  EXPECT_NE(said.find("TFX_PROJECT_FOLLOW_STRANDS x 4"), std::string::npos) << said;
  EXPECT_NE(said.find("a.tfxproj beside the file grows 4 follow strands around each guide, within 0.25"), std::string::npos) << said;
}
