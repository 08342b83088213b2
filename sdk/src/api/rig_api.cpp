#include "forelock/rig.h"

#include "api/load_call.h"
#include "asset/file_io.h"
#include "asset/loaded_rig.h"
#include "asset/sniff.h"

using namespace forelock;

namespace {

template <class Body>
FlkResult makeWith(const FlkRigOptions* options, const char* default_name, FlkRig* rig, Body&& body) noexcept {
  constexpr LoadCall call{FLK_TYPE_RIG_OPTIONS, "FlkRigOptions", "rig"};
  return loadWith<RigPointer>(call, options, default_name, rig, [&](const FlkRigOptions& given, const LoadBase& base, const Report& report, RigPointer& made) {
    const RigSettings settings{base.memory, base.messages, base.name,
                               {limitOr(given.max_bones, limit_bones), limitOr(given.max_records, limit_records)}, given.asset};
    return body(settings, report, made);
  });
}

FlkResult acceptHead(std::span<const std::byte> head, const Report& report) {
  uint32_t format = FLK_FORMAT_UNKNOWN;
  return sniffRig(head, report, format);
}

}  // namespace

extern "C" {

FlkResult flkRigLoadMemory(const void* bytes, size_t size, const FlkRigOptions* options, FlkRig* rig) {
  return makeWith(options, nullptr, rig, [&](const RigSettings& settings, const Report& report, RigPointer& made) {
    if (!bytes && size != 0) return invalid(report, "bytes is NULL, but size is not 0");
    return readRig(std::span(static_cast<const std::byte*>(bytes), size), settings, made);
  });
}

FlkResult flkRigLoadFile(const char* path, const FlkRigOptions* options, FlkRig* rig) {
  return makeWith(options, path, rig, [&](const RigSettings& settings, const Report& report, RigPointer& made) {
    if (!path) return invalid(report, "path is NULL");
    HostMemory memory = settings.memory;
    FileBytes file(&memory);
    const FlkResult result = readFile(path, settings.limits.largestFile(), true, report, acceptHead, file);
    return result == FLK_SUCCESS ? readRig(file.bytes(), settings, made) : result;
  });
}

FlkResult flkRigGetInfo(FlkRig rig, FlkRigInfo* info) {
  if (!rig || !info) return FLK_ERROR_INVALID_ARGUMENT;
  *info = rig->info;
  return FLK_SUCCESS;
}

FlkResult flkRigGetArrays(FlkRig rig, FlkRigArrays* arrays) {
  if (!rig || !arrays) return FLK_ERROR_INVALID_ARGUMENT;
  const RigArrays& held = rig->arrays;
  const bool mesh = rig->info.kind == FLK_RIG_MESH;
  *arrays = {held.names.pointers(), held.bones.data(), held.weights.data(), mesh ? held.positions.data() : nullptr,
             mesh ? held.normals.data() : nullptr, mesh ? held.triangles.data() : nullptr};
  return FLK_SUCCESS;
}

FlkResult flkRigGetFinding(FlkRig rig, uint32_t index, FlkFinding* finding) {
  if (!rig || !finding || index >= rig->findings.size()) return FLK_ERROR_INVALID_ARGUMENT;
  *finding = rig->findings.get(index);
  return FLK_SUCCESS;
}

void flkRigDestroy(FlkRig rig) {
  if (rig) RigDeleter{}(rig);
}

}  // extern "C"
