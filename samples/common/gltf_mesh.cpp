// Triangles of glTF files as one opaque mesh. SPDX-License-Identifier: MIT
#include "gltf_accessor.h"
#include "gltf_document.h"
#include "gltf_nodes.h"
#include "gltf_reader.h"
#include "gltf_refusal.h"
#include "opaque_mesh.h"
#include "whole_file.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <new>

namespace forelock::samples {
namespace {

bool isTriangleMode(int mode) { return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP || mode == TINYGLTF_MODE_TRIANGLE_FAN; }

class MeshCollector {
public:
  MeshCollector(const tinygltf::Model& model, const MeshLimits& limits) : limits_(limits), accessors_(model) {}

  void add(const tinygltf::Primitive& primitive, const std::string& where, const GltfPlacement& placement);
  OpaqueMesh finish() { return std::move(mesh_); }
  size_t triangles() const { return mesh_.indices.size() / 3; }

private:
  std::vector<uint32_t> trianglesOf(const tinygltf::Primitive& primitive, const std::string& where, uint32_t vertices);
  void addPositions(const GltfAccessor& positions, const std::string& where, const GltfPlacement& placement);
  void addNormals(const GltfAccessor* given, const glm::dmat3& turn, size_t first_vertex, size_t first_index);

  const MeshLimits limits_;
  GltfAccessors accessors_;
  OpaqueMesh mesh_;
};

std::vector<uint32_t> MeshCollector::trianglesOf(const tinygltf::Primitive& primitive, const std::string& where, uint32_t vertices) {
  const std::string role = "indices of " + where;
  const GltfAccessor* indices = primitive.indices >= 0 ? &accessors_.get(primitive.indices, role) : nullptr;
  const std::string who = "accessors[" + std::to_string(primitive.indices) + "] (" + role + ")";
  if (indices) {
    const int type = indices->componentType();
    if (indices->components() != 1 || (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
                                       type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT))
      refuseGltf("GLTF_FIELD", who + " is not of an unsigned integer type, as indices have to be: export the file again");
  }
  const uint64_t count = indices ? indices->count() : vertices;
  const bool separate = primitive.mode == TINYGLTF_MODE_TRIANGLES;
  if ((separate ? count / 3 : count) > limits_.triangles - triangles())
    refuseGltf("GLTF_TOO_LARGE", "with " + where + " it has more than the limit of " + std::to_string(limits_.triangles) + " triangles: make a coarser mesh", FLK_ERROR_LIMIT);
  const uint64_t restart = indices ? indices->largestInteger() : UINT64_MAX;
  std::vector<uint32_t> triangles;
  triangles.reserve(size_t(separate ? count : 3 * count));
  uint32_t recent[2] = {0, 0};  // of a strip the two before, of a fan its middle and the one before
  uint64_t run = 0;             // indices since the strip or fan began
  for (uint64_t i = 0; i < count; ++i) {
    const uint32_t index = indices ? indices->integer(i) : uint32_t(i);
    if (!separate && index == restart) {
      run = 0;
      continue;
    }
    if (index >= vertices)
      refuseGltf("GLTF_INDEX_STRAY", who + " holds " + std::to_string(index) + " at its element " + std::to_string(i) + ", but there are " +
                                         std::to_string(vertices) + " vertices: the file is damaged, export it again");
    const uint64_t place = separate ? run % 3 : run;
    if (place >= 2) {
      const bool turned = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP && run % 2 == 1;  // every other one of a strip winds backwards
      const uint32_t a = recent[turned ? 1 : 0], b = recent[turned ? 0 : 1];
      if (a != b && b != index && a != index) triangles.insert(triangles.end(), {a, b, index});
      if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) recent[0] = recent[1];
      recent[1] = index;
    } else {
      recent[place] = index;
    }
    ++run;
  }
  return triangles;
}

void MeshCollector::addPositions(const GltfAccessor& positions, const std::string& where, const GltfPlacement& placement) {
  const auto& m = placement.world;
  for (uint64_t v = 0; v < positions.count(); ++v) {
    const double p[3] = {double(positions.number(v, 0)), double(positions.number(v, 1)), double(positions.number(v, 2))};
    for (size_t row = 0; row < 3; ++row) {
      const double value = m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
      if (!(std::abs(value) <= 1e15))  // also what is no number; as far as hair may be from the origin
        refuseGltf("GLTF_FIELD", "POSITION of " + where + " is not finite, or beyond 1e15 m, at its vertex " + std::to_string(v) + ": repair the mesh in the program that made it");
      mesh_.positions.push_back(float(value));
    }
  }
}

// Smooth over the vertices that triangles share, weighed by area; `given` where it says a direction.
void MeshCollector::addNormals(const GltfAccessor* given, const glm::dmat3& turn, size_t first_vertex, size_t first_index) {
  const auto place = [&](uint32_t v) { return glm::dvec3(mesh_.positions[3 * size_t(v)], mesh_.positions[3 * size_t(v) + 1], mesh_.positions[3 * size_t(v) + 2]); };
  std::vector<glm::dvec3> made(mesh_.vertices() - first_vertex, glm::dvec3(0.0));
  for (size_t i = first_index; i < mesh_.indices.size(); i += 3) {
    const glm::dvec3 a = place(mesh_.indices[i]);
    const glm::dvec3 area = glm::cross(place(mesh_.indices[i + 1]) - a, place(mesh_.indices[i + 2]) - a);
    for (size_t corner = 0; corner < 3; ++corner) made[mesh_.indices[i + corner] - first_vertex] += area;
  }
  for (size_t v = 0; v < made.size(); ++v) {
    glm::dvec3 normal = made[v];
    if (given) {
      const glm::dvec3 said = turn * glm::dvec3(given->number(v, 0), given->number(v, 1), given->number(v, 2));
      const double square = glm::dot(said, said);
      if (square > 0 && std::isfinite(square)) normal = said;
    }
    const double length = glm::length(normal);
    normal = length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0, 1, 0);  // of a vertex without an area
    mesh_.normals.insert(mesh_.normals.end(), {float(normal.x), float(normal.y), float(normal.z)});
  }
}

