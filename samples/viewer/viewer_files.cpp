// SPDX-License-Identifier: MIT
#include "viewer_app.h"

#include "picture_file.h"
#include "view_measure.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

bool sceneSuffix(const std::string& name) { return fs::path(name).extension() == ".json"; }

bool strandSuffix(const std::string& name) {
  static const char* const kSuffixes[] = {".tfx", ".hair", ".ply", ".gltf", ".glb", ".flk", ".data", ".bin", ".json"};
  const std::string suffix = fs::path(name).extension().string();
  return std::any_of(std::begin(kSuffixes), std::end(kSuffixes), [&](const char* known) { return suffix == known; });
}

bool namesAssets(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(size_t{1} << 20, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<size_t>(file.gcount()));
  return text.find("\"assets\"") != std::string::npos;
}

bool meshSuffix(const std::string& name) { return fs::path(name).extension() == ".gltf" || fs::path(name).extension() == ".glb"; }

}  // namespace

void Viewer::open(const Scene& scene, const OpenFiles& files, bool arranging) {
  arranging_ = arranging;
  opened_ = Clock::now();
  opening_ = true;
  first_picture_ = false;
  held_ms_ = 0.0;
  last_frame_ = opened_;
  loader_.open(scene, files);
}

// What the window holds, to be arranged otherwise.
OpenFiles Viewer::openFiles() const {
  OpenFiles files;
  if (session_.plain) {
    const Stage& stage = *session_.plain;
    for (size_t i = 0; i < stage.assets.size(); ++i) {
      files.assets.emplace_back(stage.scene.assets[i], stage.assets[i].opened);
    }
    for (size_t i = 0; i < stage.meshes.size(); ++i) {
      files.meshes.emplace_back(stage.scene.meshes[i], stage.meshes[i].read);
    }
  }
  return files;
}

void Viewer::addMesh(const std::string& path) {
  if (!session_.loaded()) {
    session_.alert = path + ": open hair first, then a mesh beside it.";
    return;
  }
  Scene scene = session_.currentScene();
  scene.meshes.emplace_back().source = path;
  open(scene, openFiles(), true);
}

void Viewer::openPath(const std::string& path, bool add) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    session_.settings.last_folder = path;
    browse(add ? ViewSession::Browse::add : ViewSession::Browse::open);
    return;
  }
  const std::string whole = path.rfind("groom:", 0) == 0 ? path : fs::absolute(path, error).string();
  if (sceneSuffix(path)) {  // a groom's recipe is JSON too, but has no assets
    try {
      const Scene scene = loadScene(path);
      if (!scene.assets.empty()) {
        open(scene);
        return;
      }
    } catch (const std::exception& failure) {
      if (namesAssets(path)) {
        session_.alert = path + ": " + failure.what();
        return;
      }
    }
  }
  const bool beside = add && session_.loaded();
  open(sceneOf(session_, whole, beside), beside ? openFiles() : OpenFiles{});
}

// What was dragged in: with shift beside what is open, several beside each other.
void Viewer::takeDropped() {
  const std::vector<std::string> paths = window_->takeDropped();
  const bool add = window_->droppedWithShift();
  if (paths.size() == 1) {
    openPath(paths[0], add);
  } else if (!paths.empty()) {
    const bool beside = add && session_.loaded();
    Scene scene = sceneOf(session_, paths[0], beside);
    for (size_t i = 1; i < paths.size(); ++i) {
      scene.assets.emplace_back().source = paths[i];
    }
    open(scene, beside ? openFiles() : OpenFiles{});
  }
}

void Viewer::adopt(std::unique_ptr<LoadedStage> loaded) {
  opening_ = false;
  if (!loaded->plain && !loaded->meshes.empty() && session_.loaded()) {  // meshes go beside the hair that is open
    Scene scene = session_.currentScene();
    scene.meshes.insert(scene.meshes.end(), loaded->meshes.begin(), loaded->meshes.end());
    open(scene, openFiles(), true);
    return;
  }
  if (!loaded->plain) {
    first_picture_ = true;  // what comes next is not of it
    session_.alert = loaded->error + (session_.loaded() ? "\n\nWhat was open stays as it was." : "");
    return;
  }
  loader_.stopStudy();
  try {
    device_->layers->setStage(loaded->colored ? *loaded->colored : *loaded->plain);
  } catch (const AssetError& error) {
    session_.alert = error.what();
    if (session_.stage()) {
      device_->layers->setStage(*session_.stage());
    }
    return;
  }
  session_.plain = std::move(loaded->plain);
  session_.colored = std::move(loaded->colored);
  session_.findings.clear();
  session_.faults.clear();
  session_.selection = {};
  session_.picked.reset();
  session_.times.clear();
  const Stage& stage = *session_.plain;
  session_.notes = stage.notes;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::vec3& p : stage.seen) {
    low = glm::min(low, glm::dvec3(p) - stage.radius);
    high = glm::max(high, glm::dvec3(p) + stage.radius);
  }
  session_.bounds = {low, high};
  encloseMeshes();
  session_.scene = stage.scene;
  viewport_.size(session_.scene.width, session_.scene.height);
  session_.plain->scene.width = session_.scene.width;
  session_.plain->scene.height = session_.scene.height;
  if (!arranging_) {
    home_ = orbitOf(stageCamera(*session_.plain, 0, 1), session_.scene.camera.up);
    session_.orbit = home_;
    session_.approach_to.reset();
  }
  applied_ = session_.scene;
  drawn_key_.clear();
  drawn_full_ = sounding_ = false;
  compiled_keys_.clear();  // other assets may need others
  last_change_ = Clock::now();
  std::string names;
  for (const SceneAsset& asset : session_.scene.assets) {
    noteRecent(session_.settings, asset.source);
    names += (names.empty() ? "" : ", ") + (asset.source.rfind("groom:", 0) == 0 ? asset.source : fs::path(asset.source).filename().string());
  }
  window_->setTitle(names + " - Forelock");
  opened_text_ = names;
  if (loaded->read) {
    char text[64];
    std::snprintf(text, sizeof text, ", opened in %.2f s", loaded->seconds);
    opened_text_ += text;
  }
  session_.say(opened_text_);
  loader_.study(*session_.plain);
}

