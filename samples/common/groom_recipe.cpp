// SPDX-License-Identifier: MIT
#include "groom_recipe.h"

#include "key_reader.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace forelock::samples {

namespace {

void readScalp(KeyReader reader, Recipe& recipe) {
  reader.vector("centre", recipe.scalp.centre, -1.0, 1.0, "m");
  reader.vector("radii", recipe.scalp.radii, 0.01, 1.0, "m");
  reader.number("feather", recipe.scalp.feather_deg, 0.0, 45.0, "degrees");
  double before = -1.0;
  const nlohmann::json& points = reader.array("hairline", 32);
  for (size_t i = 0; i < points.size(); ++i) {
    KeyReader point(points[i], reader.fullKey("hairline[" + std::to_string(i) + "]"));
    HairlinePoint entry{0.0, 0.0};
    point.require("azimuth");
    point.require("elevation");
    point.number("azimuth", entry.azimuth_deg, 0.0, 180.0, "degrees");
    point.number("elevation", entry.elevation_deg, -90.0, 90.0, "degrees");
    point.finish();
    if (entry.azimuth_deg <= before) {
      throw RecipeError(point.fullKey("azimuth") + " must be greater than the entry's before it");
    }
    before = entry.azimuth_deg;
    recipe.scalp.hairline.push_back(entry);
  }
  reader.finish();
  if (recipe.scalp.hairline.empty()) {
    // Forehead, temple, over the ear, nape.
    recipe.scalp.hairline = {{0, 33}, {35, 30}, {60, 8}, {78, -4}, {100, -2}, {125, -26}, {180, -34}};
  }
}

void readLength(KeyReader reader, Recipe& recipe) {
  reader.number("mean", recipe.length.mean, 0.001, 3.0, "m");
  reader.number("variation", recipe.length.variation, 0.0, 0.9, "");
  reader.number("clump_variation", recipe.length.clump_variation, 0.0, 0.9, "");
  reader.number("layers", recipe.length.layers, -2.0, 0.9, "");
  reader.number("front", recipe.length.front, -2.0, 0.9, "");
  reader.number("hem", recipe.length.hem, -10.0, 10.0, "m");
  reader.number("hem_variation", recipe.length.hem_variation, 0.0, 1.0, "m");
  reader.finish();
}

void readFlow(KeyReader reader, Recipe& recipe) {
  reader.number("lift", recipe.flow.lift, 0.0, 1.0, "");
  reader.number("bend", recipe.flow.bend, 0.002, 10.0, "m");
  reader.number("gravity", recipe.flow.gravity, 0.0, 1.0, "");
  reader.number("comb", recipe.flow.comb, 0.001, 10.0, "m");
  reader.number("back", recipe.flow.back, -2.0, 2.0, "");
  reader.number("whorl", recipe.flow.whorl, 0.0, 1.0, "");
  reader.number("ruffle", recipe.flow.ruffle, 0.0, 4.0, "");
  reader.number("ruffle_size", recipe.flow.ruffle_size, 0.001, 1.0, "m");
  reader.number("face_gap", recipe.flow.face_gap, 0.0, 0.2, "m");
  reader.number("gather", recipe.flow.gather, 0.0, 4.0, "");
  reader.number("clearance_low", recipe.flow.clearance_low, 0.0, 0.1, "m");
  reader.number("clearance_high", recipe.flow.clearance_high, 0.0, 0.1, "m");
  reader.number("clearance_spread", recipe.flow.clearance_spread, 0.0, 1.0, "");
  reader.finish();
}

void readWave(KeyReader reader, Wave& wave) {
  reader.number("amplitude", wave.amplitude, 0.0, 0.1, "m");
  reader.number("wavelength", wave.wavelength, 0.002, 2.0, "m");
  reader.number("depth", wave.depth, 0.0, 1.0, "");
  reader.number("coherence", wave.coherence, 0.0, 1.0, "");
  reader.number("variation", wave.variation, 0.0, 1.0, "");
  reader.number("start", wave.start, 0.0, 1.0, "m");
  reader.finish();
}

void readClumps(KeyReader& top, Recipe& recipe) {
  const nlohmann::json& levels = top.array("clumps", 4);
  for (size_t i = 0; i < levels.size(); ++i) {
    KeyReader reader(levels[i], "clumps[" + std::to_string(i) + "]");
    ClumpLevel level{100, 0.7, 0.1, 0.6, 0.2};
    reader.integer("count", level.count, 1, 100000);
    reader.number("tightness", level.tightness, 0.0, 1.0, "");
    reader.number("start", level.start, 0.0, 1.0, "");
    reader.number("full", level.full, 0.0, 1.0, "");
    reader.number("spread", level.spread, 0.0, 1.0, "");
    reader.finish();
    if (!recipe.clumps.empty() && level.count <= recipe.clumps.back().count) {
      throw RecipeError(reader.fullKey("count") + " must be greater than the coarser level's before it");
    }
    recipe.clumps.push_back(level);
  }
}

void readCameras(KeyReader& top, Recipe& recipe) {
  const nlohmann::json& cameras = top.array("cameras", 64);
  for (size_t i = 0; i < cameras.size(); ++i) {
    KeyReader reader(cameras[i], "cameras[" + std::to_string(i) + "]");
    RecipeCamera camera{"", {0, 0, 1}, {0, 0, 0}, {0, 1, 0}, 30.0, 0.1, 10.0, 1920, 1200};
    for (const char* key : {"name", "eye", "target", "vertical_fov"}) {
      reader.require(key);
    }
    reader.text("name", camera.name);
    reader.vector("eye", camera.eye, -1000.0, 1000.0, "m");
    reader.vector("target", camera.target, -1000.0, 1000.0, "m");
    reader.vector("up", camera.up, -1.0, 1.0, "");
    reader.number("vertical_fov", camera.vertical_fov_deg, 0.1, 170.0, "degrees");
    reader.number("near", camera.near_m, 1e-4, 1000.0, "m");
    reader.number("far", camera.far_m, 1e-3, 10000.0, "m");
    reader.integer("width", camera.width, 1, 16384);
    reader.integer("height", camera.height, 1, 16384);
    reader.finish();
    if (camera.far_m <= camera.near_m) {
      throw RecipeError(reader.fullKey("far") + " must be greater than near");
    }
    recipe.cameras.push_back(camera);
  }
}

Recipe readRecipe(const nlohmann::json& json, const std::string& name) {
  Recipe recipe;
  recipe.name = name;
  KeyReader top(json, "");
  top.text("name", recipe.name);
  top.text("description", recipe.description);
  top.integer("seed", recipe.seed);
  top.integer("strands", recipe.strands, 1, 1000000);
  top.integer("vertices", recipe.vertices, 2, 256);
  readScalp(top.object("scalp"), recipe);
  std::string body = "bust";
  top.text("drape_on", body);
  if (body != "bust" && body != "scalp") {
    throw RecipeError("drape_on is \"" + body + "\", must be \"bust\" or \"scalp\"");
  }
  recipe.drape_on_bust = body == "bust";
  readLength(top.object("length"), recipe);

  KeyReader parting = top.object("parting");
  parting.number("offset", recipe.parting.offset, -0.1, 0.1, "m");
  parting.number("strength", recipe.parting.strength, 0.0, 4.0, "");
  parting.finish();

  readFlow(top.object("flow"), recipe);
  readClumps(top, recipe);
  readWave(top.object("wave"), recipe.wave);
  readWave(top.object("curl"), recipe.curl);

  KeyReader frizz = top.object("frizz");
  frizz.number("amplitude", recipe.frizz.amplitude, 0.0, 0.1, "m");
  frizz.number("wavelength", recipe.frizz.wavelength, 0.002, 1.0, "m");
  frizz.finish();

  KeyReader flyaways = top.object("flyaways");
  flyaways.number("fraction", recipe.flyaways.fraction, 0.0, 1.0, "");
  flyaways.number("amplitude", recipe.flyaways.amplitude, 0.0, 0.2, "m");
  flyaways.number("loose", recipe.flyaways.loose, 0.0, 1.0, "");
  flyaways.finish();

  KeyReader undercoat = top.object("undercoat");
  undercoat.number("fraction", recipe.undercoat.fraction, 0.0, 1.0, "");
  undercoat.number("length", recipe.undercoat.length, 0.05, 1.0, "");
  undercoat.number("crimp", recipe.undercoat.crimp, 0.0, 0.1, "m");
  undercoat.number("wavelength", recipe.undercoat.wavelength, 0.002, 1.0, "m");
  undercoat.finish();

  KeyReader width = top.object("width");
  width.number("root", recipe.width.root, 1e-6, 0.1, "m");
  width.number("tip", recipe.width.tip, 0.0, 0.1, "m");
  width.number("taper", recipe.width.taper, 0.0, 0.999, "");
  width.finish();

  readCameras(top, recipe);
  top.finish();
  return recipe;
}

}  // namespace

Recipe parseRecipe(const std::string& text, const std::string& name) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    size_t line = 1;
    for (size_t i = 0; i < text.size() && i + 1 < error.byte; ++i) {
      line += text[i] == '\n' ? 1 : 0;
    }
    throw RecipeError("not valid JSON (line " + std::to_string(line) + ", byte " + std::to_string(error.byte) + ")");
  }
  return readRecipe(json, name);
}

std::string readSmallText(const std::string& path, const char* what) {
  constexpr uintmax_t largest = 16u << 20;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw RecipeError(std::filesystem::exists(path, error) ? "cannot be read as a " + std::string(what) + " file: it is no regular file" : "cannot be read as a " + std::string(what) + " file: it is not there");
  if (std::filesystem::file_size(path, error) > largest) throw RecipeError("cannot be read as a " + std::string(what) + " file: it is longer than 16 MiB, which no recipe or scene is");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw RecipeError("cannot be read as a " + std::string(what) + " file: check its permissions, and that it is not empty");
  return text.str();
}

Recipe loadRecipe(const std::string& path) {
  return parseRecipe(readSmallText(path, "recipe"), std::filesystem::path(path).stem().string());
}

}  // namespace forelock::samples
