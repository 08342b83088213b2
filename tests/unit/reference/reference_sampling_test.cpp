// The coverage model against supersampled geometry, R_cover.
#include "reference_support.h"

namespace forelock::reference {
namespace {

// RMSE of the opacity in 1/255 over the pixels that either covers.
double opacityError(const Scene& scene, const Camera& camera, int samples, const char* name) {
  const std::vector<double> model = opacityOf(gatherFragments(scene, camera));
  const std::vector<double> truth = renderCover(scene, camera, samples);
  double squares = 0;
  int pixels = 0;
  for (size_t i = 0; i < model.size(); ++i) {
    if (model[i] == 0 && truth[i] == 0) continue;
    squares += std::pow(255 * (model[i] - truth[i]), 2);
    ++pixels;
  }
  const double rmse = std::sqrt(squares / std::max(pixels, 1));
  if (rmse > 2) {
    writePfm(std::string(name) + "_actual.pfm", model, camera.width, camera.height);
    writePfm(std::string(name) + "_expected.pfm", truth, camera.width, camera.height);
  }
  return rmse;
}

// Samples along an edge so that a grid aligned with the strand counts its width to about 1/256.
int samplesFor(double width) { return width < 3 ? 256 : 64; }

TEST(ReferenceSampling, OneStrandAtAnyAngle) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double width : {0.02, 0.1, 0.3, 1.0, 2.0, 5.0, 20.0}) {
    double worst = 0;
    for (int i = 0; i < 24; ++i) {
      const double angle = i < 8 ? radians(i * 15) : uniform(random) * std::numbers::pi;
      const Camera camera = pixelCamera(72, 72);
      const double x = 36 + uniform(random), y = 36 + uniform(random);
      const double dx = 22 * std::cos(angle), dy = 22 * std::sin(angle);
      Scene scene;
      scene.hairs.resize(1);
      addLine(scene.hairs[0], camera, std::vector<Point>{{x - dx, y - dy}, {x, y}, {x + dx, y + dy}}, width);
      worst = std::max(worst, opacityError(scene, camera, samplesFor(width), "strand"));
    }
    std::printf("one strand, %5.2f px: worst RMSE %.3f / 255\n", width, worst);
    // The strip's coverage is exact; only the corners of the flush ends, where a product stands for the exact area
    // of a pixel cut by two lines, and the grid of samples differ: 1 / 255 is the bound asked of the model.
    EXPECT_LE(worst, 1) << width;
  }
}

TEST(ReferenceSampling, CrossingPair) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const double width : {0.1, 0.3, 1.0, 3.0, 8.0}) {
    double worst = 0, mean = 0;
    for (int i = 0; i < 24; ++i) {
      const Camera camera = pixelCamera(96, 96);
      Scene scene;
      scene.hairs.resize(1);
      scene.hairs[0].material.opacity_tip = 0.5;
      const double first = uniform(random) * std::numbers::pi;
      const double between = radians(20 + 140 * uniform(random));
      for (const double angle : {first, first + between}) {
        const double x = 48 + uniform(random), y = 48 + uniform(random);
        const double dx = 36 * std::cos(angle), dy = 36 * std::sin(angle);
        addLine(scene.hairs[0], camera, std::vector<Point>{{x - dx, y - dy}, {x + dx, y + dy}}, width, angle);
      }
      const double error = opacityError(scene, camera, samplesFor(width), "crossing");
      worst = std::max(worst, error);
      mean += error / 24;
    }
    std::printf("crossing pair, %4.1f px: mean RMSE %.3f, worst %.3f / 255\n", width, mean, worst);
    // Where they cross, the layers multiply as if independent inside a pixel, off by at most 1/4 in opacity on the
    // 2 w / sin pixels along the overlap's border out of some 140 (w + 1): under 2 / 255 unless nearly parallel.
    EXPECT_LE(worst, 2) << width;
  }
}

// A bend is exact nowhere in its pixels; reported, and bounded where hair has it: up to 30 degrees a joint.
TEST(ReferenceSampling, BentStrand) {
  for (const double width : {0.3, 1.0, 4.0}) {
    for (const double bend : {5.0, 15.0, 30.0, 60.0, 120.0}) {
      double worst = 0;
      for (int i = 0; i < 16; ++i) {
        const Camera camera = pixelCamera(128, 128);
        std::vector<Point> points = bentLine(10, 8, radians(bend), true, i * 0.3);
        double cx = 0, cy = 0;
        for (const Point& p : points) {
          cx += p.x / double(points.size());
          cy += p.y / double(points.size());
        }
        for (Point& p : points) p = {p.x - cx + 64 + i / 16.0, p.y - cy + 64 + (i * 7 % 16) / 16.0};
        Scene scene;
        scene.hairs.resize(1);
        addLine(scene.hairs[0], camera, points, width);
        worst = std::max(worst, opacityError(scene, camera, samplesFor(width), "bent"));
      }
      std::printf("bent strand, %3.1f px, %3.0f degrees every 10 px: worst RMSE %.3f / 255\n", width, bend, worst);
      // The wedge a joint adds or takes inside its pixels is tan(bend / 2) / 2 of a pixel at most over some three
      // pixels of the (w + 1.5) 10 a segment covers.
      const double bound = 255 * std::tan(radians(bend) / 2) / 2 * std::sqrt(3 / (10 * (width + 1.5)));
      EXPECT_LE(worst, 1 + bound);
    }
  }
}

}  // namespace
}  // namespace forelock::reference
