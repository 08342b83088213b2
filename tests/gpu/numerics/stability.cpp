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

What extreme inputs do, measured on a device. Rows G1 to G8, *coverage* and *other*: the shader functions of `shaders/lib`,
which test shaders include unchanged and evaluate over arrays of ordinary, extreme and broken inputs, against float64 twins
on the CPU. Rows G9 to G22: whole frames, 16 to 256 pixels, of strands laid out for the case, against `tests/reference`. The
numbers are those of the robustness matrix. A row without a threshold is only reported. A *code* is 1/255.

The tests write this page; each of them fails when a row of its own is missing here, or where a threshold is passed, unless
the threshold says **not held** and why. Values differ a little from device to device, the thresholds do not; the page shows
one run on one device. To make it again, from the build folder:

    ./test_gpu_numerics --write-stability ../docs/stability.md

**Not held: lavapipe ends the loops of a shader invocation after 65,535 rounds in all** (`LP_MAX_TGSI_LOOP_ITERATIONS` of Mesa),
without a word. `exact` walks a pixel's list once for each 24 fragments, which reaches that at about 1230 fragments; beyond,
the farthest are left out. A group of a computed capture reaches it when its 16 segments cover more than 8 million pixels
together. Other methods and the rasteriser stay far from it.

**G6 asks for a counter** of degenerate tangents. Findings count them, where they come from, once an asset: strands of zero length
are dropped (`STRAND_ZERO_LENGTH`), segments of zero length kept and counted (`SEGMENT_ZERO_LENGTH`). On the device such a
tangent can only come from positions of the host; it shades as diffuse only and is not counted, which would cost every frame.

**G12, G13**: the lists hold linear depth in fp32, whatever the host's depth buffer is, so that hair sorts alike under every
projection. Against the host's surface its format decides: 70 um are resolved by reversed D32 to beyond 100 m, by standard D32
to about 2 m, by D16 to 0.3 m (near plane at 1 cm).

**G15**: the API refuses opacities out of range, NaN too, so that nothing is left to clamp; a call that is refused changes nothing.

**G19** is not tested over two queue families: the device has one.

Not here yet: **G23 to G32** (lights, camera, broken assets, far from the origin, half precision, compilers, time, level of
detail, k, what is not needed). Other tests hold parts of them.

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
