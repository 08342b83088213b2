// What recognises a .tfxbone file, which has no mark to be known by.
#pragma once

#include <cstddef>
#include <span>

namespace forelock {

// Whether the first bytes are a count and then numbers, lengths and printable names that end with NUL.
bool looksLikeTfxbone(std::span<const std::byte> head) noexcept;

// Whether names and records, as their counts say, fill the bytes to the last one.
bool fitsTfxbone(std::span<const std::byte> bytes) noexcept;

}  // namespace forelock
