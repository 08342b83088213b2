// What a study measures, in order of importance. SPDX-License-Identifier: MIT
#pragma once

#include "condition.h"
#include "methods.h"
#include "options.h"

#include <string>
#include <vector>

namespace forelock::study {

// One row.
struct Measurement {
  std::string view;
  const Method* method = nullptr;
  std::string capture = "raster", payload = "default";
  uint32_t k = 8, k_sort = 8;  // meaningful where the method has them
  uint32_t core_taps = 25, lights = 1, shadow_size = 1024;
  samples::HairColor color = samples::HairColor::dark;
  bool main = false;  // at k 8 and default settings: gets everything that is measured, and an image

  // What tells rows apart, as it stands in their columns.
  std::string key() const;
};

// What the asset and the device allow.
struct Room {
  std::vector<std::string> views;
  bool raster = true, compute = true;
  uint32_t scene_lights = 0;       // 0: lights are the condition's
  uint32_t default_shadow_size = 1024;
};

// Most important first, none twice. Throws UsageError where nothing is left.
std::vector<Measurement> listMeasurements(const Options& options, const Room& room);

// The view that sweeps are made in.
const std::string& mainView(const std::vector<std::string>& views);

// Fills in method, k and so on of a frame.
void applyMeasurement(const Measurement& measurement, FlkFrame& frame);

}  // namespace forelock::study
