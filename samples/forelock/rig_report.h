// What `forelock inspect` says of rigs: the skin (.tfxbone) and the collision mesh (.tfxmesh) of hair. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <forelock/rig.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

struct RigDeleter {
  void operator()(FlkRig rig) const { flkRigDestroy(rig); }
};

struct OpenedRig {
  std::string label;
  std::unique_ptr<FlkRig_T, RigDeleter> rig;
  std::vector<AssetFinding> findings;

  bool clean() const;  // no finding beyond info
};

// `hair`: the strands that a skin is checked against; nullptr: none. Throws AssetError.
OpenedRig openRig(const std::string& path, FlkAsset hair = nullptr);

void printRig(const OpenedRig& rig);
nlohmann::ordered_json rigJson(const OpenedRig& rig);

// Inspects `path` if it is a rig, and gives the exit status; nothing if it is something else. Throws AssetError.
std::optional<int> inspectIfRig(const std::string& path, bool json, bool strict);

}  // namespace forelock::samples
