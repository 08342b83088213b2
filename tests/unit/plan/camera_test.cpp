// The host's camera: what is taken, what is refused, and which pixels a box can touch.
#include "plan/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace forelock {
namespace {

struct Projection {
  float m[16] = {};
};

// Vulkan perspective with y down; `reversed` swaps near and far, far_plane 0 is infinity.
Projection perspective(double tan_half, double aspect, double near_plane, double far_plane, bool reversed) {
  Projection p;
  p.m[0] = float(1 / (tan_half * aspect));
  p.m[5] = float(-1 / tan_half);
  p.m[11] = -1;
  const bool infinite = far_plane == 0;
  if (reversed) {
    p.m[10] = infinite ? 0 : float(near_plane / (far_plane - near_plane));
    p.m[14] = infinite ? float(near_plane) : float(far_plane * near_plane / (far_plane - near_plane));
  } else {
    p.m[10] = infinite ? -1 : float(far_plane / (near_plane - far_plane));
    p.m[14] = infinite ? float(-near_plane) : float(far_plane * near_plane / (near_plane - far_plane));
  }
  return p;
}

TEST(Camera, FindsTheNearPlaneOfEveryConvention) {
  for (const bool reversed : {false, true})
    for (const double far_plane : {100.0, 0.0}) {
      Camera camera;
      EXPECT_EQ(
          makeCamera(kIdentity.data(), perspective(0.5, 1.5, 0.25, far_plane, reversed).m, reversed, 300, 200, camera),
          nullptr)
          << reversed << far_plane;
      EXPECT_NEAR(camera.near_plane, 0.25, 1e-5);
      EXPECT_FALSE(camera.orthographic);
    }
}

TEST(Camera, TheWrongDepthConventionIsRefused) {
  Camera camera;
  EXPECT_NE(makeCamera(kIdentity.data(), perspective(0.5, 1, 0.25, 100, true).m, false, 100, 100, camera), nullptr);
  EXPECT_NE(makeCamera(kIdentity.data(), perspective(0.5, 1, 0.25, 100, false).m, true, 100, 100, camera), nullptr);
}

TEST(Camera, RefusesWhatItCannotDraw) {
  Camera camera;
  const Projection good = perspective(0.5, 1, 0.25, 100, false);
  for (int i = 0; i < 16; ++i) {
    Projection bad = good;
    bad.m[i] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(makeCamera(kIdentity.data(), bad.m, false, 100, 100, camera), nullptr) << i;
    Mat4 view = kIdentity;
    view[std::size_t(i)] = std::numeric_limits<double>::infinity();
    EXPECT_NE(makeCamera(view.data(), good.m, false, 100, 100, camera), nullptr) << i;
  }
  for (const int i : {1, 2, 3, 4, 6, 7, 12, 13, 15}) {
    Projection skewed = good;
    skewed.m[i] = 0.5f;
    EXPECT_NE(makeCamera(kIdentity.data(), skewed.m, false, 100, 100, camera), nullptr) << i;
  }
  Mat4 scaled = kIdentity;
  scaled[0] = 2;
  EXPECT_NE(makeCamera(scaled.data(), good.m, false, 100, 100, camera), nullptr);
  Projection flat = good;
  flat.m[0] = 0;
  EXPECT_NE(makeCamera(kIdentity.data(), flat.m, false, 100, 100, camera), nullptr);
}

// Every point of the box projects into the rectangle.
TEST(ScreenRect, HoldsEveryPointOfTheBox) {
  Camera camera;
  ASSERT_EQ(makeCamera(kIdentity.data(), perspective(0.5, 1.5, 0.1, 100, false).m, false, 300, 200, camera), nullptr);
  for (int seed = 0; seed < 200; ++seed) {
    const double s = seed * 0.37;
    const Vec3 center{std::sin(s) * 2, std::cos(s * 1.7) * 2, -3 + 2.5 * std::sin(s * 0.3)};
    const Box box{center - Vec3{0.3, 0.2, 0.4}, center + Vec3{0.3, 0.2, 0.4}};
    double nearest = 0, farthest = 0;
    const Rect rect = screenRect(camera, kIdentity, box, 0.01, nearest, farthest);
    for (int corner = 0; corner < 27; ++corner) {
      const Vec3 p{center[0] + 0.3 * (corner % 3 - 1), center[1] + 0.2 * (corner / 3 % 3 - 1),
                   center[2] + 0.4 * (corner / 9 - 1)};
      const double d = -p[2];
      EXPECT_GE(d, nearest);
      EXPECT_LE(d, farthest);
      if (d < camera.near_plane) continue;
      for (const double beside : {-0.01, 0.0, 0.01}) {  // as far as the margin says
        const double x = ((p[0] + beside) * camera.scale[0] / d * 0.5 + 0.5) * 300;
        const double y = ((p[1] + beside) * camera.scale[1] / d * 0.5 + 0.5) * 200;
        if (x < 0 || y < 0 || x >= 300 || y >= 200) continue;
        ASSERT_FALSE(rect.empty());
        EXPECT_GE(x, rect.x);
        EXPECT_GE(y, rect.y);
        EXPECT_LE(x, rect.x + rect.width);
        EXPECT_LE(y, rect.y + rect.height);
      }
    }
  }
}

TEST(ScreenRect, BehindTheCameraIsOutOfView) {
  Camera camera;
  ASSERT_EQ(makeCamera(kIdentity.data(), perspective(0.5, 1, 0.1, 100, false).m, false, 100, 100, camera), nullptr);
  double nearest = 0, farthest = 0;
  EXPECT_TRUE(screenRect(camera, kIdentity, {{-1, -1, 1}, {1, 1, 2}}, 0.01, nearest, farthest).empty());
  EXPECT_FALSE(screenRect(camera, kIdentity, {{-1, -1, -1}, {1, 1, 2}}, 0.01, nearest, farthest).empty());
  EXPECT_TRUE(screenRect(camera, kIdentity, {{50, -1, -2}, {51, 1, -1}}, 0.01, nearest, farthest).empty());
}

}  // namespace
}  // namespace forelock
