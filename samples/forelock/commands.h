// The subcommands of `forelock`; each has a source file of its own. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"

#include <CLI/CLI.hpp>

#include <string>

namespace forelock::samples {

// What the process exits with.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,   // the asset or a check
  kUsage = 2,    // wrong usage
  kNoDevice = 3  // no usable device
};

// Thrown by a subcommand whose arguments do not make sense together.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Each adds itself to the program; when chosen it runs as its callback, throws AssetError or UsageError, and leaves
// its outcome in `exit_code`.
void addGroomCommand(CLI::App& program, int& exit_code);
void addInspectCommand(CLI::App& program, int& exit_code);
void addConvertCommand(CLI::App& program, int& exit_code);
void addDiffCommand(CLI::App& program, int& exit_code);
void addPreviewCommand(CLI::App& program, int& exit_code);
void addPlanCommand(CLI::App& program, int& exit_code);
void addReportCommand(CLI::App& program, int& exit_code);

// --points-per-strand N, which goes into OpenOptions.
void addOpenOptions(CLI::App& command, uint32_t& points_per_strand);

// Prints messages of severity warning and error (and info, if asked) to stderr as `forelock: text`.
void printMessages(const std::vector<AssetMessage>& messages, bool with_info);

// "12,345,678" and "1.2 MiB".
std::string groupedDigits(uint64_t number);
std::string readableBytes(uint64_t bytes);

const char* severityName(uint32_t severity);

}  // namespace forelock::samples
