// `forelock inspect`: what is in an asset, and what is wrong with it. SPDX-License-Identifier: MIT
#include "commands.h"
#include "progress.h"
#include "rig_report.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace forelock::samples {

namespace {

struct InspectArguments {
  std::string asset, bones;
  uint32_t points_per_strand = 0;
  bool json = false;
  bool strict = false;
};

constexpr const char* kExamples =
    "Lengths and widths are in the asset's own unit, metres by convention. Findings are explained in\n"
    "docs/findings.md; `repaired` ones were mended while loading, the file itself is never touched.\n\n"
    "Examples:\n"
    "  forelock inspect pony.tfx\n"
    "  forelock inspect groom:long-wavy --json\n"
    "  forelock inspect head.tfxbone                         bones and weights; head.tfxmesh: the collision mesh\n"
    "  forelock inspect pony.tfx --bones pony.tfxbone        do both belong together?\n"
    "  forelock inspect points.ply --points-per-strand 100   a PLY file of bare points, as NeuralHaircut writes them\n"
    "  forelock inspect --strict pony.hair && echo clean     exit status 1 on any warning or error\n";

void printText(const OpenedAsset& opened, const FlkAssetInfo& info, const std::vector<AssetFinding>& findings) {
  std::printf("%s\n", opened.label.c_str());
  std::printf("  format      %s\n", opened.format.c_str());
  std::printf("  strands     %s", groupedDigits(info.strand_count).c_str());
  if (info.strands_in_source != info.strand_count) {
    std::printf(" of %s (the rest cannot be drawn)", groupedDigits(info.strands_in_source).c_str());
  }
  std::printf("\n  vertices    %s, ", groupedDigits(info.vertex_count).c_str());
  if (info.min_vertices_per_strand == info.max_vertices_per_strand) {
    std::printf("%u a strand\n", info.max_vertices_per_strand);
  } else {
    std::printf("%u to %u a strand\n", info.min_vertices_per_strand, info.max_vertices_per_strand);
  }
  std::printf("  bounds      (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g)\n", info.min_bounds[0], info.min_bounds[1],
              info.min_bounds[2], info.max_bounds[0], info.max_bounds[1], info.max_bounds[2]);
  std::printf("  length      %.4g to %.4g, mean %.4g\n", info.min_length, info.max_length, info.mean_length);
  std::printf("  width       %.4g to %.4g", 2.0 * info.min_radius, 2.0 * info.max_radius);
  std::printf(info.has_radii ? "\n" : " (default: 80 um x max(1, 100,000 / strands); preview --width MM changes it)\n");
  std::printf("  attributes  positions%s%s%s%s\n", info.has_radii ? ", widths" : "",
              info.has_root_uvs ? ", root UV" : "", info.has_inverse_masses ? ", inverse masses" : "",
              info.has_colors ? ", colours" : "");
  std::printf("  memory      %s\n", readableBytes(info.bytes_host).c_str());
  if (findings.empty()) {
    std::printf("  findings    none\n");
  }
  for (const AssetFinding& finding : findings) {
    std::printf("  %-11s %s x %s%s\n", severityName(finding.severity), finding.code.c_str(),
                groupedDigits(finding.count).c_str(), finding.repaired ? ", repaired" : "");
    std::printf("              %s\n", finding.text.c_str());
    if (!finding.strands.empty()) {
      std::printf("              strands");
      for (const uint32_t strand : finding.strands) {
        std::printf(" %u", strand);
      }
      std::printf("%s\n", finding.count > finding.strands.size() ? " ..." : "");
    }
    if (finding.byte_offset != UINT64_MAX) {
      std::printf("              first at byte %s\n", groupedDigits(finding.byte_offset).c_str());
    }
  }
}

void printJson(const OpenedAsset& opened, const FlkAssetInfo& info, const std::vector<AssetFinding>& findings, const OpenedRig* rig) {
  nlohmann::ordered_json json;
  json["asset"] = opened.label;
  json["format"] = opened.format;
  json["strands"] = info.strand_count;
  json["strands_in_source"] = info.strands_in_source;
  json["vertices"] = info.vertex_count;
  json["vertices_per_strand"] = {{"min", info.min_vertices_per_strand}, {"max", info.max_vertices_per_strand}};
  json["bounds"] = {{"min", info.min_bounds}, {"max", info.max_bounds}};
  json["length"] = {{"min", info.min_length}, {"mean", info.mean_length}, {"max", info.max_length}};
  json["width"] = {{"min", 2.0f * info.min_radius},
                   {"max", 2.0f * info.max_radius},
                   {"source", info.has_radii ? "asset" : "default"}};
  json["attributes"] = {{"widths", info.has_radii != 0},
                        {"root_uvs", info.has_root_uvs != 0},
                        {"inverse_masses", info.has_inverse_masses != 0},
                        {"colors", info.has_colors != 0}};
  json["bytes_host"] = info.bytes_host;
  json["findings"] = nlohmann::ordered_json::array();
  for (const AssetFinding& finding : findings) {
    nlohmann::ordered_json entry;
    entry["code"] = finding.code;
    entry["severity"] = severityName(finding.severity);
    entry["repaired"] = finding.repaired;
    entry["count"] = finding.count;
    entry["strands"] = finding.strands;
    entry["byte_offset"] = nullptr;
    if (finding.byte_offset != UINT64_MAX) {
      entry["byte_offset"] = finding.byte_offset;
    }
    entry["text"] = finding.text;
    json["findings"].push_back(entry);
  }
  if (rig) json["rig"] = rigJson(*rig);
  const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // a file name need not be UTF-8
  std::printf("%s\n", json.dump(2, ' ', false, replace).c_str());
}

int runInspect(const InspectArguments& arguments) {
  if (arguments.bones.empty()) {
    if (const std::optional<int> done = inspectIfRig(arguments.asset, arguments.json, arguments.strict)) return *done;
  }
  OpenedAsset opened;
  {
    Progress progress("opening " + arguments.asset);
    opened = openAsset(arguments.asset, [&](uint64_t done, uint64_t total) { progress.update(done, total); },
                       {arguments.points_per_strand});
  }
  std::optional<OpenedRig> rig;
  if (!arguments.bones.empty()) rig = openRig(arguments.bones, opened.asset.get());
  FlkAssetInfo info = {};
  flkAssetGetInfo(opened.asset.get(), &info);
  const std::vector<AssetFinding> findings = findingsOf(opened);
  if (arguments.json) {
    printJson(opened, info, findings, rig ? &*rig : nullptr);
  } else {
    printText(opened, info, findings);
    if (rig) printRig(*rig);
  }
  bool clean = !rig || rig->clean();
  for (const AssetFinding& finding : findings) {
    clean = clean && finding.severity == FLK_SEVERITY_INFO;
  }
  return arguments.strict && !clean ? kFailed : kDone;
}

}  // namespace

void addInspectCommand(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("inspect", "Say what is in an asset, and what is wrong with it.");
  auto arguments = std::make_shared<InspectArguments>();
  command->add_option("ASSET", arguments->asset, "A strand file, a recipe, groom:NAME, or a rig (.tfxbone, .tfxmesh)")->required();
  command->add_flag("--json", arguments->json, "Print JSON for programs");
  command->add_flag("--strict", arguments->strict, "Exit with 1 if there is any finding of severity warning or error");
  command->add_option("--bones", arguments->bones, "The hair's .tfxbone file, to be checked with it")->type_name("FILE");
  addOpenOptions(*command, arguments->points_per_strand);
  command->footer(kExamples);
  command->callback([arguments, &exit_code] { exit_code = runInspect(*arguments); });
}

}  // namespace forelock::samples
