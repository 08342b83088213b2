// SPDX-License-Identifier: MIT
#include "viewer_app.h"

#include "colored_stage.h"
#include "view_measure.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace forelock::samples {

namespace {

constexpr double kStillAfter_s = 0.2;      // without a change the picture is drawn in full
constexpr double kLeastShare = 0.2;
constexpr int kQuick_ms = 20;              // pipelines that are there sooner are waited for

// What of a picture may need other pipelines. What is missing here is made while the window waits.
std::string pipelineKey(const Scene& scene, const LayerRequest& request) {
  Scene of;
  of.display = scene.display;
  of.coloring = scene.coloring;
  of.head = scene.head;
  of.sky = scene.sky ? std::optional<SceneSky>(SceneSky{}) : std::nullopt;
  of.lights.clear();
  for (const SceneLight& light : scene.lights) {
    SceneLight& kept = of.lights.emplace_back();
    kept.kind = light.kind;
    kept.shadow = light.shadow;
    kept.shadow_cover = light.shadow_cover;
  }
  std::string key = writeScene(of, true) + (scene.meshes.empty() ? "" : "m");
  for (const SceneAsset& asset : scene.assets) {
    key += asset.ignore_colors ? "c" : "-";
    key += asset.material.tip_blend > 0.0f ? "t" : "-";
    key += asset.follow.count > 0 ? "f" : "-";
    key += asset.root_image.empty() ? "-" : asset.source + asset.root_image;
  }
  for (const std::optional<MethodChoice>& method : request.methods) {
    Scene chosen;
    if (method) {
      applyMethod(*method, chosen);
      key += writeScene(chosen, true);
    }
  }
  return key + (request.meshes ? "m" : "-") + (request.cheap ? "q" : "-") + (request.count_work ? "w" : "-");
}

// What of a scene needs hair to be uploaded anew.
bool sameHair(const SceneAsset& a, const SceneAsset& b) {
  return a.follow.count == b.follow.count && a.follow.radius_mm == b.follow.radius_mm && a.follow.spread_tip == b.follow.spread_tip &&
         a.follow.seed == b.follow.seed && a.ignore_colors == b.ignore_colors && a.root_image == b.root_image;
}

}  // namespace

// The stage in other colours, or in its own again.
void Viewer::recolor() {
  Stage& plain = *session_.plain;
  plain.scene = session_.scene;
  plain.scene.coloring = StrandColoring::none;
  std::unique_ptr<Stage> colored;
  if (session_.scene.coloring != StrandColoring::none) {
    plain.scene.camera.placed = cameraOf(session_.orbit, session_.bounds);
    colored = std::make_unique<Stage>(coloredStage(plain, session_.scene.coloring));
  }
  device_->layers->setStage(colored ? *colored : plain);
  session_.colored = std::move(colored);
}

// Nothing opaque is cut off by the camera's planes.
void Viewer::encloseMeshes() {
  float low[3], high[3];
  if (device_->layers->opaqueBounds(low, high)) {
    for (int i = 0; i < 3; ++i) {
      session_.bounds.low[i] = std::min(session_.bounds.low[i], static_cast<double>(low[i]));
      session_.bounds.high[i] = std::max(session_.bounds.high[i], static_cast<double>(high[i]));
    }
  }
}

// What panels changed of the scene goes to the stage and the device.
void Viewer::applyEdits() {
  if (!session_.plain) {
    return;
  }
  Scene& scene = session_.scene;
  bool light_changed = false;
  try {
    if (scene.coloring != applied_.coloring) {
      recolor();
    }
    session_.plain->legend = displayLegend(scene.display);
    bool moved = false;  // a mesh, or it came or went
    if (scene.head != applied_.head) {
      for (Stage* stage : {session_.plain.get(), session_.colored.get()}) {
        if (stage) {
          stage->scene.head = scene.head;
        }
      }
      moved = true;
    }
    for (size_t i = 0; i < std::min(scene.meshes.size(), session_.plain->meshes.size()); ++i) {
      const SceneMesh &wanted = scene.meshes[i], &now = applied_.meshes[i];
      if (wanted.position == now.position && wanted.turn_deg == now.turn_deg && wanted.scale == now.scale && wanted.color == now.color) {
        continue;
      }
      for (Stage* stage : {session_.plain.get(), session_.colored.get()}) {
        if (stage && i < stage->meshes.size()) {
          placeMesh(wanted, scene.camera.up, stage->meshes[i]);
        }
      }
      moved = true;
    }
    if (moved) {
      device_->layers->renewMeshes();
      encloseMeshes();
    }
    bool look = false;
    for (size_t i = 0; i < std::min(scene.assets.size(), session_.plain->assets.size()); ++i) {
      const SceneAsset& wanted = scene.assets[i];
      if (writeAsset(wanted) == writeAsset(applied_.assets[i])) {
        continue;
      }
      StagedAsset& asset = session_.plain->assets[i];
      std::vector<std::string> ignored;
      stageLook(wanted, asset, ignored);
      placeAsset(wanted, scene.camera.up, asset);
      if (!sameHair(wanted, applied_.assets[i]) && !session_.colored) {
        device_->layers->renewHair(i);
      }
      look = light_changed = true;
    }
    if (look && !session_.colored) {
      device_->layers->updateLook();
    }
  } catch (const AssetError& error) {
    session_.alert = error.what();
    scene = applied_;
    return;
  }
  Scene lights = scene, before = applied_;
  lights.assets.clear(), before.assets.clear();
  light_changed = light_changed || lightsKey(lights) != lightsKey(before);
  if (light_changed && session_.auto_exposure) {
    scene.exposure = 0.0;
  }
  applied_ = scene;
  session_.plain->scene = scene;
  session_.plain->scene.coloring = StrandColoring::none;
  if (session_.colored) {
    std::vector<SceneAsset> pieces = session_.colored->scene.assets;
    session_.colored->scene = scene;
    session_.colored->scene.assets = std::move(pieces);
  }
}

