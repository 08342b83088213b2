// SPDX-License-Identifier: MIT
#include "viewer.h"

#include "colored_stage.h"
#include "command_line.h"
#include "commands.h"
#include "file_browser.h"
#include "picture_file.h"
#include "stray.h"
#include "ui.h"
#include "view_loader.h"
#include "view_measure.h"
#include "view_script.h"
#include "view_session.h"
#include "view_window.h"
#include "viewport.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

constexpr double kStillAfter_s = 0.2;      // without a change the picture is drawn in full
constexpr double kIdle_s = 0.5;            // a person's input wakes it at once
constexpr double kAgainAfterLoss_s = 5.0;  // a device that is lost sooner again is given up
constexpr double kLeastShare = 0.2;

double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

// What of a scene needs hair to be uploaded anew.
bool sameHair(const SceneAsset& a, const SceneAsset& b) {
  return a.follow.count == b.follow.count && a.follow.radius_mm == b.follow.radius_mm && a.follow.spread_tip == b.follow.spread_tip &&
         a.follow.seed == b.follow.seed && a.ignore_colors == b.ignore_colors && a.root_image == b.root_image;
}

bool sceneSuffix(const std::string& name) { return fs::path(name).extension() == ".json"; }

bool strandSuffix(const std::string& name) {
  static const char* const kSuffixes[] = {".tfx", ".hair", ".ply", ".gltf", ".glb", ".flk", ".data", ".bin", ".json"};
  const std::string suffix = fs::path(name).extension().string();
  return std::any_of(std::begin(kSuffixes), std::end(kSuffixes), [&](const char* known) { return suffix == known; });
}

class Viewer {
public:
  explicit Viewer(const ViewerOptions& options) : options_(options), loader_([] { glfwPostEmptyEvent(); }) {}
  int run();

private:
  // Everything on the device.
  struct Device {
    std::unique_ptr<ViewScreen> screen;
    std::unique_ptr<ViewLayers> layers;
    std::unique_ptr<DisplayPass> display;
    ~Device() {
      layers.reset();
      display.reset();
    }
  };

  bool makeDevice(std::string& error);
  void loseDevice(const std::string& why);
  void adopt(std::unique_ptr<LoadedStage> loaded);
  void adoptExtras(std::unique_ptr<LoadedExtras> extras);
  void open(const Scene& scene);
  void openPath(const std::string& path, bool add);
  void recolor();
  void encloseMeshes();
  void applyEdits();
  void takeRequests();
  void takeBrowsed();
  void takeScript();
  void keys();
  void drawUi();
  void moveCamera(double dt);
  bool planPicture(bool& planned);
  void afterPicture(double ms);
  void savePictureTo(const std::string& path, LayerIndex layer = kLayerFirst);
  void saveSceneTo(const std::string& path);
  void stepTurntable();
  std::vector<glm::vec3> selectedPoints() const;
  void frameSelection();
  void browse(ViewSession::Browse what);
  void measure();
  bool settled() const;
  void frame();
  int finish();

  ViewerOptions options_;
  ViewSession session_;
  std::unique_ptr<ViewWindow> window_;
  std::unique_ptr<Device> device_;
  ViewLoader loader_;
  ViewScript script_;
  FileBrowser browser_;
  Viewport viewport_;

  Scene applied_;              // that the stage has
  Orbit home_;
  std::string drawn_key_;      // of the last picture
  bool drawn_full_ = false, again_ = false, pending_picture_ = false, fly_ = false;
  Clock::time_point last_change_ = Clock::now(), last_frame_ = Clock::now(), opened_ = Clock::now(), lost_{};
  double cheap_share_ = 0.35, full_ms_ = 0.0;
  bool sounding_ = false;      // what is shown is the small picture that told the exposure
  bool opening_ = false, first_picture_ = false, measured_ = false, minimised_ = false;
  uint32_t frames_ = 0, settled_frames_ = 0;
  std::vector<double> moving_ms_;   // from the input to the picture, while something moved
  std::string turntable_path_;
  uint32_t turntable_at_ = 0, turntable_views_ = 0;
  Orbit turntable_from_;
  std::vector<std::string> validation_;
  float ui_scale_ = 0.0f;
  int exit_code_ = kDone;
  bool quit_ = false;
};

