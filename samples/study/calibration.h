// What the device can do at best, for limit_us: bytes and multiply-adds a second. SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"

namespace forelock::study {

struct Calibration {
  double bytes_per_s = 0;       // of a copy between two large buffers, read and written bytes together
  double operations_per_s = 0;  // fused multiply-adds of single lanes, in independent chains
  bool measured = true;         // both; else given by hand
};

// Best of several, by the wall clock; about a second on a processor. Throws std::runtime_error.
Calibration calibrate(samples::HeadlessHost& host);

}  // namespace forelock::study
