#include "stability.h"

#include "scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

namespace forelock::test {
namespace {

struct Row {
  std::string row, what, threshold, measured, where;
};
std::vector<Row>& rows() {
  static std::vector<Row> all;
  return all;
}
std::string& outputPath() {
  static std::string path;
  return path;
}

std::string nameOf(const Row& row) { return "| " + row.row + " | " + row.what + " | "; }

const std::string& committed() {
  static const std::string text = [] {
    std::ifstream file(std::string(FORELOCK_SOURCE_DIR) + "/docs/stability.md");
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  return text;
}

constexpr const char* kIntroduction = R"(# Numerical stability

What the shader functions of `shaders/lib` give on a device, against float64 twins on the CPU: test shaders include the
functions unchanged and evaluate them over arrays of ordinary, extreme and broken inputs. Rows G1 to G8 are those of the
robustness matrix; *coverage* and *other* hold what lies near them. A row without a threshold is only reported. A *code*
is 1/255.

The tests write this page; each of them fails when a row of its own is missing here, or where a threshold is passed.
Values differ a little from device to device, the thresholds do not; the page shows one run on one device. To make it
again, from the build folder:

    ./test_gpu_numerics --write-stability ../docs/stability.md

Not here yet: **G9 to G32** (huge widths, near plane, edge-on strands, depth formats, position from depth, alpha cull,
opacity out of range, layers, overflow, depth ties, determinism, tail, blend round-off, background, lights, camera, broken
assets, far from the origin, half precision, compilers, time, level of detail, k, what is not needed). They concern whole
frames or the API, which these tests do not touch.

)";

}  // namespace

std::string format(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void record(const std::string& row, const std::string& what, const std::string& threshold,
            const std::string& measured) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  rows().push_back({row, what, threshold, measured, std::string(test.test_suite_name()) + "." + test.name()});
  std::printf("ROW %s, %s: %s (%s)\n", row.c_str(), what.c_str(), measured.c_str(), threshold.c_str());
  if (outputPath().empty()) {
    EXPECT_NE(committed().find(nameOf(rows().back())), std::string::npos)
        << "docs/stability.md lacks the row " << row << ", " << what << ": run test_gpu_numerics --write-stability";
  }
}

void writeStabilityTo(const std::string& path) { outputPath() = path; }

bool finishStability() {
  if (outputPath().empty()) return true;
  // G1, G2 ... in order, then the words; within a row as the tests ran.
  auto rank = [](const Row& row) { return row.row[0] == 'G' ? std::atoi(row.row.c_str() + 1) : 1000; };
  std::stable_sort(rows().begin(), rows().end(), [&](const Row& a, const Row& b) {
    return std::pair(rank(a), a.row) < std::pair(rank(b), b.row);
  });
  std::ofstream file(outputPath());
  file << kIntroduction << "Device: " << host().deviceName() << ", " << host().driverName() << ".\n\n"
       << "| row | case | threshold | measured | where |\n|---|---|---|---|---|\n";
  for (const Row& row : rows())
    file << nameOf(row) << row.threshold << " | " << row.measured << " | `" << row.where << "` |\n";
  return bool(file.flush());
}

}  // namespace forelock::test
