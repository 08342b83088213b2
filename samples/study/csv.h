// study.csv: a header and a row a measurement, each flushed as it is written. SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace forelock::study {

// In the order of the file.
std::span<const char* const> columns();

// A row by column names; a column that is not set is empty, which stands for unknown or not applicable.
class Row {
public:
  void set(const std::string& column, const std::string& text);
  void set(const std::string& column, const char* text) { set(column, std::string(text)); }
  void set(const std::string& column, uint64_t value) { set(column, std::to_string(value)); }
  void set(const std::string& column, uint32_t value) { set(column, std::to_string(value)); }
  // Six digits; not finite: left empty.
  void set(const std::string& column, double value);
  const std::string& operator[](const std::string& column) const;

private:
  std::map<std::string, std::string> fields_;
};

// RFC 4180: quoted where it holds a comma, a quote or a line end.
std::string csvLine(const std::vector<std::string>& fields);
// The fields of one line without its end. False: a quote is never closed, or the line is not CSV.
bool parseCsvLine(const std::string& line, std::vector<std::string>& fields);

struct StudyFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class StudyFile {
public:
  // Makes the file with its header, or reads what is there: a last line without an end was torn by a kill and is cut off.
  // Throws StudyFileError: it holds something else, or cannot be written.
  explicit StudyFile(const std::string& path);

  const std::vector<Row>& rows() const { return rows_; }
  void append(const Row& row);

private:
  std::string path_;
  std::vector<Row> rows_;
  std::ofstream file_;
};

}  // namespace forelock::study
