// The viewer itself, in parts: viewer.cpp the loop and the device, viewer_input.cpp what a person does, viewer_files.cpp what is opened and
// saved, viewer_picture.cpp what is drawn. SPDX-License-Identifier: MIT
#pragma once

#include "commands.h"
#include "display_pass.h"
#include "file_browser.h"
#include "view_layers.h"
#include "view_loader.h"
#include "view_script.h"
#include "view_session.h"
#include "view_window.h"
#include "viewer.h"
#include "viewport.h"

#include <future>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace forelock::samples {

inline double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

class Viewer {
public:
  explicit Viewer(const ViewerOptions& options) : options_(options), loader_(ViewWindow::wake) {}
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
  void open(const Scene& scene, const OpenFiles& files = {}, bool arranging = false);
  OpenFiles openFiles() const;
  void addMesh(const std::string& path);
  void openPath(const std::string& path, bool add);
  void takeDropped();
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
  bool compiled(const LayerRequest& request);
  bool compiling() const;
  bool takeCompiled();
  bool drawFull();
  void afterPicture(double ms);
  bool savePictureTo(const std::string& path);
  void saveSceneTo(const std::string& path);
  void stepTurntable();
  std::vector<glm::vec3> selectedPoints() const;
  void frameSelection();
  void browse(ViewSession::Browse what);
  void measure();
  bool settled() const;
  void tellProgress(bool compiles);
  void frame();
  int finish();

  ViewerOptions options_;
  ViewSession session_;
  std::unique_ptr<ViewWindow> window_;
  std::unique_ptr<Device> device_;
  ViewLoader loader_;
  std::unique_ptr<LoadedStage> ready_;  // to be taken over by the next frame
  ViewScript script_;
  FileBrowser browser_;
  Viewport viewport_;

  std::future<void> compiling_;  // of pipelines; while it runs the device's layers are left alone
  std::set<std::string> compiled_keys_;  // of pictures whose pipelines are there
  std::string compiling_key_;

  Scene applied_;              // that the stage has
  Orbit home_;
  std::string drawn_key_;      // of the last picture
  bool drawn_full_ = false, again_ = false;
  Clock::time_point last_change_ = Clock::now(), last_frame_ = Clock::now(), opened_ = Clock::now(), lost_{};
  double cheap_share_ = 0.35, full_ms_ = 0.0;
  bool only_full_ = false;     // no reduced pictures are planned
  bool sounding_ = false;      // what is shown is the small picture that told the exposure
  std::string opened_text_;
  double held_ms_ = 0.0;       // longest time between two frames from opening until the first picture
  bool picture_is_new_ = false;  // its numbers are not on the screen yet
  bool arranging_ = false;  // what is opened is what was open: the view stays
  bool opening_ = false, first_picture_ = false, minimised_ = false;
  uint32_t frames_ = 0, settled_frames_ = 0;
  std::vector<double> moving_ms_;   // from the input to the picture, while something moved
  std::string turntable_path_;
  uint32_t turntable_at_ = 0, turntable_views_ = 0, turntable_wanted_ = 0, turntable_saved_ = 0;
  Orbit turntable_from_;
  std::vector<std::string> validation_;
  float ui_scale_ = 0.0f;
  int exit_code_ = kDone;
  bool quit_ = false;
};

}  // namespace forelock::samples
