// Rows G9 to G11: huge widths, the near plane, strands seen end-on.
#include "frame_kit.h"

#include <gtest/gtest.h>

#include <string>

namespace forelock::test {
namespace {

TEST(HugeWidth, EdgesOfAStrip) {
  const ViewSpec view = flatView(256, 256);
  const double cx = 128.37, cy = 127.21;
  for (const CaptureWay& way : kCaptures) {
    Worst edge, cost;
    std::size_t rows = 0;
    for (const double width : {2.0, 5.3, 20.0, 64.0, 200.0})
      for (const double angle : {0.0, 0.1, 0.35, 0.7853981}) {
        const double dx = std::sin(angle), dy = std::cos(angle);
        StrandArrays strands;
        strands.add({flatPoint(view, cx - 600 * dx, cy - 600 * dy), flatPoint(view, cx + 37 * dx, cy + 37 * dy),
                     flatPoint(view, cx + 600 * dx, cy + 600 * dy)},
                    float(width / 2 / view.height));
        Scene scene(strands, plainMaterial(1, 1), view);
        FlkFrame frame{};
        frame.capture = way.capture;
        const std::vector<float> image = scene.render(frame);
        const double half = width / 2 / dy;
        double drawn = 0;
        for (int row = 0; row < 256; ++row) {
          const double axis = cx + (row + 0.5 - cy) * dx / dy, lean = 0.5 * dx / dy + 1;
          const int middle = int(std::floor(axis + 0.5));
          double left = middle, right = middle;
          for (int column = 0; column < 256; ++column) {
            const double a = double(image[std::size_t(row * 256 + column) * 4 + 3]);
            drawn += a > 0;
            (column < middle ? left : right) += column < middle ? -a : a;
          }
          if (axis - half - lean < 0 || axis + half + lean > 256) continue;
          ++rows;
          edge.see(std::fabs(left - (axis - half)) * dy);
          edge.see(std::fabs(right - (axis + half)) * dy);
        }
        cost.see(double(scene.statistics.fragments) / drawn);
      }
    EXPECT_GT(rows, 1000u);
    EXPECT_LE(edge.value(), 0.01);
    // A pixel is in one of two segments that meet.
    EXPECT_LE(cost.value(), 1);
    record("G9", std::string(way.name) + ": edges of straight strands, 2 to 200 px, 4 angles: largest error",
           "<= 0.01 px", format(edge.value()) + " px");
    record("G9", std::string(way.name) + ": the same: fragments per pixel drawn", "<= 1", format(cost.value()));
  }
}

TEST(HugeWidth, NoGapAtJoints) {
  const ViewSpec view = flatView(160, 160);
  for (const CaptureWay& way : kCaptures) {
    std::size_t gaps = 0, whole = 0, short_gaps = 0, short_whole = 0;
    double lost = 0;
    for (const bool shorter : {false, true})
      for (const double width : {8.0, 24.0, 60.0})
        for (const double bend : {20.0, 45.0, 90.0}) {
          std::vector<std::array<float, 3>> points;
          const double length = (shorter ? 0.25 : 2) * width;
          double x = 20, y = 110, heading = 0.3 + bend * kDegree / 2;
          for (int i = 0; i < 8; ++i) {
            points.push_back(flatPoint(view, x, y));
            x += length * std::cos(heading), y -= length * std::sin(heading);
            heading += (i % 2 ? 1 : -1) * bend * kDegree;
          }
          StrandArrays strands;
          strands.add(points, float(width / 2 / view.height));
          Scene scene(strands, plainMaterial(1, 1), view);
          FlkFrame frame{};
          frame.capture = way.capture;
          const std::vector<float> image = scene.render(frame);
          const std::vector<double> truth = reference::renderCover(scene.reference_scene, scene.camera, 16);
          for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] < 1) continue;
            const double missing = 1 - double(image[i * 4 + 3]);
            (shorter ? short_whole : whole) += 1;
            (shorter ? short_gaps : gaps) += missing > 1.0 / 255;
            if (shorter) lost = std::max(lost, missing);
          }
        }
    EXPECT_GT(whole, 20000u);
    EXPECT_EQ(gaps, 0u);
    record("G9",
           std::string(way.name) +
               ": zig-zags of 8 to 60 px, bends to 90 degrees, segments of two widths: pixels wholly covered, short of "
               "1 by a code",
           "0", std::to_string(gaps));
    record("G9",
           std::string(way.name) +
               ": the same, segments of a quarter width (opacity shared out, methods.md section 2): share of pixels, "
               "most missing",
           "reported", format(100.0 * double(short_gaps) / double(short_whole)) + " %, " + format(lost));
  }
}

