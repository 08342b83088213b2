// `forelock preview` of a folder or of several assets. SPDX-License-Identifier: MIT
#include "commands.h"
#include "contact_sheet.h"
#include "preview.h"
#include "progress.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

struct Item {
  std::string source;
  std::string name;  // under its tile
  std::string out;
  std::string error;
  uint64_t strands = 0;
  double seconds = 0.0;
};

constexpr uint32_t kOverviewTile = 256;

// Formats are told from their bytes; which files of a folder are worth opening, from their names.
bool looksLikeAsset(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".json") {
    try {
      openRecipe(path.string());
      return true;
    } catch (const std::exception&) {
      return false;  // a scene, or something else
    }
  }
  static const std::set<std::string> known{".tfx", ".hair", ".ply", ".data", ".bin", ".gltf", ".glb", ".flk"};
  std::error_code error;
  if (extension == ".bin" && fs::exists(fs::path(path).replace_extension(".gltf"), error)) return false;  // its buffer
  return known.count(extension) > 0;
}

template <class Iterator>
void collect(const fs::path& folder, std::vector<fs::path>& found, std::error_code& error) {
  for (Iterator entry(folder, fs::directory_options::skip_permission_denied, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && looksLikeAsset(entry->path())) {
      found.push_back(entry->path());
    }
  }
}

std::vector<Item> findItems(const PreviewArguments& arguments) {
  std::vector<Item> items;
  std::set<std::string> taken{"overview.png"};
  const auto add = [&](const std::string& source, const fs::path& relative) {
    Item& item = items.emplace_back();
    item.source = source;
    item.name = relative.generic_string();
    std::string out = item.name + ".png";
    for (int number = 2; !taken.insert(out).second; ++number) {
      out = item.name + "-" + std::to_string(number) + ".png";
    }
    item.out = (fs::path(arguments.out) / out).string();
  };
  for (const std::string& asset : arguments.assets) {
    std::error_code error;
    if (!fs::is_directory(asset, error)) {
      const bool groom = asset.rfind("groom:", 0) == 0;
      add(asset, groom ? fs::path(asset.substr(6)) : fs::path(asset).filename());
      continue;
    }
    std::vector<fs::path> found;
    if (arguments.recursive) {
      collect<fs::recursive_directory_iterator>(asset, found, error);
    } else {
      collect<fs::directory_iterator>(asset, found, error);
    }
    if (error) {
      throw AssetError(FLK_ERROR_IO, asset + ": " + error.message());
    }
    std::sort(found.begin(), found.end());
    for (const fs::path& path : found) {
      add(path.string(), path.lexically_relative(asset));
    }
  }
  return items;
}

void printItems(const PreviewArguments& arguments, const std::vector<Item>& items, const std::string& overview, size_t failed) {
  if (!arguments.json) {
    std::printf("%s\n  %zu of %zu pictures drawn\n", overview.c_str(), items.size() - failed, items.size());
    return;
  }
  nlohmann::ordered_json json;
  json["overview"] = overview;
  json["failed"] = failed;
  json["pictures"] = nlohmann::ordered_json::array();
  for (const Item& item : items) {
    nlohmann::ordered_json entry;
    entry["asset"] = item.source;
    entry["out"] = item.error.empty() ? nlohmann::ordered_json(item.out) : nlohmann::ordered_json();
    entry["strands"] = item.error.empty() ? nlohmann::ordered_json(item.strands) : nlohmann::ordered_json();
    entry["seconds"] = item.seconds;
    entry["error"] = item.error.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(item.error);
    json["pictures"].push_back(entry);
  }
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace

int runPreviewBatch(const CLI::App& command, const PreviewArguments& arguments, HeadlessHost& host) {
  std::vector<Item> items = findItems(arguments);
  if (items.empty()) {
    throw AssetError(FLK_ERROR_IO, arguments.assets[0] + ": no strand file or recipe in this folder" +
                                       (arguments.recursive ? "" : "; --recursive looks into the folders in it too"));
  }
  ContactSheet sheet(layoutSheet(static_cast<uint32_t>(items.size()), kOverviewTile, kOverviewTile, 0, false), "");
  size_t failed = 0;
  Progress progress("");
  for (size_t i = 0; i < items.size(); ++i) {
    Item& item = items[i];
    progress.rename("drawing " + std::to_string(i + 1) + " of " + std::to_string(items.size()));
    progress.update(i, items.size());
    const auto started = std::chrono::steady_clock::now();
    try {
      std::error_code error;
      fs::create_directories(fs::path(item.out).parent_path(), error);  // a failure shows when the picture is written
      PreviewArguments one = arguments;
      one.asset = item.source;
      const Preview preview = drawPreview(host, previewScene(command, one), one, item.out);
      for (const StagedAsset& asset : preview.stage.assets) {
        item.strands += asset.info.strand_count;
      }
      sheet.place(static_cast<uint32_t>(i), preview.picture.image, item.name);
    } catch (const std::exception& error) {
      item.error = error.what();
      ++failed;
      std::fprintf(stderr, "forelock: %s\n", error.what());
      const std::string prefix = item.source + ": ";
      sheet.placeText(static_cast<uint32_t>(i), item.error.rfind(prefix, 0) == 0 ? item.error.substr(prefix.size()) : item.error, item.name, true);
    }
    item.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (!arguments.json && item.error.empty()) {
      std::printf("%s  %s strands, %.2f s\n", item.out.c_str(), groupedDigits(item.strands).c_str(), item.seconds);
      std::fflush(stdout);
    }
  }
  const std::string overview = (fs::path(arguments.out) / "overview.png").string();
  std::error_code error;
  fs::create_directories(arguments.out, error);
  savePicture(overview, sheet.image);
  printItems(arguments, items, overview, failed);
  return failed == 0 ? kDone : kFailed;
}

}  // namespace forelock::samples
