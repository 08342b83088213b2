#include "forelock/asset.h"

#include "api/boundary.h"
#include "api/load_call.h"
#include "asset/file_io.h"
#include "asset/loaded_asset.h"
#include "asset/sniff.h"

#include <cassert>
#include <cinttypes>

using namespace forelock;

namespace {

// Runs `body(settings, report, asset)` with the options of a call.
template <class Body>
FlkResult makeWith(const FlkAssetOptions* options, const char* default_name, FlkAsset* asset, Body&& body) noexcept {
  constexpr LoadCall call{FLK_TYPE_ASSET_OPTIONS, "FlkAssetOptions", "asset"};
  return loadWith<AssetPointer>(call, options, default_name, asset, [&](const FlkAssetOptions& given, const LoadBase& base, const Report& report, AssetPointer& made) {
    if (given.points_per_strand == 1) return invalid(report, "FlkAssetOptions.points_per_strand is 1: a strand has two or more points, and 0 is none");
    if (given.flags & ~uint32_t{FLK_ASSET_COPY_FILE})
      return invalid(report, "FlkAssetOptions.flags has bits that are no FLK_ASSET_... flag: set it to 0");
    const AssetSettings settings{base.memory, base.messages, base.name,
                                 {limitOr(given.max_strands, limit_strands), limitOr(given.max_vertices, limit_vertices), given.points_per_strand},
                                 (given.flags & FLK_ASSET_COPY_FILE) != 0};
    return body(settings, report, made);
  });
}

FlkResult acceptHead(std::span<const std::byte> head, const Report& report) {
  uint32_t format = FLK_FORMAT_UNKNOWN;
  return sniffStrands(head, report, format);
}

}  // namespace

extern "C" {

FlkResult flkAssetCreate(const FlkStrands* strands, const FlkAssetOptions* options, FlkAsset* asset) {
  return makeWith(options, nullptr, asset, [&](const AssetSettings& settings, const Report& report, AssetPointer& made) {
    if (!strands) return invalid(report, "strands is NULL");
    if (strands->type != FLK_TYPE_STRANDS) return invalid(report, "FlkStrands.type is not FLK_TYPE_STRANDS");
    if (strands->next) return invalid(report, "FlkStrands.next is reserved and has to be NULL");
    if (strands->strand_count == 0) return invalid(report, "FlkStrands.strand_count is 0: give at least one strand");
    if (strands->vertex_count < 2) return invalid(report, "FlkStrands.vertex_count is below 2: a strand has two or more");
    if (!strands->first_vertex) return invalid(report, "FlkStrands.first_vertex is NULL");
    if (!strands->positions) return invalid(report, "FlkStrands.positions is NULL");
    return makeAsset(*strands, settings, made);
  });
}

FlkResult flkAssetLoadMemory(const void* bytes, size_t size, const FlkAssetOptions* options, FlkAsset* asset) {
  return makeWith(options, nullptr, asset, [&](const AssetSettings& settings, const Report& report, AssetPointer& made) {
    if (!bytes && size != 0) return invalid(report, "bytes is NULL, but size is not 0");
    return readAsset(std::span(static_cast<const std::byte*>(bytes), size), nullptr, settings, made);
  });
}

FlkResult flkAssetLoadFile(const char* path, const FlkAssetOptions* options, FlkAsset* asset) {
  return makeWith(options, path, asset, [&](const AssetSettings& settings, const Report& report, AssetPointer& made) {
    if (!path) return invalid(report, "path is NULL");
    HostMemory memory = settings.memory;
    FileBytes file(&memory);
    const FlkResult result = readFile(path, settings.limits.largestFile(), settings.copy_file, report, acceptHead, file);
    return result == FLK_SUCCESS ? readAsset(file.bytes(), &file.mapping, settings, made) : result;
  });
}

FlkResult flkAssetSaveMemory(FlkAsset asset, uint32_t format, void* bytes, size_t* size) {
  if (!asset) return FLK_ERROR_INVALID_ARGUMENT;
  const Report report = asset->report();
  if (!size) return invalid(report, "size is NULL");
  uint64_t needed = 0;
  const FlkResult result = measureAsset(*asset, format, report, needed);
  if (result != FLK_SUCCESS) return result;
  if (bytes && *size < needed)
    return report.fail(FLK_ERROR_INVALID_ARGUMENT, "WRITE_CAPACITY_TOO_SMALL",
                       "writing it needs %" PRIu64 " bytes, but there is room for %zu: ask for the size first", needed, *size);
  *size = static_cast<size_t>(needed);
  if (!bytes) return FLK_SUCCESS;
  ByteSink sink(std::span(static_cast<std::byte*>(bytes), *size));
  writeAsset(*asset, format, report, sink);
  assert(sink.complete());
  return FLK_SUCCESS;
}

FlkResult flkAssetSaveFile(FlkAsset asset, uint32_t format, const char* path) {
  if (!asset) return FLK_ERROR_INVALID_ARGUMENT;
  const Report report = asset->report();
  if (!path) return invalid(report, "path is NULL");
  uint64_t needed = 0;
  FlkResult result = measureAsset(*asset, format, report, needed);
  if (result != FLK_SUCCESS) return result;
  result = guarded([&] {
    // Its own resource: an asset may be saved by several threads at once.
    HostMemory memory = asset->memory;
    std::vector<std::byte, UnfilledAllocator<std::byte>> bytes(static_cast<size_t>(needed), &memory);
    ByteSink sink{bytes};
    writeAsset(*asset, format, report, sink);
    assert(sink.complete());
    return writeFile(path, bytes, report, &memory);
  });
  if (result == FLK_ERROR_OUT_OF_HOST_MEMORY)
    return report.fail(result, "OUT_OF_HOST_MEMORY", "the host's allocator refused memory: nothing was written");
  return result;
}

FlkResult flkAssetGetInfo(FlkAsset asset, FlkAssetInfo* info) {
  if (!asset || !info) return FLK_ERROR_INVALID_ARGUMENT;
  *info = asset->info;
  return FLK_SUCCESS;
}

FlkResult flkAssetGetStrands(FlkAsset asset, FlkStrands* strands) {
  if (!asset || !strands) return FLK_ERROR_INVALID_ARGUMENT;
  *strands = asset->view();
  return FLK_SUCCESS;
}

FlkResult flkAssetGetFinding(FlkAsset asset, uint32_t index, FlkFinding* finding) {
  if (!asset || !finding || index >= asset->findings.size()) return FLK_ERROR_INVALID_ARGUMENT;
  *finding = asset->findings.get(index);
  return FLK_SUCCESS;
}

void flkAssetDestroy(FlkAsset asset) {
  if (asset) AssetDeleter{}(asset);
}

}  // extern "C"
