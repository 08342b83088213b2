// `forelock convert`: any readable strand format to any writable one. SPDX-License-Identifier: MIT
#include "commands.h"
#include "convert_edits.h"
#include "progress.h"
#include "strand_formats.h"

#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace {

struct ConvertArguments : ConvertEdits {
  std::string in, out;
  uint32_t points_per_strand = 0;
  bool strict = false, overwrite = false;
};

constexpr const char* kExamples =
    "The format is told from IN's bytes and from OUT's extension. What the target cannot hold is left out and named.\n\n"
    "Examples:\n"
    "  forelock convert pony.tfx pony.hair\n"
    "  forelock convert pony.tfx pony.ply               keeps everything; any viewer of PLY files shows its lines\n"
    "  forelock convert pony.tfx pony.glb               glTF lines, which every viewer and Blender open; keeps everything\n"
    "  forelock convert groom:long-wavy hair.tfx\n"
    "  forelock convert pony.hair pony.flk              a cache that loads many times faster; cook it again after an update\n"
    "  forelock convert cm.hair game.tfx --scale 0.01 --axes x,z,-y --resample 16\n"
    "  forelock convert guides.tfx full.ply --interpolate 30000 --width 0.08 --width-profile 0:1,0.7:0.9,1:0.1\n"
    "  forelock convert full.ply far.ply --keep 12.5%   an eighth of the strands, eight times as wide\n"
    "  forelock convert pony.tfx pony.ply --root-image scalp.png --flip-v\n"
    "  forelock convert points.ply hair.ply --points-per-strand 100   bare points, as NeuralHaircut writes them\n"
    "  forelock convert --strict pony.hair pony.tfx     fail, and write nothing, if anything is lost\n";

bool saysDropped(const AssetMessage& message) { return message.id.rfind("WRITE_DROPS_", 0) == 0; }

int runConvert(const ConvertArguments& arguments) {
  if (!writableFormatOf(arguments.out)) {
    throw UsageError(arguments.out + ": no writer for this extension, use " + writableExtensions());
  }
  std::error_code error_of_compare;
  if (!arguments.overwrite && std::filesystem::equivalent(arguments.in, arguments.out, error_of_compare))
    throw UsageError(arguments.out + ": is the input itself, which is left as it is: name another file, or add --overwrite-input");
  OpenedAsset opened;
  {
    Progress progress("opening " + arguments.in);
    opened = openAsset(arguments.in, [&](uint64_t done, uint64_t total) { progress.update(done, total); },
                       {arguments.points_per_strand});
  }
  printMessages(*opened.messages, false);
  if (const uint32_t lost = arguments.any() ? applyEdits(opened, arguments) : 0; lost > 0) {
    std::fprintf(stderr, "forelock: %s: %s strands are lost, which no asset may hold after what was done to them%s\n", arguments.out.c_str(), groupedDigits(lost).c_str(),
                 arguments.strict ? "; not written, because --strict allows no loss" : "");
    if (arguments.strict) return kFailed;
  }
  if (arguments.strict) {
    bool lost = false;
    for (const AssetMessage& message : rehearseSave(opened, arguments.out)) {
      if (saysDropped(message)) {
        std::fprintf(stderr, "forelock: %s\n", message.text.c_str());
        lost = true;
      }
    }
    if (lost) {
      std::fprintf(stderr, "forelock: %s: not written, because --strict allows no loss\n", arguments.out.c_str());
      return kFailed;
    }
  }
  printMessages(saveAsset(opened, arguments.out), true);
  FlkAssetInfo info = {};
  flkAssetGetInfo(opened.asset.get(), &info);
  std::error_code error;
  uintmax_t bytes = std::filesystem::file_size(arguments.out, error);
  if (const std::string buffer = gltfBufferPath(arguments.out); !error && !buffer.empty()) bytes += std::filesystem::file_size(buffer, error);
  std::printf("%s: %s strands, %s vertices, %s\n", arguments.out.c_str(), groupedDigits(info.strand_count).c_str(),
              groupedDigits(info.vertex_count).c_str(), readableBytes(error ? 0 : bytes).c_str());
  return kDone;
}

}  // namespace

void addConvertCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("convert", "Write an asset in another strand format.");
  auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("IN", arguments->in, "A strand file, a recipe or groom:NAME")->required();
  command->add_option("OUT", arguments->out, "The file to write: " + writableExtensions())->required();
  command->add_flag("--strict", arguments->strict, "Fail instead of leaving out what the target cannot hold");
  command->add_flag("--overwrite-input", arguments->overwrite, "Allow OUT to be the input itself");
  addConvertEdits(*command, *arguments);
  addOpenOptions(*command, arguments->points_per_strand);
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runConvert(*arguments); });
}

}  // namespace forelock::samples
