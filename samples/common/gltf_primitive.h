// Strands of the line primitives of a glTF file, one primitive after the other. SPDX-License-Identifier: MIT
#pragma once

#include "gltf_accessor.h"
#include "gltf_chains.h"
#include "gltf_findings.h"
#include "gltf_nodes.h"
#include "gltf_reader.h"

namespace forelock::samples {

class GltfCollector {
public:
  GltfCollector(const tinygltf::Model& model, const GltfLimits& limits, GltfFindings& findings);
  GltfCollector(const GltfCollector&) = delete;
  GltfCollector& operator=(const GltfCollector&) = delete;

  // `where`: the field, for messages. Throws GltfRefusal.
  void add(const tinygltf::Primitive& primitive, const std::string& where, const GltfPlacement& placement);
  uint32_t strandCount() const { return uint32_t(strands_.first_vertex.size() - 1); }
  // All strands; where an attribute is only on some of them, a default on the rest. Once. Throws GltfRefusal if there are none.
  EditableStrands finish();

private:
  struct Attributes {
    const GltfAccessor* position = nullptr;
    const GltfAccessor *width = nullptr, *radius = nullptr, *color = nullptr, *uv = nullptr, *mass = nullptr, *strand_id = nullptr, *guide = nullptr;
  };
  Attributes attributesOf(const tinygltf::Primitive& primitive, const std::string& where);
  std::vector<uint32_t> indicesOf(const tinygltf::Primitive& primitive, const std::string& where, uint32_t vertices);
  Chains chainsOf(const tinygltf::Primitive& primitive, const std::string& where, const GltfAccessor& position);
  void noteChains(const Chains& chains);
  void append(const Chains& chains, const Attributes& attributes, const GltfPlacement& placement);

  // An array of strands_ that only some primitives have.
  struct Partial {
    std::vector<float>& values;
    const char* name;
    size_t components;
    std::vector<std::pair<size_t, size_t>> missing{};  // ranges of vertices, of strands for root UVs
    // The array as it goes on from element `before`, or null where this primitive has none.
    std::vector<float>* begin(bool present, size_t before, size_t after);
  };
  void fill(Partial& partial, size_t count, float value);


  const GltfLimits limits_;
  GltfFindings& findings_;
  GltfAccessors accessors_;
  bool restart_declared_ = false;
  std::map<int, std::vector<bool>> used_;  // vertices, of each accessor of positions
  EditableStrands strands_;
  Partial radii_{strands_.radii, "_WIDTH", 1}, colors_{strands_.colors, "COLOR_0", 3}, masses_{strands_.inverse_masses, "_INVERSE_MASS", 1},
      uvs_{strands_.root_uvs, "TEXCOORD_0", 2};
};

}  // namespace forelock::samples
