// SPDX-License-Identifier: MIT
#include "command_line.h"

#include <filesystem>

namespace forelock::samples {

namespace {

void makeAbsolute(std::string& path) {
  if (!path.empty()) {
    path = std::filesystem::absolute(path).lexically_normal().string();
  }
}

}  // namespace

std::string shellQuoted(const std::string& text) {
  const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) {
    return text;
  }
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return quoted + "'";
}

Scene withAbsolutePaths(const Scene& scene) {
  Scene anywhere = scene;
  for (SceneAsset& asset : anywhere.assets) {
    if (asset.source.rfind("groom:", 0) != 0) {
      makeAbsolute(asset.source);
    }
    makeAbsolute(asset.root_image);
  }
  for (SceneMesh& mesh : anywhere.meshes) {
    makeAbsolute(mesh.source);
  }
  return anywhere;
}

std::string commandLine(const Scene& scene, const std::string& out) {
  Scene placed = withAbsolutePaths(scene);
  if (placed.camera.placed) {
    placed.camera.name.clear();  // it would take the place's place
  }
  // An option of its own even where it begins with a dash.
  const std::string target = !out.empty() && out[0] == '-' ? "./" + out : out;
  return "forelock preview --scene " + shellQuoted(writeScene(placed, true)) + " -o " + shellQuoted(target);
}

}  // namespace forelock::samples
