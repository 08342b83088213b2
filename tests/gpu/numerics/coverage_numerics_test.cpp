// Row G8 and the coverage of strips at every width, angle, offset and pixel aspect; pixels of hard strands; depth values.
#include "numerics_kit.h"
#include "numerics_spv/numerics_coverage.h"
#include "numerics_spv/numerics_depth.h"
#include "numerics_spv/numerics_edge.h"
#include "numerics_spv/numerics_hard.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace forelock::test {
namespace {

const double kAngles[] = {0, 10, 26.57, 30, 45, 63.43, 90};  // of the strand from the pixel's x axis, degrees
constexpr int kOffsets = 64;
constexpr double kLength = 2000;  // of the segment, pixels

struct Strip {
  double width_px, angle, aspect, opacity;
  int offset;
};

// Sums of one row (or column) of pixels, times the share of the strand's length that lies in the row: per unit length.
// A box filter of the whole row makes this exact, wherever the row cuts the strip.
struct StripSums {
  double coverage, alpha_default, alpha_paper;
};

std::vector<StripSums> sums(const std::vector<Strip>& strips) {
  std::vector<float> in;
  std::vector<double> share;
  for (const Strip& s : strips) {
    const double tx = std::cos(s.angle * kDegree), ty = std::sin(s.angle * kDegree);
    const bool upright = std::fabs(ty) >= std::fabs(tx);
    share.push_back(std::max(std::fabs(tx), std::fabs(ty)));
    // Pixels per metre: 1000 along x. The radius in metre follows from the cylinder's own geometry: one metre of strand
    // along w = (tx / sx, ty / sy) (normalised) is |S w| pixels long and holds 2 r sx sy pixels of area.
    const double sx = 1000, sy = 1000 / s.aspect;
    const double pixels_per_length = 1 / std::hypot(tx / sx, ty / sy);
    const double radius = s.width_px * pixels_per_length / (2 * sx * sy);
    const double off = double(s.offset) / kOffsets;
    add(in, {upright ? 960 + off : 540.5, upright ? 540.5 : 960 + off, tx, ty, radius, sx, sy, s.opacity, kLength});
  }
  const std::vector<float> out = runItems(numerics_coverage, in, 9, 3);
  std::vector<StripSums> result(out.size() / 3);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {double(out[i * 3]) * share[i], double(out[i * 3 + 1]) * share[i], double(out[i * 3 + 2]) * share[i]};
  return result;
}

TEST(Coverage, WidthPerLength) {
  const double widths[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 1.5, 2, 5, 10, 20, 50, 100, 200};
  const struct {
    double value;
    const char* name;
  } aspects[] = {{1, "1:1"}, {16.0 / 9, "16:9"}, {0.5, "1:2"}};
  for (const auto& aspect : aspects) {
    std::vector<Strip> strips;
    for (const double width : widths)
      for (const double angle : kAngles)
        for (int offset = 0; offset < kOffsets; ++offset) strips.push_back({width, angle, aspect.value, 1, offset});
    const std::vector<StripSums> result = sums(strips);
    ASSERT_EQ(result.size(), strips.size());
    Worst fine, coarse;
    for (std::size_t i = 0; i < result.size(); ++i) {
      const double percent = 100 * std::fabs(result[i].coverage / strips[i].width_px - 1);
      EXPECT_LT(percent, 1) << strips[i].width_px << " px, " << strips[i].angle << " degrees, offset "
                            << strips[i].offset;
      (strips[i].width_px < 1 ? fine : coarse).see(percent);
    }
    const std::string name = std::string("pixels of ") + aspect.name + ", 7 angles, worst of 64 offsets: ";
    record("coverage", name + "width 0.001 to 0.5 px", "< 1 %", format(fine.value()) + " %");
    record("coverage", name + "width 1 to 200 px", "< 1 %", format(coarse.value()) + " %");
  }
}

TEST(Coverage, EdgeOfAPixel) {
  std::vector<float> in;
  std::vector<double> expected;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> angles = {0, 45, 90, 135, 1e-3, 1e-6, 45.0001, 44.9999};
  for (int i = 0; i < 200; ++i) angles.push_back(180 * uniform(random));
  for (const double angle : angles) {
    const float nx = float(std::cos(angle * kDegree)), ny = float(std::sin(angle * kDegree));
    const float a = std::max(std::fabs(nx), std::fabs(ny)), b = std::min(std::fabs(nx), std::fabs(ny));
    std::vector<double> distances = {
        0, -0.0, 0.5 * double(a - b), 0.5 * double(a + b), 1e-30, 1e30, double(kInf), -double(kInf), 100};
    for (int i = 0; i < 200; ++i) distances.push_back(uniform(random));
    for (const double t : distances) {
      in.insert(in.end(), {float(t), a, b});
      expected.push_back(std::isinf(t) ? std::copysign(0.5, t)
                                       : reference::pixelHalfArea(double(float(t)), double(nx), double(ny)));
    }
  }
  const std::vector<float> out = runItems(numerics_edge, in, 3, 1);
  ASSERT_EQ(out.size(), expected.size());
  Worst error;
  for (std::size_t i = 0; i < out.size(); ++i) error.see(std::fabs(double(out[i]) - expected[i]));
  // Some ulp of 1/2.
  EXPECT_LT(error.value(), 5e-7);
  record("coverage", "half area of a pixel, all angles and distances, also infinite: largest error", "< 5e-7",
         format(error.value()));
}

TEST(SubPixelWidth, AfterAlphaCoding) {
  const double widths[] = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1};
  for (const double opacity : {1.0, 0.63}) {
    std::vector<Strip> strips;
    for (const double width : widths)
      for (const double angle : kAngles)
        for (int offset = 0; offset < kOffsets; ++offset) strips.push_back({width, angle, 1, opacity, offset});
    const std::vector<StripSums> result = sums(strips);
    ASSERT_EQ(result.size(), strips.size());
    std::size_t i = 0;
    struct {
      Worst worst, mean, paper;
    } fine, wide;  // below 0.01 px, and from there
    for (const double width : widths)
      for (std::size_t angle = 0; angle < std::size(kAngles); ++angle) {
        auto& seen = width < 0.0099 ? fine : wide;
        double mean = 0, mean_paper = 0;
        for (int offset = 0; offset < kOffsets; ++offset, ++i) {
          const double relative = result[i].alpha_default / (width * opacity);
          mean += relative / kOffsets;
          mean_paper += result[i].alpha_paper / (width * opacity) / kOffsets;
          seen.worst.see(100 * std::fabs(relative - 1));
        }
        seen.mean.see(100 * std::fabs(mean - 1));
        seen.paper.see(100 * std::fabs(mean_paper - 1));
      }
    // A strand along an axis keeps one offset: the worst counts, not the mean.
    EXPECT_LT(wide.worst.value(), 2) << opacity;
    EXPECT_LT(fine.worst.value(), 10) << opacity;
    const std::string name = "opacity " + format(opacity) + ", 7 angles, ";
    auto both = [](const Worst& a, const Worst& b) { return format(a.value()) + " %; " + format(b.value()) + " %"; };
    record("G8", name + "default coding, worst of 64 offsets: 0.01 to 1 px; 0.001 to 0.005 px", "< 2 %; < 10 %",
           both(wide.worst, fine.worst));
    record("G8", name + "default coding, mean of the offsets: 0.01 to 1 px; 0.001 to 0.005 px", "reported",
           both(wide.mean, fine.mean));
    record("G8", name + "paper coding, mean of the offsets: 0.01 to 1 px; 0.001 to 0.005 px", "reported",
           both(wide.paper, fine.paper));
  }
}

