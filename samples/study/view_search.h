// Finds the cameras of a study on the device. SPDX-License-Identifier: MIT
#pragma once

#include "frames.h"
#include "views.h"

#include <functional>
#include <string>
#include <vector>

namespace forelock::study {

// Views by name, in order: stored by the asset, the scene's own, framed and zoomed, or the quick crop. `says` is told what takes
// time; `notes` gets what a person should know. Throws UsageError or std::runtime_error.
std::vector<View> findViews(samples::HeadlessHost& host, DeviceSubject& device, const Subject& subject, const Options& options,
                            const std::function<void(const std::string&)>& says, std::vector<std::string>& notes);

}  // namespace forelock::study
