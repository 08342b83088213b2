// `forelock groom`: a procedural groom written to a strand file. SPDX-License-Identifier: MIT
#include "commands.h"
#include "progress.h"
#include "strand_formats.h"

#include <cstdio>

namespace forelock::samples {

namespace {

struct GroomArguments {
  std::string recipe, out;
  uint32_t strands = 0, vertices = 0;
  uint64_t seed = 0;
  bool list = false;
};

constexpr const char* kExamples =
    "The same recipe gives the same bytes on every machine. Recipes are explained in docs/grooms.md.\n\n"
    "Examples:\n"
    "  forelock groom --list                               the grooms that come with Forelock\n"
    "  forelock groom long-wavy hair.hair                  with widths\n"
    "  forelock groom my-recipe.json hair.tfx              TressFX; widths are left out\n"
    "  forelock groom long-wavy thin.hair --strands 4000   fewer strands, the rest as in the recipe\n";

void listGrooms() {
  for (const std::string& name : groomNames()) {
    std::string about;
    try {
      const Recipe recipe = openRecipe("groom:" + name);
      about = groupedDigits(recipe.strands) + " strands x " + std::to_string(recipe.vertices) + "  " +
              recipe.description;
    } catch (const AssetError& error) {
      about = std::string("cannot be used: ") + error.what();
    }
    std::printf("%-14s %s\n", name.c_str(), about.c_str());
  }
}

void runGroom(const CLI::App& command, const GroomArguments& arguments) {
  if (arguments.list) {
    listGrooms();
    return;
  }
  if (arguments.recipe.empty() || arguments.out.empty()) {
    throw UsageError("groom needs RECIPE and OUT, or --list; `forelock groom --help` explains");
  }
  if (!writableFormatOf(arguments.out)) {
    throw UsageError(arguments.out + ": no writer for this extension, use " + writableExtensions());
  }
  Recipe recipe = openRecipe(arguments.recipe);
  if (command.count("--strands")) {
    recipe.strands = arguments.strands;
  }
  if (command.count("--vertices")) {
    recipe.vertices = arguments.vertices;
  }
  if (command.count("--seed")) {
    recipe.seed = arguments.seed;
  }
  OpenedAsset opened;
  {
    Progress progress("growing " + recipe.name);
    opened = growAsset(recipe, arguments.recipe, [&](uint64_t done, uint64_t total) { progress.update(done, total); });
  }
  printMessages(*opened.messages, false);
  printMessages(saveAsset(opened, arguments.out), true);
  FlkAssetInfo info = {};
  flkAssetGetInfo(opened.asset.get(), &info);
  std::printf("%s: %s strands, %s vertices\n", arguments.out.c_str(), groupedDigits(info.strand_count).c_str(),
              groupedDigits(info.vertex_count).c_str());
}

}  // namespace

void addGroomCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("groom", "Write a procedural groom to a strand file.");
  auto arguments = std::make_shared<GroomArguments>();
  command->add_option("RECIPE", arguments->recipe, "A recipe: a .json file, or the name of a groom");
  command->add_option("OUT", arguments->out, "The file to write: " + writableExtensions());
  command->add_option("--strands", arguments->strands, "Strands instead of the recipe's")
      ->check(CLI::Range(1u, 1000000u))->type_name("N");
  command->add_option("--vertices", arguments->vertices, "Vertices of a strand instead of the recipe's")
      ->check(CLI::Range(2u, 256u))->type_name("N");
  command->add_option("--seed", arguments->seed, "Seed instead of the recipe's: another head, same style")
      ->type_name("N");
  command->add_flag("--list", arguments->list, "Name the grooms that come with Forelock");
  command->footer(kExamples);
  command->callback([command, arguments, &exit_code] {
    runGroom(*command, *arguments);
    exit_code = kDone;
  });
}

}  // namespace forelock::samples
