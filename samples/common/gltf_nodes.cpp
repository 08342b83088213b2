// SPDX-License-Identifier: MIT
#include "gltf_nodes.h"

#include "gltf_refusal.h"

#include <cmath>

namespace forelock::samples {
namespace {

using Matrix = std::array<double, 12>;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (size_t row = 0; row < 3; ++row)
    for (size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? a[4 * row + 3] : 0;
      for (size_t k = 0; k < 3; ++k) sum += a[4 * row + k] * b[4 * k + column];
      c[4 * row + column] = sum;
    }
  return c;
}

Matrix localOf(const tinygltf::Node& node) {
  Matrix local = kIdentity;
  if (node.matrix.size() == 16) {  // column by column
    for (size_t row = 0; row < 3; ++row)
      for (size_t column = 0; column < 4; ++column) local[4 * row + column] = node.matrix[4 * column + row];
    return local;
  }
  if (node.rotation.size() == 4) {
    double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
    if (length > 0) {
      x /= length, y /= length, z /= length, w /= length;
      local = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0, 2 * (x * y + z * w), 1 - 2 * (x * x + z * z),
               2 * (y * z - x * w), 0, 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0};
    }
  }
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3 && node.scale.size() == 3; ++column) local[4 * row + column] *= node.scale[column];
    if (node.translation.size() == 3) local[4 * row + 3] = node.translation[row];
  }
  return local;
}

std::string nameOf(const tinygltf::Model& model, const std::string& node, int mesh) {
  if (!node.empty()) return node;
  const std::string& name = model.meshes[size_t(mesh)].name;
  return name.empty() ? "mesh " + std::to_string(mesh) : name;
}

std::vector<int> rootsOf(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes.at(size_t(model.defaultScene < 0 ? 0 : model.defaultScene)).nodes;
  std::vector<bool> is_child(model.nodes.size());
  for (const tinygltf::Node& node : model.nodes)
    for (const int child : node.children) is_child.at(size_t(child)) = true;
  std::vector<int> roots;
  for (size_t i = 0; i < model.nodes.size(); ++i)
    if (!is_child[i]) roots.push_back(int(i));
  if (roots.empty() && !model.nodes.empty()) refuseGltf("GLTF_NODE_CYCLE", "every node is a child of another: nodes go round in a cycle, export the file again");
  return roots;
}

}  // namespace

std::vector<GltfPlacement> placeGltfMeshes(const tinygltf::Model& model) {
  std::vector<GltfPlacement> placements;
  if (model.nodes.empty()) {
    for (size_t mesh = 0; mesh < model.meshes.size(); ++mesh) placements.push_back({int(mesh), nameOf(model, "", int(mesh))});
    return placements;
  }
  struct Step {
    int node;
    Matrix parent;
  };
  std::vector<Step> steps;  // a stack, so that no depth of nodes can exhaust that of the program
  const std::vector<int> roots = rootsOf(model);
  for (size_t i = roots.size(); i-- > 0;) steps.push_back({roots[i], kIdentity});
  std::vector<bool> reached(model.nodes.size());
  while (!steps.empty()) {
    const Step step = steps.back();
    steps.pop_back();
    if (reached.at(size_t(step.node)))
      refuseGltf("GLTF_NODE_CYCLE", "nodes[" + std::to_string(step.node) + "] is reached twice: children go round in a cycle or two nodes share a child, export the file again");
    reached[size_t(step.node)] = true;
    const tinygltf::Node& node = model.nodes[size_t(step.node)];
    const Matrix world = product(step.parent, localOf(node));
    if (node.mesh >= 0) placements.push_back({node.mesh, nameOf(model, node.name, node.mesh), world, world != kIdentity});
    for (size_t i = node.children.size(); i-- > 0;) steps.push_back({node.children[i], world});
  }
  return placements;
}

}  // namespace forelock::samples
