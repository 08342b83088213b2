// Coverage of section 2 against areas known in closed form.
#include "reference_support.h"

namespace forelock::reference {
namespace {

// Relative error of the coverage summed over whole pixel rows (columns for a flat strand) against width x length.
double worstWidthError(const Camera& camera, double pixel_aspect, double angle, double width_px) {
  const double sx = 1 / pixel_aspect;  // pixels per metre; one metre is one pixel vertically
  double worst = 0;
  for (int offset = 0; offset < 64; ++offset) {
    const double ox = (offset % 8) / 8.0, oy = (offset / 8) / 8.0;
    const double dx = std::cos(angle) * 2000, dy = std::sin(angle) * 2000;  // pixels
    Scene scene;
    scene.hairs.resize(1);
    const Vec3 ends[2] = {{(ox - dx) / sx, oy - dy, 0}, {(ox + dx) / sx, oy + dy, 0}};
    addStrand(scene.hairs[0].strands, ends, width_px / 2);
    const FragmentLists lists = gatherFragments(scene, camera);
    const bool rows = std::fabs(dy) >= std::fabs(dx);
    const int middle = (rows ? camera.height : camera.width) / 2, across = rows ? camera.width : camera.height;
    double sum = 0;
    for (int i = middle - 4; i < middle + 4; ++i) {
      for (int j = 0; j < across; ++j) {
        for (const Fragment& f : rows ? lists.at(j, i) : lists.at(i, j)) sum += f.coverage;
      }
    }
    // Area in square metres times pixels per square metre; the length is that of the axis within the eight lines.
    const double per_line = rows ? 1 / std::fabs(dy) : 1 / std::fabs(dx);
    const double expected = width_px * 8 * per_line * std::hypot(dx / sx, dy) * sx;
    worst = std::max(worst, std::fabs(sum / expected - 1));
  }
  return worst;
}

TEST(ReferenceCoverage, PixelSumIsTheWidthAtEveryAngleWidthAndOffset) {
  const double angles[] = {0, 10, 26.57, 30, 45, 63.43, 90};
  const double widths[] = {0.001, 0.1, 1, 5, 200};
  double worst_all = 0;
  for (const double aspect : {1.0, 16.0 / 9}) {
    for (const bool wide : {true, false}) {
      const Camera camera = wide ? pixelCamera(576, 324, aspect) : pixelCamera(320, 640, aspect);
      for (const double angle : angles) {
        for (const double width : widths) {
          // Pixels that are not square widen a flat strand on the screen; it has to fit into the target.
          if (width > 100 && aspect != 1) continue;
          const double error = worstWidthError(camera, aspect, radians(angle), width);
          worst_all = std::max(worst_all, error);
          // The summands are exact areas of a partition: only rounding is left. F loses 1e-16 of 1/2 against a
          // coverage of the width, so 1e-16 / 0.001 for the thinnest; 1e-10 leaves room for the positions' rounding.
          EXPECT_LT(error, 1e-10) << width << " px at " << angle << " degrees";
        }
      }
    }
  }
  std::printf("coverage: worst relative error of the width %.2e\n", worst_all);
}

TEST(ReferenceCoverage, HalfAreaMatchesPolygonClipping) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 200; ++i) {
    const double angle = uniform(random) * 2 * std::numbers::pi, t = uniform(random) * 2 - 1;
    const double nx = std::cos(angle), ny = std::sin(angle);
    // Area of {p in the unit square around 0 : p.n <= t} by Sutherland-Hodgman and the shoelace formula.
    const Point square[4] = {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    std::vector<Point> kept;
    for (int k = 0; k < 4; ++k) {
      const Point p = square[k], q = square[(k + 1) % 4];
      const double dp = p.x * nx + p.y * ny - t, dq = q.x * nx + q.y * ny - t;
      if (dp <= 0) kept.push_back(p);
      if ((dp <= 0) != (dq <= 0)) {
        kept.push_back({p.x + (q.x - p.x) * dp / (dp - dq), p.y + (q.y - p.y) * dp / (dp - dq)});
      }
    }
    double area = 0;
    for (size_t k = 0; k < kept.size(); ++k) {
      const Point p = kept[k], q = kept[(k + 1) % kept.size()];
      area += (p.x * q.y - q.x * p.y) / 2;
    }
    EXPECT_NEAR(pixelHalfArea(t, nx, ny) + 0.5, area, 1e-12);  // a dozen roundings of numbers of order 1
  }
}

TEST(ReferenceCoverage, EqualLayersMultiply) {
  const Camera camera = pixelCamera(32, 32);
  for (const int layers : {1, 2, 5, 40}) {
    for (const double opacity : {0.003, 0.25, 0.9, 1.0}) {
      Scene scene;
      scene.hairs.resize(1);
      scene.hairs[0].material.opacity_root = scene.hairs[0].material.opacity_tip = opacity;
      for (int i = 0; i < layers; ++i) addLine(scene.hairs[0], camera, std::vector<Point>{{-50, 16}, {80, 16}}, 9);
      const double expected = 1 - std::pow(1 - opacity, layers);
      const FragmentLists lists = gatherFragments(scene, camera);
      EXPECT_NEAR(opacityOf(lists)[16 * 32 + 16], expected, 1e-13);
      EXPECT_NEAR(opacityOf(resolve(scene, camera, {}, lists))[16 * 32 + 16], expected, 1e-13);
      EXPECT_NEAR(renderCover(scene, camera)[16 * 32 + 16], expected, 1e-13);
    }
  }
}

TEST(ReferenceCoverage, TaperedStrandHasItsMeanWidth) {
  double sum = 0, worst = 0;
  for (int offset = 0; offset < 64; ++offset) {
    const Camera camera = pixelCamera(64, 64);
    Scene scene;
    scene.hairs.resize(1);
    const Vec3 points[3] = {atPixel(camera, {10.0 + offset % 8 / 8.0, 14.0 + offset / 8 / 8.0}),
                            atPixel(camera, {26.0 + offset % 8 / 8.0, 26.0 + offset / 8 / 8.0}),
                            atPixel(camera, {42.0 + offset % 8 / 8.0, 38.0 + offset / 8 / 8.0})};
    const double radii[3] = {2, 1, 0};
    addStrand(scene.hairs[0].strands, points, radii);
    double area = 0;
    for (const Fragment& f : gatherFragments(scene, camera).fragments) area += f.coverage;
    sum += area / 64;
    worst = std::max(worst, std::fabs(area / 80 - 1));
  }
  std::printf("tapered: mean %+.4f %%, worst offset %.3f %%\n", 100 * (sum / 80 - 1), 100 * worst);
  // Mean width 2 px over 40 px. Each end's ramp sees the width change by at most slope x E^2 / 2 = 0.1 x 0.25 px^2,
  // and the strip's edges are tilted by 0.05, a second-order 0.1 %: below 0.2 % in all.
  EXPECT_NEAR(sum / 80, 1, 2e-3);
}

TEST(ReferenceCoverage, OpacityFollowsTheArcLength) {
  const Camera camera = pixelCamera(128, 16);
  Scene scene;
  scene.hairs.resize(1);
  scene.hairs[0].material.opacity_root = 0.8;
  scene.hairs[0].material.opacity_tip = 0.2;
  addLine(scene.hairs[0], camera, std::vector<Point>{{10, 8}, {20, 8}, {90, 8}, {110, 8}}, 6);
  const FragmentLists lists = gatherFragments(scene, camera);
  for (const int x : {12, 19, 50, 100}) {
    ASSERT_EQ(lists.at(x, 8).size(), 1u);
    EXPECT_NEAR(lists.at(x, 8)[0].alpha, 0.8 - 0.6 * (x + 0.5 - 10) / 100, 1e-12);
  }
}

TEST(ReferenceCoverage, PayloadCodes) {
  EXPECT_DOUBLE_EQ(codedAlpha(1, Payload::standard), 1);
  EXPECT_DOUBLE_EQ(codedAlpha(0.2e-6, Payload::standard), 0);  // below (0.5 / 1023)^2 = 2.4e-7
  EXPECT_DOUBLE_EQ(codedAlpha(0.0039, Payload::paper), 0);
  EXPECT_DOUBLE_EQ(codedAlpha(0.5, Payload::paper), 128.0 / 255);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  double worst[2] = {0, 0};
  for (int i = 0; i < 100000; ++i) {
    Vec3 v{normal(random), normal(random), normal(random)};
    const double l = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    v = {v.x / l, v.y / l, v.z / l};
    for (int p = 0; p < 2; ++p) {
      const Vec3 w = codedTangent(v, p ? Payload::paper : Payload::standard);
      worst[p] = std::max(worst[p], std::hypot(w.x - v.x, w.y - v.y, w.z - v.z));
    }
  }
  // Half a step (1 / 2046, 1 / 4094) in both components, stretched at most by 3 where the octahedron meets its faces.
  EXPECT_LT(worst[0], 1.5 * std::numbers::sqrt2 / 2046 * 2);
  EXPECT_LT(worst[1], 1.5 * std::numbers::sqrt2 / 4094 * 2);
  std::printf("tangent codes: worst %.4f and %.4f degrees\n", worst[0] / radians(1), worst[1] / radians(1));
  const Vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3& a : axes) {
    const Vec3 w = codedTangent(a, Payload::standard);
    EXPECT_NEAR(w.x * a.x + w.y * a.y + w.z * a.z, 1, 1e-15);
  }
}

}  // namespace
}  // namespace forelock::reference
