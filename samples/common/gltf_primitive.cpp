// SPDX-License-Identifier: MIT
#include "gltf_primitive.h"

#include "gltf_refusal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::samples {
namespace {

// The mean of what a transform does to lengths: the cube root of what it does to volumes. `uniform`: whether it does the same
// along each axis, to a thousandth; quaternions in 32-bit floats are off by less.
float scaleOf(const std::array<double, 12>& m, bool& uniform) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (size_t column = 0; column < 3; ++column) {
    const double length = std::hypot(m[column], m[4 + column], m[8 + column]);
    least = std::min(least, length), most = std::max(most, length);
  }
  uniform = most - least <= 1e-3 * most;
  const double volume = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
  return float(std::cbrt(std::abs(volume)));
}

bool isExtensionNamed(const tinygltf::Model& model, const char* name) {
  const auto& names = model.extensionsUsed;
  const auto& required = model.extensionsRequired;
  return std::find(names.begin(), names.end(), name) != names.end() || std::find(required.begin(), required.end(), name) != required.end();
}

}  // namespace

GltfCollector::GltfCollector(const tinygltf::Model& model, const GltfLimits& limits, GltfFindings& findings)
    : limits_(limits), findings_(findings), accessors_(model) {
  restart_declared_ = isExtensionNamed(model, "KHR_mesh_primitive_restart") || isExtensionNamed(model, "EXT_mesh_primitive_restart");
  strands_.first_vertex.push_back(0);
}

GltfCollector::Attributes GltfCollector::attributesOf(const tinygltf::Primitive& primitive, const std::string& where) {
  Attributes found;
  for (const auto& attribute : primitive.attributes) {
    const std::string& name = attribute.first;
    const int accessor = attribute.second;
    const std::string role = printable(name) + " of " + where;
    const auto take = [&](const GltfAccessor*& slot, int components, int more_components, bool integers_as_they_are) {
      const GltfAccessor& read = accessors_.get(accessor, role);
      const bool fits = (read.components() == components || read.components() == more_components) &&
                        (read.isFloat() || read.normalized() || integers_as_they_are);
      if (fits) slot = &read;
      else findings_.noteName(GltfFinding::attribute_ignored, name);
    };
    if (name == "POSITION") take(found.position, 3, 3, true);
    else if (name == "_WIDTH") take(found.width, 1, 1, false);
    else if (name == "_RADIUS") take(found.radius, 1, 1, false);
    else if (name == "COLOR_0") take(found.color, 3, 4, false);
    else if (name == "TEXCOORD_0") take(found.uv, 2, 2, true);
    else if (name == "_INVERSE_MASS") take(found.mass, 1, 1, true);
    else if (name == "_STRAND_ID") take(found.strand_id, 1, 2, true);
    else if (name == "_GUIDE") take(found.guide, 1, 1, true);
    else findings_.noteName(GltfFinding::attribute_ignored, name);
  }
  if (!found.position) refuseGltf("GLTF_FIELD", where + ".attributes.POSITION is " + (primitive.attributes.count("POSITION") ? "no VEC3" : "missing") + ": export the file again");
  const uint64_t count = found.position->count();
  if (count > limits_.vertices)
    refuseGltf("GLTF_TOO_LARGE", where + " has " + std::to_string(count) + " vertices, more than the limit of " + std::to_string(limits_.vertices) + ": split the file", FLK_ERROR_LIMIT);
  for (const GltfAccessor* other : {found.width, found.radius, found.color, found.uv, found.mass, found.strand_id, found.guide})
    if (other && other->count() != count)
      refuseGltf("GLTF_COUNTS_DISAGREE", where + " has " + std::to_string(count) + " positions, but an attribute of " + std::to_string(other->count()) +
                                             " values: the file is damaged, export it again");
  if (!found.position->isFloat()) findings_.note(GltfFinding::positions_quantized);
  return found;
}

