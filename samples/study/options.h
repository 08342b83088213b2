// What a person asks of a study. SPDX-License-Identifier: MIT
#pragma once

#include "condition.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::study {

// Arguments that do not make sense: exit status 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class Amount { quick, standard, full };

struct Options {
  std::string asset, scene, out, device;
  std::vector<std::string> views, methods, captures, payloads;
  std::vector<samples::HairColor> colors;
  std::vector<uint32_t> k, core_taps, shadow_sizes, lights;
  uint32_t k_sort = 0;  // 0: max(8, k)
  uint32_t frames = 0;  // timed, a row; 0: by the device
  Amount amount = Amount::standard;
  bool resume = false, validation = false, images = true, z_up = false;
  double minutes = 0;         // 0: by the amount
  double bandwidth_gb_s = 0;  // 0: measured
  double lane_rate = 0;       // operations a second; 0: measured
  bool views_given = false, captures_given = false, lights_given = false, shadow_sizes_given = false;
  std::string command;        // as it was typed
};

// What the command line says before it is checked: lists are still text.
struct Arguments {
  Options options;
  std::string views, methods, k, captures, core_taps, payloads, shadow_sizes, colors, lights, images = "main", up = "y";
  bool quick = false, full = false;
};

void addOptions(CLI::App& program, Arguments& arguments);

// Splits lists and fills in what was left out. Throws UsageError.
Options checkOptions(const Arguments& arguments);

// "35k" -> 35,000 pixels. False: no such name.
bool pixelsOfView(const std::string& name, double& pixels);

const char* colorName(samples::HairColor color);

}  // namespace forelock::study
