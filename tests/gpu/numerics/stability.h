// What the tests measured, row by row of docs/stability.md.
#pragma once

#include <cmath>
#include <string>

namespace forelock::test {

// Adds a row named after the running test. Fails it where the committed docs/stability.md lacks the row (unless it is
// being written anew). `row` is G1 ... or a word, `what` the case; `threshold` and `measured` are for the reader.
void record(const std::string& row, const std::string& what, const std::string& threshold, const std::string& measured);

// Shortest form with three digits.
std::string format(double value);

// The largest of what it is shown; NaN counts as infinite, so that no comparison loses it.
class Worst {
public:
  void see(double value) { value_ = std::fmax(value_, std::isnan(value) ? HUGE_VAL : value); }
  double value() const { return value_; }

private:
  double value_ = 0;
};

// Writes the table at exit of the run. False: not written.
void writeStabilityTo(const std::string& path);
bool finishStability();

}  // namespace forelock::test