void MeshCollector::add(const tinygltf::Primitive& primitive, const std::string& where, const GltfPlacement& placement) {
  const auto find = [&](const char* name) -> const GltfAccessor* {
    const auto found = primitive.attributes.find(name);
    return found != primitive.attributes.end() ? &accessors_.get(found->second, std::string(name) + " of " + where) : nullptr;
  };
  const GltfAccessor* positions = find("POSITION");
  if (!positions || positions->components() != 3)
    refuseGltf("GLTF_FIELD", where + ".attributes.POSITION is " + (positions ? "no VEC3" : "missing") + ": export the file again");
  if (positions->count() > limits_.vertices - mesh_.vertices())
    refuseGltf("GLTF_TOO_LARGE", "with " + where + " it has more than the limit of " + std::to_string(limits_.vertices) + " vertices: make a coarser mesh", FLK_ERROR_LIMIT);
  const GltfAccessor* normals = find("NORMAL");
  if (normals && normals->count() != positions->count())
    refuseGltf("GLTF_COUNTS_DISAGREE", where + " has " + std::to_string(positions->count()) + " positions, but " + std::to_string(normals->count()) +
                                           " normals: the file is damaged, export it again");
  if (normals && normals->components() != 3) normals = nullptr;

  const auto& m = placement.world;
  const glm::dvec3 x(m[0], m[4], m[8]), y(m[1], m[5], m[9]), z(m[2], m[6], m[10]);
  const bool mirrors = glm::dot(glm::cross(x, y), z) < 0;
  // The inverse's transpose up to its length, which a matrix without an inverse has too.
  const glm::dmat3 turn = glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * (mirrors ? -1.0 : 1.0);

  std::vector<uint32_t> triangles = trianglesOf(primitive, where, uint32_t(positions->count()));
  const size_t first_vertex = mesh_.vertices(), first_index = mesh_.indices.size();
  addPositions(*positions, where, placement);
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    if (mirrors) std::swap(triangles[i + 1], triangles[i + 2]);
    for (size_t corner = 0; corner < 3; ++corner) mesh_.indices.push_back(uint32_t(first_vertex) + triangles[i + corner]);
  }
  addNormals(normals, turn, first_vertex, first_index);
}

