// SPDX-License-Identifier: MIT
#include "study_table.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

namespace forelock::samples {

namespace {

// A study has hundreds of rows. What is larger than this is no study.
constexpr size_t kMaxFileBytes = size_t{256} << 20;
constexpr size_t kMaxFieldBytes = 2000;
constexpr size_t kMaxRows = 50000;
constexpr size_t kMaxValueWarnings = 12;
constexpr double kMaxNumber = 1e18;

std::string readWhole(const std::filesystem::path& path) {
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) {
    throw StudyError(path.string() + ": cannot be read");
  }
  if (size > kMaxFileBytes) {
    throw StudyError(path.string() + ": is larger than 256 MiB, which no study is");
  }
  std::string text(size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<size_t>(file.gcount()));
  return text;
}

std::string shortened(const std::string& text) { return text.size() > 40 ? text.substr(0, 40) + "..." : text; }

// Control characters would break the lines of messages and the columns of data files.
std::string plainText(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return text;
}

enum class Verdict { good, unknown, no_number, not_finite, negative };

Verdict parseNumber(std::string_view text, double& value) {
  value = kUnknown;
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.empty()) return Verdict::unknown;
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) return Verdict::not_finite;
  if (error != std::errc() || end != text.data() + text.size()) return Verdict::no_number;
  if (!std::isfinite(number) || std::fabs(number) > kMaxNumber) return Verdict::not_finite;
  if (number < 0.0) return Verdict::negative;  // no column counts below 0
  value = number;
  return Verdict::good;
}

class Warnings {
 public:
  explicit Warnings(StudyTable& table) : table_(table) {}
  void add(const std::string& text) {
    if (++count_ <= kMaxValueWarnings) table_.warnings.push_back(text);
  }
  ~Warnings() {
    if (count_ > kMaxValueWarnings) {
      table_.warnings.push_back("and " + std::to_string(count_ - kMaxValueWarnings) + " more values like these");
    }
  }

 private:
  StudyTable& table_;
  size_t count_ = 0;
};

std::string verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_finite: return "is not finite";
    case Verdict::negative: return "is negative";
    default: return "is no number";
  }
}

std::string jsonText(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || found->is_null()) return {};
  std::string text = found->is_string() ? found->get<std::string>()
                                        : found->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > kMaxFieldBytes) text.resize(kMaxFieldBytes);
  return plainText(text);
}

double jsonNumber(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_number()) return kUnknown;
  const double number = found->get<double>();
  return std::isfinite(number) && number >= 0.0 && number <= kMaxNumber ? number : kUnknown;
}

}  // namespace

const std::vector<StudyColumn>& studyColumns() {
#define TEXT(name) {#name, &StudyRow::name, nullptr, true}
#define NUMBER(name) {#name, nullptr, &StudyRow::name, true}
#define LATER(name) {#name, nullptr, &StudyRow::name, false}  // not in the tables of the first studies
  static const std::vector<StudyColumn> columns = {
      TEXT(asset), TEXT(view), NUMBER(width), NUMBER(height), NUMBER(hair_pixels), NUMBER(fragments), NUMBER(mean_overdraw),
      NUMBER(max_overdraw), NUMBER(segments), TEXT(method), TEXT(store), TEXT(capture), NUMBER(k), NUMBER(k_sort), NUMBER(tau),
      NUMBER(core_taps), NUMBER(tail_taps), TEXT(payload), NUMBER(lights), TEXT(hair_colour), NUMBER(shadow_size),
      NUMBER(frames), NUMBER(ms_total), NUMBER(ms_p5), NUMBER(ms_p95), NUMBER(ms_prepare), NUMBER(ms_shadow), NUMBER(ms_shade),
      NUMBER(ms_capture), NUMBER(ms_resolve), NUMBER(cpu_per_wall), NUMBER(full_shades), NUMBER(shadow_taps),
      NUMBER(bytes_persistent), NUMBER(bytes_transient), NUMBER(limit_us), NUMBER(overflow_fragments), NUMBER(rmse_forward),
      NUMBER(rmse_exact), NUMBER(rmse_exact_channel), NUMBER(rmse_cover), NUMBER(p999_exact), NUMBER(perceptual),
      NUMBER(radiance_ratio), NUMBER(temporal_drift), NUMBER(order_noise), NUMBER(deterministic), TEXT(reference_hash),
      TEXT(scene_hash), TEXT(commit), TEXT(device), TEXT(driver), TEXT(status), LATER(frame_noise), LATER(pair_ratio),
      LATER(pair_spread)};
#undef TEXT
#undef NUMBER
#undef LATER
  return columns;
}

