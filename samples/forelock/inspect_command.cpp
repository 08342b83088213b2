// `forelock inspect`: what is in an asset, what is wrong with it, and how to mend it. SPDX-License-Identifier: MIT
#include "commands.h"
#include "inspect_batch.h"
#include "inspect_report.h"
#include "progress.h"
#include "rig_report.h"
#include "strand_formats.h"
#include "strand_edit.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace forelock::samples {

namespace {

namespace fs = std::filesystem;

struct InspectArguments {
  std::vector<std::string> assets;
  std::string bones, csv, repair;
  std::vector<std::string> repair_only, repair_also;
  uint32_t points_per_strand = 0;
  bool json = false;
  bool strict = false;
  bool overwrite = false;
};

constexpr const char* kExamples =
    "Lengths and widths are in the asset's own unit, metres by convention; unit and up axis are guesses. Findings are explained in\n"
    "docs/findings.md, the JSON in docs/inspect-json.md. The input is never touched.\n\n"
    "Examples:\n"
    "  forelock inspect pony.tfx\n"
    "  forelock inspect groom:long-wavy --json\n"
    "  forelock inspect head.tfxbone                         bones and weights; head.tfxmesh: the collision mesh\n"
    "  forelock inspect pony.tfx --bones pony.tfxbone        do both belong together?\n"
    "  forelock inspect points.ply --points-per-strand 100   a PLY file of bare points, as NeuralHaircut writes them\n"
    "  forelock inspect grooms/ --csv grooms.csv             a line a file; one that cannot be read does not stop the rest\n"
    "  forelock inspect --strict pony.hair && echo clean     exit status 1 on any warning or error\n"
    "  forelock inspect pony.hair --repair mended.hair       copies and stray strands go; every change is listed\n"
    "  forelock inspect pony.hair --repair turned.hair --repair-only ROOT_AT_TIP\n";

OpenedAsset open(const std::string& source, uint32_t points_per_strand) {
  Progress progress("opening " + source);
  return openAsset(source, [&](uint64_t done, uint64_t total) { progress.update(done, total); }, {points_per_strand});
}

std::vector<std::string> wantedRepairs(const InspectArguments& arguments) {
  std::vector<std::string> codes = arguments.repair_only;
  if (codes.empty()) {
    for (const RepairKind& kind : repairKinds())
      if (kind.unasked) codes.emplace_back(kind.code);
  }
  codes.insert(codes.end(), arguments.repair_also.begin(), arguments.repair_also.end());
  return codes;
}

struct Written {
  std::vector<Repair> repairs;
  std::vector<AssetMessage> said;  // above all what the format cannot hold
  FlkAssetInfo info{};
  std::vector<AssetFinding> left;
};

Written writeRepaired(const OpenedAsset& opened, const Inspected& seen, const InspectArguments& arguments) {
  std::error_code error;
  if (!arguments.overwrite && fs::equivalent(opened.label, arguments.repair, error))
    throw UsageError(arguments.repair + ": is the input itself, which is left as it is: name another file, or add --overwrite-input");
  FlkStrands held{};
  flkAssetGetStrands(opened.asset.get(), &held);
  EditableStrands strands = editableStrands(held, seen.info.has_radii != 0);
  Written written;
  written.repairs = repairsOnLoading(seen.findings);
  for (Repair& repair : repairStrands(strands, seen.info, seen.findings, wantedRepairs(arguments))) written.repairs.push_back(std::move(repair));
  const OpenedAsset mended = assetOf(strands.view(), arguments.repair);
  try {
    written.said = saveAsset(mended, arguments.repair);
  } catch (const AssetError& failure) {
    const bool uneven = std::any_of(written.repairs.begin(), written.repairs.end(), [](const Repair& repair) { return repair.code == "SEGMENT_ZERO_LENGTH"; });
    if (failure.result != FLK_ERROR_LIMIT || !uneven) throw;
    throw AssetError(failure.result, std::string(failure.what()) + "; or leave repeated vertices in, with --repair-only and without SEGMENT_ZERO_LENGTH");
  }
  flkAssetGetInfo(mended.asset.get(), &written.info);
  written.left = findingsOf(mended);
  return written;
}

void printWritten(const Written& written, const std::string& path) {
  for (const Repair& repair : written.repairs) std::printf("  %-11s %s x %s: %s\n", "changed", repair.code.c_str(), groupedDigits(repair.count).c_str(), repair.what.c_str());
  if (written.repairs.empty()) std::printf("  %-11s nothing\n", "changed");
  std::printf("  %-11s %s: %s strands, %s vertices", "written", path.c_str(), groupedDigits(written.info.strand_count).c_str(), groupedDigits(written.info.vertex_count).c_str());
  std::string left;
  for (const AssetFinding& finding : written.left)
    if (finding.severity != FLK_SEVERITY_INFO) left += (left.empty() ? "; still " : ", ") + finding.code;
  std::printf("%s\n", left.c_str());
}

int inspectOne(const InspectArguments& arguments) {
  if (arguments.bones.empty() && arguments.repair.empty()) {
    if (const std::optional<int> done = inspectIfRig(arguments.assets[0], arguments.json, arguments.strict)) return *done;
  }
  const OpenedAsset opened = open(arguments.assets[0], arguments.points_per_strand);
  std::optional<OpenedRig> rig;
  if (!arguments.bones.empty()) rig = openRig(arguments.bones, opened.asset.get());
  const Inspected seen = inspectAsset(opened);
  nlohmann::ordered_json json;
  if (arguments.json) {
    json = inspectedJson(seen);
    if (rig) json["rig"] = rigJson(*rig);
  } else {
    printInspected(seen);
    if (rig) printRig(*rig);
  }
  if (!arguments.repair.empty()) {
    const Written written = writeRepaired(opened, seen, arguments);
    printMessages(written.said, true);
    if (arguments.json) {
      json["repairs"] = repairsJson(written.repairs);
      json["written"] = arguments.repair;
    } else {
      printWritten(written, arguments.repair);
    }
  }
  if (arguments.json) printJsonText(json);
  if (!arguments.csv.empty()) {
    InspectedFiles alone;
    alone.files.push_back({arguments.assets[0], "", seen});
    writeCsv(alone, arguments.csv);
  }
  const bool clean = seen.count(FLK_SEVERITY_WARNING) + seen.count(FLK_SEVERITY_ERROR) == 0 && (!rig || rig->clean());
  return arguments.strict && !clean ? kFailed : kDone;
}

int inspectMany(const InspectArguments& arguments) {
  if (!arguments.repair.empty()) throw UsageError("--repair takes one asset, not several or a folder; repair them one by one");
  if (!arguments.bones.empty()) throw UsageError("--bones belongs to one asset, not to several or a folder");
  const InspectedFiles all = inspectFiles(arguments.assets, [&](const std::string& source) { return open(source, arguments.points_per_strand); });
  if (arguments.json) printJsonText(filesJson(all));
  else printTable(all);
  if (all.files.empty()) std::fprintf(stderr, "forelock: %s: no strand file is in it\n", arguments.assets[0].c_str());
  if (!arguments.csv.empty()) writeCsv(all, arguments.csv);
  return all.failed() || (arguments.strict && !all.clean()) ? kFailed : kDone;
}

int runInspect(const InspectArguments& arguments) {
  if (!arguments.csv.empty() && fs::path(arguments.csv).extension() != ".csv") throw UsageError(arguments.csv + ": --csv writes a file whose name ends in .csv");
  if (arguments.repair.empty() && (arguments.overwrite || !arguments.repair_only.empty() || !arguments.repair_also.empty()))
    throw UsageError("--repair-only, --repair-also and --overwrite-input need --repair OUT");
  if (!arguments.repair.empty() && !writableFormatOf(arguments.repair))
    throw UsageError(arguments.repair + ": no writer for this extension, use " + writableExtensions());
  try {  // before a long load
    EditableStrands none;
    none.first_vertex.push_back(0);
    repairStrands(none, {}, {}, wantedRepairs(arguments));
  } catch (const std::invalid_argument& wrong) {
    throw UsageError(wrong.what());
  }
  std::error_code error;
  return arguments.assets.size() == 1 && !fs::is_directory(arguments.assets[0], error) ? inspectOne(arguments) : inspectMany(arguments);
}

std::string repairHelp() {
  std::string by_itself, asked;
  for (const RepairKind& kind : repairKinds()) (kind.unasked ? by_itself : asked) += std::string((kind.unasked ? by_itself : asked).empty() ? "" : ", ") + kind.code;
  return "Write the asset mended: what loading mends, and " + by_itself + ". On request (--repair-also): " + asked;
}

}  // namespace

void addInspectCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("inspect", "Say what is in an asset, and what is wrong with it.");
  auto arguments = std::make_shared<InspectArguments>();
  command->add_option("ASSET", arguments->assets, "Strand files, recipes, groom:NAME, or folders; of several a table. Or a rig: .tfxbone, .tfxmesh")->required();
  command->add_option("--bones", arguments->bones, "The hair's .tfxbone file, to be checked with it")->type_name("FILE");
  addOpenOptions(*command, arguments->points_per_strand);
  command->add_flag("--json", arguments->json, "Print JSON for programs");
  command->add_flag("--strict", arguments->strict, "Exit with 1 if there is any finding of severity warning or error");
  command->add_option("--csv", arguments->csv, "Write a line a file, for a spreadsheet")->type_name("OUT.csv");
  command->add_option("--repair", arguments->repair, repairHelp())->type_name("OUT");
  command->add_option("--repair-only", arguments->repair_only, "Mend these findings and what loading mends, nothing else")->delimiter(',')->allow_extra_args(false)->type_name("CODE,...");
  command->add_option("--repair-also", arguments->repair_also, "Mend these findings as well")->delimiter(',')->allow_extra_args(false)->type_name("CODE,...");
  command->add_flag("--overwrite-input", arguments->overwrite, "Allow OUT to be the asset's own file");
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runInspect(*arguments); });
}

}  // namespace forelock::samples
