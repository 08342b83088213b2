// Joints of section 1: the area they conserve, and where they put two layers on one pixel.
#include "reference_support.h"

#include <algorithm>

namespace forelock::reference {
namespace {

struct AreaError {
  double mean = 0, standard_error = 0, worst = 0;
};

// Coverage summed over the image against length x width, over random headings and sub-pixel offsets.
AreaError areaError(double width, double l, double bend, bool alternate, int samples, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  // One turn at most: a strand that runs round itself is many strands, and its error repeats instead of averaging.
  const int most = alternate ? 60 : std::max(2, int(300 / bend));
  const int count = std::clamp(int(std::ceil(24 / l)), 3, std::max(3, most));
  AreaError out;
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    std::vector<Point> points = bentLine(l, count, radians(bend), alternate, uniform(random) * 2 * std::numbers::pi);
    double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
    for (const Point& p : points) {
      low_x = std::min(low_x, p.x);
      low_y = std::min(low_y, p.y);
      high_x = std::max(high_x, p.x);
      high_y = std::max(high_y, p.y);
    }
    const double margin = 2 * width + l / 2 + 6;  // a mitre reaches twice its half width, or half a segment
    const double ox = uniform(random) + margin - low_x, oy = uniform(random) + margin - low_y;
    for (Point& p : points) p = {p.x + ox, p.y + oy};
    const Camera camera = pixelCamera(int(high_x - low_x + 2 * margin + 2), int(high_y - low_y + 2 * margin + 2));
    Scene scene;
    scene.hairs.resize(1);
    addLine(scene.hairs[0], camera, points, width);
    GatherOptions one;
    one.threads = 1;
    double area = 0;
    for (const Fragment& f : gatherFragments(scene, camera, one).fragments) area += f.coverage;
    const double error = area / (count * l * width) - 1;
    out.mean += error / samples;
    squares += error * error / samples;
    out.worst = std::max(out.worst, std::fabs(error));
  }
  out.standard_error = std::sqrt(std::max(0.0, squares - out.mean * out.mean) / samples);
  return out;
}

TEST(ReferenceJoint, BentStrandsKeepTheirAreaInTheMean) {
  std::mt19937 random(3);
  const double bends[] = {5, 15, 30, 60, 90, 120, 150, 170}, lengths[] = {0.1, 0.3, 1, 3, 10, 20};
  double worst_mean = 0;
  std::printf("area, %%: worst mean over the bends (worst single offset), up to 30 degrees | above\n");
  for (const double width : {0.02, 0.3, 1.0, 3.0, 10.0}) {
    for (const double l : lengths) {
      double mean[2] = {0, 0}, single[2] = {0, 0};
      for (const double bend : bends) {
        for (const bool alternate : {false, true}) {
          AreaError e = areaError(width, l, bend, alternate, 50, random);
          // The sum scatters with the offset; sample until the mean is known to 0.5 %, as far as that is affordable.
          const double wanted = std::min(1500.0, 50 * std::pow(e.standard_error / 0.005, 2));
          if (wanted > 50) e = areaError(width, l, bend, alternate, int(wanted), random);
          mean[bend > 30] = std::max(mean[bend > 30], std::fabs(e.mean));
          single[bend > 30] = std::max(single[bend > 30], e.worst);
          worst_mean = std::max(worst_mean, std::fabs(e.mean));
          // m keeps each segment's sum; the 1 % is for what a pixel that counts as covered leaves out of a sharp
          // point. Four standard errors for the sampling.
          EXPECT_LT(std::fabs(e.mean), 0.01 + 4 * e.standard_error)
              << "width " << width << " length " << l << " bend " << bend << (alternate ? " alternating" : "");
        }
      }
      std::printf("w %5.2f l %4.1f: %.2f (%.1f) | %.2f (%.1f)\n", width, l, 100 * mean[0], 100 * single[0],
                  100 * mean[1], 100 * single[1]);
    }
  }
  std::printf("area: worst mean %.3f %%\n", 100 * worst_mean);
}

struct Layers {
  size_t fragments = 0;
  double coverage = 0;
};

// The most that any pixel holds of one strand.
Layers mostLayers(std::vector<Point> points, double width, double l, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Point low = points[0], high = low;
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const double margin = 2 * width + l / 2 + 6;
  const double ox = margin + uniform(random) - low.x, oy = margin + uniform(random) - low.y;
  for (Point& p : points) p = {p.x + ox, p.y + oy};
  const Camera camera = pixelCamera(int(high.x - low.x + 2 * margin + 2), int(high.y - low.y + 2 * margin + 2));
  Scene scene;
  scene.hairs.resize(1);
  addLine(scene.hairs[0], camera, points, width);
  GatherOptions one;
  one.threads = 1;
  const FragmentLists lists = gatherFragments(scene, camera, one);
  Layers most;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      double sum = 0;
      for (const Fragment& f : lists.at(x, y)) sum += f.coverage;
      most.coverage = std::max(most.coverage, sum);
      most.fragments = std::max(most.fragments, lists.at(x, y).size());
    }
  }
  return most;
}

