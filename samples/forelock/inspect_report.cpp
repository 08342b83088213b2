// SPDX-License-Identifier: MIT
#include "inspect_report.h"

#include "commands.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::samples {
namespace {

using Json = nlohmann::ordered_json;

Json spreadJson(const Spread& spread) { return {{"min", spread.min}, {"median", spread.median}, {"mean", spread.mean}, {"max", spread.max}}; }

Json rankedJson(const std::vector<RankedStrand>& ranked) {
  Json list = Json::array();
  for (const RankedStrand& entry : ranked) list.push_back({{"strand", entry.strand}, {"value", entry.value}});
  return list;
}

Json guessJson(const Guess& guess) {
  Json json;
  json["value"] = guess.value.empty() ? Json() : Json(guess.value);
  json["why"] = guess.why;
  return json;
}

void printSpread(const char* name, const Spread& spread, const char* after = "") {
  if (spread.min == spread.max) {
    std::printf("  %-11s %.4g%s\n", name, spread.min, after);
    return;
  }
  std::printf("  %-11s %.4g to %.4g, median %.4g, mean %.4g%s\n", name, spread.min, spread.max, spread.median, spread.mean, after);
}

std::string rankedText(const std::vector<RankedStrand>& ranked, const char* unit = "") {
  std::string text;
  for (size_t i = 0; i < ranked.size() && i < 3; ++i) {
    char entry[64];
    std::snprintf(entry, sizeof entry, "%s%u (%.3g%s)", i ? ", " : "", ranked[i].strand, ranked[i].value, unit);
    text += entry;
  }
  return text;
}

void printFinding(const AssetFinding& finding) {
  std::printf("  %-11s %s x %s%s\n", severityName(finding.severity), finding.code.c_str(),
              groupedDigits(finding.count).c_str(), finding.repaired ? ", repaired" : "");
  std::printf("              %s\n", finding.text.c_str());
  if (!finding.strands.empty()) {
    std::printf("              strands");
    for (const uint32_t strand : finding.strands) std::printf(" %u", strand);
    std::printf("%s\n", finding.count > finding.strands.size() ? " ..." : "");
  }
  if (finding.byte_offset != UINT64_MAX) std::printf("              first at byte %s\n", groupedDigits(finding.byte_offset).c_str());
}

}  // namespace

uint64_t Inspected::count(uint32_t severity) const {
  return uint64_t(std::count_if(findings.begin(), findings.end(), [&](const AssetFinding& finding) { return finding.severity == severity; }));
}

std::string Inspected::firstCode() const {
  const auto worst = std::max_element(findings.begin(), findings.end(), [](const AssetFinding& a, const AssetFinding& b) { return a.severity < b.severity; });
  return worst == findings.end() ? "" : worst->code;
}

Inspected inspectAsset(const OpenedAsset& opened) {
  Inspected seen;
  seen.label = opened.label;
  seen.format = opened.format;
  seen.findings = findingsOf(opened);
  seen.groups = opened.group_names;
  FlkStrands strands{};
  flkAssetGetInfo(opened.asset.get(), &seen.info);
  flkAssetGetStrands(opened.asset.get(), &strands);
  seen.numbers = measureStrands(strands);
  seen.unit = guessUnit(seen.info);
  seen.up = guessUpAxis(seen.info, seen.numbers);
  return seen;
}

