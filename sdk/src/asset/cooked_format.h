// Forelock's cache, FLK_FORMAT_COOKED: everything of an asset, as it lies in memory. docs/findings.md has the layout.
#pragma once

#include "asset/loaded_asset.h"

namespace forelock {

uint64_t measureCooked(const FlkAsset_T& asset) noexcept;

// The same bytes for the same asset.
void writeCooked(const FlkAsset_T& asset, ByteSink& sink);

// Fills `asset`, all but the parts that every asset gets at the end, having verified checksums and that the arrays keep what asset.h
// promises: a cooked file is not trusted. Takes over `mapping` (of `bytes`; nullptr: none) where the arrays can be views of it.
// Refusals are told to `report`. Throws std::bad_alloc.
FlkResult readCooked(std::span<const std::byte> bytes, Mapping* mapping, const Limits& limits, const Report& report, FlkAsset_T& asset);

}  // namespace forelock
