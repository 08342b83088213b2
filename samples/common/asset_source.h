// What a person may write where a program wants an asset: a strand file, or groom:NAME. SPDX-License-Identifier: MIT
#pragma once

#include "groom_recipe.h"

#include <forelock/asset.h>

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::samples {

// One sentence for a person, beginning with the asset's name: "FILE: what is wrong (where), what to do".
struct AssetError : std::runtime_error {
  AssetError(FlkResult why, const std::string& text) : std::runtime_error(text), result(why) {}
  FlkResult result;
};

struct AssetMessage {
  uint32_t severity;
  std::string id;
  std::string text;
};

struct AssetDeleter {
  void operator()(FlkAsset asset) const { flkAssetDestroy(asset); }
};
using AssetHandle = std::unique_ptr<FlkAsset_T, AssetDeleter>;

// A finding (FlkFinding) that does not depend on its asset's life.
struct AssetFinding {
  std::string code, text;
  uint32_t severity = 0;  // FLK_SEVERITY_...
  bool repaired = false;
  uint64_t count = 0;
  std::vector<uint32_t> strands;      // the first ones, numbered as in the source
  uint64_t byte_offset = UINT64_MAX;  // UINT64_MAX: none
};

struct OpenedAsset {
  // What the library said while opening, and says later about this asset. Not moved while the asset lives: the asset
  // holds a pointer to it. Declared first, so that it is destroyed last.
  std::unique_ptr<std::vector<AssetMessage>> messages;
  AssetHandle asset;
  std::string label;             // as the user wrote it
  std::optional<Recipe> recipe;  // of a groom: its cameras and description
  std::string format;            // a word for it: "tfx", "groom"
  std::vector<AssetFinding> source_findings;  // of a reader that is not the library's
  std::vector<uint32_t> groups;               // of each strand an index into group_names; empty: the source has no groups
  std::vector<std::string> group_names;
};

// "tfx", "hair", ...; "arrays" where it was no file.
const char* formatName(uint32_t format);

// All findings: of the reader, then of the library.
std::vector<AssetFinding> findingsOf(const OpenedAsset& opened);

// Called from any thread with work done and work to do.
using ProgressFunction = std::function<void(uint64_t done, uint64_t total)>;

struct OpenOptions {
  uint32_t points_per_strand = 0;  // of a PLY file of bare points, which does not say it; 0: none
  bool copy_file = false;          // for a file that another program may be writing: FLK_ASSET_COPY_FILE
};

// Opens a strand file (also glTF, whatever it is called), a recipe file (*.json) or groom:NAME. Throws AssetError.
OpenedAsset openAsset(const std::string& source, const ProgressFunction& progress = {}, const OpenOptions& how = {});

// Grows a recipe into an asset. Throws AssetError.
OpenedAsset growAsset(const Recipe& recipe, const std::string& label, const ProgressFunction& progress = {});

// An asset of arrays, which are copied. Throws AssetError.
OpenedAsset assetOf(const FlkStrands& strands, const std::string& label);

// The recipe of groom:NAME, a recipe's path, or a bare NAME of a groom. Throws AssetError.
Recipe openRecipe(const std::string& source);

// Folders in which groom:NAME is looked for, best first: the environment variable FORELOCK_HAIRASSETS, `hairassets` of
// the source tree this was built from, `hairassets` beside the executable and one folder above it.
std::vector<std::string> groomFolders();

// Names of all grooms that are found, sorted.
std::vector<std::string> groomNames();

// Saves in the format of the path's extension (strand_formats.h), and gives what there is to say about it, above all what the
// format cannot hold, as WRITE_DROPS_... Throws AssetError.
std::vector<AssetMessage> saveAsset(const OpenedAsset& opened, const std::string& path);

// What saveAsset would say, without writing a file. Throws AssetError.
std::vector<AssetMessage> rehearseSave(const OpenedAsset& opened, const std::string& path);

}  // namespace forelock::samples