std::vector<uint32_t> GltfCollector::indicesOf(const tinygltf::Primitive& primitive, const std::string& where, uint32_t vertices) {
  const std::string role = "indices of " + where;
  const GltfAccessor& read = accessors_.get(primitive.indices, role);
  const int type = read.componentType();
  const bool is_index = read.components() == 1 && (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                                                   type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT);
  const std::string who = "accessors[" + std::to_string(primitive.indices) + "] (" + role + ")";
  if (!is_index) refuseGltf("GLTF_FIELD", who + " is not of an unsigned integer type, as indices have to be: export the file again");
  // A vertex may be named any number of times, so that it is this count that has to be bounded.
  if (read.count() > 2 * uint64_t(limits_.vertices))
    refuseGltf("GLTF_TOO_LARGE", who + " has " + std::to_string(read.count()) + " indices, more than twice the limit of " + std::to_string(limits_.vertices) + " vertices: split the file", FLK_ERROR_LIMIT);
  const bool strip = primitive.mode != TINYGLTF_MODE_LINE;
  const uint64_t restart = read.largestInteger();
  std::vector<uint32_t> indices(read.count());
  for (uint64_t i = 0; i < read.count(); ++i) {
    indices[i] = read.integer(i);
    if (strip && indices[i] == restart) {
      indices[i] = kRestart;
      if (!restart_declared_) findings_.note(GltfFinding::restart_undeclared);
    } else if (indices[i] >= vertices) {
      refuseGltf("GLTF_INDEX_STRAY", who + " holds " + std::to_string(indices[i]) + " at its element " + std::to_string(i) + ", but there are " +
                                         std::to_string(vertices) + " vertices: the file is damaged, export it again");
    }
  }
  return indices;
}

Chains GltfCollector::chainsOf(const tinygltf::Primitive& primitive, const std::string& where, const GltfAccessor& position) {
  const uint32_t vertices = uint32_t(position.count());
  const bool pairs = primitive.mode == TINYGLTF_MODE_LINE;
  std::vector<bool>& used = used_[primitive.attributes.at("POSITION")];
  used.resize(vertices);
  if (primitive.indices < 0 && pairs) {
    std::fill(used.begin(), used.end() - vertices % 2, true);
    return chainsOfVertices(vertices, [&](uint32_t a, uint32_t b) {
      for (int axis = 0; axis < 3; ++axis)
        if (position.number(a, axis) != position.number(b, axis)) return false;
      return true;
    });
  }
  std::vector<uint32_t> indices;
  if (primitive.indices >= 0) {
    indices = indicesOf(primitive, where, vertices);
  } else {
    indices.resize(vertices);
    for (uint32_t v = 0; v < vertices; ++v) indices[v] = v;
  }
  for (const uint32_t index : indices)
    if (index != kRestart) used[index] = true;
  return pairs ? chainsOfPairs(std::move(indices)) : chainsOfStrip(indices, primitive.mode == TINYGLTF_MODE_LINE_LOOP);
}

void GltfCollector::noteChains(const Chains& chains) {
  const uint32_t base = strandCount();
  for (uint32_t i = 0; i < chains.marks.size(); ++i) {
    const uint8_t marks = chains.marks[i];
    if (marks & kChainBranch) findings_.note(GltfFinding::branch, base + i);
    if (marks & kChainCycle) findings_.note(GltfFinding::cycle, base + i);
    if (marks & kChainRootGuessed) findings_.note(GltfFinding::root_guessed, base + i);
    if (marks & kChainLoop) findings_.note(GltfFinding::loop_opened, base + i);
  }
  for (const auto& [kind, count] : {std::pair{GltfFinding::edge_degenerate, chains.self_edges}, {GltfFinding::edge_repeated, chains.repeated_edges},
                                    {GltfFinding::index_odd, chains.odd_indices}, {GltfFinding::lines_joined, chains.joined}})
    if (count > 0) findings_.note(kind, GltfFindings::kNoStrand, count);
}

std::vector<float>* GltfCollector::Partial::begin(bool present, size_t before, size_t after) {
  if (!present) {
    missing.emplace_back(before, after);
    return nullptr;
  }
  values.resize(before * components);
  return &values;
}

void GltfCollector::fill(Partial& partial, size_t count, float value) {
  if (partial.values.empty() || partial.missing.empty()) return;
  partial.values.resize(count * partial.components);
  for (const auto& [begin, end] : partial.missing)
    std::fill(partial.values.begin() + std::ptrdiff_t(begin * partial.components), partial.values.begin() + std::ptrdiff_t(end * partial.components), value);
  findings_.noteName(GltfFinding::attribute_partial, partial.name);
}

