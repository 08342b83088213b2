// What `forelock convert` does to strands on the way. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <CLI/CLI.hpp>

#include <string>

namespace forelock::samples {

struct ConvertEdits {
  std::string axes, width_profile, root_image;
  double scale = 1, min_length = 0, follow_radius_mm = 1, width_mm = 0;
  uint32_t resample = 0, interpolate = 0, follow = 0, keep = 0;
  double keep_share = 0;
  bool flip_v = false, reverse = false, recentre = false, lod_order = false;

  bool any() const;
};

void addConvertEdits(CLI::App& command, ConvertEdits& edits);

// Replaces the opened asset by the edited one; says what it did, a line each, in the order in which it does it. Gives how many strands were lost
// because no asset may hold what became of them. Throws AssetError.
uint32_t applyEdits(OpenedAsset& opened, const ConvertEdits& edits);

}  // namespace forelock::samples
