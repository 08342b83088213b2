#include "asset/loaded_asset.h"

#include "asset/codec.h"
#include "asset/cooked_format.h"
#include "asset/sanitise.h"
#include "asset/sniff.h"

#include <cinttypes>

namespace forelock {
namespace {

AssetPointer newAsset(const AssetSettings& settings) {
  HostMemory memory = settings.memory;
  return AssetPointer(memory.create<FlkAsset_T>(settings.memory, settings.messages, settings.name));
}

const float* dataOf(const FloatArray& array) noexcept { return array.empty() ? nullptr : array.data(); }

// The view, and what is said of the asset as a whole.
void settleAsset(FlkAsset_T& asset) noexcept {
  const StrandArrays& arrays = asset.arrays;
  if (asset.file.bytes().empty())
    asset.strands = {FLK_TYPE_STRANDS, nullptr, arrays.strandCount(), arrays.vertexCount(), nullptr, dataOf(arrays.positions),
                     dataOf(arrays.radii), dataOf(arrays.root_uvs), dataOf(arrays.inverse_masses), dataOf(arrays.colors)};
  asset.strands.first_vertex = arrays.first_vertex.data();
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  asset.info.finding_count = asset.findings.size();
  asset.info.bytes_mapped = asset.file.bytes().size();
  asset.info.bytes_host = sizeof(FlkAsset_T) + asset.name.capacity() + bytes(arrays.first_vertex) + bytes(arrays.positions) +
                          bytes(arrays.radii) + bytes(arrays.root_uvs) + bytes(arrays.inverse_masses) + bytes(arrays.colors) +
                          bytes(arrays.dropped_strands) + asset.findings.bytes();
}

// The last steps, the same for every source but a cooked one.
FlkResult finish(FlkAsset_T& asset, const Places& places, uint32_t format) {
  const Report report = asset.report();
  const FlkResult result = sanitise(asset.arrays, places, &asset.memory, asset.findings, report, asset.info);
  if (result != FLK_SUCCESS) return result;
  asset.findings.finish();

  asset.info.format = asset.info.source_format = format;
  settleAsset(asset);
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

FlkResult readAsset(std::span<const std::byte> bytes, Mapping* mapping, const AssetSettings& settings, AssetPointer& asset) {
  const Report report(settings.messages, settings.name);
  uint32_t format = FLK_FORMAT_UNKNOWN;
  FlkResult result = sniffStrands(bytes, report, format);
  if (result != FLK_SUCCESS) return result;
  AssetPointer made = newAsset(settings);
  if (format == FLK_FORMAT_COOKED) {
    result = readCooked(bytes, mapping, settings.limits, report, *made);
    if (result == FLK_SUCCESS) settleAsset(*made), made->findings.tell(report);
  } else {
    Places places;
    result = findCodec(format)->read(bytes, settings.limits, report, made->arrays, places, made->findings);
    if (result == FLK_SUCCESS) result = finish(*made, places, format);
  }
  if (result == FLK_SUCCESS) asset = std::move(made);
  return result;
}

FlkResult measureAsset(const FlkAsset_T& asset, uint32_t format, const Report& report, uint64_t& bytes) {
  FlkResult result = FLK_SUCCESS;
  const Codec* codec = findCodec(format);
  if (format == FLK_FORMAT_COOKED)
    bytes = measureCooked(asset);
  else if (codec && codec->write)
    result = codec->measure(asset.view(), asset.info, report, bytes);
  else
    return report.fail(FLK_ERROR_INVALID_ARGUMENT, "WRITE_FORMAT_UNKNOWN",
                       "format %" PRIu32 " cannot be written: choose FLK_FORMAT_TFX, FLK_FORMAT_HAIR, FLK_FORMAT_PLY or FLK_FORMAT_COOKED", format);
  if (result == FLK_SUCCESS && bytes > SIZE_MAX)
    return report.fail(FLK_ERROR_LIMIT, "WRITE_TOO_LARGE", "its %" PRIu64 " bytes do not fit into memory", bytes);
  return result;
}

void writeAsset(const FlkAsset_T& asset, uint32_t format, const Report& report, ByteSink& sink) {
  if (format == FLK_FORMAT_COOKED)
    writeCooked(asset, sink);
  else
    findCodec(format)->write(asset.view(), asset.info, report, sink);
}

}  // namespace forelock
