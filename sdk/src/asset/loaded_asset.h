// The object behind FlkAsset: strands that keep what asset.h promises, what is known about them, and where they live.
#pragma once

#include "asset/strand_arrays.h"

#include <memory>
#include <span>
#include <string_view>

struct FlkAsset_T {
  FlkAsset_T(const forelock::HostMemory& host, const forelock::Messages& to, std::string_view called)
      : memory(host), messages(to), name(called, &memory), arrays(&memory), findings(&memory) {}
  FlkAsset_T(const FlkAsset_T&) = delete;
  FlkAsset_T& operator=(const FlkAsset_T&) = delete;

  FlkStrands view() const noexcept;
  forelock::Report report() const noexcept { return {messages, name}; }

  forelock::HostMemory memory;  // first: everything below lives in it
  forelock::Messages messages;
  std::pmr::string name;
  forelock::StrandArrays arrays;
  forelock::Findings findings;
  FlkAssetInfo info{};
};

namespace forelock {

struct AssetDeleter {
  void operator()(FlkAsset_T* asset) const noexcept;
};
using AssetPointer = std::unique_ptr<FlkAsset_T, AssetDeleter>;

// What the options of a call come to once they are checked.
struct AssetSettings {
  HostMemory memory;
  Messages messages;
  std::string_view name;
  Limits limits;
};

// Both leave `asset` empty on failure, having said why, and throw std::bad_alloc.
FlkResult makeAsset(const FlkStrands& strands, const AssetSettings& settings, AssetPointer& asset);
FlkResult readAsset(std::span<const std::byte> bytes, const AssetSettings& settings, AssetPointer& asset);

}  // namespace forelock
