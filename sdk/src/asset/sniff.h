// Tells a format from the first bytes, and says what a file is that people mistake for one.
#pragma once

#include "asset/report.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace forelock {

// As much of a file as is looked at.
inline constexpr std::size_t sniffed_bytes = 4096;

// Beside FLK_FORMAT_...: what is read into a rig.
inline constexpr uint32_t format_tfxbone = 0x1000, format_tfxmesh = 0x1001;

// `head`: the first bytes of a file (all of it, or at least sniffed_bytes). FLK_SUCCESS and a format of strands, or a refusal
// that was told to `report`.
FlkResult sniffStrands(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept;

// The same for format_tfxbone and format_tfxmesh. Bytes that are of no known kind are a damaged .tfxbone, which has no mark.
FlkResult sniffRig(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept;

}  // namespace forelock