OpaqueMesh meshOf(const GltfDocument& document, const MeshLimits& limits, const ProgressFunction& progress) {
  const tinygltf::Model& model = document.model;
  size_t of_triangles = 0, of_lines = 0;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      of_triangles += isTriangleMode(primitive.mode);
      of_lines += !isTriangleMode(primitive.mode) && primitive.mode != TINYGLTF_MODE_POINTS;
    }
  if (of_triangles == 0)
    refuseGltf("GLTF_NO_TRIANGLES", of_lines > 0 ? "it holds lines and no triangles: it is hair, not a mesh; name it as ASSET"
                                                 : "it holds no primitive of triangles: export the mesh as TRIANGLES", FLK_ERROR_EMPTY_ASSET);
  MeshCollector collector(model, limits);
  const std::vector<GltfPlacement> placements = placeGltfMeshes(model);
  for (size_t done = 0; done < placements.size(); ++done) {
    const GltfPlacement& placement = placements[done];
    const tinygltf::Mesh& mesh = model.meshes[size_t(placement.mesh)];
    for (size_t i = 0; i < mesh.primitives.size(); ++i)
      if (isTriangleMode(mesh.primitives[i].mode))
        collector.add(mesh.primitives[i], "meshes[" + std::to_string(placement.mesh) + "].primitives[" + std::to_string(i) + "]", placement);
    if (progress) progress(done + 1, placements.size());
  }
  if (collector.triangles() == 0)
    refuseGltf("GLTF_NO_TRIANGLES", "its scene shows none of its triangles, or all of them have no area: add the mesh to the scene and export it again", FLK_ERROR_EMPTY_ASSET);
  OpaqueMesh mesh = collector.finish();
  if (document.base_color) mesh.albedo = glm::vec3((*document.base_color)[0], (*document.base_color)[1], (*document.base_color)[2]);
  return mesh;
}

}  // namespace

OpaqueMesh readMesh(const std::string& path, const ProgressFunction& progress, const MeshLimits& limits) {
  try {
    // What vertices and triangles within the limits can take: 16 floats, and three indices.
    std::vector<unsigned char> bytes = readWholeFile(path, uint64_t(limits.vertices) * 64 + uint64_t(limits.triangles) * 12 + (uint64_t{256} << 20));
    if (!looksLikeGltf(bytes, bytes))
      throw GltfError(FLK_ERROR_FORMAT_UNKNOWN, "GLTF_JSON", path + ": it is no glTF file: export the mesh as .gltf or .glb");
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    OpaqueMesh mesh = meshOf(readGltfDocument(std::move(bytes), folder.empty() ? "." : folder), limits, progress);
    mesh.label = path;
    return mesh;
  } catch (const GltfRefusal& refusal) {
    throw GltfError(refusal.result, refusal.id, path + ": " + refusal.what());
  } catch (const AssetError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw GltfError(FLK_ERROR_OUT_OF_HOST_MEMORY, "OUT_OF_HOST_MEMORY", path + ": there is not enough memory to read it: close programs or make a coarser mesh");
  } catch (const std::exception& error) {
    throw GltfError(FLK_ERROR_MALFORMED, "GLTF_PARSER", path + ": its structure cannot be read (" + printable(error.what(), 200) + "): export it again");
  }
}

}  // namespace forelock::samples
