// SPDX-License-Identifier: MIT
#include "viewer_app.h"

#include "command_line.h"
#include "ui.h"
#include "view_measure.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstdio>

namespace forelock::samples {

void Viewer::keys() {
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [&](int key) { return ImGui::IsKeyPressed(key, false); };
  if (pressed(GLFW_KEY_F1)) session_.show_help = !session_.show_help;
  if (pressed(GLFW_KEY_F5)) session_.requests.reload = true;
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
    if (pressed(GLFW_KEY_1 + static_cast<int>(i))) {
      session_.scene.method = i;
      session_.say("method " + methodNames()[i]);
    }
  }
  if (pressed(GLFW_KEY_TAB)) session_.hide_panels = !session_.hide_panels;
  if (pressed(GLFW_KEY_ESCAPE)) {
    session_.requests.cancel_turntable = true;
    session_.show_help = session_.show_about = false;
    session_.selection = {};
    session_.picked.reset();
  }
}

std::vector<glm::vec3> Viewer::selectedPoints() const {
  const Selection& selection = session_.selection;
  if (!session_.plain || selection.strands.empty() || selection.asset >= session_.plain->assets.size()) {
    return {};
  }
  const StagedAsset& asset = session_.plain->assets[selection.asset];
  FlkStrands strands = {};
  flkAssetGetStrands(asset.opened->asset.get(), &strands);
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
  if (ask.arrange) open(*ask.arrange, openFiles(), true);
  if (ask.reload && session_.loaded()) open(session_.currentScene(), {}, true);
  if (ask.open_file) browse(Browse::open);
  if (ask.add_file) browse(Browse::add);
  if (ask.add_mesh) browse(Browse::mesh);
  if (ask.open_scene) browse(Browse::scene);
  if (ask.save_scene && session_.loaded()) browse(Browse::save_scene);
  if (ask.save_picture && session_.loaded()) browse(Browse::save_picture);
  if (ask.turntable > 0 && session_.loaded()) {
    turntable_views_ = turntable_wanted_ = ask.turntable;
    turntable_at_ = turntable_saved_ = 0;
    turntable_path_.clear();
    browse(Browse::save_turntable);
  }
  if (ask.cancel_turntable && turntable_views_ > 0) {
    turntable_views_ = turntable_at_;  // the view that is under way is the last
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
        for (const RecipeCamera& camera : asset.opened->recipe ? asset.opened->recipe->cameras : std::vector<RecipeCamera>()) {
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

void Viewer::drawUi() {
  keys();
  menuBar(session_);
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float top = ImGui::GetFrameHeight(), bottom = whole.y - ImGui::GetFrameHeight();
  const float panel = std::min(ImGui::GetFontSize() * 24.0f, whole.x * 0.3f);
  const bool shown = !session_.hide_panels;
  const float left = shown && session_.settings.show_left ? panel : 0.0f, right = shown && session_.settings.show_right ? panel : 0.0f;
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
    ImGui::TextUnformatted(session_.hide_panels ? "Tab brings the panels back" : session_.status.c_str());
    if (facts) {
      char text[128];
      std::snprintf(text, sizeof text, "%s   %.1f ms%s", methodText(session_.scene).c_str(), facts->statistics.milliseconds_frame,
                    session_.reduced ? "   (reduced)" : "");
      const float at = whole.x - ImGui::CalcTextSize(text).x - 12.0f;
      if (at > ImGui::GetItemRectMax().x + ImGui::GetFontSize()) {
        ImGui::SameLine(at);
        ImGui::TextDisabled("%s", text);
      }
    }
  }
  ImGui::End();
  ImGui::PopStyleVar();
  busyOverlay(session_, left, top, whole.x - left - right, bottom - top);
  takeBrowsed();
  helpWindow(session_);
  alertWindow(session_);
}

}  // namespace forelock::samples
