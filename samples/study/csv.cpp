// SPDX-License-Identifier: MIT
#include "csv.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>

namespace forelock::study {
namespace {

constexpr const char* kColumns[] = {
    "asset", "view", "width", "height", "hair_pixels", "fragments", "mean_overdraw", "max_overdraw", "segments", "method",
    "store", "capture", "k", "k_sort", "tau", "core_taps", "tail_taps", "payload", "lights", "hair_colour", "shadow_size",
    "frames", "ms_total", "ms_p5", "ms_p95", "ms_prepare", "ms_shadow", "ms_shade", "ms_capture", "ms_resolve",
    "cpu_per_wall", "full_shades", "shadow_taps", "bytes_persistent", "bytes_transient", "limit_us", "overflow_fragments",
    "rmse_forward", "rmse_exact", "rmse_exact_channel", "rmse_cover", "p999_exact", "perceptual", "radiance_ratio",
    "temporal_drift", "order_noise", "deterministic", "reference_hash", "scene_hash", "commit", "device", "driver", "status",
    "frame_noise", "pair_ratio", "pair_spread", "ms_dense"};

std::string headerLine() { return csvLine({std::begin(kColumns), std::end(kColumns)}); }

}  // namespace

std::span<const char* const> columns() { return kColumns; }

void Row::set(const std::string& column, const std::string& text) {
  if (std::find(std::begin(kColumns), std::end(kColumns), column) == std::end(kColumns))
    throw std::logic_error("study.csv has no column " + column);
  fields_[column] = text;
}

void Row::set(const std::string& column, double value) {
  char text[40] = "";
  if (std::isfinite(value)) std::snprintf(text, sizeof text, "%.6g", value);
  set(column, std::string(text));
}

const std::string& Row::operator[](const std::string& column) const {
  static const std::string empty;
  const auto found = fields_.find(column);
  return found == fields_.end() ? empty : found->second;
}

std::string csvLine(const std::vector<std::string>& fields) {
  std::string line;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i) line += ',';
    if (fields[i].find_first_of(",\"\r\n") == std::string::npos) {
      line += fields[i];
      continue;
    }
    line += '"';
    for (const char c : fields[i]) {
      // A row stays one line, so that a torn one can be told.
      line += c == '\n' || c == '\r' ? ' ' : c;
      if (c == '"') line += c;
    }
    line += '"';
  }
  return line;
}

bool parseCsvLine(const std::string& line, std::vector<std::string>& fields) {
  fields.assign(1, "");
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted) {
      if (c != '"') fields.back() += c;
      else if (i + 1 < line.size() && line[i + 1] == '"') fields.back() += line[++i];
      else if (i + 1 < line.size() && line[i + 1] != ',') return false;
      else quoted = false;
    } else if (c == ',') {
      fields.emplace_back();
    } else if (c == '"') {
      if (!fields.back().empty()) return false;
      quoted = true;
    } else {
      fields.back() += c;
    }
  }
  return !quoted;
}

StudyFile::StudyFile(const std::string& path) : path_(path) {
  std::string text;
  {
    std::ifstream file(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  const std::size_t whole = text.find_last_of('\n') == std::string::npos ? 0 : text.find_last_of('\n') + 1;
  std::size_t kept = 0;
  for (std::size_t begin = 0, number = 0; begin < whole; ++number) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (number == 0) {
      if (line != headerLine())
        throw StudyFileError(path + ": begins with other columns than this version writes, choose another folder");
      kept = begin;
      continue;
    }
    std::vector<std::string> fields;
    if (!parseCsvLine(line, fields) || fields.size() != std::size(kColumns))
      throw StudyFileError(path + ": line " + std::to_string(number + 1) + " is no row of a study, mend it or choose another folder");
    Row row;
    for (std::size_t i = 0; i < fields.size(); ++i) row.set(kColumns[i], fields[i]);
    rows_.push_back(row);
    kept = begin;
  }
  // Not a study's beginning: nothing of somebody else's is cut off.
  if (kept == 0 && !text.empty() && !headerLine().starts_with(text))
    throw StudyFileError(path + ": is no study, choose another folder");
  if (kept < text.size()) {
    std::error_code error;
    std::filesystem::resize_file(path, kept, error);
    if (error) throw StudyFileError(path + ": its torn last line cannot be cut off, " + error.message());
  }
  file_.open(path, std::ios::binary | std::ios::app);
  if (kept == 0) file_ << headerLine() << '\n' << std::flush;
  if (!file_) throw StudyFileError(path + ": cannot be written, check the folder's permissions and room");
}

void StudyFile::append(const Row& row) {
  std::vector<std::string> fields;
  for (const char* column : kColumns) fields.push_back(row[column]);
  file_ << csvLine(fields) + "\n" << std::flush;
  if (!file_) throw StudyFileError(path_ + ": cannot be written, check the room on the disk");
  rows_.push_back(row);
}

}  // namespace forelock::study
