// SPDX-License-Identifier: MIT
#include "view_session.h"

namespace forelock::samples {

void ViewSession::flyTo(const Orbit& orbit_there) {
  approach_from = orbit;
  approach_to = orbit_there;
  approach_start = Clock::now();
}

Scene ViewSession::currentScene() const {
  Scene current = scene;
  current.camera.placed = cameraOf(orbit, bounds);
  current.camera.name.clear();
  if (plain) {
    current.head = plain->scene.head;
  }
  return current;
}

Scene sceneOf(const ViewSession& session, const std::string& source, bool add) {
  Scene scene = session.scene;
  SceneAsset asset;
  asset.source = source;
  if (!add) {
    scene.assets.clear();
    scene.meshes.clear();
    scene.head.reset();
    scene.exposure = 0.0;
  }
  scene.assets.push_back(asset);
  scene.camera.placed.reset();
  scene.camera.name.clear();
  scene.width = scene.height = 0;
  return scene;
}

}  // namespace forelock::samples