const StudyColumn* findStudyColumn(std::string_view name) {
  for (const StudyColumn& column : studyColumns()) {
    if (name == column.name) return &column;
  }
  return nullptr;
}

std::string cellText(const StudyRow& row, const StudyColumn& column) {
  if (column.text) return row.*column.text;
  const double value = row.*column.number;
  if (std::isnan(value)) return {};
  char text[40];
  // Whole numbers in full, so that counts of fragments stay exact.
  std::snprintf(text, sizeof text, value == std::floor(value) && value < 1e15 ? "%.0f" : "%.6g", value);
  return text;
}

std::vector<CsvRecord> parseCsv(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);
  std::vector<CsvRecord> records;
  size_t line = 1;
  for (size_t at = 0; at < text.size();) {
    CsvRecord record;
    record.line = line;
    record.whole = false;
    std::string field;
    bool quoted = at < text.size() && text[at] == '"', in_quotes = quoted;
    if (quoted) ++at;
    while (at < text.size()) {
      const char c = text[at++];
      if (c == '\n') ++line;
      if (in_quotes) {
        if (c != '"') {
          field += c;
        } else if (at < text.size() && text[at] == '"') {
          field += text[at++];
        } else {
          in_quotes = false;
        }
      } else if (c == ',') {
        record.fields.push_back(std::move(field));
        field.clear();
        in_quotes = at < text.size() && text[at] == '"';
        if (in_quotes) ++at;
      } else if (c == '\n') {
        if (!field.empty() && field.back() == '\r') field.pop_back();
        record.whole = true;
        break;
      } else {
        field += c;
      }
    }
    record.fields.push_back(std::move(field));
    if (record.fields.size() > 1 || !record.fields[0].empty()) {  // an empty line is no record
      records.push_back(std::move(record));
    }
  }
  return records;
}

