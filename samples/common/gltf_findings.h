// What is worth knowing about the strands of a glTF file. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <array>
#include <set>

namespace forelock::samples {

// In the order in which they are listed; codes and sentences are in gltf_findings.cpp and docs/findings.md.
enum class GltfFinding : uint32_t {
  branch, cycle, loop_opened, edge_degenerate, edge_repeated, root_guessed, index_odd, vertices_unused, restart_undeclared, mesh_unused,
  scale_not_uniform, strand_id_disagrees, attribute_partial, trailing_bytes, lines_joined, primitive_skipped, transform_applied,
  positions_quantized, root_uv_varies, alpha_ignored, guides_ignored, attribute_ignored, deformation_ignored, kinds
};

class GltfFindings {
public:
  static constexpr uint32_t kNoStrand = UINT32_MAX;

  void note(GltfFinding kind, uint32_t strand = kNoStrand, uint64_t times = 1);
  // As note, and the sentence says the name, once each.
  void noteName(GltfFinding kind, const std::string& name);
  std::vector<AssetFinding> list() const;

private:
  struct Slot {
    uint64_t count = 0;
    std::vector<uint32_t> strands;
    std::set<std::string> names;
  };
  std::array<Slot, size_t(GltfFinding::kinds)> slots_;
};

}  // namespace forelock::samples
