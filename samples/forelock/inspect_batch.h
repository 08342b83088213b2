// Many files at once: a line each, and none that stops the others. SPDX-License-Identifier: MIT
#pragma once

#include "inspect_report.h"

#include <functional>
#include <string>
#include <vector>

namespace forelock::samples {

struct InspectedFile {
  std::string path;
  std::string error;  // why it failed; empty: `seen` holds
  Inspected seen;
};

struct InspectedFiles {
  std::vector<InspectedFile> files;   // strand files, in the order in which they were named, those of a folder by name
  std::vector<std::string> no_strands;  // files of folders that are in no strand format and have no strand file's name

  bool failed() const;
  bool clean() const;  // nothing failed, and there are neither warnings nor errors
};

// `sources` are assets and folders, which are searched with all below them. `open` throws AssetError.
InspectedFiles inspectFiles(const std::vector<std::string>& sources, const std::function<OpenedAsset(const std::string&)>& open);

void printTable(const InspectedFiles& all);
nlohmann::ordered_json filesJson(const InspectedFiles& all);
// As RFC 4180 has it, with a header line. Throws AssetError.
void writeCsv(const InspectedFiles& all, const std::string& path);

}  // namespace forelock::samples