void Viewer::adoptExtras(std::unique_ptr<LoadedExtras> extras) {
  if (session_.plain && extras->findings.size() == session_.plain->assets.size()) {
    session_.findings = std::move(extras->findings);
    session_.faults = std::move(extras->faults);
    const bool any = std::any_of(extras->few.begin(), extras->few.end(), [](const auto& few) { return few != nullptr; });
    if (any && !session_.colored) {
      device_->layers->setFewStrands(extras->few);
    }
  }
}

void Viewer::browse(ViewSession::Browse what) {
  session_.browse = what;
  const std::string& folder = session_.settings.last_folder;
  std::string name = "hair";  // of the first asset
  if (session_.loaded()) {
    const std::string& source = session_.scene.assets[0].source;
    name = source.rfind("groom:", 0) == 0 ? source.substr(6) : fs::path(source).stem().string();
  }
  switch (what) {
    case ViewSession::Browse::open: browser_.open("Open a strand file", folder, strandSuffix); break;
    case ViewSession::Browse::add: browser_.open("Add a strand file to the scene", folder, strandSuffix); break;
    case ViewSession::Browse::mesh: browser_.open("Add a mesh to the scene", folder, meshSuffix); break;
    case ViewSession::Browse::scene: browser_.open("Open a scene", folder, sceneSuffix); break;
    case ViewSession::Browse::save_scene: browser_.open("Save the scene", folder, sceneSuffix, name + "-scene.json"); break;
    case ViewSession::Browse::save_picture: browser_.open("Save the picture", folder, isImagePath, name + ".png"); break;
    case ViewSession::Browse::save_turntable: browser_.open("Save the turntable as numbered pictures, NAME-000.png and on", folder, isImagePath, name + "-turn.png", false); break;
    default: break;
  }
}

void Viewer::takeBrowsed() {
  const std::optional<std::string> path = browser_.draw();
  if (!path) {
    return;
  }
  session_.settings.last_folder = browser_.folder();
  switch (session_.browse) {
    case ViewSession::Browse::open: openPath(*path, false); break;
    case ViewSession::Browse::add: openPath(*path, true); break;
    case ViewSession::Browse::mesh: addMesh(*path); break;
    case ViewSession::Browse::scene: openPath(*path, false); break;
    case ViewSession::Browse::save_scene: saveSceneTo(*path); break;
    case ViewSession::Browse::save_picture: savePictureTo(*path); break;
    case ViewSession::Browse::save_turntable: turntable_path_ = *path; break;
    default: break;
  }
}

// False: it was not written, and an alert says why.
bool Viewer::savePictureTo(const std::string& path) {
  try {
    if (!isImagePath(path)) {
      throw AssetError(FLK_ERROR_IO, path + ": no picture format of this extension, use .png or .exr");
    }
    if (!drawFull()) {
      throw AssetError(FLK_ERROR_IO, path + ": nothing was written, because the picture could not be drawn" +
                                         (session_.alert.empty() ? "" : ":\n" + session_.alert));
    }
    Image image = device_->layers->read(kLayerFirst);
    if (session_.scene.background) {
      const glm::vec3 ground(*session_.scene.background);
      image = over(image, &ground[0]);
    }
    int corner = -1;
    drawLegend(image, session_.stage()->legend, corner);
    savePicture(path, image);
    session_.say("saved " + path);
    return true;
  } catch (const DeviceLost&) {
    throw;
  } catch (const std::runtime_error& error) {
    session_.alert = error.what();
    return false;
  }
}

void Viewer::saveSceneTo(const std::string& path) {
  try {
    writeWholeText(path, writeScene(session_.currentScene()) + "\n");
    session_.say("saved " + path);
  } catch (const std::runtime_error& error) {
    session_.alert = error.what();
  }
}

// One view of the turntable a frame, so that the window goes on.
void Viewer::stepTurntable() {
  if (turntable_views_ == 0 || turntable_path_.empty()) {
    if (turntable_views_ > 0 && !browser_.isOpen()) {
      turntable_views_ = 0;  // cancelled
    }
    return;
  }
  if (turntable_at_ == 0) {
    turntable_from_ = session_.orbit;
  } else {
    turntable_saved_ += savePictureTo(numberedPath(turntable_path_, turntable_at_ - 1)) ? 1 : 0;
  }
  if (turntable_at_ >= turntable_views_ || !session_.alert.empty()) {
    session_.orbit = turntable_from_;
    session_.say((turntable_views_ < turntable_wanted_ ? "cancelled, " : "") + std::string("saved ") + std::to_string(turntable_saved_) + " of " +
                 std::to_string(turntable_wanted_) + " views, " + numberedPath(turntable_path_, 0) + " and on");
    turntable_views_ = 0;
    session_.busy.clear();
    return;
  }
  session_.orbit = turntable_from_;
  session_.orbit.azimuth =
      std::remainder(turntable_from_.azimuth + 2.0 * 3.14159265358979323846 * turntable_at_ / turntable_views_, 2.0 * 3.14159265358979323846);
  ++turntable_at_;
}

}  // namespace forelock::samples