void printInspected(const Inspected& seen) {
  const FlkAssetInfo& info = seen.info;
  const StrandStatistics& numbers = seen.numbers;
  std::printf("%s\n", seen.label.c_str());
  const bool cooked = info.format == FLK_FORMAT_COOKED;
  std::printf("  format      %s%s%s\n", seen.format.c_str(), cooked ? ", from " : "", cooked ? formatName(info.source_format) : "");
  std::printf("  strands     %s", groupedDigits(info.strand_count).c_str());
  if (info.strands_in_source != info.strand_count) {
    std::printf(" of %s (the rest cannot be drawn)", groupedDigits(info.strands_in_source).c_str());
  }
  if (!seen.groups.empty()) std::printf(" in %zu groups", seen.groups.size());
  if (numbers.duplicates > 0) std::printf(", %s of them copies", groupedDigits(numbers.duplicates).c_str());
  std::printf("\n  vertices    %s, ", groupedDigits(info.vertex_count).c_str());
  if (info.min_vertices_per_strand == info.max_vertices_per_strand) {
    std::printf("%u a strand\n", info.max_vertices_per_strand);
  } else {
    std::printf("%u to %u a strand, median %.4g, mean %.4g\n", info.min_vertices_per_strand, info.max_vertices_per_strand, numbers.vertices.median,
                numbers.vertices.mean);
  }
  std::printf("  bounds      (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g)\n", double(info.min_bounds[0]), double(info.min_bounds[1]), double(info.min_bounds[2]),
              double(info.max_bounds[0]), double(info.max_bounds[1]), double(info.max_bounds[2]));
  printSpread("length", numbers.length);
  printSpread("segments", numbers.segment_length);
  printSpread("turns", numbers.turn_degrees, " degrees");
  printSpread("width", numbers.width, info.has_radii ? "" : " (a default: docs/findings.md; preview --width MM changes it)");
  std::printf("  unit        %s: %s\n", seen.unit.value.empty() ? "no guess" : (seen.unit.value + "?").c_str(), seen.unit.why.c_str());
  std::printf("  up          %s: %s\n", seen.up.value.empty() ? "no guess" : (seen.up.value + "?").c_str(), seen.up.why.c_str());
  std::printf("  attributes  positions%s%s%s%s\n", info.has_radii ? ", widths" : "",
              info.has_root_uvs ? ", root UV" : "", info.has_inverse_masses ? ", inverse masses" : "",
              info.has_colors ? ", colours" : "");
  std::printf("  look at     longest %s; shortest %s; sharpest %s\n", rankedText(numbers.longest).c_str(), rankedText(numbers.shortest).c_str(),
              rankedText(numbers.sharpest, " degrees").c_str());
  std::printf("  memory      %s here, %s on the device\n", readableBytes(info.bytes_host + info.bytes_mapped).c_str(), readableBytes(hairBytes(info)).c_str());
  if (seen.findings.empty()) std::printf("  findings    none\n");
  for (const uint32_t severity : {uint32_t{FLK_SEVERITY_ERROR}, uint32_t{FLK_SEVERITY_WARNING}, uint32_t{FLK_SEVERITY_INFO}})
    for (const AssetFinding& finding : seen.findings)
      if (finding.severity == severity) printFinding(finding);
}

Json inspectedJson(const Inspected& seen) {
  const FlkAssetInfo& info = seen.info;
  const StrandStatistics& numbers = seen.numbers;
  Json json;
  json["schema"] = "forelock.inspect/1";
  json["asset"] = seen.label;
  json["format"] = seen.format;
  json["source_format"] = info.format == FLK_FORMAT_COOKED ? nlohmann::ordered_json(formatName(info.source_format)) : nlohmann::ordered_json();
  json["strands"] = info.strand_count;
  json["strands_in_source"] = info.strands_in_source;
  json["duplicates"] = numbers.duplicates;
  json["groups"] = seen.groups;
  json["vertices"] = info.vertex_count;
  json["vertices_per_strand"] = spreadJson(numbers.vertices);
  json["bounds"] = {{"min", info.min_bounds}, {"max", info.max_bounds}};
  json["bounds_with_width"] = {{"min", numbers.min_bounds}, {"max", numbers.max_bounds}};
  json["length"] = spreadJson(numbers.length);
  json["segment_length"] = spreadJson(numbers.segment_length);
  json["unevenness"] = spreadJson(numbers.unevenness);
  json["turn_degrees"] = spreadJson(numbers.turn_degrees);
  json["width"] = spreadJson(numbers.width);
  json["width"]["source"] = info.has_radii ? "asset" : "default";
  json["direction"] = numbers.direction;
  json["unit_guess"] = guessJson(seen.unit);
  json["up_axis_guess"] = guessJson(seen.up);
  json["attributes"] = {{"widths", info.has_radii != 0},
                        {"root_uvs", info.has_root_uvs != 0},
                        {"inverse_masses", info.has_inverse_masses != 0},
                        {"colors", info.has_colors != 0}};
  json["longest"] = rankedJson(numbers.longest);
  json["shortest"] = rankedJson(numbers.shortest);
  json["sharpest"] = rankedJson(numbers.sharpest);
  json["bytes_host"] = info.bytes_host;
  json["bytes_mapped"] = info.bytes_mapped;
  json["bytes_device"] = hairBytes(info);
  json["findings"] = Json::array();
  for (const AssetFinding& finding : seen.findings) {
    Json entry;
    entry["code"] = finding.code;
    entry["severity"] = severityName(finding.severity);
    entry["repaired"] = finding.repaired;
    entry["count"] = finding.count;
    entry["strands"] = finding.strands;
    entry["byte_offset"] = finding.byte_offset == UINT64_MAX ? Json() : Json(finding.byte_offset);
    entry["text"] = finding.text;
    json["findings"].push_back(entry);
  }
  return json;
}

Json repairsJson(const std::vector<Repair>& repairs) {
  Json list = Json::array();
  for (const Repair& repair : repairs) list.push_back({{"code", repair.code}, {"count", repair.count}, {"what", repair.what}});
  return list;
}

void printJsonText(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

}  // namespace forelock::samples
