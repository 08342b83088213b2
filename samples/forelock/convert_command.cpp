// `forelock convert`: any readable strand format to any writable one. SPDX-License-Identifier: MIT
#include "commands.h"
#include "progress.h"
#include "strand_edit.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace forelock::samples {

namespace {

struct ConvertArguments {
  std::string in, out;
  bool strict = false;
  std::string axes;
  double scale = 1, min_length = 0;
  uint32_t resample = 0, points_per_strand = 0;
  bool flip_v = false, reverse = false, recentre = false;

  bool edits() const { return !axes.empty() || scale != 1 || min_length > 0 || resample != 0 || flip_v || reverse || recentre; }
};

constexpr const char* kExamples =
    "The format is told from IN's bytes and from OUT's extension. What the target cannot hold is left out and named.\n\n"
    "Examples:\n"
    "  forelock convert pony.tfx pony.hair\n"
    "  forelock convert pony.tfx pony.ply               keeps everything; any viewer of PLY files shows its lines\n"
    "  forelock convert groom:long-wavy hair.tfx\n"
    "  forelock convert cm.hair game.tfx --scale 0.01 --axes x,z,-y --resample 16\n"
    "  forelock convert points.ply hair.ply --points-per-strand 100   bare points, as NeuralHaircut writes them\n"
    "  forelock convert --strict pony.hair pony.tfx     fail, and write nothing, if anything is lost\n";

bool saysDropped(const AssetMessage& message) { return message.id.rfind("WRITE_DROPS_", 0) == 0; }

// Asks the library what it would leave out, without writing a file.
std::vector<AssetMessage> rehearse(const OpenedAsset& opened, uint32_t format) {
  const size_t before = opened.messages->size();
  size_t size = 0;
  if (flkAssetSaveMemory(opened.asset.get(), format, nullptr, &size) == FLK_SUCCESS) {
    std::vector<unsigned char> bytes(size);
    flkAssetSaveMemory(opened.asset.get(), format, bytes.data(), &size);
  }
  return {opened.messages->begin() + static_cast<std::ptrdiff_t>(before), opened.messages->end()};
}

// Says what it did, a line each, in the order in which it does it.
void edit(OpenedAsset& opened, const ConvertArguments& arguments) {
  FlkStrands held{};
  FlkAssetInfo info{};
  flkAssetGetStrands(opened.asset.get(), &held);
  flkAssetGetInfo(opened.asset.get(), &info);
  EditableStrands strands = editableStrands(held, info.has_radii != 0);
  if (arguments.reverse) reverseStrands(strands), std::printf("reversed: roots are where tips were\n");
  if (!arguments.axes.empty()) {
    const AxisMap map = parseAxes(arguments.axes);
    mapAxes(strands, map);
    std::printf("axes: %s%s\n", arguments.axes.c_str(), map.mirrors() ? ", which mirrors the hair" : "");
  }
  if (arguments.scale != 1) scaleStrands(strands, arguments.scale), std::printf("scaled by %g, widths too\n", arguments.scale);
  if (arguments.recentre) {
    const std::array<double, 3> shift = recentreStrands(strands);
    std::printf("moved by %g %g %g\n", shift[0], shift[1], shift[2]);
  }
  if (arguments.min_length > 0) {
    const uint32_t removed = removeShortStrands(strands, arguments.min_length);
    std::printf("removed %s strands shorter than %g\n", groupedDigits(removed).c_str(), arguments.min_length);
    if (strands.strands() == 0) throw AssetError(FLK_ERROR_EMPTY_ASSET, opened.label + ": no strand is as long as --min-length asks for");
  }
  if (arguments.resample != 0) {
    const ResampleReport report = resampleStrands(strands, arguments.resample);
    std::printf("resampled to %u vertices a strand: lengths are off by %.2g %% on average, by %.2g %% at most (strand %u)\n", arguments.resample,
                100 * report.mean_error, 100 * report.worst_error, report.worst_strand);
  }
  if (arguments.flip_v) {
    flipV(strands);
    std::printf(strands.root_uvs.empty() ? "no root UVs to flip\n" : "flipped v of the root UVs\n");
  }
  OpenedAsset edited = assetOf(strands.view(), opened.label);
  std::swap(opened.asset, edited.asset);  // before the messages that each points to
  std::swap(opened.messages, edited.messages);
}

int runConvert(const ConvertArguments& arguments) {
  const uint32_t format = formatOfPath(arguments.out);
  if (format == FLK_FORMAT_UNKNOWN) {
    throw UsageError(arguments.out + ": no writer for this extension, use .tfx, .hair or .ply");
  }
  OpenedAsset opened;
  {
    Progress progress("opening " + arguments.in);
    opened = openAsset(arguments.in, [&](uint64_t done, uint64_t total) { progress.update(done, total); },
                       {arguments.points_per_strand});
  }
  printMessages(*opened.messages, false);
  if (arguments.edits()) edit(opened, arguments);
  if (arguments.strict) {
    bool lost = false;
    for (const AssetMessage& message : rehearse(opened, format)) {
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
  const uintmax_t bytes = std::filesystem::file_size(arguments.out, error);
  std::printf("%s: %s strands, %s vertices, %s\n", arguments.out.c_str(), groupedDigits(info.strand_count).c_str(),
              groupedDigits(info.vertex_count).c_str(), readableBytes(error ? 0 : bytes).c_str());
  return kDone;
}

}  // namespace

void addConvertCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("convert", "Write an asset in another strand format.");
  auto arguments = std::make_shared<ConvertArguments>();
  command->add_option("IN", arguments->in, "A strand file, a recipe or groom:NAME")->required();
  command->add_option("OUT", arguments->out, "The file to write: .hair, .ply or .tfx")->required();
  command->add_flag("--strict", arguments->strict, "Fail instead of leaving out what the target cannot hold");
  command->add_option("--scale", arguments->scale, "Positions and widths times this: 0.01 makes metres of centimetres")->check(CLI::PositiveNumber);
  command->add_option("--axes", arguments->axes, "New axes from old ones: x,z,-y makes y up of z up, x,-z,y the other way")->check([](const std::string& text) {
    try {
      parseAxes(text);
      return std::string();
    } catch (const std::invalid_argument& wrong) {
      return "--axes " + std::string(wrong.what());
    }
  });
  command->add_flag("--recentre", arguments->recentre, "Move the middle of the hair to the origin");
  command->add_flag("--reverse", arguments->reverse, "Swap root and tip of every strand");
  command->add_flag("--flip-v", arguments->flip_v, "v of the root UVs becomes 1 - v");
  command->add_option("--min-length", arguments->min_length, "Remove strands that are shorter (unit of the written file)")->check(CLI::PositiveNumber);
  command->add_option("--resample", arguments->resample, "Vertices a strand, evenly along it; says how far lengths are off")->check(CLI::Range(2, 1024));
  addOpenOptions(*command, arguments->points_per_strand);
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runConvert(*arguments); });
}

}  // namespace forelock::samples
