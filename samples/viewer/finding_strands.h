// Which strands of a loaded asset its findings speak of. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "strand_faults.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

// Findings number strands as in the source, where those that were dropped while loading still count. The library lists the first eight
// dropped of each kind, so that all numbers are known unless there were more: then those up to the last listed one.
class SourceNumbers {
 public:
  SourceNumbers(const FlkAssetInfo& info, const std::vector<AssetFinding>& findings);

  std::optional<uint32_t> loaded(uint32_t source) const;  // none: dropped, or not known
  std::optional<uint32_t> source(uint32_t loaded) const;  // none: not known

 private:
  uint32_t in_source_, known_below_;
  std::vector<uint32_t> dropped_;  // rising
};

enum class FindingReach : uint32_t {
  strands,  // those listed
  asset,    // all of them alike: none is listed
  dropped,  // none of those that were loaded
  file      // no strands
};

struct FindingStrands {
  AssetFinding finding;  // without a code: of the viewer, not of the library
  FindingReach reach = FindingReach::file;
  std::vector<uint32_t> strands;  // as loaded, rising
  bool all = true;                // or only the first
  std::string label;              // "12 strands", "the first 8 strands", "the whole asset"
};

// One for each of findingsOf, in its order, then what `faults` has beside them.
std::vector<FindingStrands> findingStrands(const OpenedAsset& opened, const StrandFaults& faults);

// Vertices in the world; `world_from_hair` is column major.
std::vector<glm::vec3> pointsOf(const FlkStrands& strands, const std::vector<uint32_t>& chosen, const double world_from_hair[16]);
// Of all strands where the finding is about the asset.
std::vector<glm::vec3> pointsOf(const FlkStrands& strands, const FindingStrands& finding, const double world_from_hair[16]);

}  // namespace forelock::samples
