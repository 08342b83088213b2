// SPDX-License-Identifier: MIT
#include "asset_source.h"

#include "groom.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

constexpr const char* kGroomPrefix = "groom:";

void collectMessage(void* user, const FlkMessage* message) {
  static_cast<std::vector<AssetMessage>*>(user)->push_back({message->severity, message->id, message->text});
}

std::string lowerExtension(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string lastError(const std::vector<AssetMessage>& messages, const std::string& label, FlkResult result) {
  for (size_t i = messages.size(); i-- > 0;) {
    if (messages[i].severity == FLK_SEVERITY_ERROR) {
      return messages[i].text;
    }
  }
  return label + ": failed with " + flkResultName(result);
}

OpenedAsset prepare(const std::string& label, FlkAssetOptions& options) {
  OpenedAsset opened;
  opened.messages = std::make_unique<std::vector<AssetMessage>>();
  opened.label = label;
  options = {};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.message = collectMessage;
  options.message_user = opened.messages.get();
  options.name = label.c_str();
  return opened;
}

void finish(OpenedAsset& opened, FlkResult result, FlkAsset asset) {
  if (result != FLK_SUCCESS) {
    throw AssetError(result, lastError(*opened.messages, opened.label, result));
  }
  opened.asset.reset(asset);
  FlkAssetInfo info{};
  flkAssetGetInfo(asset, &info);
  opened.format = formatName(info.format);
}

bool isName(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_';
  });
}

std::string recipePath(const std::string& name, const std::string& source) {
  std::string looked;
  if (isName(name)) {
    for (const std::string& folder : groomFolders()) {
      const fs::path path = fs::path(folder) / (name + ".json");
      std::error_code error;
      if (fs::is_regular_file(path, error)) {
        return path.string();
      }
      looked += (looked.empty() ? "" : ", ") + folder;
    }
  }
  std::string known;
  for (const std::string& groom : groomNames()) {
    known += " " + groom;
  }
  throw AssetError(FLK_ERROR_IO, source + ": no such groom (looked in " + (looked.empty() ? "no folder" : looked) +
                                     "), " + (known.empty() ? "set FORELOCK_HAIRASSETS" : "there are:" + known));
}

}  // namespace

std::vector<std::string> groomFolders() {
  std::vector<std::string> folders;
  if (const char* named = std::getenv("FORELOCK_HAIRASSETS"); named && *named) {
    folders.emplace_back(named);
  }
  folders.emplace_back(FORELOCK_HAIRASSETS_DIR);
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    folders.push_back((executable.parent_path() / "hairassets").string());
    folders.push_back((executable.parent_path().parent_path() / "hairassets").string());
  }
  folders.erase(std::remove_if(folders.begin(), folders.end(),
                               [](const std::string& folder) {
                                 std::error_code ignored;
                                 return !fs::is_directory(folder, ignored);
                               }),
                folders.end());
  return folders;
}

std::vector<std::string> groomNames() {
  std::set<std::string> names;
  for (const std::string& folder : groomFolders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      if (entry.path().extension() == ".json") {
        names.insert(entry.path().stem().string());
      }
    }
  }
  return {names.begin(), names.end()};
}

Recipe openRecipe(const std::string& source) {
  std::string path = source;
  if (source.rfind(kGroomPrefix, 0) == 0) {
    path = recipePath(source.substr(std::string(kGroomPrefix).size()), source);
  } else if (isName(source) && !fs::exists(source)) {
    path = recipePath(source, source);
  }
  try {
    return loadRecipe(path);
  } catch (const RecipeError& error) {
    throw AssetError(FLK_ERROR_MALFORMED, path + ": " + error.what());
  }
}

OpenedAsset growAsset(const Recipe& recipe, const std::string& label, const ProgressFunction& progress) {
  try {
    const Groom groom = makeGroom(recipe, progress);
    OpenedAsset opened = assetOf(describeGroom(groom), label);
    opened.recipe = recipe;
    opened.format = "groom";
    return opened;
  } catch (const RecipeError& error) {
    throw AssetError(FLK_ERROR_INVALID_ARGUMENT, label + ": " + error.what());
  }
}

std::vector<AssetFinding> findingsOf(const OpenedAsset& opened) {
  std::vector<AssetFinding> findings = opened.source_findings;
  FlkAssetInfo info{};
  flkAssetGetInfo(opened.asset.get(), &info);
  for (uint32_t i = 0; i < info.finding_count; ++i) {
    FlkFinding finding{};
    flkAssetGetFinding(opened.asset.get(), i, &finding);
    findings.push_back({finding.code, finding.text, finding.severity, finding.repaired != 0, finding.count,
                        {finding.strands, finding.strands + finding.strands_listed}, finding.byte_offset});
  }
  return findings;
}

const char* formatName(uint32_t format) {
  switch (format) {
    case FLK_FORMAT_TFX: return "tfx";
    case FLK_FORMAT_HAIR: return "hair";
    case FLK_FORMAT_TFX_TEXT: return "tfx text";
    case FLK_FORMAT_STRAND_DATA: return "strand data";
    case FLK_FORMAT_PLY: return "ply";
    default: return "arrays";
  }
}

OpenedAsset assetOf(const FlkStrands& strands, const std::string& label) {
  FlkAssetOptions options;
  OpenedAsset opened = prepare(label, options);
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetCreate(&strands, &options, &asset);
  finish(opened, result, asset);
  return opened;
}

OpenedAsset openAsset(const std::string& source, const ProgressFunction& progress, const OpenOptions& how) {
  if (source.rfind(kGroomPrefix, 0) == 0 || lowerExtension(source) == ".json") {
    return growAsset(openRecipe(source), source, progress);
  }
  FlkAssetOptions options;
  OpenedAsset opened = prepare(source, options);
  options.points_per_strand = how.points_per_strand;
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetLoadFile(source.c_str(), &options, &asset);
  finish(opened, result, asset);
  return opened;
}

uint32_t formatOfPath(const std::string& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".tfx" ? FLK_FORMAT_TFX : extension == ".hair" ? FLK_FORMAT_HAIR : extension == ".ply" ? FLK_FORMAT_PLY : FLK_FORMAT_UNKNOWN;
}

std::vector<AssetMessage> saveAsset(const OpenedAsset& opened, const std::string& path) {
  const uint32_t format = formatOfPath(path);
  if (format == FLK_FORMAT_UNKNOWN) {
    throw AssetError(FLK_ERROR_FORMAT_UNKNOWN, path + ": no writer for this extension, use .tfx, .hair or .ply");
  }
  const size_t before = opened.messages->size();
  const FlkResult result = flkAssetSaveFile(opened.asset.get(), format, path.c_str());
  std::vector<AssetMessage> said(opened.messages->begin() + static_cast<std::ptrdiff_t>(before),
                                 opened.messages->end());
  if (result != FLK_SUCCESS) {
    throw AssetError(result, lastError(said, path, result));
  }
  return said;
}

}  // namespace forelock::samples
