// SPDX-License-Identifier: MIT
#include "rig_report.h"

#include "commands.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>

namespace forelock::samples {

namespace {

void keepError(void* user, const FlkMessage* message) {
  if (message->severity == FLK_SEVERITY_ERROR) *static_cast<AssetMessage*>(user) = {message->severity, message->id, message->text};
}

// Empty on failure; `error` then says why, and `result` of which kind.
OpenedRig tryRig(const std::string& path, FlkAsset hair, AssetMessage& error, FlkResult& result) {
  OpenedRig opened;
  opened.label = path;
  FlkRigOptions options{};
  options.type = FLK_TYPE_RIG_OPTIONS;
  options.message = keepError;
  options.message_user = &error;
  options.name = path.c_str();
  options.asset = hair;
  FlkRig rig = nullptr;
  result = flkRigLoadFile(path.c_str(), &options, &rig);
  opened.rig.reset(rig);
  if (!rig) return opened;
  FlkRigInfo info{};
  flkRigGetInfo(rig, &info);
  for (uint32_t i = 0; i < info.finding_count; ++i) {
    FlkFinding finding{};
    flkRigGetFinding(rig, i, &finding);
    opened.findings.push_back({finding.code, finding.text, finding.severity, finding.repaired != 0, finding.count,
                               {finding.strands, finding.strands + finding.strands_listed}, finding.byte_offset});
  }
  return opened;
}

const char* recordsName(const FlkRigInfo& info) { return info.kind == FLK_RIG_SKIN ? "strands" : "vertices"; }

// How many records each bone has a share of.
std::vector<uint64_t> usesOf(const OpenedRig& opened, const FlkRigInfo& info) {
  FlkRigArrays arrays{};
  flkRigGetArrays(opened.rig.get(), &arrays);
  std::vector<uint64_t> uses(info.bone_count);
  for (size_t i = 0; i < size_t{info.record_count} * 4; ++i)
    if (arrays.weights[i] > 0) ++uses[arrays.bones[i]];
  return uses;
}

}  // namespace

bool OpenedRig::clean() const {
  return std::all_of(findings.begin(), findings.end(), [](const AssetFinding& finding) { return finding.severity == FLK_SEVERITY_INFO; });
}

OpenedRig openRig(const std::string& path, FlkAsset hair) {
  AssetMessage error{};
  FlkResult result = FLK_SUCCESS;
  OpenedRig opened = tryRig(path, hair, error, result);
  if (!opened.rig) throw AssetError(result, error.text);
  return opened;
}

void printRig(const OpenedRig& opened) {
  FlkRigInfo info{};
  FlkRigArrays arrays{};
  flkRigGetInfo(opened.rig.get(), &info);
  flkRigGetArrays(opened.rig.get(), &arrays);
  const std::vector<uint64_t> uses = usesOf(opened, info);
  std::printf("%s\n", opened.label.c_str());
  std::printf("  format      %s\n", info.kind == FLK_RIG_SKIN ? "tfxbone: bones and weights of strands" : "tfxmesh: mesh that hair collides with");
  std::printf("  %-11s %s", recordsName(info), groupedDigits(info.record_count).c_str());
  if (info.records_in_source != info.record_count) std::printf(" (%s in the file)", groupedDigits(info.records_in_source).c_str());
  if (info.unattached_count != 0) std::printf(", %s hang on nothing", groupedDigits(info.unattached_count).c_str());
  if (info.kind == FLK_RIG_MESH) {
    std::printf("\n  triangles   %s", groupedDigits(info.triangle_count).c_str());
    if (info.triangles_in_source != info.triangle_count) std::printf(" of %s", groupedDigits(info.triangles_in_source).c_str());
  }
  std::printf("\n  bones       %s, of which %s are used\n", groupedDigits(info.bone_count).c_str(),
              groupedDigits(static_cast<uint64_t>(std::count_if(uses.begin(), uses.end(), [](uint64_t count) { return count != 0; }))).c_str());
  for (uint32_t bone = 0; bone < info.bone_count; ++bone)
    if (uses[bone] != 0)
      std::printf("              %-4u %s: %s %s\n", bone, arrays.bone_names[bone], groupedDigits(uses[bone]).c_str(), recordsName(info));
  std::printf("  memory      %s\n", readableBytes(info.bytes_host).c_str());
  if (opened.findings.empty()) std::printf("  findings    none\n");
  for (const AssetFinding& finding : opened.findings) {
    std::printf("  %-11s %s x %s%s\n              %s\n", severityName(finding.severity), finding.code.c_str(), groupedDigits(finding.count).c_str(),
                finding.repaired ? ", repaired" : "", finding.text.c_str());
    if (finding.strands.empty()) continue;
    std::printf("              numbers");
    for (const uint32_t number : finding.strands) std::printf(" %u", number);
    std::printf("%s\n", finding.count > finding.strands.size() ? " ..." : "");
  }
}

nlohmann::ordered_json rigJson(const OpenedRig& opened) {
  FlkRigInfo info{};
  FlkRigArrays arrays{};
  flkRigGetInfo(opened.rig.get(), &info);
  flkRigGetArrays(opened.rig.get(), &arrays);
  const std::vector<uint64_t> uses = usesOf(opened, info);
  nlohmann::ordered_json json;
  json["rig"] = opened.label;
  json["format"] = info.kind == FLK_RIG_SKIN ? "tfxbone" : "tfxmesh";
  json[recordsName(info)] = info.record_count;
  json[std::string(recordsName(info)) + "_in_source"] = info.records_in_source;
  json["unattached"] = info.unattached_count;
  if (info.kind == FLK_RIG_MESH) {
    json["triangles"] = info.triangle_count;
    json["triangles_in_source"] = info.triangles_in_source;
  }
  json["bones"] = nlohmann::ordered_json::array();
  for (uint32_t bone = 0; bone < info.bone_count; ++bone) json["bones"].push_back({{"name", arrays.bone_names[bone]}, {recordsName(info), uses[bone]}});
  json["bytes_host"] = info.bytes_host;
  json["findings"] = nlohmann::ordered_json::array();
  for (const AssetFinding& finding : opened.findings) {
    nlohmann::ordered_json entry = {{"code", finding.code}, {"severity", severityName(finding.severity)}, {"repaired", finding.repaired},
                                    {"count", finding.count}, {"numbers", finding.strands}, {"byte_offset", nullptr}};
    if (finding.byte_offset != UINT64_MAX) entry["byte_offset"] = finding.byte_offset;
    entry["text"] = finding.text;
    json["findings"].push_back(entry);
  }
  return json;
}

std::optional<int> inspectIfRig(const std::string& path, bool json, bool strict) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (path.rfind("groom:", 0) == 0 || extension == ".json") return std::nullopt;
  AssetMessage error{};
  FlkResult result = FLK_SUCCESS;
  const OpenedRig opened = tryRig(path, nullptr, error, result);
  if (!opened.rig) {
    // A binary file that is nothing else is taken for a .tfxbone: only its name makes that worth saying.
    const bool meant = extension == ".tfxbone" || extension == ".tfxmesh" || error.id.rfind("MESH_", 0) == 0 || error.id.rfind("SKIN_", 0) == 0;
    if (meant) throw AssetError(result, error.text);
    return std::nullopt;
  }
  if (json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;  // names need not be UTF-8
    std::printf("%s\n", rigJson(opened).dump(2, ' ', false, replace).c_str());
  } else {
    printRig(opened);
  }
  return strict && !opened.clean() ? kFailed : kDone;
}

}  // namespace forelock::samples