TEST(Depth, LinearFromBuffer) {
  struct Projection {
    double p22, p32, orthographic;
  };
  const double n = 0.01, f = 100;
  // Vulkan's: standard, reversed, either with an infinite far plane, orthographic.
  const Projection projections[] = {{-f / (f - n), -n * f / (f - n), 0},
                                    {n / (f - n), n * f / (f - n), 0},
                                    {-1, -n, 0},
                                    {0, n, 0},
                                    {-1 / (f - n), -n / (f - n), 1}};
  std::vector<float> in;
  std::vector<double> expected;
  std::size_t broken_from = 0;
  for (const Projection& p : projections) {
    const float p22 = float(p.p22), p32 = float(p.p32);
    for (int i = 0; i <= 1000; ++i) {
      const float value = float(i) / 1000;
      in.insert(in.end(), {value, p22, p32, float(p.orthographic)});
      const double denominator = double(value) + double(p22);
      const double d = p.orthographic > 0 ? (double(p32) - double(value)) / double(p22) : double(p32) / denominator;
      expected.push_back(denominator == 0 && p.orthographic == 0 ? 3e38 : d);
    }
  }
  broken_from = expected.size();
  for (const Projection& p : projections)
    for (const float value : {-kInf, -1.0f, kDenormal, 1.0000001f, 2.0f, kInf, kNan}) {
      in.insert(in.end(), {value, float(p.p22), float(p.p32), float(p.orthographic)});
      expected.push_back(0);
    }
  const std::vector<float> out = runItems(numerics_depth, in, 4, 1);
  ASSERT_EQ(out.size(), expected.size());
  Worst relative;
  std::size_t nans = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (i < broken_from) relative.see(std::fabs(double(out[i]) / expected[i] - 1) * (expected[i] == 0 ? 0 : 1));
    // Orthographic depth of a NaN or an infinity is one: it compares as not behind, or as it should.
    else if (in[i * 4 + 3] == 0)
      nans += !(out[i] >= 0 && out[i] <= 3.1e38f);
  }
  // A division of 2.5 ulp and a difference of inputs that are themselves exact.
  EXPECT_LT(relative.value(), 1e-6);
  EXPECT_EQ(nans, 0u);
  record("other",
         "linear depth, standard and reversed, finite and infinite far plane, orthographic: largest relative error",
         "< 1e-6", format(relative.value()));
  record("other", "linear depth of values outside [0, 1], perspective: negative, infinite or NaN", "0",
         std::to_string(nans));
}