StudyTable parseStudy(std::string_view csv, const std::string& name) {
  StudyTable table;
  std::vector<CsvRecord> records = parseCsv(csv);
  if (records.empty()) {
    throw StudyError(name + ": is empty; a study that was stopped before its first row leaves nothing to report");
  }
  const CsvRecord header = std::move(records.front());
  records.erase(records.begin());
  std::vector<const StudyColumn*> columns;
  for (const std::string& title : header.fields) {
    columns.push_back(findStudyColumn(title));
  }
  std::string missing;
  for (const StudyColumn& column : studyColumns()) {
    const auto times = std::count(columns.begin(), columns.end(), &column);
    if (times == 0 && column.required) missing += (missing.empty() ? "" : ", ") + std::string(column.name);
    if (times > 1) throw StudyError(name + ": has the column " + column.name + " twice (line 1)");
  }
  if (!missing.empty()) {
    const bool several = missing.find(',') != std::string::npos;
    throw StudyError(name + ": its header (line 1) lacks the column" + (several ? "s " : " ") + missing +
                     "; is it from forelock-study, and of this version?");
  }
  if (!records.empty() && records.back().fields.size() != columns.size() && !records.back().whole) {
    table.warnings.push_back("study.csv, line " + std::to_string(records.back().line) +
                             " is torn off and was left out: the study was stopped while it wrote");
    records.pop_back();
  }
  Warnings warnings(table);
  for (CsvRecord& record : records) {
    const std::string where = "study.csv, line " + std::to_string(record.line);
    if (record.fields.size() != columns.size()) {
      warnings.add(where + " has " + std::to_string(record.fields.size()) + " fields instead of " +
                   std::to_string(columns.size()) + " and was left out");
      continue;
    }
    if (table.rows.size() == kMaxRows) {
      table.warnings.push_back("only the first " + std::to_string(kMaxRows) + " rows were read");
      break;
    }
    StudyRow row;
    row.line = record.line;
    for (size_t i = 0; i < columns.size(); ++i) {
      std::string& field = record.fields[i];
      if (!columns[i]) continue;  // a column of a later version
      if (columns[i]->text) {
        if (field.size() > kMaxFieldBytes) {
          warnings.add(where + ": " + columns[i]->name + " has " + std::to_string(field.size()) + " characters and was cut");
          field.resize(kMaxFieldBytes);
        }
        row.*columns[i]->text = plainText(std::move(field));
        continue;
      }
      const Verdict verdict = parseNumber(field, row.*columns[i]->number);
      if (verdict != Verdict::good && verdict != Verdict::unknown) {
        warnings.add(where + ": " + columns[i]->name + " " + verdictText(verdict) + " (" + shortened(plainText(field)) +
                     ") and was taken as unknown");
      }
    }
    if (row.status.empty()) row.status = "no status";
    table.rows.push_back(std::move(row));
  }
  if (table.rows.empty()) {
    throw StudyError(name + ": has a header but no row; a study that was stopped before its first row leaves nothing to report");
  }
  return table;
}

void parseStudyDevice(std::string_view text, const std::string& name, StudyTable& table) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) {
    table.warnings.push_back(name + " is no JSON object and was left out");
    return;
  }
  StudyDevice& device = table.device;
  device.device = jsonText(json, "device");
  device.driver = jsonText(json, "driver");
  device.type = jsonText(json, "type");
  device.calibration = jsonText(json, "calibration");
  device.commit = jsonText(json, "commit");
  device.date = jsonText(json, "date");
  device.asset = jsonText(json, "asset");
  device.command = jsonText(json, "command");
  device.bandwidth_gb_s = jsonNumber(json, "bandwidth_gb_s");
  device.lane_operations_per_s = jsonNumber(json, "lane_operations_per_s");
  const auto views = json.find("views");
  if (views == json.end() || !views->is_array()) return;
  for (const nlohmann::json& from : *views) {
    if (!from.is_object() || device.views.size() == 1000) continue;
    device.views.push_back({jsonText(from, "name"), jsonNumber(from, "width"), jsonNumber(from, "height"),
                            jsonNumber(from, "fragments"), jsonNumber(from, "hair_pixels"), jsonNumber(from, "mean_overdraw"),
                            jsonNumber(from, "max_overdraw")});
  }
}

StudyTable readStudy(const std::string& folder) {
  const std::filesystem::path path(folder);
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) {
    throw StudyError(folder + ": no such folder; `forelock-study --asset ASSET --out " + folder + "` makes one");
  }
  if (!std::filesystem::is_regular_file(path / "study.csv", error)) {
    throw StudyError((path / "study.csv").string() + ": not found; DIR is the folder that `forelock-study --out DIR` wrote");
  }
  StudyTable table = parseStudy(readWhole(path / "study.csv"), (path / "study.csv").string());
  if (std::filesystem::is_regular_file(path / "device.json", error)) {
    parseStudyDevice(readWhole(path / "device.json"), "device.json", table);
  } else {
    table.warnings.push_back("device.json is missing: device and views are told by the rows alone");
  }
  // The rows know what the file may not.
  const StudyRow& first = table.rows.front();
  const auto fill = [](std::string& to, const std::string& from) { if (to.empty()) to = from; };
  fill(table.device.device, first.device);
  fill(table.device.driver, first.driver);
  fill(table.device.commit, first.commit);
  fill(table.device.asset, first.asset);
  return table;
}

}  // namespace forelock::samples
