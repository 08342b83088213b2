// Crops and shifts of matrices, and the search for a zoom.
#include "views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::study {
namespace {

samples::Camera camera(bool orthographic) {
  samples::Camera c;
  c.eye = {0.85, 0.18, 1.45}, c.target = {0, -0.045, -0.01};
  c.orthographic = orthographic;
  return c;
}

// fp32 matrices: a hundred-thousandth of the picture's width in pixels.
constexpr double kTolerance = 2e-3;

TEST(StudyViews, ACropKeepsItsPixels) {
  for (const bool orthographic : {false, true}) {
    const Matrices whole = matricesOf(camera(orthographic), 1920, 1200);
    const Rect rect{700, 330, 480, 300};
    const reference::Camera all = referenceCamera(whole, 1920, 1200, {0, 0, 1920, 1200});
    const reference::Camera part = referenceCamera(whole, 1920, 1200, rect);
    const reference::Camera device = referenceCamera(cropped(whole, 1920, 1200, rect), 480, 300, {0, 0, 480, 300});
    for (const reference::Vec3 p : {reference::Vec3{0, 0, 0}, {0.05, -0.1, 0.02}, {-0.1, 0.08, -0.09}}) {
      const reference::Projected in_all = project(all, p), in_part = project(part, p), on_device = project(device, p);
      EXPECT_NEAR(in_part.x, in_all.x - 700, 1e-9);
      EXPECT_NEAR(in_part.y, in_all.y - 330, 1e-9);
      EXPECT_NEAR(on_device.x, in_part.x, kTolerance);
      EXPECT_NEAR(on_device.y, in_part.y, kTolerance);
      EXPECT_NEAR(in_part.depth, in_all.depth, 1e-12);
    }
  }
}

TEST(StudyViews, AShiftMovesThePictureRightAndDown) {
  for (const bool orthographic : {false, true}) {
    const Matrices whole = matricesOf(camera(orthographic), 1920, 1200);
    const Rect frame{0, 0, 1920, 1200};
    const reference::Projected before = project(referenceCamera(whole, 1920, 1200, frame), {0.05, -0.1, 0.02});
    const reference::Projected after = project(referenceCamera(shifted(whole, 1920, 1200, 0.31, 0.17), 1920, 1200, frame), {0.05, -0.1, 0.02});
    EXPECT_NEAR(after.x - before.x, 0.31, kTolerance);
    EXPECT_NEAR(after.y - before.y, 0.17, kTolerance);
  }
}

TEST(StudyViews, ZoomIsFoundInFewSteps) {
  // Pixels fall with the square of the tangent, and no more than a frame is covered.
  for (const double wanted : {35e3, 78e3, 198e3, 365e3}) {
    int steps = 0;
    const ZoomFound found = findZoom(wanted, 0.02, 0.009, 1.7, 0.2, [&](double t) { return ++steps, std::min(2.0e6, 9e3 / (t * t)); });
    EXPECT_TRUE(found.reached) << wanted;
    EXPECT_NEAR(found.pixels / wanted, 1, 0.02);
    EXPECT_LE(steps, 3) << wanted;
  }
}

TEST(StudyViews, ZoomCopesWithAnotherLaw) {
  for (const double power : {0.3, 1.0, 3.0, 4.0}) {
    int steps = 0;
    const ZoomFound found = findZoom(198e3, 0.02, 0.009, 1.7, 0.2, [&](double t) { return ++steps, 1e5 * std::pow(0.2 / t, power); });
    EXPECT_TRUE(found.reached) << power;
    EXPECT_LE(steps, 20) << power;
  }
}

TEST(StudyViews, AZoomThatIsNotThereEndsAtTheNearest) {
  const ZoomFound found = findZoom(198e3, 0.02, 0.009, 1.7, 0.2, [](double t) { return std::min(1e5, 9e3 / (t * t)); });
  EXPECT_FALSE(found.reached);
  EXPECT_EQ(found.pixels, 1e5);
  EXPECT_FALSE(findZoom(198e3, 0.02, 0.009, 1.7, 0.2, [](double) { return 0.0; }).reached);
}

TEST(StudyViews, HairsRectangleIsPaddedWithinTheFrame) {
  std::vector<float> rgba(20 * 10 * 4, 0);
  rgba[(4 * 20 + 3) * 4 + 3] = 0.5f;
  rgba[(6 * 20 + 17) * 4 + 3] = 1e-4f;
  uint64_t pixels = 0;
  const Rect rect = hairRect(rgba, 20, 10, 2, pixels);
  EXPECT_EQ(pixels, 2u);
  EXPECT_EQ(rect.x, 1u);
  EXPECT_EQ(rect.y, 2u);
  EXPECT_EQ(rect.width, 19u);
  EXPECT_EQ(rect.height, 7u);
}

}  // namespace
}  // namespace forelock::study
