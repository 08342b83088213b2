// Runs gnuplot on a script. SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace forelock::samples {

enum class GnuplotResult { done, not_found, failed };

// In `folder`, without the user's settings. `complaint` gets what it said when it failed.
GnuplotResult runGnuplot(const std::string& folder, const std::string& script, std::string& complaint);

}  // namespace forelock::samples