void Viewer::moveCamera(double dt) {
  if (session_.approach_to) {
    const double t = seconds(Clock::now() - session_.approach_start);
    session_.orbit = approach(*session_.approach_from, *session_.approach_to, t);
    if (t >= kApproachSeconds) {
      session_.approach_to.reset();
    }
  }
  if (session_.turning && session_.loaded() && turntable_views_ == 0) {
    const double turn = session_.turn_speed * (3.14159265358979323846 / 180.0) * std::min(dt, 0.2);
    session_.orbit.azimuth = std::remainder(session_.orbit.azimuth + turn, 2.0 * 3.14159265358979323846);
  }
}

// Whether a picture can be planned without making pipelines. Else they are made beside the window, which goes on.
bool Viewer::compiled(const LayerRequest& request) {
  const std::string key = pipelineKey(session_.scene, request);
  if (compiled_keys_.count(key) > 0) {
    return true;
  }
  compiling_key_ = key;
  compiling_ = std::async(std::launch::async, [this, request] {
    device_->layers->compile(request);
    ViewWindow::wake();
  });
  if (compiling_.wait_for(std::chrono::milliseconds(kQuick_ms)) != std::future_status::ready) {
    return false;
  }
  takeCompiled();
  return true;
}

// Of what has been made. True: there was something. What was drawn is then to be drawn again: it left the depths of meshes undrawn.
bool Viewer::takeCompiled() {
  if (!compiling_.valid()) {
    return false;
  }
  try {
    std::exchange(compiling_, {}).get();
  } catch (const AssetError&) {  // planning meets it again, and tells
  }
  compiled_keys_.insert(compiling_key_);
  again_ = true;
  return true;
}

// Draws the full picture of the scene as it is now, whatever is on the screen. False: it failed.
bool Viewer::drawFull() {
  if (compiling_.valid()) {
    compiling_.wait();
    takeCompiled();
  }
  applyEdits();
  if (drawn_full_ && !again_ && !sounding_ && pictureKey(session_, cameraOf(session_.orbit, session_.bounds)) == drawn_key_) {
    return true;
  }
  drawn_full_ = false;
  only_full_ = true;
  bool fine = true;
  for (int pictures = 0, tries = 0; fine && pictures < 4 && tries < 16 && (!drawn_full_ || again_); ++tries) {
    bool planned = false;
    fine = planPicture(planned);
    if (fine && planned) {
      fine = device_->screen->host().submit([&](VkCommandBuffer cmd) { device_->layers->record(cmd); });
      if (!fine) {
        throw DeviceLost("drawing: the device was lost");
      }
      afterPicture(0.0);
      ++pictures;
    } else if (compiling_.valid()) {
      compiling_.wait();
      takeCompiled();
    }
  }
  only_full_ = false;
  return fine && drawn_full_;
}

