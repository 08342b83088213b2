// What a study left in its folder: the rows of study.csv and device.json. docs/report.md. SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace forelock::samples {

// The file and what is wrong with it, in one line.
struct StudyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A measurement. Of numbers, kUnknown is what the study did not say: nothing here is infinite or, where that would make no
// sense, negative.
struct StudyRow {
  std::string asset, view, method, store, capture, payload, hair_colour, reference_hash, scene_hash, commit, device, driver, status;
  double width = kUnknown, height = kUnknown, hair_pixels = kUnknown, fragments = kUnknown, mean_overdraw = kUnknown,
         max_overdraw = kUnknown, segments = kUnknown, k = kUnknown, k_sort = kUnknown, tau = kUnknown, core_taps = kUnknown,
         tail_taps = kUnknown, lights = kUnknown, shadow_size = kUnknown, frames = kUnknown, ms_total = kUnknown,
         ms_p5 = kUnknown, ms_p95 = kUnknown, ms_prepare = kUnknown, ms_shadow = kUnknown, ms_shade = kUnknown,
         ms_capture = kUnknown, ms_resolve = kUnknown, cpu_per_wall = kUnknown, full_shades = kUnknown,
         shadow_taps = kUnknown, bytes_persistent = kUnknown, bytes_transient = kUnknown, limit_us = kUnknown,
         overflow_fragments = kUnknown, rmse_forward = kUnknown, rmse_exact = kUnknown, rmse_exact_channel = kUnknown,
         rmse_cover = kUnknown, p999_exact = kUnknown, perceptual = kUnknown, radiance_ratio = kUnknown,
         temporal_drift = kUnknown, order_noise = kUnknown, deterministic = kUnknown, frame_noise = kUnknown,
         pair_ratio = kUnknown, pair_spread = kUnknown;
  size_t line = 0;  // of study.csv, counted from 1
};

// Where a column goes; one of both members is set.
struct StudyColumn {
  const char* name;
  std::string StudyRow::*text;
  double StudyRow::*number;
  bool required;  // a table without it is refused
};

const std::vector<StudyColumn>& studyColumns();
const StudyColumn* findStudyColumn(std::string_view name);

// Empty where the row does not say: a number as short as it can be written.
std::string cellText(const StudyRow& row, const StudyColumn& column);

struct StudyView {
  std::string name;
  double width = kUnknown, height = kUnknown, fragments = kUnknown, hair_pixels = kUnknown, mean_overdraw = kUnknown,
         max_overdraw = kUnknown;
};

struct StudyDevice {
  std::string device, driver, type, calibration, commit, date, asset, command;
  double bandwidth_gb_s = kUnknown, lane_operations_per_s = kUnknown;
  std::vector<StudyView> views;
};

struct StudyTable {
  std::vector<StudyRow> rows;
  StudyDevice device;
  std::vector<std::string> warnings;  // a sentence each; what was wrong and what was done about it
};

// One record a line but for quoted line ends (RFC 4180). A quote inside an unquoted field is a character like any other.
struct CsvRecord {
  std::vector<std::string> fields;
  size_t line = 0;      // where it begins, counted from 1
  bool whole = true;    // false: the text ends inside of it, without an end of line
};
std::vector<CsvRecord> parseCsv(std::string_view text);

// `name` is what messages call the text. Throws StudyError without a header, without a required column or without any row.
StudyTable parseStudy(std::string_view csv, const std::string& name);

// Values of another kind than expected are ignored, text that is no JSON is a warning.
void parseStudyDevice(std::string_view json, const std::string& name, StudyTable& table);

// Reads FOLDER/study.csv and, where it is, FOLDER/device.json. Throws StudyError.
StudyTable readStudy(const std::string& folder);

}  // namespace forelock::samples
