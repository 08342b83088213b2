// SPDX-License-Identifier: MIT
#include "asset_source.h"

#include "gltf_reader.h"
#include "gltf_writer.h"
#include "groom.h"
#include "strand_formats.h"
#include "tfx_project.h"

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
    case FLK_FORMAT_COOKED: return "cooked";
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
  const bool is_groom = source.rfind(kGroomPrefix, 0) == 0;
  // Told from its bytes: it may be called .json, as recipes are.
  if (!is_groom && isGltfFile(source)) {
    return openGltf(source);
  }
  if (is_groom || lowerExtension(source) == ".json") {
    return growAsset(openRecipe(source), source, progress);
  }
  FlkAssetOptions options;
  OpenedAsset opened = prepare(source, options);
  options.points_per_strand = how.points_per_strand;
  options.flags = how.copy_file ? FLK_ASSET_COPY_FILE : 0;
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetLoadFile(source.c_str(), &options, &asset);
  if (result == FLK_ERROR_IO && isName(source) && !fs::exists(source)) {
    const std::vector<std::string> names = groomNames();
    if (std::find(names.begin(), names.end(), source) != names.end()) {
      throw AssetError(result, source + ": no such file, but there is a groom of this name: write groom:" + source);
    }
  }
  finish(opened, result, asset);
  if (opened.format == "tfx") {
    noteTfxProject(source, opened.source_findings);
  }
  return opened;
}

namespace {

// Which formats have no place for what the tools know beside the strands.
std::vector<AssetMessage> toolLosses(const OpenedAsset& opened, const WritableFormat& format, const std::string& label) {
  if (format.library == FLK_FORMAT_UNKNOWN) {
    return gltfLosses(opened, label);
  }
  std::vector<AssetMessage> losses;
  if (!opened.groups.empty() && opened.group_names.size() > 1 && !format.keeps_groups) {
    losses.push_back({FLK_SEVERITY_WARNING, "WRITE_DROPS_GROUPS", label + ": the " + std::to_string(opened.group_names.size()) +
                      " groups of strands are left out, which " + format.extension + " does not hold: write .glb to keep them"});
  }
  if (format.library == FLK_FORMAT_COOKED && !opened.source_findings.empty()) {
    losses.push_back({FLK_SEVERITY_WARNING, "WRITE_DROPS_FINDINGS", label + ": " + std::to_string(opened.source_findings.size()) +
                      " findings of its reader are left out, a cache keeps those of the library: `forelock inspect` says them of the source"});
  }
  return losses;
}

const WritableFormat& formatFor(const std::string& path) {
  const WritableFormat* format = writableFormatOf(path);
  if (!format) {
    throw AssetError(FLK_ERROR_FORMAT_UNKNOWN, path + ": no writer for this extension, use " + writableExtensions());
  }
  return *format;
}

// What the library said since there were `before` messages.
std::vector<AssetMessage> saidSince(const OpenedAsset& opened, size_t before) {
  return {opened.messages->begin() + static_cast<std::ptrdiff_t>(before), opened.messages->end()};
}

}  // namespace

std::vector<AssetMessage> rehearseSave(const OpenedAsset& opened, const std::string& path) {
  const WritableFormat& format = formatFor(path);
  std::vector<AssetMessage> losses = toolLosses(opened, format, opened.label);
  if (format.library == FLK_FORMAT_UNKNOWN) {
    return losses;
  }
  const size_t before = opened.messages->size();
  size_t size = 0;
  if (flkAssetSaveMemory(opened.asset.get(), format.library, nullptr, &size) == FLK_SUCCESS) {
    std::vector<unsigned char> bytes(size);
    flkAssetSaveMemory(opened.asset.get(), format.library, bytes.data(), &size);
  }
  const std::vector<AssetMessage> said = saidSince(opened, before);
  losses.insert(losses.end(), said.begin(), said.end());
  return losses;
}

std::vector<AssetMessage> saveAsset(const OpenedAsset& opened, const std::string& path) {
  const WritableFormat& format = formatFor(path);
  std::vector<AssetMessage> losses = toolLosses(opened, format, opened.label);
  if (format.library == FLK_FORMAT_UNKNOWN) {
    saveGltf(opened, path);
    return losses;
  }
  const size_t before = opened.messages->size();
  const FlkResult result = flkAssetSaveFile(opened.asset.get(), format.library, path.c_str());
  const std::vector<AssetMessage> said = saidSince(opened, before);
  if (result != FLK_SUCCESS) {
    throw AssetError(result, lastError(said, path, result));
  }
  losses.insert(losses.end(), said.begin(), said.end());
  return losses;
}

}  // namespace forelock::samples
