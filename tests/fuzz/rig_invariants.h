// What rig.h promises of every rig, checked through the public functions only. Shared by unit tests and fuzzing.
#pragma once

#include "asset_invariants.h"
#include "forelock/rig.h"
#include "rig_files.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace asset_test {

// The first promise that is broken; nullptr if none is.
inline const char* brokenRigPromise(FlkRig rig) {
  FlkRigInfo info;
  FlkRigArrays arrays;
  if (flkRigGetInfo(rig, &info) != FLK_SUCCESS || flkRigGetArrays(rig, &arrays) != FLK_SUCCESS) return "info and arrays can be asked for";
  if (info.kind != FLK_RIG_SKIN && info.kind != FLK_RIG_MESH) return "a kind";
  if (info.bone_count == 0 || info.record_count == 0) return "bones and records are left";
  const bool mesh = info.kind == FLK_RIG_MESH;
  if (mesh != (arrays.positions && arrays.normals && arrays.triangles)) return "a mesh has its arrays";
  if (!mesh && (arrays.positions || arrays.normals || arrays.triangles || info.triangle_count)) return "a skin has none of a mesh";
  if (mesh && (info.triangle_count == 0 || info.triangle_count > info.triangles_in_source)) return "triangles are left";
  for (uint32_t bone = 0; bone < info.bone_count; ++bone)
    if (!arrays.bone_names[bone] || std::strlen(arrays.bone_names[bone]) > info.bytes_host) return "names end";
  uint32_t unattached = 0;
  for (uint32_t record = 0; record < info.record_count; ++record) {
    double sum = 0;
    for (size_t i = size_t{record} * 4; i < size_t{record} * 4 + 4; ++i) {
      if (arrays.bones[i] >= info.bone_count) return "bones exist";
      if (!(arrays.weights[i] >= 0 && arrays.weights[i] <= 1.00001f)) return "weights within 0..1";
      sum += double{arrays.weights[i]};
    }
    if (sum == 0) ++unattached;
    else if (std::fabs(sum - 1) > 1.001e-5) return "weights make 1";
    for (size_t i = size_t{record} * 3; mesh && i < size_t{record} * 3 + 3; ++i)
      if (!(std::fabs(arrays.positions[i]) <= 1e6f) || !std::isfinite(arrays.normals[i])) return "positions within 1e6, normals finite";
  }
  if (unattached != info.unattached_count) return "unattached records are counted";
  for (size_t i = 0; i < size_t{info.triangle_count} * 3; i += 3) {
    const uint32_t* t = arrays.triangles + i;
    if (t[0] >= info.record_count || t[1] >= info.record_count || t[2] >= info.record_count) return "vertices of triangles exist";
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return "triangles have three vertices";
  }
  for (uint32_t i = 0; i < info.finding_count; ++i) {
    FlkFinding finding;
    if (flkRigGetFinding(rig, i, &finding) != FLK_SUCCESS) return "findings can be asked for";
    if (!finding.code || !*finding.code || !finding.text || !*finding.text || finding.count == 0 || finding.strands_listed > 8 || !isSentence(finding.text))
      return "findings have a code, a sentence and a count";
  }
  FlkFinding none;
  if (flkRigGetFinding(rig, info.finding_count, &none) == FLK_SUCCESS) return "no finding past the last";
  return nullptr;
}

}  // namespace asset_test
