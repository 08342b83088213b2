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

nlohmann::json passOf(const nlohmann::json& plan, const std::string& name) {
  for (const auto& pass : plan.at("passes")) {
    if (pass.at("name") == name) return pass;
  }
  return nullptr;
}

TEST(PlanCommand, EveryMethodIsPlanned) {
  for (const char* method : {"core_tail", "exact", "forward", "core_only", "all_low", "hard"}) {
    const nlohmann::json plan = planOf(smallRecipe() + " --method " + method);
    ASSERT_TRUE(plan.is_object()) << method;
    EXPECT_EQ(plan.at("method"), method);
    EXPECT_EQ(hasPass(plan, "capture nearest"), method == std::string("hard"));
    EXPECT_EQ(plan.at("node_capacity") == 0, method == std::string("hard"));
  }
}

TEST(PlanCommand, HashesTellWhatOtherOptionsChange) {
  const nlohmann::json mean = planOf(smallRecipe()), list = planOf(smallRecipe() + " --tail list");
  ASSERT_TRUE(mean.is_object() && list.is_object());
  EXPECT_EQ(list.at("tail"), "list");
  EXPECT_EQ(passOf(mean, "capture").at("hash"), passOf(list, "capture").at("hash"));
  EXPECT_NE(passOf(mean, "resolve").at("hash"), passOf(list, "resolve").at("hash"));
  EXPECT_EQ(passOf(mean, "resolve").at("hash").get<std::string>().size(), 16u);
  EXPECT_EQ(passOf(mean, "clear").at("hash"), "");
}

TEST(PlanCommand, ComputedCaptureGoesOverSegments) {
  const nlohmann::json raster = planOf(smallRecipe() + " --capture raster");
  const nlohmann::json compute = planOf(smallRecipe() + " --capture compute");
  ASSERT_TRUE(raster.is_object() && compute.is_object());
  EXPECT_EQ(passOf(raster, "capture").at("segments"), 0);
  EXPECT_EQ(passOf(raster, "capture").at("indices"), 300 * 7 * 6);
  EXPECT_EQ(passOf(compute, "capture").at("segments"), 300 * 7);
  EXPECT_EQ(passOf(compute, "shadow").at("segments"), 300 * 7);
  EXPECT_EQ(passOf(compute, "capture").at("indices"), 0);
}

TEST(PlanCommand, FollowStrandsAndTipColorsCost) {
  const nlohmann::json bare = planOf(smallRecipe()), follow = planOf(smallRecipe() + " --follow 3");
  ASSERT_TRUE(bare.is_object() && follow.is_object());
  EXPECT_EQ(follow.at("assets").at(0).at("follow"), 3);
  EXPECT_EQ(follow.at("assets").at(0).at("segments"), 4 * 300 * 7);
  EXPECT_EQ(passOf(follow, "capture").at("indices"), 4 * 300 * 7 * 6);
  EXPECT_EQ(follow.at("bytes_persistent"), 4 * bare.at("bytes_persistent").get<uint64_t>());
  EXPECT_NE(bare.at("left_out").dump().find("a fragment's own colour"), std::string::npos);
  const nlohmann::json tips = planOf(smallRecipe() + " --tip-color d8a860");
  EXPECT_EQ(tips.at("left_out").dump().find("a fragment's own colour"), std::string::npos);
}

TEST(PlanCommand, LightsOfAScene) {
  const std::string recipe = smallRecipe();
  const std::string scene = writeScratch("lights.json", R"({"assets": [{"source": "small.json"}],
      "lights": [{}, {"kind": "point", "position": [0, 0, 0], "shadow_size": 128},
                 {"kind": "spot", "position": [0, 1, 0], "shadow_size": 128}, {"azimuth": 120, "shadow": false}],
      "sky": {"top": "#ffffff", "bottom": "#000000"}, "near_fade": {"end_m": 0.1}, "lens": {}})");
  const nlohmann::json plan = planOf("--scene " + scene);
  ASSERT_TRUE(plan.is_object());
  EXPECT_EQ(plan.at("lights"), 4);
  EXPECT_EQ(passOf(plan, "shadow").at("indices"), 8 * 300 * 7 * 6) << "maps: 1, 6 around the point light, 1";
  for (const char* used : {"harmonics", "the loop over lights", "opacity modifiers"}) {
    EXPECT_EQ(plan.at("left_out").dump().find(used), std::string::npos) << used;
  }
  const nlohmann::json none = planOf("--scene " + scene + " --no-shadow");
  EXPECT_FALSE(hasPass(none, "shadow"));
  const auto dark = runCommand("plan --scene " + writeScratch("dark.json", R"({"assets": [{"source": "small.json"}],
      "lights": []})"));
  EXPECT_EQ(dark.status, 0) << dark.err;
  EXPECT_NE(dark.out.find("the frame has no light"), std::string::npos) << dark.out;
}

TEST(PlanCommand, TextAlignsAndNamesTheMethod) {
  const auto run = runCommand("plan " + smallRecipe() + " --method core_only --tail list --capture compute");
  EXPECT_NE(run.out.find("core_only, k 8, k_sort 8, capture by compute;"), std::string::npos) << run.out;
  EXPECT_NE(runCommand("plan " + smallRecipe() + " --tail list --k 2").out.find("core_tail, k 2, k_sort 8, tail in list order;"),
            std::string::npos);
  EXPECT_NE(runCommand("plan " + smallRecipe() + " --method all_low").out.find(", all_low, k_sort 8;"), std::string::npos);
  const auto hard = runCommand("plan " + smallRecipe() + " --method hard --tail list");
  EXPECT_NE(hard.out.find(", hard; hair in"), std::string::npos) << hard.out;
  const size_t header = hard.out.find("pass "), row = hard.out.find("  capture nearest");
  ASSERT_TRUE(header != std::string::npos && row != std::string::npos) << hard.out;
  const size_t work = hard.out.find("work", header) - header;
  EXPECT_NE(hard.out.at(row + work), ' ') << hard.out;
  EXPECT_EQ(hard.out.at(row + work - 1), ' ') << hard.out;
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

TEST(PlanCommand, AnInlineSceneIsAScene) {
  const std::string source = "\"assets\": [{\"source\": \"" + smallRecipe() + "\"}], \"size\": [60, 40], \"method\": \"exact\"";
  const nlohmann::json of_text = planOf("--scene '{" + source + "}'"), of_file = planOf("--scene " + writeScratch("plan.json", "{" + source + "}"));
  EXPECT_EQ(of_text.at("size"), nlohmann::json({60, 40}));
  EXPECT_EQ(of_text, of_file);
  EXPECT_EQ(planOf(smallRecipe() + " --scene '{}' --size 60x40 --method exact"), of_file);
  const auto wrong = runCommand("plan --scene '{\"lamp\": 1}'");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_EQ(wrong.err.rfind("forelock: --scene: lamp is no key of a scene", 0), 0u) << wrong.err;
  const auto cut = runCommand("plan --scene '{\"size\": '");
  EXPECT_EQ(cut.status, 1);
  EXPECT_EQ(cut.err.rfind("forelock: --scene: not valid JSON (line 1", 0), 0u) << cut.err;
}

TEST(PlanCommand, SourcesOfAnInlineSceneStartAtTheWorkingFolder) {
  const std::filesystem::path recipe = smallRecipe();
  const std::string name = recipe.filename().string(), folder = recipe.parent_path().string();
  const auto run = runCommand("plan --scene '{\"assets\": [{\"source\": \"" + name + "\"}]}'", "cd \"" + folder + "\" && ");
  EXPECT_EQ(run.status, 0) << run.err;
}