TEST(HugeWidth, WiderThanTheScreen) {
  const ViewSpec view = flatView(128, 96);
  for (const CaptureWay& way : kCaptures) {
    std::size_t open = 0, open_at_most = 0;
    double cost = 0;
    for (const double width : {300.0, 1e3, 1e4, 1e6})
      for (const double angle : {0.0, 0.5, 1.3}) {
        const double dx = 300 * std::cos(angle), dy = 300 * std::sin(angle);
        StrandArrays strands;
        strands.add({flatPoint(view, 64 - dx, 48 - dy), flatPoint(view, 64 + dx / 50, 48 + dy / 50),
                     flatPoint(view, 64 + dx, 48 + dy)},
                    float(width / 2 / view.height));
        Scene scene(strands, plainMaterial(1, 1), view);
        FlkFrame frame{};
        frame.capture = way.capture;
        const std::vector<float> image = scene.render(frame);
        for (std::size_t i = 3; i < image.size(); i += 4) (width < 1e6 ? open : open_at_most) += image[i] != 1.0f;
        cost = std::max(cost, double(scene.statistics.fragments) / (128.0 * 96.0));
      }
    EXPECT_EQ(open, 0u);
    EXPECT_LE(cost, 1);
    record("G9", std::string(way.name) + ": strands of 300 to 1e4 px: pixels not opaque", "0", std::to_string(open));
    record("G9",
           std::string(way.name) +
               ": strands of 1e6 px (a rasteriser clips them to its own reach): pixels not opaque, of 36864",
           "reported", std::to_string(open_at_most));
    record("G9", std::string(way.name) + ": both: fragments per pixel of the screen", "<= 1", format(cost));
  }
}

// Many such strands in one group of a computed capture. lavapipe (Mesa 22.3.6) ends the loops of an invocation after 65,535 rounds in all,
// 64 pixels of a quad each for 64 lanes; to be held there too once it does not.
TEST(HugeWidth, ManyScreensFull) {
  const ViewSpec view = flatView(256, 256);
  uint64_t least = UINT64_MAX;
  for (const uint32_t count : {16u, 80u}) {
    for (const CaptureWay& way : kCaptures) {
      Scene scene(layers(view, count, true), plainMaterial(0.01f, 0.01f), view);
      FlkFrame frame{};
      frame.capture = way.capture;
      scene.render(frame);
      const uint64_t lost = uint64_t(count) * 256 * 256 - scene.statistics.fragments;
      least = std::min(least, scene.statistics.fragments);
      const bool limited = count == 80 && way.capture == FLK_CAPTURE_COMPUTE && loopsAreLimited();
      EXPECT_TRUE(limited || lost == 0) << lost;
      record(
          "G9",
          std::string(way.name) + ": " + std::to_string(count) + " strands that fill 256 x 256 pixels: fragments lost",
          limited ? "0: **not held**, this driver ends loops after 65,535 rounds" : "0", std::to_string(lost));
    }
  }
  EXPECT_GT(least, 0u);
}

