// SPDX-License-Identifier: MIT
#include "gltf_reader.h"

#include "gltf_document.h"
#include "gltf_primitive.h"
#include "gltf_refusal.h"

#include <algorithm>
#include <new>

namespace forelock::samples {
namespace {

bool isLineMode(int mode) { return mode == TINYGLTF_MODE_LINE || mode == TINYGLTF_MODE_LINE_LOOP || mode == TINYGLTF_MODE_LINE_STRIP; }

bool hasLines(const tinygltf::Mesh& mesh) {
  return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [](const tinygltf::Primitive& p) { return isLineMode(p.mode); });
}

// Which primitives there are, and what the scene does not use.
std::vector<GltfPlacement> placementsWithLines(const tinygltf::Model& model, GltfFindings& findings) {
  size_t triangles = 0, points = 0, line_meshes = 0;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    line_meshes += hasLines(mesh);
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      points += primitive.mode == TINYGLTF_MODE_POINTS;
      triangles += primitive.mode >= TINYGLTF_MODE_TRIANGLES;
    }
  }
  if (line_meshes == 0 && triangles > 0)
    refuseGltf("GLTF_MESH_ONLY", "it is a mesh: " + std::to_string(triangles) + " primitives of triangles and none of lines; hair has to be lines (LINES or LINE_STRIP), "
               "curves or loose edges in the program that made it; a mesh can be the head beside it", FLK_ERROR_FORMAT_UNKNOWN);
  if (line_meshes == 0)
    refuseGltf("GLTF_NO_LINES", std::string("it holds no primitive of lines") + (points ? ", but points, which do not say which make a strand" : "") +
               ": export hair as LINES or LINE_STRIP", FLK_ERROR_EMPTY_ASSET);
  if (triangles + points > 0) findings.note(GltfFinding::primitive_skipped, GltfFindings::kNoStrand, triangles + points);

  std::vector<GltfPlacement> placements = placeGltfMeshes(model);
  std::vector<bool> used(model.meshes.size());
  for (const GltfPlacement& placement : placements) used.at(size_t(placement.mesh)) = true;
  for (size_t mesh = 0; mesh < used.size(); ++mesh)
    if (!used[mesh] && hasLines(model.meshes[mesh])) findings.note(GltfFinding::mesh_unused);
  std::erase_if(placements, [&](const GltfPlacement& placement) { return !hasLines(model.meshes[size_t(placement.mesh)]); });
  if (placements.empty())
    refuseGltf("GLTF_NO_LINES", "its scene uses none of the " + std::to_string(line_meshes) + " meshes that have lines: add them to the scene", FLK_ERROR_EMPTY_ASSET);
  return placements;
}

GltfStrands strandsOf(GltfDocument document, const GltfLimits& limits) {
  const tinygltf::Model& model = document.model;
  GltfFindings findings;
  if (document.deforms) findings.note(GltfFinding::deformation_ignored);
  if (document.bytes_unused) findings.note(GltfFinding::trailing_bytes, GltfFindings::kNoStrand, document.bytes_unused);
  GltfStrands read;
  GltfCollector collector(model, limits, findings);
  for (const GltfPlacement& placement : placementsWithLines(model, findings)) {
    const tinygltf::Mesh& mesh = model.meshes[size_t(placement.mesh)];
    const uint32_t before = collector.strandCount();
    for (size_t i = 0; i < mesh.primitives.size(); ++i)
      if (isLineMode(mesh.primitives[i].mode))
        collector.add(mesh.primitives[i], "meshes[" + std::to_string(placement.mesh) + "].primitives[" + std::to_string(i) + "]", placement);
    if (placement.moves) findings.note(GltfFinding::transform_applied);
    if (collector.strandCount() == before) continue;
    read.groups.resize(collector.strandCount(), uint32_t(read.group_names.size()));
    read.group_names.push_back(printable(placement.name, 200));
  }
  read.strands = collector.finish();
  read.findings = findings.list();
  return read;
}

}  // namespace

GltfStrands readGltf(std::vector<unsigned char> bytes, const std::string& name, const std::filesystem::path& folder, const GltfLimits& limits) {
  try {
    return strandsOf(readGltfDocument(std::move(bytes), folder), limits);
  } catch (const GltfRefusal& refusal) {
    throw GltfError(refusal.result, refusal.id, name + ": " + refusal.what());
  } catch (const std::bad_alloc&) {
    throw GltfError(FLK_ERROR_OUT_OF_HOST_MEMORY, "OUT_OF_HOST_MEMORY", name + ": there is not enough memory to read it: close programs or split the file");
  } catch (const std::exception& error) {
    throw GltfError(FLK_ERROR_MALFORMED, "GLTF_PARSER", name + ": its structure cannot be read (" + printable(error.what(), 200) + "): export it again");
  }
}

}  // namespace forelock::samples
