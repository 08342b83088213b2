// What relates two sets of strands: the same groom in another unit, with other axes, turned around, moved, reordered, resampled or
// thinned out; and how far apart they are once that is taken away. SPDX-License-Identifier: MIT
#pragma once

#include "strand_edit.h"

#include <forelock/asset.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace forelock::samples {

// What makes A of B: position = scale * axes(position of B) + shift.
struct StrandRelation {
  double scale = 1;
  AxisMap axes;
  std::array<double, 3> shift{};  // unit of A
  bool reversed = false;          // roots of B are tips of A

  bool isNone() const;
  std::array<double, 3> apply(const float* b) const;
};

enum class UvRelation { absent, only_a, only_b, same, flipped_v, different };

struct StrandPair {
  uint32_t a = 0, b = 0;
  double distance = 0;  // greatest of its vertices (unit of A)
};

struct StrandDiff {
  bool related = false;  // half of the smaller set has a partner within a twentieth of the mean length; nothing below holds otherwise
  StrandRelation relation;

  uint64_t matched = 0;
  std::vector<uint32_t> only_a, only_b;  // strands without a partner
  bool reordered = false;                // the partners of A's strands do not rise in B
  uint64_t resampled = 0;                // partners of other vertex counts; compared at even steps of their length
  uint64_t respaced = 0;                 // partners of equal counts, whose vertices are elsewhere along the same curve

  // Between vertices of partners (unit of A).
  double max_distance = 0, mean_distance = 0, rms_distance = 0;
  uint64_t differing = 0;                // partners further apart than `tolerance`
  std::vector<StrandPair> worst;         // at most `listed`, the furthest first
  std::vector<StrandPair> first;         // at most `listed` of those beyond `tolerance`, in the order of A

  UvRelation uvs = UvRelation::absent;
  double max_uv_difference = 0;          // after the flip
  // Attributes that one side lacks have no difference; widths are those of their own, no defaults.
  bool has_widths[2] = {}, has_masses[2] = {}, has_colors[2] = {};
  uint64_t compared_vertices = 0;        // of partners of equal counts, which the attributes below are about
  double width_ratio = 0;                // median of A's over B's after `scale`; 1: widths went along
  double max_width_difference = 0;       // unit of A
  uint64_t differing_masses = 0;         // vertices
  double max_color_difference = 0;
};

struct StrandDiffOptions {
  double tolerance = 0;  // unit of A; 0: 1e-5 of the mean length, which 32-bit floats can miss after a change of unit
  size_t listed = 8;
  std::function<void(uint64_t done, uint64_t total)> progress;
};

// `a_radii`, `b_radii`: whether the widths are the assets' own. Cost: 5 to 20 microseconds a strand, and 1 s to find that nothing relates them. `progress` is called in two rounds. Equal input gives equal output.
StrandDiff diffStrands(const FlkStrands& a, bool a_radii, const FlkStrands& b, bool b_radii, const StrandDiffOptions& options = {});

}  // namespace forelock::samples
