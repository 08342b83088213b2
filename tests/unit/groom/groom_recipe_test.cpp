// SPDX-License-Identifier: MIT
#include "groom_recipe.h"

#include <gtest/gtest.h>

namespace forelock::samples {
namespace {

std::string errorOf(const std::string& text) {
  try {
    parseRecipe(text, "test");
  } catch (const RecipeError& error) {
    return error.what();
  }
  return "";
}

TEST(GroomRecipe, EmptyRecipeIsAllDefaults) {
  const Recipe recipe = parseRecipe("{}", "plain");
  EXPECT_EQ(recipe.name, "plain");
  EXPECT_EQ(recipe.strands, 10000u);
  EXPECT_FALSE(recipe.scalp.hairline.empty());
  EXPECT_TRUE(recipe.cameras.empty());
}

struct BadRecipe {
  const char* text;
  const char* message;  // a part of what must be said
};

TEST(GroomRecipe, ErrorsNameKeyValueAndRange) {
  const BadRecipe table[] = {
      {R"({"strandz": 3})", "strandz is no key"},
      {R"({"wave": {"lenght": 3}})", "wave.lenght is no key"},
      {R"({"wave": {"amplitude": 3}})", "wave.amplitude is 3, must be a number in [0, 0.1] m"},
      {R"({"wave": {"amplitude": "x"}})", "wave.amplitude is \"x\", must be a number"},
      {R"({"wave": 1})", "wave is 1, must be an object"},
      {R"({"strands": 0})", "strands is 0, must be a whole number in [1, 1000000]"},
      {R"({"strands": 1.5})", "strands is 1.5, must be a whole number"},
      {R"({"strands": -4})", "strands is -4, must be a whole number"},
      {R"({"seed": -1})", "seed is -1"},
      {R"({"vertices": 1})", "vertices is 1, must be a whole number in [2, 256]"},
      {R"({"drape_on": "horse"})", "drape_on is \"horse\", must be \"bust\" or \"scalp\""},
      {R"({"name": 5})", "name is 5, must be a string"},
      {R"({"scalp": {"radii": [1, 2]}})", "scalp.radii is [1,2], must be three numbers"},
      {R"({"scalp": {"hairline": [{"azimuth": 3}]}})", "scalp.hairline[0].elevation is missing"},
      {R"({"scalp": {"hairline": [{"azimuth": 9, "elevation": 0}, {"azimuth": 3, "elevation": 0}]}})",
       "scalp.hairline[1].azimuth must be greater"},
      {R"({"length": {"layers": -3}})", "length.layers is -3, must be a number in [-2, 0.9]"},
      {R"({"flow": {"gravity": 2}})", "flow.gravity is 2, must be a number in [0, 1]"},
      {R"({"undercoat": {"fraktion": 1}})", "undercoat.fraktion is no key"},
      {R"({"clumps": [{"count": 10}, {"count": 5}]})", "clumps[1].count must be greater"},
      {R"({"clumps": {"count": 10}})", "clumps is {\"count\":10}, must be an array"},
      {R"({"cameras": [{"name": "a"}]})", "cameras[0].eye is missing"},
      {R"({"strands": 5,})", "not valid JSON (line 1"},
      {"{\n\n\"strands\" 5}", "not valid JSON (line 3"},
      {"[]", "the recipe is [], must be an object"},
      {"", "not valid JSON"},
  };
  for (const BadRecipe& entry : table) {
    const std::string said = errorOf(entry.text);
    EXPECT_NE(said.find(entry.message), std::string::npos) << entry.text << "\nsaid: " << said;
  }
}

TEST(GroomRecipe, InvalidUtf8IsAnErrorNotACrash) {
  EXPECT_NE(errorOf("{\"\xff\xfe\": 1}"), "");
}

TEST(GroomRecipe, MissingFileIsAnError) { EXPECT_THROW(loadRecipe("/nonexistent/groom.json"), RecipeError); }

}  // namespace
}  // namespace forelock::samples
