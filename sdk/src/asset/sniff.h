// Tells a strand format from the first bytes, and says what a file is that people mistake for one.
#pragma once

#include "asset/report.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace forelock {

// As much of a file as sniffFormat looks at.
inline constexpr std::size_t sniffed_bytes = 4096;

// `head`: the first bytes of a file (all of it, or at least sniffed_bytes). FLK_SUCCESS and the format, or a refusal that
// was told to `report`.
FlkResult sniffFormat(std::span<const std::byte> head, const Report& report, uint32_t& format) noexcept;

}  // namespace forelock
