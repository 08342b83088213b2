// `forelock plan` without a device.
#include "command_run.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using forelock::test::runCommand;
using forelock::test::smallRecipe;
using forelock::test::writeScratch;

namespace {

nlohmann::json planOf(const std::string& arguments) {
  const auto run = runCommand("plan --json " + arguments, "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent ");
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out, nullptr, false);
}

bool hasPass(const nlohmann::json& plan, const std::string& name) {
  for (const auto& pass : plan.at("passes")) {
    if (pass.at("name") == name) return true;
  }
  return false;
}

}  // namespace

TEST(PlanCommand, BytesAddUp) {
  const nlohmann::json plan = planOf(smallRecipe() + " --size 200x100");
  ASSERT_TRUE(plan.is_object());
  EXPECT_EQ(plan.at("size"), nlohmann::json({200, 100}));
  EXPECT_EQ(plan.at("assets").at(0).at("segments"), 300 * 7);
  uint64_t transient = 0;
  for (const auto& resource : plan.at("resources")) {
    EXPECT_FALSE(resource.at("why").get<std::string>().empty());
    transient += resource.at("transient").get<bool>() ? resource.at("bytes").get<uint64_t>() : 0;
  }
  EXPECT_EQ(plan.at("bytes_transient"), transient);
  EXPECT_GT(plan.at("bytes_persistent"), 300u * 8u * 16u - 1u);  // 16 bytes a vertex
}

TEST(PlanCommand, LeavesOutWhatIsNotAskedFor) {
  const nlohmann::json with = planOf(smallRecipe()), without = planOf(smallRecipe() + " --no-shadow");
  ASSERT_TRUE(with.is_object() && without.is_object());
  EXPECT_TRUE(hasPass(with, "shadow"));
  EXPECT_FALSE(hasPass(without, "shadow"));
  EXPECT_LT(without.at("bytes_transient"), with.at("bytes_transient"));
  EXPECT_NE(without.at("left_out").dump().find("shadow"), std::string::npos);
}

TEST(PlanCommand, StoredCameraBringsItsSize) {
  EXPECT_EQ(planOf(smallRecipe() + " --camera side").at("size"), nlohmann::json({60, 40}));
  EXPECT_EQ(planOf(smallRecipe() + " --camera side --size 30x20").at("size"), nlohmann::json({30, 20}));
}

TEST(PlanCommand, SceneIsReadAndOptionsChangeIt) {
  const std::string recipe = smallRecipe();
  const std::string scene = writeScratch(
      "scene.json", R"({"assets": [{"source": "small.json"}, {"source": "small.json", "position": [0.5, 0, 0]}],
                        "size": [64, 32], "method": "exact"})");
  const nlohmann::json plan = planOf("--scene " + scene);
  EXPECT_EQ(plan.at("assets").size(), 2u);
  EXPECT_EQ(plan.at("method"), "exact");
  const nlohmann::json changed = planOf(recipe + " --scene " + scene + " --method forward");
  EXPECT_EQ(changed.at("assets").size(), 1u);
  EXPECT_EQ(changed.at("method"), "forward");
  EXPECT_EQ(changed.at("size"), nlohmann::json({64, 32}));
}

TEST(PlanCommand, TextNamesPassesAndReasons) {
  const auto run = runCommand("plan " + smallRecipe());
  EXPECT_EQ(run.status, 0) << run.err;
  for (const char* part : {"capture", "resolve", "nodes", "why", "together", "left out"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << " is not in\n" << run.out;
  }
}