void GltfCollector::append(const Chains& chains, const Attributes& from, const GltfPlacement& placement) {
  const size_t before = strands_.vertices(), after = before + chains.vertices.size();
  bool uniform = true;
  const float scale = placement.moves ? scaleOf(placement.world, uniform) : 1.0f;
  if (!uniform && (from.width || from.radius)) findings_.note(GltfFinding::scale_not_uniform);

  for (const uint32_t vertex : chains.vertices) {
    const float p[3] = {from.position->number(vertex, 0), from.position->number(vertex, 1), from.position->number(vertex, 2)};
    const auto& m = placement.world;
    for (size_t row = 0; row < 3; ++row)
      strands_.positions.push_back(placement.moves ? float(m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3]) : p[row]);
  }
  const auto values = [&](Partial& partial, const GltfAccessor* accessor, float factor) {
    if (std::vector<float>* to = partial.begin(accessor, before, after))
      for (const uint32_t vertex : chains.vertices)
        for (size_t c = 0; c < partial.components; ++c) to->push_back(accessor->number(vertex, int(c)) * factor);
  };
  values(radii_, from.width ? from.width : from.radius, (from.width ? 0.5f : 1.0f) * scale);
  values(colors_, from.color, 1);
  values(masses_, from.mass, 1);

  uint64_t alphas = 0;
  if (from.color && from.color->components() == 4)
    for (const uint32_t vertex : chains.vertices) alphas += from.color->number(vertex, 3) != 1;
  if (alphas > 0) findings_.note(GltfFinding::alpha_ignored, GltfFindings::kNoStrand, alphas);

  std::vector<float>* root_uvs = uvs_.begin(from.uv, strandCount(), strandCount() + chains.marks.size());
  for (size_t i = 0; i < chains.marks.size(); ++i) {
    const uint32_t strand = strandCount(), *begin = &chains.vertices[chains.first[i]], *end = chains.vertices.data() + chains.first[i + 1];
    const auto varies = [&](const GltfAccessor& accessor) {
      return std::any_of(begin, end, [&](uint32_t v) {
        for (int c = 0; c < accessor.components(); ++c)
          if (accessor.number(v, c) != accessor.number(*begin, c)) return true;
        return false;
      });
    };
    if (root_uvs) {
      root_uvs->insert(root_uvs->end(), {from.uv->number(*begin, 0), from.uv->number(*begin, 1)});
      if (varies(*from.uv)) findings_.note(GltfFinding::root_uv_varies, strand);
    }
    if (from.strand_id && varies(*from.strand_id)) findings_.note(GltfFinding::strand_id_disagrees, strand);
    if (from.guide && from.guide->number(*begin, 0) != 0) findings_.note(GltfFinding::guides_ignored, strand);
    strands_.first_vertex.push_back(uint32_t(before + chains.first[i + 1]));
  }
}

void GltfCollector::add(const tinygltf::Primitive& primitive, const std::string& where, const GltfPlacement& placement) {
  const Attributes attributes = attributesOf(primitive, where);
  const Chains chains = chainsOf(primitive, where, *attributes.position);
  if (chains.vertices.size() > limits_.vertices - strands_.vertices() || chains.marks.size() > limits_.strands - strandCount())
    refuseGltf("GLTF_TOO_LARGE", "with " + where + " it has more than the limit of " + std::to_string(limits_.strands) + " strands or " +
                                     std::to_string(limits_.vertices) + " vertices: split the file", FLK_ERROR_LIMIT);
  noteChains(chains);
  append(chains, attributes, placement);
}

EditableStrands GltfCollector::finish() {
  for (const auto& [accessor, used] : used_)
    if (const auto unused = std::count(used.begin(), used.end(), false); unused > 0)
      findings_.note(GltfFinding::vertices_unused, GltfFindings::kNoStrand, uint64_t(unused));
  if (strandCount() == 0 || strands_.vertices() < 2) refuseGltf("GLTF_NO_LINES", "its lines have no segment that leads from one vertex to another: export it again", FLK_ERROR_EMPTY_ASSET);
  // Nearly the library's default width (docs/findings.md); white; free; the corner of the scalp.
  float side = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    float low = strands_.positions[axis], high = low;
    for (size_t i = axis; i < strands_.positions.size(); i += 3) low = std::min(low, strands_.positions[i]), high = std::max(high, strands_.positions[i]);
    side = std::max(side, high - low);
  }
  fill(radii_, strands_.vertices(), 0.5f * std::min(side / 5000 * std::max(1.0f, 100'000.0f / float(strandCount())), side / 1000));
  fill(colors_, strands_.vertices(), 1);
  fill(masses_, strands_.vertices(), 1);
  fill(uvs_, strandCount(), 0);
  return std::move(strands_);
}

}  // namespace forelock::samples