// Neighbours share their split line up to a slope of 2, 126.9 degrees, or further where they are long: a pixel is in
// one of them, however short they are and however wide. To and fro all split lines are parallel, and the same holds for
// the whole strand.
TEST(ReferenceJoint, OneLayerWhereTheMitreIsNotClamped) {
  std::printf("most fragments and coverage on a pixel: one joint | to and fro | one way, 300 degrees at most\n");
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double width : {0.02, 0.3, 1.0, 3.0, 10.0}) {
    for (const double l : {0.1, 0.3, 1.0, 3.0, 10.0, 20.0}) {
      std::printf("w %5.2f l %4.1f:", width, l);
      for (const double bend : {5.0, 15.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0}) {
        Layers most[3];
        const int count = std::clamp(int(std::ceil(24 / l)), 3, 60);
        for (int i = 0; i < 48; ++i) {
          for (const int shape : {0, 1, 2}) {
            const int segments = shape == 0 ? 2 : shape == 1 ? count : std::clamp(int(300 / bend), 2, count);
            const double heading = uniform(random) * 2 * std::numbers::pi;
            const std::vector<Point> points = bentLine(l, segments, radians(bend), shape == 1, heading);
            const Layers layers = mostLayers(points, width, l, random);
            most[shape].fragments = std::max(most[shape].fragments, layers.fragments);
            most[shape].coverage = std::max(most[shape].coverage, layers.coverage);
          }
        }
        std::printf("  %.0f:", bend);
        for (const Layers& m : most) std::printf(" %zu %.2f", m.fragments, m.coverage);
        // E is at most sqrt(1/2) px: below this slope no heading is clamped.
        const double steepest = std::max(2.0, l / (width + std::numbers::sqrt2));
        for (const int shape : {0, 1}) {
          if (std::tan(radians(bend) / 2) > steepest) continue;
          EXPECT_LE(most[shape].fragments, 1u) << width << " " << l << " " << bend;
          EXPECT_LE(most[shape].coverage, 1 + 1e-12) << width << " " << l << " " << bend;
        }
      }
      std::printf("\n");
    }
  }
}

TEST(ReferenceJoint, SplittingAStraightSegmentChangesNothing) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 50; ++i) {
    const Camera camera = pixelCamera(64, 64);
    const double width = 0.05 + 6 * uniform(random);
    // Every other strand lies on a row of pixel centres, where the split edges meet centres exactly.
    const Point a{8.5, i % 2 ? 20.5 : 8 + 20 * uniform(random)}, b{52.5, i % 2 ? 20.5 : 12 + 40 * uniform(random)};
    Scene whole, split;
    whole.hairs.resize(1);
    split.hairs.resize(1);
    // Three pieces against twelve: the ends' ramps are those of a strand of several segments in both.
    for (const int pieces : {3, 12}) {
      std::vector<Point> points;
      for (int k = 0; k <= pieces; ++k) {
        points.push_back({a.x + (b.x - a.x) * k / pieces, a.y + (b.y - a.y) * k / pieces});
      }
      addLine((pieces == 3 ? whole : split).hairs[0], camera, points, width);
    }
    const std::vector<double> one = opacityOf(gatherFragments(whole, camera));
    const std::vector<double> many = opacityOf(gatherFragments(split, camera));
    // Rounding of the split points, 1e-14 px, times the slope of the coverage.
    for (size_t k = 0; k < one.size(); ++k) ASSERT_NEAR(one[k], many[k], 1e-12);
  }
}

}  // namespace
}  // namespace forelock::reference