// Plans the layers that the window needs anew. False: failed, and said so.
bool Viewer::planPicture(bool& planned) {
  planned = false;
  if (!session_.stage()) {
    return true;
  }
  Scene& scene = session_.scene;
  viewport_.size(scene.width, scene.height);
  for (Stage* stage : {session_.plain.get(), session_.colored.get()}) {
    if (stage) {
      stage->scene.width = scene.width;
      stage->scene.height = scene.height;
    }
  }
  applied_.width = scene.width;
  applied_.height = scene.height;
  const Camera camera = cameraOf(session_.orbit, session_.bounds);
  std::string key = pictureKey(session_, camera);
  const auto now = Clock::now();
  if (key != drawn_key_) {
    last_change_ = now;
  }
  if (window_->input().waiting()) {  // a full picture would hold it up
    last_change_ = now;
  }
  const bool moving = seconds(now - last_change_) < kStillAfter_s && turntable_views_ == 0 && !only_full_;
  const bool adapt = session_.settings.adapt && (full_ms_ > session_.settings.moving_budget_ms || full_ms_ == 0.0);
  const bool cheap = moving && adapt;
  if (key == drawn_key_ && !again_ && (drawn_full_ || cheap)) {
    sounding_ = false;
    return true;
  }
  try {
    if (scene.exposure <= 0.0 && session_.shaded()) {
      if (!compiled(device_->layers->soundingRequest(camera))) {
        return true;
      }
      scene.exposure = device_->layers->chooseExposure(camera);
      applied_.exposure = scene.exposure;
      session_.plain->scene.exposure = scene.exposure;
      key = pictureKey(session_, camera);
      const VkImageView small = device_->layers->hairImage(kLayerFirst).view;  // is shown until there is a larger one
      device_->display->bind({small, small, small});
      sounding_ = true;
      if (!first_picture_) {
        return true;
      }
    }
    LayerRequest request;
    request.camera = camera;
    request.exposure = scene.exposure > 0.0 ? scene.exposure : 1.0;
    request.count_work = session_.count_work;
    request.cheap = cheap;
    session_.share = cheap ? cheap_share_ : 1.0;
    const auto scaled = [&](uint32_t side) { return std::max(16u, static_cast<uint32_t>(std::lround(side * session_.share))); };
    request.width = cheap ? std::min(scaled(scene.width), scene.width) : scene.width;
    request.height = cheap ? std::min(scaled(scene.height), scene.height) : scene.height;
    request.few_strands = cheap && cheap_share_ < 0.7 && scene.display != FLK_DISPLAY_LAYERS && device_->layers->hasFewStrands();
    request.methods[kLayerFirst] = methodOf(scene);
    if (session_.compare != Compare::none && session_.shaded()) {
      request.methods[kLayerSecond] = session_.second;
    }
    if (session_.measure_error && session_.shaded() && !cheap) {
      MethodChoice exact{FLK_METHOD_EXACT};
      exact.capture = scene.capture;
      request.methods[kLayerExact] = exact;
    }
    if (!compiled(request)) {
      return true;
    }
    device_->layers->plan(request);
    const VkImageView first = device_->layers->hairImage(kLayerFirst).view;
    const VkImageView second = request.methods[kLayerSecond] ? device_->layers->hairImage(kLayerSecond).view : first;
    const VkImageView opaque = device_->layers->opaqueView();
    device_->display->bind({first, second, opaque ? opaque : first});
    drawn_key_ = key;
    drawn_full_ = !cheap;
    sounding_ = false;
    planned = true;
  } catch (const AssetError& error) {
    sounding_ = again_ = false;
    session_.alert = error.what();
    drawn_key_ = key;  // not again until something changes
    drawn_full_ = true;
    return false;
  }
  return true;
}

void Viewer::afterPicture(double ms) {
  again_ = device_->layers->finish();
  const FlkStatistics& statistics = device_->layers->facts(kLayerFirst).statistics;
  FrameTimes times;
  std::copy(statistics.milliseconds, statistics.milliseconds + FLK_STAGE_COUNT, times.stage_ms.begin());
  times.total_ms = statistics.milliseconds_frame;
  times.resolution_share = session_.share;
  times.reduced = !drawn_full_;
  session_.times.add(times);
  session_.frame_ms = ms;
  if (drawn_full_) {
    full_ms_ = ms > 0.0 ? ms : full_ms_;
    measure();
  } else if (ms > 0.0) {  // half way to what the budget allows, so that it does not swing
    const double wanted = cheap_share_ * std::sqrt(session_.settings.moving_budget_ms / ms);
    cheap_share_ = std::clamp(0.5 * (cheap_share_ + wanted), kLeastShare, 1.0);
  }
}

void Viewer::measure() {
  if (!session_.measure_error || !device_->layers->drawn(kLayerExact)) {
    session_.error = session_.error_second = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const std::vector<float> exact = device_->layers->readHair(kLayerExact);
  session_.error = rmseOf(device_->layers->readHair(kLayerFirst), exact);
  session_.error_second = device_->layers->drawn(kLayerSecond) ? rmseOf(device_->layers->readHair(kLayerSecond), exact)
                                                               : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace forelock::samples
