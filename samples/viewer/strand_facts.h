// What there is to say about one strand. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "strand_faults.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace forelock::samples {

// Lengths are in the unit of the asset.
struct StrandFacts {
  uint32_t vertices = 0;
  double length = 0.0, root_to_tip = 0.0;  // along it, and straight
  double min_segment = 0.0, mean_segment = 0.0, max_segment = 0.0;
  double max_curvature = 0.0;  // (rad / unit)
  double max_turn_deg = 0.0;   // in a vertex
  std::vector<std::pair<std::string, std::string>> lines;  // name and value, for a panel: these numbers and all else
};

struct StrandFactsOptions {
  const StrandFaults* faults = nullptr;  // of the asset; null: they are not said
  uint32_t follow = 0;                   // strands that are drawn beside each: then those of the asset are guides
  double width_scale = 1.0;              // as FlkMaterial.width_scale
};

// `strand` as loaded. Cost: of the strand, and of the asset's findings.
StrandFacts strandFacts(const OpenedAsset& opened, uint32_t strand, const StrandFactsOptions& options = {});

struct VertexRow {
  uint32_t index = 0;      // from the root
  glm::vec3 position{0.0f};  // of the asset
  float radius = 0.0f;
  std::optional<glm::vec3> color;  // linear; none: the asset has none
  double along = 0.0;      // distance from the root along the strand
};
std::vector<VertexRow> vertexRows(const FlkStrands& strands, uint32_t strand);

// Words for the bits of StrandFaults.of, "" where there are none.
std::string faultWords(uint8_t faults);

}  // namespace forelock::samples
