// DIR/device.json and DIR/scene-VIEW.json: on what and of what the numbers are. SPDX-License-Identifier: MIT
#pragma once

#include "calibration.h"
#include "lighting.h"
#include "views.h"

#include <string>
#include <vector>

namespace forelock::study {

struct DeviceFacts {
  std::string device, driver, type, commit, asset, command;
  Calibration calibration;
};

// What an earlier run of the same device measured, so that one study has one limit. False: nothing usable is there.
bool readCalibration(const std::string& path, const std::string& device, Calibration& calibration);

// Views that an earlier run has written and this one does not have are kept. Throws std::runtime_error.
void writeDeviceFile(const std::string& path, const DeviceFacts& facts, const std::vector<View>& views);

// What `forelock preview --scene` draws of the view in that light. Throws std::runtime_error.
void writeSceneFile(const std::string& path, const Subject& subject, const View& view, samples::HairColor color, double exposure);

// A word for JSON and people.
const char* deviceKind(VkPhysicalDeviceType type);

}  // namespace forelock::study
