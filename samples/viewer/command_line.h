// What is seen in the window as a command that draws it. SPDX-License-Identifier: MIT
#pragma once

#include "scene_file.h"

#include <string>

namespace forelock::samples {

// As a POSIX shell reads it back as one word.
std::string shellQuoted(const std::string& text);

// Of all its files: it means the same in any folder.
Scene withAbsolutePaths(const Scene& scene);

// `forelock preview --scene '{...}' -o OUT`, from any folder. A camera that is placed counts before one that is named. Shells hand on
// up to 128 KiB in one word (Linux), some 400 lights: longer scenes need a file. Throws SceneError where a name is not UTF-8.
std::string commandLine(const Scene& scene, const std::string& out);

}  // namespace forelock::samples
