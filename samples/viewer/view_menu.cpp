// The menu bar, help, and what must be read and closed. SPDX-License-Identifier: MIT
#include "asset_source.h"
#include "ui.h"
#include "view_session.h"

#include <array>
#include <filesystem>

namespace forelock::samples {

namespace {

struct Key {
  const char* keys;
  const char* what;
};

constexpr Key kMouse[] = {
    {"left drag", "orbit"},
    {"right or middle drag, shift + left", "pan"},
    {"wheel", "zoom, towards the mouse"},
    {"click", "pick a strand"},
    {"double click", "pick a strand and go there"},
    {"drag the divider", "more of one method or the other"},
    {"drop files", "open; with shift, or a mesh: add to the scene"},
};
constexpr Key kKeys[] = {
    {"Ctrl O", "open a strand file"},
    {"F5", "read the files again"},
    {"Ctrl S, F12", "save the picture"},
    {"Ctrl Shift S", "save the scene"},
    {"Ctrl C", "copy the command line that makes this picture"},
    {"F", "all of the hair in view"},
    {"G", "what is selected in view"},
    {"R", "reset the view"},
    {"1 ... 6", "core_tail, exact, forward, core_only, all_low, hard"},
    {"C", "two methods beside each other"},
    {"D", "difference of two methods"},
    {"E", "measure the error against exact"},
    {"L", "how many layers a pixel has; its number at the mouse"},
    {"T", "auto-rotate"},
    {"Tab", "panels away, and back"},
    {"Esc", "deselect, close"},
    {"F1", "this list"},
    {"Ctrl Q", "quit"},
};

void keyTable(const char* name, const Key* rows, size_t count) {
  if (ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingFixedFit)) {
    for (size_t i = 0; i < count; ++i) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextColored(ImVec4(0.95f, 0.75f, 0.3f, 1.0f), "%s", rows[i].keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(rows[i].what);
    }
    ImGui::EndTable();
  }
}

void fileMenu(ViewSession& session) {
  Requests& ask = session.requests;
  ask.open_file = ui::menuItem("Open...", "Ctrl O") || ask.open_file;
  ask.add_file = ui::menuItem("Add to scene...", "", session.loaded()) || ask.add_file;
  ask.add_mesh = ui::menuItem("Add a mesh...", "", session.loaded()) || ask.add_mesh;
  ask.reload = ui::menuItem("Reload", "F5", session.loaded()) || ask.reload;
  if (ImGui::BeginMenu("Open a groom")) {
    ui::noteItem("Open a groom", true);
    for (const std::string& name : groomNames()) {
      if (ui::menuItem(name.c_str(), "")) {
        ask.open = sceneOf(session, "groom:" + name, false);
      }
    }
    ImGui::EndMenu();
  } else {
    ui::noteItem("Open a groom");
  }
  if (ImGui::BeginMenu("Recent", !session.settings.recent.empty())) {
    ui::noteItem("Recent", true);
    for (const std::string& source : session.settings.recent) {
      if (ui::menuItem(source.c_str(), "")) {
        ask.open = sceneOf(session, source, false);
      }
    }
    ImGui::EndMenu();
  } else {
    ui::noteItem("Recent");
  }
  ImGui::Separator();
  ask.open_scene = ui::menuItem("Open a scene...", "") || ask.open_scene;
  ask.save_scene = ui::menuItem("Save the scene...", "Ctrl Shift S", session.loaded()) || ask.save_scene;
  ImGui::Separator();
  ask.save_picture = ui::menuItem("Save the picture...", "Ctrl S", session.loaded()) || ask.save_picture;
  ask.copy_command = ui::menuItem("Copy command line", "Ctrl C", session.loaded()) || ask.copy_command;
  ImGui::Separator();
  ask.quit = ui::menuItem("Quit", "Ctrl Q") || ask.quit;
}

void viewMenu(ViewSession& session) {
  Requests& ask = session.requests;
  ask.frame_all = ui::menuItem("Frame all", "F", session.loaded()) || ask.frame_all;
  ask.frame_selection = ui::menuItem("Frame selection", "G", !session.selection.strands.empty()) || ask.frame_selection;
  ask.reset_view = ui::menuItem("Reset view", "R", session.loaded()) || ask.reset_view;
  struct Side {
    const char* name;
    double azimuth_deg, elevation_deg;
  };
  constexpr Side kSides[] = {{"From the front", 0, 0}, {"From the hair's left", 90, 0}, {"From behind", 180, 0}, {"From the hair's right", -90, 0},
                             {"From above", 0, 89}};
  for (const Side& side : kSides) {
    if (ui::menuItem(side.name, "", session.loaded())) {
      Orbit there = session.orbit;
      there.azimuth = side.azimuth_deg * (3.14159265358979323846 / 180.0);
      there.elevation = side.elevation_deg * (3.14159265358979323846 / 180.0);
      session.flyTo(there);
    }
  }
  if (session.plain) {
    for (const StagedAsset& asset : session.plain->assets) {
      for (const RecipeCamera& camera : asset.opened->recipe ? asset.opened->recipe->cameras : std::vector<RecipeCamera>()) {
        if (ui::menuItem(("Camera " + camera.name).c_str(), "")) {
          ask.camera = camera.name;
        }
      }
    }
  }
  ImGui::Separator();
  ui::menuCheck("Auto-rotate", "T", session.turning);
  ui::menuCheck("Left panel", "", session.settings.show_left);
  ui::menuCheck("Right panel", "", session.settings.show_right);
  ImGui::Separator();
  ui::menuCheck("Reduced while moving", "", session.settings.adapt);
  ui::menuCheck("V-sync", "", session.settings.vsync);
  for (const float scale : {1.0f, 1.5f, 2.0f}) {
    const std::string label = scale == 1.0f ? "UI scale 100 %" : scale == 1.5f ? "UI scale 150 %" : "UI scale 200 %";
    if (ui::menuItem(label.c_str(), "")) {
      ask.ui_scale = scale;
    }
  }
  if (ui::menuItem("UI scale of the screen", "")) {
    ask.ui_scale = 0.0f;
  }
}

}  // namespace

