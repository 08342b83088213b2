// The interactive viewer: `forelock view`. SPDX-License-Identifier: MIT
#pragma once

#include "scene_file.h"

#include <string>

namespace forelock::samples {

struct ViewerOptions {
  Scene scene;                     // without assets: an empty window that says what to do
  std::string second_method;       // shown beside the first; empty: one
  std::string device, script;      // part of a name; a file of steps (docs/viewer.md)
  uint32_t frames = 0;             // 0: until it is closed; else that many pictures, then 0
  int width = 0, height = 0;       // of the window; 0: as it was the last time
  bool validation = false, forget = false;  // forget: neither read nor write settings
};

// Until it is closed; gives the process's exit code.
int runViewer(const ViewerOptions& options);

}  // namespace forelock::samples
