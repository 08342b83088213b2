// What `forelock inspect` says of one asset, as text and as JSON (docs/inspect-json.md). SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "strand_repair.h"
#include "strand_statistics.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace forelock::samples {

struct Inspected {
  std::string label, format;
  FlkAssetInfo info{};
  std::vector<AssetFinding> findings;
  StrandStatistics numbers;
  Guess unit, up;
  std::vector<std::string> groups;

  uint64_t count(uint32_t severity) const;  // of kinds of findings
  std::string firstCode() const;            // of the worst finding; empty: none
};

Inspected inspectAsset(const OpenedAsset& opened);

void printInspected(const Inspected& seen);
nlohmann::ordered_json inspectedJson(const Inspected& seen);
nlohmann::ordered_json repairsJson(const std::vector<Repair>& repairs);

// Prints JSON for programs; a file name need not be UTF-8.
void printJsonText(const nlohmann::ordered_json& json);

}  // namespace forelock::samples