// A head of hair around the eye: strands that cross the near plane, lie behind, pass through the eye or start in its plane.
StrandArrays hairAroundTheEye(uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-0.3f, 0.3f);
  StrandArrays strands;
  for (int i = 0; i < 120; ++i) {
    const std::array<float, 3> a{uniform(random), uniform(random), uniform(random)},
        c{uniform(random), uniform(random), uniform(random)};
    std::array<float, 3> b{uniform(random), uniform(random), uniform(random)};
    if (i % 10 == 1) b = {0, 0, 0};  // a vertex in the eye
    if (i % 10 == 3) b[2] = 0;       // w = 0
    if (i % 10 == 5) b[2] = -0.01f;  // on the near plane
    if (i % 10 == 7) b[2] = -1e-30f;
    strands.add({a, b, c}, i % 2 ? 1e-3f : 1e-4f);
  }
  strands.add({{0.1f, 0.1f, 0.01f}, {-0.1f, 0.1f, 0.3f}}, 1e-3f);  // wholly behind
  strands.add({{0, 0, 0}, {0, 0, -0.3f}}, 1e-3f);                  // from the eye along the axis
  strands.add({{-0.2f, 0, 0}, {0.2f, 0, 0}}, 1e-3f);               // through the eye, across
  return strands;
}

// Pixels within a pixel of the cylinders: of their axes, cut at the near plane, with the width that perspective gives each point.
std::vector<bool> silhouette(const StrandArrays& strands, const ViewSpec& view) {
  std::vector<bool> inside(std::size_t(view.width * view.height));
  const double scale = view.height / 2.0 / view.projection.tan_half_y, near = view.projection.near_plane;
  for (uint32_t s = 0; s < strands.strands(); ++s)
    for (uint32_t v = strands.first_vertex[s]; v + 1 < strands.first_vertex[s + 1]; ++v) {
      Vec3 end[2];
      for (uint32_t e = 0; e < 2; ++e) end[e] = at(strands.positions, std::size_t(v + e) * 3);
      if (std::max(-end[0].z, -end[1].z) < near) continue;
      for (int e = 0; e < 2; ++e) {
        if (-end[e].z >= near) continue;
        const double u = (near + end[e].z) / (end[e].z - end[1 - e].z);
        end[e] = sum(scaled(end[e], 1 - u), scaled(end[1 - e], u));
        end[e].z = -near;
      }
      double x[2], y[2], h[2];
      for (int e = 0; e < 2; ++e) {
        const double d = -end[e].z;
        x[e] = view.width / 2.0 + scale * end[e].x / d, y[e] = view.height / 2.0 - scale * end[e].y / d,
        h[e] = scale * double(strands.radii[v]) / d;
      }
      const double dx = x[1] - x[0], dy = y[1] - y[0], square = dx * dx + dy * dy;
      for (int row = 0; row < view.height; ++row)
        for (int column = 0; column < view.width; ++column) {
          const double px = column + 0.5 - x[0], py = row + 0.5 - y[0],
                       u = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
          // To the pixel's corner, and one pixel.
          if (std::hypot(px - u * dx, py - u * dy) <= h[0] + (h[1] - h[0]) * u + std::numbers::sqrt2 / 2 + 1)
            inside[std::size_t(row * view.width + column)] = true;
        }
    }
  return inside;
}

TEST(NearPlane, OnlyTheSilhouette) {
  ViewSpec view;
  view.width = view.height = 128;
  view.eye = {0, 0, 0}, view.target = {0, 0, -1};
  for (const CaptureWay& way : kCaptures) {
    std::size_t outside = 0, broken = 0, pixels = 0;
    double squares = 0;
    for (uint32_t seed = 1; seed <= 4; ++seed) {
      view.projection.reversed = seed % 2;
      const StrandArrays strands = hairAroundTheEye(seed);
      const std::vector<bool> within = silhouette(strands, view);
      Scene scene(strands, plainMaterial(0.5f, 0.5f), view);
      scene.setLight(samples::kConditionLight, 1, 0);
      FlkFrame frame{};
      frame.capture = way.capture;
      const std::vector<float> image = scene.render(frame);
      broken += notFinite(image);
      const reference::FragmentLists lists = scene.gather();
      const std::vector<double> truth = reference::opacityOf(lists);
      for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
          const std::size_t i = std::size_t(y * view.width + x);
          const double a = double(image[i * 4 + 3]);
          squares += std::pow(255 * (a - truth[i]), 2), ++pixels;
          bool near = within[i];  // or at the point of a mitre, which the reference has too
          for (int v = std::max(y - 1, 0); v <= std::min(y + 1, view.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, view.width - 1); ++u)
              near = near || !lists.at(u, v).empty();
          outside += a > 0 && !near;
        }
    }
    EXPECT_EQ(outside, 0u);
    EXPECT_EQ(broken, 0u);
    record("G10",
           std::string(way.name) +
               ": eye amid strands (across the near plane, behind, through the eye): pixels beyond the strands' "
               "silhouette + 1 px",
           "0", std::to_string(outside));
    record("G10", std::string(way.name) + ": the same: NaN or infinite", "0", std::to_string(broken));
    record("G10", std::string(way.name) + ": the same: opacity against the clipped reference, rms", "reported",
           format(std::sqrt(squares / double(pixels))) + " codes");
  }
}

