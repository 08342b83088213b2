#include "asset/loaded_asset.h"

#include "asset/codec.h"
#include "asset/sanitise.h"
#include "asset/sniff.h"

#include <cinttypes>

namespace forelock {
namespace {

AssetPointer newAsset(const AssetSettings& settings) {
  HostMemory memory = settings.memory;
  return AssetPointer(memory.create<FlkAsset_T>(settings.memory, settings.messages, settings.name));
}

// The last steps, the same for every source.
FlkResult finish(FlkAsset_T& asset, const Places& places, uint32_t format) {
  const Report report = asset.report();
  const FlkResult result = sanitise(asset.arrays, places, &asset.memory, asset.findings, report, asset.info);
  if (result != FLK_SUCCESS) return result;
  asset.findings.finish();

  asset.info.format = format;
  asset.info.finding_count = asset.findings.size();
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  const StrandArrays& arrays = asset.arrays;
  asset.info.bytes_host = sizeof(FlkAsset_T) + asset.name.capacity() + bytes(arrays.first_vertex) + bytes(arrays.positions) +
                          bytes(arrays.radii) + bytes(arrays.root_uvs) + bytes(arrays.inverse_masses) + bytes(arrays.colors) + bytes(arrays.dropped_strands) +
                          asset.findings.bytes();
  asset.findings.tell(report);
  return FLK_SUCCESS;
}

}  // namespace

void AssetDeleter::operator()(FlkAsset_T* asset) const noexcept {
  HostMemory memory = asset->memory;  // outlives the object that it frees
  memory.destroy(asset);
}

FlkResult makeAsset(const FlkStrands& strands, const AssetSettings& settings, AssetPointer& asset) {
  const Report report(settings.messages, settings.name);
  if (strands.strand_count > settings.limits.strands || strands.vertex_count > settings.limits.vertices)
    return report.fail(FLK_ERROR_LIMIT, "STRANDS_TOO_LARGE",
                       "%" PRIu32 " strands and %" PRIu32 " vertices are beyond the limit of %" PRIu32 " and %" PRIu32
                       ": split the asset or raise the limit",
                       strands.strand_count, strands.vertex_count, settings.limits.strands, settings.limits.vertices);
  const uint32_t* first = strands.first_vertex;
  if (first[0] != 0 || first[strands.strand_count] != strands.vertex_count)
    return report.fail(FLK_ERROR_INVALID_ARGUMENT, "STRANDS_FIRST_VERTEX",
                       "first_vertex goes from %" PRIu32 " to %" PRIu32 ", but has to go from 0 to vertex_count = %" PRIu32,
                       first[0], first[strands.strand_count], strands.vertex_count);
  for (uint32_t strand = 0; strand < strands.strand_count; ++strand)
    if (first[strand + 1] < first[strand])
      return report.fail(FLK_ERROR_INVALID_ARGUMENT, "STRANDS_FIRST_VERTEX",
                         "first_vertex[%" PRIu32 "] = %" PRIu32 " is less than the entry before it, %" PRIu32
                         ": it has to rise from strand to strand",
                         strand + 1, first[strand + 1], first[strand]);

  AssetPointer made = newAsset(settings);
  StrandArrays& arrays = made->arrays;
  const std::size_t strand_count = strands.strand_count, vertices = strands.vertex_count;
  arrays.first_vertex.assign(first, first + strand_count + 1);
  arrays.positions.assign(strands.positions, strands.positions + vertices * 3);
  if (strands.radii) arrays.radii.assign(strands.radii, strands.radii + vertices);
  if (strands.root_uvs) arrays.root_uvs.assign(strands.root_uvs, strands.root_uvs + strand_count * 2);
  if (strands.inverse_masses) arrays.inverse_masses.assign(strands.inverse_masses, strands.inverse_masses + vertices);
  if (strands.colors) arrays.colors.assign(strands.colors, strands.colors + vertices * 3);
  const FlkResult result = finish(*made, Places{}, FLK_FORMAT_UNKNOWN);
  if (result == FLK_SUCCESS) asset = std::move(made);
  return result;
}

FlkResult readAsset(std::span<const std::byte> bytes, const AssetSettings& settings, AssetPointer& asset) {
  const Report report(settings.messages, settings.name);
  uint32_t format = FLK_FORMAT_UNKNOWN;
  FlkResult result = sniffStrands(bytes, report, format);
  if (result != FLK_SUCCESS) return result;
  AssetPointer made = newAsset(settings);
  Places places;
  result = findCodec(format)->read(bytes, settings.limits, report, made->arrays, places, made->findings);
  if (result == FLK_SUCCESS) result = finish(*made, places, format);
  if (result == FLK_SUCCESS) asset = std::move(made);
  return result;
}

}  // namespace forelock

FlkStrands FlkAsset_T::view() const noexcept {
  FlkStrands strands{};
  strands.type = FLK_TYPE_STRANDS;
  strands.strand_count = arrays.strandCount();
  strands.vertex_count = arrays.vertexCount();
  strands.first_vertex = arrays.first_vertex.data();
  strands.positions = arrays.positions.data();
  strands.radii = arrays.radii.data();
  strands.root_uvs = arrays.root_uvs.empty() ? nullptr : arrays.root_uvs.data();
  strands.inverse_masses = arrays.inverse_masses.empty() ? nullptr : arrays.inverse_masses.data();
  strands.colors = arrays.colors.empty() ? nullptr : arrays.colors.data();
  return strands;
}
