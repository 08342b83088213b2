// TressFX 3 keeps follow strands in a project (.tfxproj) beside its strand files, which alone are only the guides. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <string>
#include <vector>

namespace forelock::samples {

// Adds what a project in the folder of the .tfx file `path` asks for it. No project, or none that names the file: adds nothing.
void noteTfxProject(const std::string& path, std::vector<AssetFinding>& findings);

}  // namespace forelock::samples