TEST(EdgeOn, NoLargerThanWhatIsThere) {
  ViewSpec view;
  view.width = view.height = 128;
  view.eye = {0, 0, 0}, view.target = {0, 0, -1};
  constexpr double scale = 128;  // pixels per metre at 1 m, tan_half_y 0.5
  const double near = view.projection.near_plane;
  for (const CaptureWay& way : kCaptures) {
    Worst area, quads;
    std::size_t broken = 0, drawn = 0;
    // Directions through the picture's middle, beside it and near its corner; both fall back to the view axis with `axis`.
    for (const Vec3 at : {Vec3{0, 0, -1}, Vec3{0.1, 0.07, -1}, Vec3{-0.4, 0.35, -1}})
      for (const bool along_axis : {false, true})
        for (const double from : {0.0, 0.005, 0.02, 0.5})
          for (const double tilt : {0.0, 1e-7, 1e-5, 1e-3, 1e-2, 0.1})
            for (const double radius : {1e-4, 2e-3}) {
              // Starts on the ray through `at` at depth `from` (0: in the eye), 1 m along it or the axis, turned by `tilt`.
              const Vec3 a = scaled(at, from), d = along_axis ? Vec3{0, 0, -1} : at;
              const Vec3 b{a.x + d.x + tilt, a.y + d.y, a.z + d.z};
              StrandArrays strands;
              strands.add({{float(a.x), float(a.y), float(a.z)}, {float(b.x), float(b.y), float(b.z)}}, float(radius));
              Scene scene(strands, plainMaterial(1, 1), view);
              FlkFrame frame{};
              frame.capture = way.capture;
              const std::vector<float> image = scene.render(frame);
              broken += notFinite(image);
              double sum = 0;
              for (std::size_t i = 3; i < image.size(); i += 4) sum += double(image[i]);
              drawn += sum > 0;
              const double cut = std::max(from, near), u = (cut - from) / -(b.z - a.z);
              const double ax = (a.x + u * (b.x - a.x)) / cut * scale, ay = (a.y + u * (b.y - a.y)) / cut * scale;
              const double l = std::hypot(b.x / -b.z * scale - ax, b.y / -b.z * scale - ay), h = radius / cut * scale;
              // Discs of all points of the axis lie in this; a hundredth and a pixel for what codes round.
              area.see(sum / ((std::numbers::pi * h * h + 2 * h * l) * 1.01 + 0.01));
              quads.see(double(scene.statistics.fragments) / ((2 * h + 4) * (l + 4)));
            }
    EXPECT_GT(drawn, 50u);
    EXPECT_LE(area.value(), 1);
    EXPECT_LE(quads.value(), 1);
    EXPECT_EQ(broken, 0u);
    record("G11",
           std::string(way.name) +
               ": strands along the view axis and along rays, from the eye, from before the near plane, tilts 0 to "
               "0.1: NaN or infinite",
           "0", std::to_string(broken));
    record("G11", std::string(way.name) + ": the same: area over that of its discs (end and side)", "<= 1",
           format(area.value()));
    record("G11", std::string(way.name) + ": the same: fragments over those of a quad around it, 2 px of margin",
           "<= 1", format(quads.value()));
  }
}

}  // namespace
}  // namespace forelock::test
