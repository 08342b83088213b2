// SPDX-License-Identifier: MIT
#include "asset_source.h"

#include "groom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace forelock::samples {
namespace {

std::string errorOf(const std::string& source) {
  try {
    openAsset(source);
  } catch (const AssetError& error) {
    return error.what();
  }
  return "";
}

TEST(AssetSource, GroomBecomesAnAssetThatIsClean) {
  const OpenedAsset opened = openAsset("groom:paper-load");
  FlkAssetInfo info = {};
  ASSERT_EQ(flkAssetGetInfo(opened.asset.get(), &info), FLK_SUCCESS);
  ASSERT_TRUE(opened.recipe.has_value());
  EXPECT_EQ(info.strand_count, opened.recipe->strands);
  EXPECT_EQ(info.finding_count, 0u);
  EXPECT_EQ(info.has_radii, 1u);
  EXPECT_EQ(info.has_root_uvs, 1u);
  EXPECT_EQ(opened.recipe->cameras.size(), 4u);
}

TEST(AssetSource, ErrorsBeginWithWhatWasAskedFor) {
  EXPECT_EQ(errorOf("groom:no-such").rfind("groom:no-such: no such groom", 0), 0u) << errorOf("groom:no-such");
  EXPECT_EQ(errorOf("groom:../CMakeLists").rfind("groom:../CMakeLists: no such groom", 0), 0u);
  EXPECT_EQ(errorOf("/nonexistent.tfx").rfind("/nonexistent.tfx:", 0), 0u);
  EXPECT_EQ(errorOf("/nonexistent.json").rfind("/nonexistent.json:", 0), 0u);
}

TEST(AssetSource, HairAssetsFolderFromTheEnvironmentComesFirst) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "forelock_groom_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mine.json") << R"({"strands": 7, "vertices": 5})";
  setenv("FORELOCK_HAIRASSETS", folder.c_str(), 1);
  const std::vector<std::string> names = groomNames();
  EXPECT_NE(std::find(names.begin(), names.end(), "mine"), names.end());
  EXPECT_EQ(openRecipe("groom:mine").strands, 7u);
  EXPECT_EQ(openRecipe("mine").vertices, 5u);
  unsetenv("FORELOCK_HAIRASSETS");
  std::filesystem::remove_all(folder);
}

TEST(AssetSource, SavingNamesWhatTheFormatCannotHold) {
  Recipe recipe = openRecipe("groom:paper-load");
  recipe.strands = 50;
  const OpenedAsset opened = growAsset(recipe, "few");
  const std::string path = (std::filesystem::temp_directory_path() / "forelock_groom_test.tfx").string();
  bool names_widths = false;
  for (const AssetMessage& message : saveAsset(opened, path)) {
    names_widths = names_widths || message.id == "WRITE_DROPS_WIDTHS" || message.text.find("width") != std::string::npos;
  }
  EXPECT_TRUE(names_widths);
  const OpenedAsset again = openAsset(path);
  FlkStrands before = {}, after = {};
  ASSERT_EQ(flkAssetGetStrands(opened.asset.get(), &before), FLK_SUCCESS);
  ASSERT_EQ(flkAssetGetStrands(again.asset.get(), &after), FLK_SUCCESS);
  ASSERT_EQ(after.vertex_count, before.vertex_count);
  EXPECT_TRUE(std::equal(after.positions, after.positions + size_t{3} * after.vertex_count, before.positions));
  std::remove(path.c_str());
  EXPECT_THROW(saveAsset(opened, "few.abc"), AssetError);
}

}  // namespace
}  // namespace forelock::samples
