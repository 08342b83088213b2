// Measures row by row. SPDX-License-Identifier: MIT
#pragma once

#include "options.h"

namespace forelock::study {

// Exit status: 0, 1 where the validation layers spoke, 3 without a device. Throws UsageError (2) and other exceptions (1).
int runStudy(const Options& options);

}  // namespace forelock::study
