// The panel of pictures and files to take away. SPDX-License-Identifier: MIT
#include "ui.h"
#include "view_session.h"

namespace forelock::samples {

void picturePanel(ViewSession& session) {
  const ui::Section section("Picture", true, "Pictures and files to take away");
  if (!section) {
    return;
  }
  Requests& ask = session.requests;
  ui::faintText(std::to_string(session.scene.width) + " x " + std::to_string(session.scene.height) + " pixels, as large as in the window" +
                (session.scene.background ? "" : ", transparent background"));
  if (ui::button("Save picture...", "As it is seen, without panels: .png or .exr (Ctrl S)", session.loaded())) {
    ask.save_picture = true;
  }
  if (ui::button("Copy command line", "A `forelock preview` command that makes the same picture, into the clipboard (Ctrl C)", session.loaded())) {
    ask.copy_command = true;
  }
  if (ui::button("Save scene...", "Assets, materials, lights, camera and method in a file that preview, plan and view read", session.loaded())) {
    ask.save_scene = true;
  }
  ImGui::SameLine();
  if (ui::button("Open scene...", "Such a file")) {
    ask.open_scene = true;
  }
  ui::checkbox("Auto-rotate", session.turning, "Around the hair, in the window (T)");
  if (session.turning) {
    ui::slide("Speed (deg/s)", session.turn_speed, -180.0, 180.0, "How fast", "%.0f");
  }
  static const std::vector<uint32_t> kViews{8, 12, 24, 36, 72};
  static const std::vector<std::string> kNames{"8 views", "12 views", "24 views", "36 views", "72 views"};
  ui::choose("Turntable", session.turntable_choice, kNames, "Pictures evenly around what is looked at");
  ImGui::SameLine();
  if (ui::button("Save views...", "A picture for each view: NAME-000.png and on", session.loaded())) {
    ask.turntable = kViews[session.turntable_choice];
  }
}

}  // namespace forelock::samples
