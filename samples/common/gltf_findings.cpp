// SPDX-License-Identifier: MIT
#include "gltf_findings.h"

#include "gltf_refusal.h"

#include <iterator>

namespace forelock::samples {
namespace {

struct Meaning {
  const char* code;
  uint32_t severity;
  bool repaired;
  const char* what;
  const char* advice;
};

constexpr uint32_t info = FLK_SEVERITY_INFO, warning = FLK_SEVERITY_WARNING;

constexpr Meaning meanings[] = {
    {"GLTF_BRANCH", warning, false, "strands begin or end where more than two segments meet", "give every strand vertices of its own if they should be longer"},
    {"GLTF_CYCLE", warning, true, "strands were closed; the segment that leads back to their lowest vertex was left out", "check where the root should be"},
    {"GLTF_LOOP_OPENED", warning, true, "strands are of mode LINE_LOOP; the segment from the last vertex to the first was left out", "export as LINE_STRIP or LINES"},
    {"GLTF_EDGE_DEGENERATE", warning, true, "segments lead from a vertex to itself and were left out", "merge no vertices when exporting"},
    {"GLTF_EDGE_REPEATED", warning, true, "segments are there more than once; one of each was kept", "check the exporter"},
    {"GLTF_ROOT_GUESSED", warning, false, "strands have indices that do not rise from one end to the other; the end with the lower index was taken as the root",
     "preview them by root to tip; reverse what is upside down"},
    {"GLTF_INDEX_ODD", warning, true, "lines have an index without a partner, which was left out", "check the exporter"},
    {"GLTF_VERTICES_UNUSED", warning, true, "vertices belong to no line and were left out", "check the exporter if they should be hair"},
    {"GLTF_RESTART_UNDECLARED", warning, false, "strips were split at the highest index, though no extension says that it restarts a strip",
     "name KHR_mesh_primitive_restart in extensionsRequired"},
    {"GLTF_MESH_UNUSED", warning, true, "meshes with lines are in no node of the scene and were left out", "add them to the scene if they should be hair"},
    {"GLTF_SCALE_NOT_UNIFORM", warning, false, "nodes scale axes differently; widths were scaled by the mean", "apply the scale where the file was made"},
    {"GLTF_STRAND_ID_DISAGREES", warning, false, "strands join vertices whose _STRAND_ID differs; the lines were followed", "check the exporter"},
    {"GLTF_ATTRIBUTE_PARTIAL", warning, true, "attributes are missing on some of the lines, where a default is used", "export them on all"},
    {"GLTF_TRAILING_BYTES", warning, false, "bytes follow the last part of the file that is known and were ignored", "check the exporter"},
    {"GLTF_LINES_JOINED", info, false, "lines without indices go on where the last one ended and were joined", "nothing, if the strands look whole"},
    {"GLTF_PRIMITIVE_SKIPPED", info, false, "primitives of triangles or points were passed over", "nothing: a mesh may be the head"},
    {"GLTF_TRANSFORM_APPLIED", info, false, "nodes move, turn or scale their strands, which was applied", "nothing to do"},
    {"GLTF_POSITIONS_QUANTIZED", info, false, "primitives have quantised positions, which are as coarse as their steps", "export strands as 32-bit floats"},
    {"GLTF_ROOT_UV_VARIES", info, false, "strands have UVs that vary along them; that of the root was taken", "nothing to do"},
    {"GLTF_ALPHA_IGNORED", info, false, "colours have an alpha below 1, which is not used", "opacity comes from the material"},
    {"GLTF_GUIDES_IGNORED", info, false, "strands are marked as guides; they were loaded like the others", "nothing to do"},
    {"GLTF_ATTRIBUTE_IGNORED", info, false, "attributes are of no use to strands or of a type that is not read", "nothing, if the hair looks right"},
    {"GLTF_DEFORMATION_IGNORED", info, false, "skins and morph targets are not applied", "export the hair at rest"},
};
static_assert(std::size(meanings) == size_t(GltfFinding::kinds));

}  // namespace

void GltfFindings::note(GltfFinding kind, uint32_t strand, uint64_t times) {
  Slot& slot = slots_[size_t(kind)];
  slot.count += times;
  if (strand != kNoStrand && slot.strands.size() < 8 && (slot.strands.empty() || slot.strands.back() != strand)) slot.strands.push_back(strand);
}

void GltfFindings::noteName(GltfFinding kind, const std::string& name) {
  Slot& slot = slots_[size_t(kind)];
  // A sentence is no place for thousands.
  if (slot.names.size() < 8 ? slot.names.insert(printable(name, 40)).second : false) ++slot.count;
}

std::vector<AssetFinding> GltfFindings::list() const {
  std::vector<AssetFinding> findings;
  for (size_t kind = 0; kind < slots_.size(); ++kind) {
    const Slot& slot = slots_[kind];
    if (slot.count == 0) continue;
    const Meaning& meaning = meanings[kind];
    std::string text = std::to_string(slot.count) + " " + meaning.what;
    if (!slot.strands.empty()) text += ", the first in strand " + std::to_string(slot.strands.front());
    std::string names;
    for (const std::string& name : slot.names) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) text += " (" + names + ")";
    findings.push_back({meaning.code, text + ": " + meaning.advice, meaning.severity, meaning.repaired, slot.count, slot.strands, UINT64_MAX});
  }
  return findings;
}

}  // namespace forelock::samples
