// `forelock diff`: what it prints, and what it exits with.
#include "strand_text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace forelock::test;
using Json = nlohmann::ordered_json;

namespace {

std::string converted(const std::string& from, const std::string& name, const std::string& options) {
  const std::string path = (scratchFolder() / name).string();
  const CommandRun run = runCommand("convert " + quoted(from) + " " + quoted(path) + " " + options);
  EXPECT_EQ(run.status, 0) << run.err;
  return path;
}

CommandRun diff(const std::string& a, const std::string& b, const std::string& options = {}) { return runCommand("diff " + quoted(a) + " " + quoted(b) + " " + options); }

}  // namespace

TEST(CommandDiff, SameGroomInTwoUnitsAndDirectionsOfV) {
  const std::string a = smallRecipe(), b = converted(a, "maya.ply", "--scale 100 --axes=x,-z,y --flip-v");
  const CommandRun run = diff(a, b);
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"matched     300 strands\n", "scale       A is 0.01 x B, as if A were in metres and B in centimetres\n", "axes        x,y,z of A are x,z,-y of B\n",
                           "root UVs    V flipped\n", "OUT --axes=x,z,-y --scale 0.01 --flip-v\n"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << run.out;
  // What it says to do does it.
  const std::string back = converted(b, "back.ply", "--axes=x,z,-y --scale 0.01 --flip-v");
  const Json json = Json::parse(diff(a, back, "--json").out);
  EXPECT_EQ(json["scale"], 1.0);
  EXPECT_EQ(json["axes"], "x,y,z");
  EXPECT_EQ(json["root_uvs"]["relation"], "same");
  EXPECT_LT(json["distance"]["max"].get<double>(), 1e-7) << "two roundings of coordinates below 0.5";
  EXPECT_NE(diff(a, a).out.find("relation    none needed"), std::string::npos);
}

TEST(CommandDiff, ToleranceAndUnrelated) {
  const std::string a = writeScratch("tuft.ply", plyText(tuft()));
  std::vector<Strand> moved = tuft();
  moved[4][3][0] += 0.002;
  const std::string b = writeScratch("moved.ply", plyText(moved));
  EXPECT_EQ(diff(a, b).status, 0) << "without a tolerance a difference is said, and no failure";
  EXPECT_EQ(diff(a, b, "--tolerance 0.01").status, 0);
  const CommandRun beyond = diff(a, b, "--tolerance 0.001");
  EXPECT_EQ(beyond.status, 1);
  EXPECT_NE(beyond.out.find("first       strand 4 of A and 4 of B: 0.002"), std::string::npos) << beyond.out;
  moved.pop_back();
  EXPECT_EQ(diff(a, writeScratch("fewer.ply", plyText(moved)), "--tolerance 0.01").status, 1) << "a strand is missing";
  const CommandRun unrelated = diff(a, smallRecipe());
  EXPECT_EQ(unrelated.status, 1);
  EXPECT_NE(unrelated.out.find("not related"), std::string::npos) << unrelated.out;
  EXPECT_EQ(Json::parse(diff(a, smallRecipe(), "--json").out)["related"], false);
  EXPECT_EQ(diff(a, "nowhere.tfx").status, 1);
}
