// The least time a frame could take on a device: docs/methods.md names what a plan must move. SPDX-License-Identifier: MIT
#pragma once

#include "calibration.h"

#include <forelock/render.h>

#include <cstdint>

namespace forelock::study {

struct Work {
  uint64_t fragments = 0, hair_pixels = 0;
};

// Bytes that a frame of that plan cannot do without: hair once for each pass that reads it, what lives within the frame written
// once and read once (nodes: as many as there are fragments), and the colour of hair's pixels read and written.
uint64_t compulsoryBytes(FlkPlan plan, const Work& work);

// max(bytes / bandwidth, 24 operations a fragment / rate) + 3 us a pass (us).
double limitMicroseconds(FlkPlan plan, const Work& work, const Calibration& device);

}  // namespace forelock::study