// FLK_METHOD_HARD: a pixel is in the box around the axis, at least a pixel wide, and at a joint in one of both segments.
TEST(Coverage, BoxesOfHardStrands) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  struct Point {
    double x, y, l, x_next, y_next, h, side;  // along either segment's axes, and of the line that splits them
  };
  std::vector<float> in;
  std::vector<Point> points;
  for (int strand = 0; strand < 400; ++strand) {
    const double h = strand % 4 == 0 ? 0.01 : 6 * uniform(random), l = 8 + 20 * uniform(random);
    const double heading = 2 * std::numbers::pi * uniform(random), bend = (2 * uniform(random) - 1) * 120 * kDegree;
    const double a[2] = {300 * uniform(random), -200 * uniform(random)};
    const double b[2] = {a[0] + l * std::cos(heading), a[1] + l * std::sin(heading)};
    const double c[2] = {b[0] + l * std::cos(heading + bend), b[1] + l * std::sin(heading + bend)};
    for (int i = 0; i < 100; ++i) {
      // A third of them beside the joint, where the two meet.
      const double* around = i % 3 ? (i % 2 ? a : c) : b;
      const double x = std::floor(around[0] + 24 * (uniform(random) - 0.5)) + 0.5,
                   y = std::floor(around[1] + 24 * (uniform(random) - 0.5)) + 0.5;
      add(in, {a[0], a[1], b[0], b[1], c[0], c[1], h, x, y});
      const Vec3 t{std::cos(heading), std::sin(heading), 0}, u{std::cos(heading + bend), std::sin(heading + bend), 0};
      const Vec3 from_a{x - a[0], y - a[1], 0}, from_b{x - b[0], y - b[1], 0};
      points.push_back({cross(t, from_a).z, dot(from_a, t), l, cross(u, from_b).z, dot(from_b, u), std::max(h, 0.5),
                        dot(from_b, sum(t, u))});
    }
  }
  const std::vector<float> out = runItems(numerics_hard, in, 9, 3);
  ASSERT_EQ(out.size(), points.size() * 3);
  std::size_t wrong = 0, both = 0, neither = 0, near = 0, inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& p = points[i];
    both += out[i * 3] > 0 && out[i * 3 + 1] > 0;
    inside += out[i * 3 + 2] > 0;
    // 300 pixels from the middle fp32 steps are 3e-5.
    const double edge = std::min({std::fabs(std::fabs(p.x) - p.h), std::fabs(p.y), std::fabs(p.y - p.l)});
    if (edge < 1e-3)
      ++near;
    else
      wrong += (out[i * 3 + 2] > 0) != (std::fabs(p.x) <= p.h && p.y >= 0 && p.y < p.l);
    const bool clear =
        p.h - std::fabs(p.x) > 1e-3 && p.h - std::fabs(p.x_next) > 1e-3 && p.y > 1e-3 && p.l - p.y_next > 1e-3;
    neither += clear && !(out[i * 3] > 0) && !(out[i * 3 + 1] > 0);
  }
  EXPECT_GT(inside, points.size() / 50);
  EXPECT_LT(near, points.size() / 100);
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(both + neither, 0u);
  record("coverage", "hard strands, 0.02 to 12 px, pixels in and around their boxes: not as the box has it", "0",
         std::to_string(wrong));
  record("coverage", "hard strands, bends to 120 degrees, pixels at the joint: in both segments, in neither", "0, 0",
         std::to_string(both) + ", " + std::to_string(neither));
}

}  // namespace
}  // namespace forelock::test
