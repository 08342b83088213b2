#include "asset/loaded_rig.h"

#include "asset/loaded_asset.h"
#include "asset/sniff.h"

#include <algorithm>
#include <cinttypes>

namespace forelock {
namespace {

// A cache does not say which strands of its source were dropped.
bool knowsDropped(const FlkAsset_T& asset) noexcept {
  return asset.info.strands_in_source - asset.info.strand_count == asset.arrays.dropped_strands.size();
}

// Gives the records the strands of `asset`, which may have dropped some of its source.
void fitToAsset(const FlkAsset_T& asset, RigArrays& arrays, Findings& findings) {
  const uint32_t records = arrays.recordCount(), source = asset.info.strands_in_source;
  const auto& dropped = asset.arrays.dropped_strands;
  if (records > source) {
    findings.note(FindingKind::skin_strands_surplus, source, no_byte, records - source);
    findings.describe(FindingKind::skin_strands_surplus,
                      "it has records for %" PRIu32 " strands, but the hair has %" PRIu32 ": those from strand %" PRIu32
                      " on were left out; it belongs to another hair, or the hair was exported with fewer strands",
                      records, source, source);
  }
  if (records < source) {
    findings.note(FindingKind::skin_strands_missing, records, no_byte, source - records);
    findings.describe(FindingKind::skin_strands_missing,
                      "it has records for %" PRIu32 " strands, but the hair has %" PRIu32 ": those from strand %" PRIu32
                      " on hang on nothing; export both files together",
                      records, source, records);
  }
  for (const uint32_t strand : dropped)
    if (strand < records) findings.note(FindingKind::skin_strands_dropped, strand, no_byte);

  arrays.bones.resize(std::size_t{source} * 4);
  arrays.weights.resize(std::size_t{source} * 4);
  std::size_t kept = 0;
  auto next = dropped.begin();
  for (std::size_t strand = 0; strand < source; ++strand) {
    if (next != dropped.end() && *next == strand) {
      ++next;
      continue;
    }
    std::copy_n(arrays.bones.begin() + static_cast<std::ptrdiff_t>(strand * 4), 4, arrays.bones.begin() + static_cast<std::ptrdiff_t>(kept * 4));
    std::copy_n(arrays.weights.begin() + static_cast<std::ptrdiff_t>(strand * 4), 4, arrays.weights.begin() + static_cast<std::ptrdiff_t>(kept * 4));
    ++kept;
  }
  arrays.bones.resize(kept * 4);
  arrays.weights.resize(kept * 4);
}

uint32_t countUnattached(const RigArrays& arrays) noexcept {
  uint32_t count = 0;
  for (std::size_t i = 0; i < arrays.weights.size(); i += 4)
    count += std::all_of(arrays.weights.data() + i, arrays.weights.data() + i + 4, [](float weight) { return weight == 0; });
  return count;
}

}  // namespace

void RigDeleter::operator()(FlkRig_T* rig) const noexcept {
  HostMemory memory = rig->memory;  // outlives the object that it frees
  memory.destroy(rig);
}

FlkResult readRig(std::span<const std::byte> bytes, const RigSettings& settings, RigPointer& rig) {
  const Report report(settings.messages, settings.name);
  uint32_t format = FLK_FORMAT_UNKNOWN;
  FlkResult result = sniffRig(bytes, report, format);
  if (result != FLK_SUCCESS) return result;
  HostMemory memory = settings.memory;
  RigPointer made(memory.create<FlkRig_T>(settings.memory, settings.name));
  const bool skin = format == format_tfxbone;
  made->findings.countIn(skin ? "strand" : "vertex");
  result = skin ? readTfxbone(bytes, settings.limits, report, made->arrays, made->findings)
                : readTfxmesh(bytes, settings.limits, report, made->arrays, made->findings, made->info.triangles_in_source);
  if (result != FLK_SUCCESS) return result;
  RigArrays& arrays = made->arrays;
  made->info.records_in_source = arrays.recordCount();
  if (skin && settings.asset && !knowsDropped(*settings.asset))
    return report.fail(FLK_ERROR_INVALID_ARGUMENT, "SKIN_HAIR_COOKED",
                       "the hair given with it is a cache, whose source had %" PRIu32 " strands, of which %" PRIu32
                       " were dropped: which ones is not kept; give the hair as its source file",
                       settings.asset->info.strands_in_source, settings.asset->info.strands_in_source - settings.asset->info.strand_count);
  if (skin && settings.asset) fitToAsset(*settings.asset, arrays, made->findings);
  made->findings.finish();

  made->info.kind = skin ? FLK_RIG_SKIN : FLK_RIG_MESH;
  made->info.bone_count = arrays.names.size();
  made->info.record_count = arrays.recordCount();
  made->info.unattached_count = countUnattached(arrays);
  made->info.triangle_count = static_cast<uint32_t>(arrays.triangles.size() / 3);
  made->info.finding_count = made->findings.size();
  const auto held = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  made->info.bytes_host = sizeof(FlkRig_T) + made->name.capacity() + arrays.names.bytes() + held(arrays.bones) + held(arrays.weights) +
                          held(arrays.positions) + held(arrays.normals) + held(arrays.triangles) + made->findings.bytes();
  made->findings.tell(report);
  rig = std::move(made);
  return FLK_SUCCESS;
}

}  // namespace forelock
