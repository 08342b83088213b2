// The object behind FlkAsset: strands that keep what asset.h promises, what is known about them, and where they live.
#pragma once

#include "asset/cursor.h"
#include "asset/file_io.h"
#include "asset/strand_arrays.h"

#include <memory>
#include <span>
#include <string_view>

struct FlkAsset_T {
  FlkAsset_T(const forelock::HostMemory& host, const forelock::Messages& to, std::string_view called)
      : memory(host), messages(to), name(called, &memory), arrays(&memory), findings(&memory) {}
  FlkAsset_T(const FlkAsset_T&) = delete;
  FlkAsset_T& operator=(const FlkAsset_T&) = delete;

  // What the arrays or the mapping hold.
  const FlkStrands& view() const noexcept { return strands; }
  forelock::Report report() const noexcept { return {messages, name}; }

  forelock::HostMemory memory;  // first: everything below lives in it
  forelock::Messages messages;
  std::pmr::string name;
  forelock::StrandArrays arrays;  // of a mapped asset only first_vertex
  forelock::Mapping file;         // of a mapped asset: where the other arrays lie
  FlkStrands strands{};
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
  bool copy_file = false;
};

// Both leave `asset` empty on failure, having said why, and throw std::bad_alloc.
FlkResult makeAsset(const FlkStrands& strands, const AssetSettings& settings, AssetPointer& asset);
// `mapping`, if not nullptr, is where `bytes` are: an asset whose arrays can lie there takes it over.
FlkResult readAsset(std::span<const std::byte> bytes, Mapping* mapping, const AssetSettings& settings, AssetPointer& asset);

// Bytes of an asset in a format, and those bytes. FLK_ERROR_INVALID_ARGUMENT: no such format is written; FLK_ERROR_LIMIT: it
// cannot hold the asset. Both were told to `report`, as is what the format leaves out.
FlkResult measureAsset(const FlkAsset_T& asset, uint32_t format, const Report& report, uint64_t& bytes);
void writeAsset(const FlkAsset_T& asset, uint32_t format, const Report& report, ByteSink& sink);

}  // namespace forelock
