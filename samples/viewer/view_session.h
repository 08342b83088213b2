// What the viewer shows and what the person has chosen; knows neither window nor device. SPDX-License-Identifier: MIT
#pragma once

#include "display_pass.h"
#include "finding_strands.h"
#include "orbit.h"
#include "settings.h"
#include "stage.h"
#include "strand_pick.h"
#include "time_history.h"
#include "view_layers.h"
#include "view_method.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace forelock::samples {

using Clock = std::chrono::steady_clock;

struct Selection {
  size_t asset = 0;
  std::vector<uint32_t> strands;  // empty: nothing is selected
  std::string label;
};

// What panels ask for; carried out between frames.
struct Requests {
  std::optional<Scene> open;              // a scene to load
  std::optional<Scene> arrange;           // one of files that are open already
  bool reload = false;                    // all files, as they are on the disk now
  bool add_file = false, open_file = false, open_scene = false, add_mesh = false;  // dialogues
  bool save_scene = false, save_picture = false;
  bool copy_command = false, frame_all = false, frame_selection = false;
  bool reset_view = false, quit = false;
  std::optional<std::string> camera;      // of the groom
  std::optional<float> ui_scale;
  uint32_t turntable = 0;                 // views to write
  bool cancel_turntable = false;
};

struct ViewSession {
  ViewSettings settings;
  std::string settings_path;

  Scene scene;                            // what is edited; the stage has a copy
  std::unique_ptr<Stage> plain, colored;  // of it; none: nothing is loaded yet
  Stage* stage() { return colored ? colored.get() : plain.get(); }
  std::vector<std::vector<FindingStrands>> findings;  // of each asset of `plain`; empty: not yet looked for
  std::vector<StrandFaults> faults;                   // likewise

  Orbit orbit;
  std::optional<Orbit> approach_from, approach_to;
  Clock::time_point approach_start;
  Bounds bounds;
  bool turning = false;                   // turntable in the window
  double turn_speed = 30.0;               // (degree/s)
  uint32_t turntable_choice = 1;          // of the numbers of views that can be saved

  Compare compare = Compare::none;
  MethodChoice second{FLK_METHOD_EXACT};
  float divider = 0.5f, gain = 8.0f;
  bool measure_error = false;
  double error = std::numeric_limits<double>::quiet_NaN();        // RMSE of the first against exact, 0..255
  double error_second = std::numeric_limits<double>::quiet_NaN();
  bool count_work = false;

  Selection selection;
  std::optional<StrandHit> picked;        // of selection.asset
  TimeHistory times;
  double frame_ms = 0.0;                  // of the last picture, from planning until it was there
  double share = 1.0;                     // of the window's resolution that was drawn
  bool auto_exposure = false;             // the exposure is chosen again when lights or materials change
  bool compiling = false;                 // pipelines: nothing may be asked of the layers
  bool reduced = false;                   // what is shown is not the full picture
  bool hide_panels = false;               // with a key; not remembered, so that nobody starts without them
  bool used_mouse = false;                // in the picture: the hint may go

  std::string busy;                       // what is under way, for a progress bar
  float busy_share = -1.0f;
  bool busy_with_turntable = false;       // which can be cancelled
  std::string alert;                      // to be read and closed
  std::string status;                     // a line at the bottom
  std::vector<std::string> notes;         // of the stage
  std::string device;
  Requests requests;
  bool show_help = false, show_about = false;
  bool show_strand = false;  // its panel to the front

  // A file dialogue.
  enum class Browse { none, open, add, mesh, scene, save_scene, save_picture, save_turntable } browse = Browse::none;

  bool loaded() const { return plain != nullptr; }
  bool shaded() const { return scene.display == FLK_DISPLAY_SHADED && scene.coloring == StrandColoring::none; }
  void say(const std::string& text) { status = text; }
  // The view goes there in a quarter of a second.
  void flyTo(const Orbit& orbit_there);
  // With the camera of the window in it.
  Scene currentScene() const;
};

// Scene of one asset with what the person has set of lights, method and camera axes.
Scene sceneOf(const ViewSession& session, const std::string& source, bool add);

void menuBar(ViewSession& session);
void hairPanel(ViewSession& session);      // assets, material
void lightPanel(ViewSession& session);
void methodPanel(ViewSession& session, bool graphics);
void comparePanel(ViewSession& session);
void costPanel(ViewSession& session, const LayerFacts* facts);
void planPanel(const LayerFacts* facts);
void findingsPanel(ViewSession& session);
void strandPanel(ViewSession& session);
void picturePanel(ViewSession& session);
void helpWindow(ViewSession& session);
void alertWindow(ViewSession& session);
void busyOverlay(ViewSession& session, float x, float y, float width, float height);

}  // namespace forelock::samples
