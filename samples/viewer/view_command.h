// `forelock view`. SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace forelock::samples {

void addViewCommand(CLI::App& program, int& exit_code);

}  // namespace forelock::samples