bool Viewer::makeDevice(std::string& error) {
  auto device = std::make_unique<Device>();
  ViewScreen::Options wanted;
  wanted.validation = options_.validation;
  wanted.vsync = session_.settings.vsync && options_.script.empty();
  wanted.device_name = options_.device;
  wanted.ui_scale = ui_scale_ = session_.settings.ui_scale > 0.0f ? session_.settings.ui_scale : window_->contentScale();
  device->screen = ViewScreen::create(*window_, wanted, error);
  if (!device->screen) {
    return false;
  }
  device->layers = std::make_unique<ViewLayers>(device->screen->host(), device->screen->gpu());
  device->display = std::make_unique<DisplayPass>(device->screen->gpu(), device->screen->renderPass());
  device_ = std::move(device);
  session_.device = device_->screen->host().deviceName();
  if (session_.stage()) {
    device_->layers->setStage(*session_.stage());
  }
  drawn_key_.clear();
  return true;
}

void Viewer::loseDevice(const std::string& why) {
  const auto now = Clock::now();
  if (device_) {
    const auto& messages = device_->screen->host().validationMessages();
    validation_.insert(validation_.end(), messages.begin(), messages.end());
  }
  device_.reset();
  if (lost_ != Clock::time_point{} && seconds(now - lost_) < kAgainAfterLoss_s) {
    throw std::runtime_error(why + " twice within " + std::to_string(static_cast<int>(kAgainAfterLoss_s)) + " seconds");
  }
  lost_ = now;
  std::string error;
  if (!makeDevice(error)) {
    throw std::runtime_error(why + ", and no other is usable: " + error);
  }
  session_.alert = why + ". It was made again; nothing of the scene is lost.";
}

void Viewer::open(const Scene& scene) {
  opened_ = Clock::now();
  opening_ = true;
  first_picture_ = false;
  loader_.open(scene);
}

void Viewer::openPath(const std::string& path, bool add) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    session_.settings.last_folder = path;
    browse(add ? ViewSession::Browse::add : ViewSession::Browse::open);
    return;
  }
  const std::string whole = path.rfind("groom:", 0) == 0 ? path : fs::absolute(path, error).string();
  if (sceneSuffix(path)) {  // a recipe is one too: told by whether it parses as a scene with assets
    try {
      const Scene scene = loadScene(path);
      if (!scene.assets.empty()) {
        open(scene);
        return;
      }
    } catch (const std::exception&) {
    }
  }
  open(sceneOf(session_, whole, add && session_.loaded()));
}

