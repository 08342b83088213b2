// What an artist does to strands before they go into a game: units, axes, direction, sampling. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/asset.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

// Strands that may be changed; as FlkStrands, an empty array is "none".
struct EditableStrands {
  std::vector<uint32_t> first_vertex;  // strands + 1
  std::vector<float> positions, radii, root_uvs, inverse_masses, colors;

  uint32_t strands() const { return uint32_t(first_vertex.size() - 1); }
  uint32_t vertices() const { return first_vertex.back(); }
  // Lives as long as the arrays stay as they are.
  FlkStrands view() const;
};

// What FlkStrands may hold.
inline constexpr uint32_t kMostStrands = 4'194'304, kMostVertices = 268'435'456;

// Way along a strand from its root to each of its vertices; the last is its length.
std::vector<double> lengthsAlong(const EditableStrands& strands, uint32_t strand);

// A copy of a strand of `from`, which has the same arrays, behind those of `to`.
void appendStrand(EditableStrands& to, const EditableStrands& from, uint32_t strand);

// with_radii: false where the widths are a default, which are none of the asset's own.
EditableStrands editableStrands(const FlkStrands& held, bool with_radii);

// Positions and widths times `factor`.
void scaleStrands(EditableStrands& strands, double factor);

// New axes from old ones: axis i becomes sign[i] times the old axis from[i].
struct AxisMap {
  std::array<int, 3> from{0, 1, 2};
  std::array<float, 3> sign{1, 1, 1};
  bool mirrors() const;  // left hands become right ones
};
// "x,-z,y": three of x y z, each once, each with or without a sign. Throws std::invalid_argument with what is wrong.
AxisMap parseAxes(const std::string& text);
void mapAxes(EditableStrands& strands, const AxisMap& map);

// v becomes 1 - v.
void flipV(EditableStrands& strands);

// Roots become tips.
void reverseStrands(EditableStrands& strands);

// Moves the middle of the bounds to the origin. Gives the shift.
std::array<double, 3> recentreStrands(EditableStrands& strands);

// Removes strands shorter than `length`. Gives how many.
uint32_t removeShortStrands(EditableStrands& strands, double length);

struct ResampleReport {
  double mean_error = 0, worst_error = 0;  // of lengths, relative: what cutting corners takes away
  uint32_t worst_strand = 0;
};
// `vertices` (>= 2) a strand, evenly along its length; root and tip stay where they are. Widths and colours are interpolated; the two
// vertices at either end keep what masses the two had there, the others take the nearest.
ResampleReport resampleStrands(EditableStrands& strands, uint32_t vertices);

}  // namespace forelock::samples
