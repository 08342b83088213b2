// What is worth knowing about an asset or a rig, collected while it is read. Collecting needs no memory, so a file with a defect
// in every vertex costs no more than one with a single defect; sentences are made once, at the end.
#pragma once

#include "asset/report.h"
#include "forelock/asset.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <string>
#include <string_view>
#include <vector>

namespace forelock {

inline constexpr uint64_t no_byte = UINT64_MAX;
inline constexpr uint32_t no_strand = UINT32_MAX;

// In the order in which they are listed; codes and sentences are in findings.cpp and docs/findings.md.
enum class FindingKind : uint32_t {
  strand_too_short,
  position_not_finite,
  position_out_of_range,
  strand_zero_length,
  radius_invalid,
  radius_all_zero,
  root_uv_not_finite,
  inverse_mass_invalid,
  color_not_finite,
  color_outside_unit,
  hair_points_unused,
  ply_vertices_unused,
  tfx_text_transform_ignored,
  hair_flags_reserved,
  tfx_offset_unaligned,
  trailing_bytes,
  unit_suspect,
  root_at_tip,
  strand_duplicate,
  width_suspect,
  root_uv_all_zero,
  root_uv_constant,
  far_from_origin,
  segment_zero_length,
  strand_micro,
  root_uv_outside_unit,
  tfx_reserved_set,
  tfx_follow_strands_ignored,
  tfx_vertex_uv_ignored,
  tfx_vertex_color_ignored,
  hair_transparency_ignored,
  hair_default_color_ignored,
  strand_root_only,
  data_values_ignored,
  tfx_text_key_unknown,
  ply_alpha_ignored,
  strand_long,
  width_grows,
  inverse_mass_implied,
  both_ends_fixed,
  inverse_mass_all_zero,
  root_not_pinned,
  hair_default_thickness_zero,
  width_defaulted,
  // Of rigs.
  bone_name_empty,
  bone_name_duplicate,
  bone_name_unterminated,
  bone_name_cut,
  bone_name_long,
  rig_index_unexpected,
  bone_out_of_range,
  weight_invalid,
  weights_all_zero,
  weights_not_normalised,
  skin_strands_surplus,
  skin_strands_missing,
  skin_strands_dropped,
  mesh_position_invalid,
  mesh_normal_invalid,
  triangle_out_of_range,
  triangle_degenerate,
  bone_placeholder,
  skin_records_unaligned,
  kinds
};

class Findings {
public:
  explicit Findings(std::pmr::memory_resource* memory) : list_(memory) {}

  // What the numbers of findings count where the kind does not say; strands unless told.
  void countIn(const char* noun) noexcept { noun_ = noun; }

  // `strand` is numbered as in the source; no_strand where the finding is about the file. Keeps the first byte told.
  void note(FindingKind kind, uint32_t strand, uint64_t byte, uint64_t times = 1) noexcept;

  // A sentence of its own for this kind in place of the table's, for one that names values. At most ten kinds.
  void describe(FindingKind kind, const char* format, ...) noexcept __attribute__((format(printf, 3, 4)));

  uint64_t count(FindingKind kind) const noexcept { return slots_[static_cast<std::size_t>(kind)].count; }

  // Makes the list and tells the host of warnings. Once, when nothing else can fail. Throws std::bad_alloc.
  void finish();
  void tell(const Report& report) const noexcept;

  // Adds to the list what another asset's list said (its code and text are given apart). After a reserve() of as many it moves nothing.
  // Throws std::bad_alloc.
  void reserve(uint32_t entries) { list_.reserve(entries); }
  void restore(const FlkFinding& finding, std::string_view code, std::string_view text);

  uint32_t size() const noexcept { return static_cast<uint32_t>(list_.size()); }
  FlkFinding get(uint32_t index) const noexcept;
  uint64_t bytes() const noexcept;

private:
  struct Slot {
    uint64_t count = 0;
    uint64_t byte = no_byte;
    uint32_t strands[8] = {};
    uint32_t strands_listed = 0;
  };
  struct Description {
    FindingKind kind = FindingKind::kinds;
    char text[320] = {};
  };
  struct Entry {
    FlkFinding finding;     // without its text, which may move while the list is made
    std::pmr::string text;
    std::pmr::string code;  // empty: the finding points at the table's
  };

  std::array<Slot, static_cast<std::size_t>(FindingKind::kinds)> slots_;
  std::array<Description, 10> descriptions_;
  std::pmr::vector<Entry> list_;
  const char* noun_ = "strand";
};

}  // namespace forelock