void menuBar(ViewSession& session) {
  if (!ImGui::BeginMainMenuBar()) {
    return;
  }
  const auto menu = [&](const char* name, auto&& body) {
    const bool open = ImGui::BeginMenu(name);
    ui::noteItem(name, open, true);
    if (open) {
      {
        const ui::Scope scope(name);
        body();
      }
      ImGui::EndMenu();
    }
  };
  menu("File", [&] { fileMenu(session); });
  menu("View", [&] { viewMenu(session); });
  menu("Help", [&] {
    session.show_help = ui::menuItem("Mouse and keys", "F1") || session.show_help;
    session.show_about = ui::menuItem("About", "") || session.show_about;
  });
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(session.device.c_str()).x - 12.0f);
  ImGui::TextDisabled("%s", session.device.c_str());
  ImGui::EndMainMenuBar();
}

void helpWindow(ViewSession& session) {
  if (session.show_help) {
    const ImVec2 middle = ImGui::GetMainViewport()->GetCenter();
    ImGui::SetNextWindowPos(middle, ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
    if (ImGui::Begin("Mouse and keys", &session.show_help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
      keyTable("mouse", kMouse, std::size(kMouse));
      ImGui::Separator();
      keyTable("keys", kKeys, std::size(kKeys));
      ImGui::Separator();
      ui::faintText("Hold the mouse over anything in a panel: it says what it does. More: docs/viewer.md");
      const ui::Scope scope("Mouse and keys");
      session.show_help = !ui::button("Close", "") && session.show_help;
    }
    ImGui::End();
  }
  if (session.show_about) {
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
    if (ImGui::Begin("About", &session.show_about, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse)) {
      const uint32_t version = flkGetVersion();
      ImGui::Text("Forelock %u.%u.%u, MIT licence", version >> 22, (version >> 12) & 0x3ff, version & 0xfff);
      ImGui::TextUnformatted(session.device.c_str());
      ImGui::Text("Settings: %s", session.settings_path.empty() ? "not kept, there is no home folder" : session.settings_path.c_str());
      const ui::Scope scope("About");
      session.show_about = !ui::button("Close", "") && session.show_about;
    }
    ImGui::End();
  }
}

void alertWindow(ViewSession& session) {
  if (!session.alert.empty() && !ImGui::IsPopupOpen("Forelock##alert")) {
    ImGui::OpenPopup("Forelock##alert");
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(ImGui::GetFontSize() * 34.0f, 0.0f));
  if (ImGui::BeginPopupModal("Forelock##alert", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    ui::text(session.alert);
    ImGui::Spacing();
    {
      const ui::Scope scope("Alert");
      if (ui::button("Close", "") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)) ||
          (!ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false))) {
        session.alert.clear();
        ImGui::CloseCurrentPopup();
      }
    }
    ImGui::EndPopup();
  }
}

void busyOverlay(ViewSession& session, float x, float y, float width, float height) {
  if (session.busy.empty()) {
    return;
  }
  ImGui::SetNextWindowPos(ImVec2(x + 0.5f * width, y + 0.5f * height), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(std::min(width * 0.8f, ImGui::GetFontSize() * 28.0f), 0.0f));
  ImGui::Begin("##busy", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_AlwaysAutoResize);
  ui::text(session.busy);
  if (session.busy_share >= 0.0f) {
    ImGui::ProgressBar(session.busy_share);
  } else {  // something moves, so that it is seen to go on
    const double t = std::fmod(ImGui::GetTime(), 1.5) / 1.5;
    ImGui::ProgressBar(static_cast<float>(t), ImVec2(-1.0f, 0.0f), "");
  }
  if (session.busy_with_turntable && ui::button("Cancel", "What is written already stays")) {
    session.requests.cancel_turntable = true;
  }
  ImGui::End();
}

}  // namespace forelock::samples