void Viewer::adopt(std::unique_ptr<LoadedStage> loaded) {
  opening_ = false;
  if (!loaded->plain) {
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
  const bool keep_exposure = loaded->plain == nullptr && stage.scene.exposure > 0.0;
  session_.scene = stage.scene;
  session_.exposure_chosen = !keep_exposure;
  viewport_.size(session_.scene.width, session_.scene.height);
  session_.plain->scene.width = session_.scene.width;
  session_.plain->scene.height = session_.scene.height;
  home_ = orbitOf(stageCamera(*session_.plain, 0, 1), session_.scene.camera.up);
  session_.orbit = home_;
  session_.approach_to.reset();
  applied_ = session_.scene;
  drawn_key_.clear();
  last_change_ = Clock::now();
  std::string names;
  for (const SceneAsset& asset : session_.scene.assets) {
    noteRecent(session_.settings, asset.source);
    names += (names.empty() ? "" : ", ") + (asset.source.rfind("groom:", 0) == 0 ? asset.source : fs::path(asset.source).filename().string());
  }
  window_->setTitle(names + " - Forelock");
  char text[64];
  std::snprintf(text, sizeof text, ", opened in %.2f s", loaded->seconds);
  session_.say(names + text);
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
    if (scene.head != applied_.head) {
      for (Stage* stage : {session_.plain.get(), session_.colored.get()}) {
        if (stage) {
          stage->scene.head = scene.head;
        }
      }
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
  if (light_changed && session_.exposure_chosen) {
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

void Viewer::browse(ViewSession::Browse what) {
  session_.browse = what;
  const std::string& folder = session_.settings.last_folder;
  switch (what) {
    case ViewSession::Browse::open: browser_.open("Open a strand file", folder, strandSuffix); break;
    case ViewSession::Browse::add: browser_.open("Add a strand file beside what is open", folder, strandSuffix); break;
    case ViewSession::Browse::scene: browser_.open("Open a scene", folder, sceneSuffix); break;
    case ViewSession::Browse::save_scene: browser_.open("Save the scene", folder, sceneSuffix, "scene.json"); break;
    case ViewSession::Browse::save_picture: browser_.open("Save the picture", folder, isImagePath, "hair.png"); break;
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
    case ViewSession::Browse::scene:
      try {
        open(loadScene(*path));
      } catch (const std::exception& error) {
        session_.alert = *path + ": " + error.what();
      }
      break;
    case ViewSession::Browse::save_scene: saveSceneTo(*path); break;
    case ViewSession::Browse::save_picture:
      if (turntable_views_ > 0 && turntable_path_.empty()) {
        turntable_path_ = *path;
      } else {
        savePictureTo(*path);
      }
      break;
    default: break;
  }
}

void Viewer::savePictureTo(const std::string& path, LayerIndex layer) {
  try {
    if (!isImagePath(path)) {
      throw AssetError(FLK_ERROR_IO, path + ": no picture format of this extension, use .png or .exr");
    }
    if (!drawn_full_) {  // whatever is on the screen now, a picture is the full one
      bool planned = false;
      last_change_ = Clock::now() - std::chrono::seconds(10);
      for (int attempt = 0; attempt < 4 && planPicture(planned) && planned; ++attempt) {
        device_->screen->host().submit([&](VkCommandBuffer cmd) { device_->layers->record(cmd); });
        afterPicture(0.0);
      }
    }
    Image image = device_->layers->read(layer);
    if (session_.scene.background) {
      const glm::vec3 ground(*session_.scene.background);
      image = over(image, &ground[0]);
    }
    int corner = -1;
    drawLegend(image, session_.stage()->legend, corner);
    savePicture(path, image);
    session_.say("saved " + path);
  } catch (const std::runtime_error& error) {
    session_.alert = error.what();
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
    savePictureTo(numberedPath(turntable_path_, turntable_at_ - 1));
  }
  if (turntable_at_ >= turntable_views_ || !session_.alert.empty()) {
    session_.orbit = turntable_from_;
    session_.say("saved " + std::to_string(turntable_at_) + " views, " + numberedPath(turntable_path_, 0) + " and on");
    turntable_views_ = 0;
    session_.busy.clear();
    return;
  }
  session_.orbit = turntable_from_;
  session_.orbit.azimuth =
      std::remainder(turntable_from_.azimuth + 2.0 * 3.14159265358979323846 * turntable_at_ / turntable_views_, 2.0 * 3.14159265358979323846);
  ++turntable_at_;
}

std::vector<glm::vec3> Viewer::selectedPoints() const {
  const Selection& selection = session_.selection;
  if (!session_.plain || selection.strands.empty() || selection.asset >= session_.plain->assets.size()) {
    return {};
  }
  const StagedAsset& asset = session_.plain->assets[selection.asset];
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened.asset.get(), &strands);
  return pointsOf(strands, selection.strands, asset.world_from_hair);
}

void Viewer::frameSelection() {
  const std::vector<glm::vec3> points = selectedPoints();
  if (points.empty()) {
    return;
  }
  glm::dvec3 low(points[0]), high(points[0]);
  for (const glm::vec3& p : points) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  // A strand of no length still gets a view of a hundredth of the scene.
  const double least = 0.01 * session_.bounds.size();
  const double grow = std::max(0.0, 0.5 * (least - glm::length(high - low)));
  Orbit there = session_.orbit;
  there.frame(Bounds{low - grow, high + grow}, session_.plain->aspect(), 1.4);
  session_.flyTo(there);
}

void Viewer::takeRequests() {
  Requests ask = std::exchange(session_.requests, {});
  using Browse = ViewSession::Browse;
  if (ask.open) open(*ask.open);
  if (ask.open_file) browse(Browse::open);
  if (ask.add_file) browse(Browse::add);
  if (ask.open_scene) browse(Browse::scene);
  if (ask.save_scene && session_.loaded()) browse(Browse::save_scene);
  if (ask.save_picture && session_.loaded()) browse(Browse::save_picture);
  if (ask.turntable > 0 && session_.loaded()) {
    turntable_views_ = ask.turntable;
    turntable_at_ = 0;
    turntable_path_.clear();
    browse(Browse::save_picture);
  }
  if (ask.copy_command && session_.loaded()) {
    try {
      window_->setClipboard(commandLine(session_.currentScene(), "hair.png"));
      session_.say("the command line is in the clipboard");
    } catch (const std::runtime_error& error) {
      session_.alert = error.what();
    }
  }
  if (session_.loaded()) {
    if (ask.frame_all) {
      Orbit there = session_.orbit;
      there.frame(session_.plain->seen, session_.plain->radius, session_.plain->aspect());
      session_.flyTo(there);
    }
    if (ask.reset_view) session_.flyTo(home_);
    if (ask.frame_selection) frameSelection();
    if (ask.camera) {
      for (const StagedAsset& asset : session_.plain->assets) {
        for (const RecipeCamera& camera : asset.opened.recipe ? asset.opened.recipe->cameras : std::vector<RecipeCamera>()) {
          if (camera.name == *ask.camera) session_.flyTo(orbitOf(fromRecipeCamera(camera), session_.scene.camera.up));
        }
      }
    }
  }
  if (ask.ui_scale) {
    session_.settings.ui_scale = *ask.ui_scale;
  }
  if (ask.quit) quit_ = true;
}

void Viewer::takeScript() {
  while (const std::optional<ScriptAction> action = script_.takeAction()) {
    switch (action->kind) {
      case ScriptAction::Kind::resize: window_->resize(action->width, action->height); break;
      case ScriptAction::Kind::minimise: minimised_ = true; glfwIconifyWindow(window_->handle()); break;
      case ScriptAction::Kind::restore: minimised_ = false; glfwRestoreWindow(window_->handle()); break;
      case ScriptAction::Kind::drop: openPath(action->text, false); break;
      case ScriptAction::Kind::window_picture: device_->screen->capture(action->text); break;
      case ScriptAction::Kind::picture: savePictureTo(action->text); break;
      case ScriptAction::Kind::copy_command:
        try {
          writeWholeText(action->text, commandLine(session_.currentScene(), "command.png") + "\n");
        } catch (const std::runtime_error& error) {
          session_.alert = error.what();
        }
        break;
      case ScriptAction::Kind::lose_device: throw DeviceLost("the device was lost, as the script asks");
    }
  }
}

void Viewer::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [&](int key) { return ImGui::IsKeyPressed(key, false); };
  if (pressed(GLFW_KEY_F1)) session_.show_help = !session_.show_help;
  if (pressed(GLFW_KEY_F12)) session_.requests.save_picture = true;
  if (io.WantTextInput || browser_.isOpen() || !session_.alert.empty()) {
    return;
  }
  if (io.KeyCtrl) {
    if (pressed(GLFW_KEY_O)) session_.requests.open_file = true;
    if (pressed(GLFW_KEY_S)) (io.KeyShift ? session_.requests.save_scene : session_.requests.save_picture) = true;
    if (pressed(GLFW_KEY_C)) session_.requests.copy_command = true;
    if (pressed(GLFW_KEY_Q)) session_.requests.quit = true;
    return;
  }
  if (pressed(GLFW_KEY_F)) session_.requests.frame_all = true;
  if (pressed(GLFW_KEY_G)) session_.requests.frame_selection = true;
  if (pressed(GLFW_KEY_R)) session_.requests.reset_view = true;
  if (pressed(GLFW_KEY_T)) session_.turning = !session_.turning;
  if (pressed(GLFW_KEY_E)) session_.measure_error = !session_.measure_error;
  const auto toggle = [&](Compare mode) { session_.compare = session_.compare == mode ? Compare::none : mode; };
  if (pressed(GLFW_KEY_C)) toggle(Compare::split);
  if (pressed(GLFW_KEY_D)) toggle(Compare::difference);
  if (pressed(GLFW_KEY_L) && session_.loaded()) {
    const bool on = session_.scene.display == FLK_DISPLAY_LAYERS;
    setShown(session_.scene, on ? FLK_DISPLAY_SHADED : FLK_DISPLAY_LAYERS);
  }
  for (uint32_t i = 0; i <= FLK_METHOD_HARD; ++i) {
    if (pressed(GLFW_KEY_1 + static_cast<int>(i))) session_.scene.method = i;
  }
  if (pressed(GLFW_KEY_TAB)) {
    const bool on = session_.settings.show_left || session_.settings.show_right;
    session_.settings.show_left = session_.settings.show_right = !on;
  }
  if (pressed(GLFW_KEY_ESCAPE)) {
    session_.show_help = session_.show_about = false;
    session_.selection = {};
    session_.picked.reset();
  }
}

void Viewer::drawUi() {
  keys();
  menuBar(session_);
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float top = ImGui::GetFrameHeight(), bottom = whole.y - ImGui::GetFrameHeight();
  const float panel = std::min(ImGui::GetFontSize() * 24.0f, whole.x * 0.3f);
  const float left = session_.settings.show_left ? panel : 0.0f, right = session_.settings.show_right ? panel : 0.0f;
  constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoBringToFrontOnFocus;
  const LayerFacts* facts = device_->layers->drawn(kLayerFirst) ? &device_->layers->facts(kLayerFirst) : nullptr;
  const bool graphics = device_->screen->host().queueHasGraphics();
  const auto side = [&](const char* name, float x, auto&& body) {
    ImGui::SetNextWindowPos(ImVec2(x, top));
    ImGui::SetNextWindowSize(ImVec2(panel, std::max(bottom - top, 1.0f)));
    if (ImGui::Begin(name, nullptr, kPanel)) {
      body();
    }
    ImGui::End();
  };
  if (left > 0.0f) {
    side("##left", 0.0f, [&] {
      if (!ImGui::BeginTabBar("##tabs")) {
        return;
      }
      const auto tab = [&](const char* name, bool wanted, auto&& body) {
        const bool open = ImGui::BeginTabItem(name, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0);
        ui::noteItem(name, open);
        if (open) {
          ImGui::BeginChild("##tab");
          body();
          ImGui::EndChild();
          ImGui::EndTabItem();
        }
      };
      const bool picked = std::exchange(session_.show_strand, false);
      tab("Hair", false, [&] { hairPanel(session_); });
      tab("Light", false, [&] { lightPanel(session_); });
      tab("Findings", false, [&] { findingsPanel(session_); });
      tab("Strand", picked, [&] { strandPanel(session_); });
      ImGui::EndTabBar();
    });
  }
  if (right > 0.0f) {
    side("##right", whole.x - panel, [&] {
      methodPanel(session_, graphics);
      comparePanel(session_);
      costPanel(session_, facts);
      planPanel(facts);
      picturePanel(session_);
    });
  }
  viewport_.draw(session_, *device_->layers, {left, top, std::max(whole.x - left - right, 16.0f), std::max(bottom - top, 16.0f)});
  ImGui::SetNextWindowPos(ImVec2(0.0f, bottom));
  ImGui::SetNextWindowSize(ImVec2(whole.x, whole.y - bottom));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(8.0f, 2.0f));
  if (ImGui::Begin("##status", nullptr, kPanel | ImGuiWindowFlags_NoScrollbar)) {
    ImGui::TextUnformatted(session_.status.c_str());
    if (facts) {
      char text[128];
      std::snprintf(text, sizeof text, "%s   %.1f ms%s", methodText(session_.scene).c_str(), facts->statistics.milliseconds_frame,
                    session_.share < 0.999 || session_.few_strands ? "   (quicker while it moves)" : "");
      ImGui::SameLine(std::max(0.0f, whole.x - ImGui::CalcTextSize(text).x - 12.0f));
      ImGui::TextDisabled("%s", text);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
  busyOverlay(session_, left, top, whole.x - left - right, bottom - top);
  takeBrowsed();
  helpWindow(session_);
  alertWindow(session_);
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

// Plans the layers that the window needs anew. False: failed, and said so.
bool Viewer::planPicture(bool& planned) {
  planned = false;
  sounding_ = false;
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
  const bool moving = seconds(now - last_change_) < kStillAfter_s && turntable_views_ == 0;
  const bool adapt = session_.settings.adapt && (full_ms_ > session_.settings.moving_budget_ms || full_ms_ == 0.0);
  const bool cheap = moving && adapt;
  if (key == drawn_key_ && !again_ && (drawn_full_ || cheap)) {
    return true;
  }
  try {
    if (scene.exposure <= 0.0 && session_.shaded()) {
      scene.exposure = device_->layers->chooseExposure(camera);
      applied_.exposure = scene.exposure;
      session_.plain->scene.exposure = scene.exposure;
      key = pictureKey(session_, camera);
      if (!first_picture_) {  // the small picture that told the exposure is shown at once
        const VkImageView small = device_->layers->hairImage(kLayerFirst).view;
        device_->display->bind({small, small, small, small});
        sounding_ = true;
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
    request.few_strands = cheap && cheap_share_ < 0.7 && device_->layers->hasFewStrands();
    session_.few_strands = request.few_strands;
    request.methods[kLayerFirst] = methodOf(scene);
    if (session_.compare != Compare::none && session_.shaded()) {
      request.methods[kLayerSecond] = session_.second;
    }
    if (session_.measure_error && session_.shaded() && !cheap) {
      MethodChoice exact = methodOf(scene);
      exact = MethodChoice{FLK_METHOD_EXACT};
      exact.capture = scene.capture;
      request.methods[kLayerExact] = exact;
    }
    device_->layers->plan(request);
    const VkImageView first = device_->layers->hairImage(kLayerFirst).view;
    const VkImageView second = request.methods[kLayerSecond] ? device_->layers->hairImage(kLayerSecond).view : first;
    const VkImageView opaque = device_->layers->opaqueView();
    device_->display->bind({first, second, opaque ? opaque : first, opaque ? opaque : first});
    drawn_key_ = key;
    drawn_full_ = !cheap;
    measured_ = false;
    planned = true;
  } catch (const AssetError& error) {
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
  measured_ = true;
}

bool Viewer::settled() const {
  return !loader_.busy() && !opening_ && !loader_.studying() && !sounding_ && (!session_.loaded() || (drawn_full_ && !again_)) &&
         !session_.approach_to && turntable_views_ == 0;
}

void Viewer::frame() {
  const auto begin = Clock::now();
  const double dt = seconds(begin - last_frame_);
  last_frame_ = begin;
  if (std::unique_ptr<LoadedStage> loaded = loader_.take()) {
    adopt(std::move(loaded));
  }
  if (std::unique_ptr<LoadedExtras> extras = loader_.takeExtras()) {
    adoptExtras(std::move(extras));
  }
  for (const std::string& path : window_->takeDropped()) {
    openPath(path, ImGui::GetIO().KeyShift);
  }
  session_.busy = loader_.busy() ? "Opening " + loader_.label() : turntable_views_ > 0 && !turntable_path_.empty() ? "Drawing views" : "";
  session_.busy_share = loader_.busy() ? loader_.share()
                                       : static_cast<float>(turntable_at_) / static_cast<float>(std::max(turntable_views_, 1u));
  const float scale = session_.settings.ui_scale > 0.0f ? session_.settings.ui_scale : window_->contentScale();
  if (scale != ui_scale_) {
    ui_scale_ = scale;
    device_->screen->setUiScale(scale);
  }
  device_->screen->setVsync(session_.settings.vsync && options_.script.empty());
  device_->screen->beginUi();
  script_.drive(settled());
  ui::begin(script_.active());
  ImGui::NewFrame();
  drawUi();
  ImGui::Render();
  takeScript();
  takeRequests();
  stepTurntable();
  moveCamera(dt);
  applyEdits();
  bool planned = false;
  planPicture(planned);
  const ViewportRect rect = viewport_.pixels();
  const bool has_picture = device_->layers->drawn(kLayerFirst) || planned;
  const bool drawn = !minimised_ && device_->screen->draw(
      [&](VkCommandBuffer cmd) {
        if (planned) {
          device_->layers->record(cmd);
        }
      },
      [&](VkCommandBuffer cmd) {
        if (!has_picture || rect.width < 1.0f || rect.height < 1.0f) {
          return;
        }
        DisplayPush push{};
        const float values[4] = {rect.x, rect.y, rect.width, rect.height};
        std::copy(values, values + 4, push.rect);
        if (session_.scene.background) {
          const glm::vec3 ground(*session_.scene.background);
          std::copy(&ground[0], &ground[0] + 3, push.ground);
          push.ground[3] = 1.0f;
        }
        push.mode = session_.shaded() ? static_cast<uint32_t>(session_.compare) : 0;
        push.divider = session_.divider;
        push.gain = session_.gain;
        push.has_opaque = device_->layers->opaqueView() && !sounding_ ? 1 : 0;
        push.scale = sounding_ ? static_cast<float>(session_.scene.exposure) : 1.0f;
        device_->display->record(cmd, push);
      });
  if (!drawn && planned) {  // the window cannot be drawn to now: the picture is drawn all the same
    if (!device_->screen->host().submit([&](VkCommandBuffer cmd) { device_->layers->record(cmd); })) {
      throw DeviceLost("drawing: the device was lost");
    }
  }
  if (planned) {
    const double ms = 1e3 * seconds(Clock::now() - begin);
    if (!drawn_full_) {
      moving_ms_.push_back(ms);
    }
    afterPicture(ms);
  }
  if (!first_picture_ && (planned || sounding_)) {
    first_picture_ = true;
    char text[64];
    std::snprintf(text, sizeof text, ", first picture after %.2f s", seconds(Clock::now() - opened_));
    session_.status += text;
  }
  ++frames_;
  if (settled() && session_.loaded()) {
    ++settled_frames_;
  }
}

int Viewer::run() {
  std::vector<std::string> notes;
  if (!options_.forget) {
    session_.settings_path = settingsPath();
    session_.settings = loadSettings(session_.settings_path, notes);
  }
  if (!options_.script.empty()) {
    script_ = ViewScript(options_.script);
  }
  session_.scene = options_.scene;
  if (!options_.second_method.empty()) {
    const std::vector<std::string>& names = methodNames();
    session_.second.method = static_cast<uint32_t>(std::find(names.begin(), names.end(), options_.second_method) - names.begin());
    session_.compare = Compare::split;
  }
  const int width = options_.width > 0 ? options_.width : session_.settings.window_width;
  const int height = options_.height > 0 ? options_.height : session_.settings.window_height;
  if (!options_.scene.assets.empty()) {
    open(options_.scene);  // reads while the window and the device come up
  }
  std::string error;
  try {
    window_ = std::make_unique<ViewWindow>(width, height, "Forelock");
    if (!makeDevice(error)) {
      throw std::runtime_error(error);
    }
  } catch (const std::runtime_error& failure) {
    std::fprintf(stderr, "forelock: view: %s\n", failure.what());
    return kNoDevice;
  }
  for (const std::string& note : notes) {
    session_.alert += (session_.alert.empty() ? "" : "\n") + note;
  }
  session_.say("drag a strand file here, or choose one under File; F1 has the keys");
  while (!quit_) {
    if (window_->wantsToClose()) {
      break;
    }
    const bool busy = script_.active() || session_.turning || session_.approach_to || turntable_views_ > 0 || !settled() || options_.frames > 0 ||
                      frames_ < 3 || viewport_.dragging();
    ViewWindow::poll(window_->hidden() && !script_.active() ? kIdle_s : busy ? 0.0 : kIdle_s);
    try {
      frame();
    } catch (const DeviceLost& lost) {
      try {
        loseDevice(lost.what());
      } catch (const std::runtime_error& failure) {
        std::fprintf(stderr, "forelock: view: %s\n", failure.what());
        exit_code_ = kNoDevice;
        break;
      }
    }
    if (script_.done() || (options_.frames > 0 && settled_frames_ >= options_.frames)) {
      break;
    }
    if (options_.frames > 0 && !session_.alert.empty()) {
      std::fprintf(stderr, "forelock: %s\n", session_.alert.c_str());
      exit_code_ = kFailed;
      break;
    }
  }
  return finish();
}

int Viewer::finish() {
  if (window_ && !options_.forget) {
    int width = 0, height = 0;
    glfwGetWindowSize(window_->handle(), &width, &height);
    if (width > 0 && height > 0) {
      session_.settings.window_width = width;
      session_.settings.window_height = height;
    }
    try {
      saveSettings(session_.settings_path, session_.settings);
    } catch (const AssetError& error) {
      std::fprintf(stderr, "forelock: %s\n", error.what());
    }
  }
  if (device_) {
    const auto& messages = device_->screen->host().validationMessages();
    validation_.insert(validation_.end(), messages.begin(), messages.end());
  }
  loader_.stopStudy();
  device_.reset();
  for (const std::string& message : validation_) {
    std::fprintf(stderr, "forelock: validation: %s\n", message.c_str());
  }
  for (const std::string& failure : script_.failures()) {
    std::fprintf(stderr, "forelock: %s: %s\n", options_.script.c_str(), failure.c_str());
  }
  if (script_.active() && !session_.alert.empty()) {
    std::fprintf(stderr, "forelock: %s: an alert was left open: %s\n", options_.script.c_str(), session_.alert.c_str());
  }
  if (script_.active() || options_.frames > 0) {
    std::sort(moving_ms_.begin(), moving_ms_.end());
    std::printf("frames %u, clicks %u, first picture %s\n", frames_, script_.clicks(), session_.status.c_str());
    if (!moving_ms_.empty()) {
      std::printf("moving: %zu pictures, median %.1f ms, 95 %% within %.1f ms, at %.0f %% of the resolution\n", moving_ms_.size(),
                  moving_ms_[moving_ms_.size() / 2], moving_ms_[moving_ms_.size() * 95 / 100], 100.0 * cheap_share_);
    }
    if (session_.measure_error) {
      std::printf("error: %.4f of 255\n", session_.error);
    }
  }
  const bool failed = !validation_.empty() || !script_.failures().empty() || (script_.active() && !session_.alert.empty());
  return exit_code_ != kDone ? exit_code_ : failed ? kFailed : kDone;
}

}  // namespace

int runViewer(const ViewerOptions& options) { return Viewer(options).run(); }

}  // namespace forelock::samples
