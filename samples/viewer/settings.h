// What `forelock view` remembers from one time to the next. SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace forelock::samples {

struct ViewSettings {
  std::vector<std::string> recent;  // newest first, at most kMostRecent; absolute paths or groom:NAME
  int window_width = 1280, window_height = 800;  // (screen coordinates) [160, 16384]
  bool show_left = true, show_right = true;      // panels
  float ui_scale = 0.0f;           // [0.25, 8]; 0: the screen's
  bool vsync = true;
  double moving_budget_ms = 50.0;  // [1, 1000] of a frame while something moves
  bool adapt = true;               // the resolution follows the budget
  std::string last_folder;         // of the file dialogue; empty: none
  std::string last_scene;          // that was open at the end, as JSON; empty: none
  std::string unknown;             // JSON of keys that are not known here, written back as they were; empty: none
  bool leave_file = false;         // the file is of a newer forelock, or could not be read or kept: it is not written over
};

inline constexpr size_t kMostRecent = 12;

// $XDG_CONFIG_HOME/forelock/view.json, else ~/.config/forelock/view.json; empty where there is no home: nothing is remembered.
std::string settingsPath();

// A missing file is the default, and so is a key that has a value which it cannot have. What is wrong goes into `notes`, a sentence
// each, and a damaged file is kept as FILE.damaged (FILE.damaged-2 and on where there is one). Throws nothing.
ViewSettings loadSettings(const std::string& path, std::vector<std::string>& notes);

// Makes the folder, writes a file beside it and renames it. Nothing where the path is empty or the file is to be left.
// Throws AssetError, which says what the system refused.
void saveSettings(const std::string& path, const ViewSettings& settings);

// Puts an asset first among the recent ones.
void noteRecent(ViewSettings& settings, const std::string& source);

}  // namespace forelock::samples
