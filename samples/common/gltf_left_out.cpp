// What the tools say where they were built without glTF (FORELOCK_GLTF=OFF). SPDX-License-Identifier: MIT
#include "gltf_reader.h"
#include "gltf_writer.h"
#include "opaque_mesh.h"

namespace forelock::samples {
namespace {

[[noreturn]] void leftOut(const std::string& path) {
  throw AssetError(FLK_ERROR_NOT_BUILT, path + ": this build reads and writes no glTF: install libtinygltf-dev and configure with -DFORELOCK_GLTF=ON");
}

}  // namespace

OpenedAsset openGltf(const std::string& path) { leftOut(path); }
std::vector<AssetMessage> gltfLosses(const OpenedAsset&, const std::string&) { return {}; }
OpaqueMesh readMesh(const std::string& path, const ProgressFunction&, const MeshLimits&) { leftOut(path); }
void saveGltf(const OpenedAsset&, const std::string& path) { leftOut(path); }

}  // namespace forelock::samples
