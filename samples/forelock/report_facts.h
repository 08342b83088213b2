// What the rows of a study say together: which of them belong to one plot, which are the methods as they are meant to be used,
// which cannot be trusted. SPDX-License-Identifier: MIT
#pragma once

#include "study_table.h"

#include <map>
#include <set>
#include <span>

namespace forelock::samples {

// A setting of a method that a study varies; everything else stays at its base value meanwhile.
struct Dial {
  const char* column;
  const char* base;   // taken where a method has it, else the value that most of its rows have
  const char* label;  // of an axis
  const char* mark;   // before a value at a point
};
std::span<const Dial> dials();

// What one plot of error against time is of.
struct Setting {
  std::string view, capture, hair_colour;
  bool operator==(const Setting&) const = default;
  std::string text() const;  // "198k, compute, dark"
};

struct Series {
  std::string method;
  const Dial* dial = nullptr;  // null: one row
  std::vector<const StudyRow*> rows;
};

struct Sweep {
  const Dial* dial = nullptr;
  std::vector<Series> series;
};

struct PlanePoint {
  double x = 0.0, y = 0.0;
};

// Indices of the points that no other point beats in one coordinate without losing in the other, by rising x. Points that are
// not finite take no part; of equal ones all stay.
std::vector<size_t> paretoFront(std::span<const PlanePoint> points);

// Why a row's time or error should not be built on; empty when it may be.
std::string whyDoubtful(const StudyRow& row);

// The method, with its store unless that is the usual one.
std::string methodOf(const StudyRow& row);

// 3 digits that count, without an exponent: "1,234", "0.0123".
std::string readableNumber(double value, int digits = 3);
std::string readableCount(double value);  // "3,957,012", or "-" if unknown

class StudyFacts {
 public:
  // `table` outlives it. `error_column`: of studyColumns().
  StudyFacts(const StudyTable& table, const std::string& error_column);

  const StudyTable& table;
  const StudyColumn* error;
  std::vector<StudyView> views;  // fewest hair pixels first
  std::vector<std::string> methods;  // the usual ones in a fixed order, then others by name
  std::vector<std::string> captures, hair_colours;
  std::vector<Setting> settings;  // those with two rows or more, the main one first
  Setting main;                   // the view, capture and colour with most rows
  size_t replaced_rows = 0;       // measured again later in the table

  double errorOf(const StudyRow& row) const { return row.*error->number; }
  // Its time as it compares with the other rows of its setting: the ratio to core_tail in alternating frames, times core_tail's median,
  // where the study has both; else its own median. A machine that is busy for a while slows both frames of a pair.
  double timeOf(const StudyRow& row) const;
  // A time and an error to plot, and the study called it a success.
  bool isPlotted(const StudyRow& row) const;
  std::vector<const StudyRow*> rows(const Setting& setting) const;
  std::vector<const StudyRow*> doubtfulRows() const;
  const std::vector<const StudyRow*>& liveRows() const { return live_; }
  // The method as it is meant to be used: k 8, 25 taps and so on. Null if there is no such row.
  const StudyRow* baseRow(const Setting& setting, const std::string& method) const;
  // Of every method: a line over each dial that changes both time and error, or a single row.
  std::vector<Series> errorSeries(const Setting& setting) const;
  std::vector<Sweep> sweeps(const Setting& setting) const;
  // time(forward) / time(row), both at their base: from alternating frames where the study has them (`paired`).
  struct Ratio {
    double value = kUnknown, spread = kUnknown;
    bool paired = false;
  };
  Ratio forwardRatio(const Setting& setting) const;

 private:
  const std::string& baseValue(const std::string& method, const Dial& dial) const;
  // Whether all dials but the one left out are at their base.
  bool atBase(const StudyRow& row, const Dial* left_out = nullptr) const;

  std::vector<const StudyRow*> live_;
  std::map<std::pair<std::string, const Dial*>, std::string> base_;
};

}  // namespace forelock::samples
