// SPDX-License-Identifier: MIT
#include "camera.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace forelock::samples {
namespace {

struct Projected {
  double x, y, z;  // normalised device coordinates
};

Projected project(const Camera& camera, double aspect, const glm::dvec3& p) {
  double view[16];
  float projection[16];
  viewMatrix(camera, view);
  projectionMatrix(camera, aspect, projection);
  const double in[4] = {p.x, p.y, p.z, 1.0};
  double eye[4] = {}, clip[4] = {};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      eye[row] += view[4 * column + row] * in[column];
    }
  }
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      clip[row] += static_cast<double>(projection[4 * column + row]) * eye[column];
    }
  }
  return {clip[0] / clip[3], clip[1] / clip[3], clip[2] / clip[3]};
}

TEST(SampleCamera, DepthRunsFromNearToFarAndYRunsDown) {
  for (bool orthographic : {false, true}) {
    for (bool reversed : {false, true}) {
      Camera camera;
      camera.eye = glm::dvec3(0, 0, 2);
      camera.near_m = 0.5;
      camera.far_m = 8.0;
      camera.orthographic = orthographic;
      camera.reversed_depth = reversed;
      const double at_near = reversed ? 1.0 : 0.0;
      // The matrix is float: 1e-6 is a few ulp of its entries.
      EXPECT_NEAR(project(camera, 1.5, {0, 0, 1.5}).z, at_near, 1e-6);
      EXPECT_NEAR(project(camera, 1.5, {0, 0, -6.0}).z, 1.0 - at_near, 1e-6);
      EXPECT_LT(project(camera, 1.5, {0, 0.1, 0}).y, 0.0);  // up in the world is up in the framebuffer: smaller y
      EXPECT_GT(project(camera, 1.5, {0.1, 0, 0}).x, 0.0);
    }
  }
}

TEST(SampleCamera, FramingSeesTheWholeBoxFromEverywhere) {
  const float low[3] = {-0.3f, -0.4f, -0.1f};
  const float high[3] = {0.2f, 0.15f, 0.25f};
  for (UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    for (double azimuth : {0.0, 0.7, 3.0, -2.0}) {
      for (double elevation : {0.0, 0.5, -1.2, 1.5707963267948966}) {
        for (double aspect : {0.4, 1.0, 2.5}) {
          const Camera camera = frameBounds(low, high, azimuth, elevation, up, 0.6, aspect, 1.05);
          double widest = 0.0;
          for (int corner = 0; corner < 8; ++corner) {
            const Projected p = project(camera, aspect, {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                                         corner & 4 ? high[2] : low[2]});
            widest = std::max({widest, std::fabs(p.x), std::fabs(p.y)});
            EXPECT_GT(p.z, 0.0);
            EXPECT_LT(p.z, 1.0);
          }
          EXPECT_LE(widest, 1.0 / 1.05 + 1e-5);
          EXPECT_GT(widest, 0.6);  // and fills the picture in one direction
        }
      }
    }
  }
}

TEST(SampleCamera, AzimuthZeroIsTheFront) {
  const float low[3] = {-1, -1, -1};
  const float high[3] = {1, 1, 1};
  EXPECT_GT(frameBounds(low, high, 0.0, 0.0, UpAxis::Y, 0.6, 1.0, 1.0).eye.z, 1.0);
  EXPECT_LT(frameBounds(low, high, 0.0, 0.0, UpAxis::Z, 0.6, 1.0, 1.0).eye.y, -1.0);
  EXPECT_GT(frameBounds(low, high, 1.5707963, 0.0, UpAxis::Y, 0.6, 1.0, 1.0).eye.x, 1.0);
  EXPECT_GT(frameBounds(low, high, 0.0, 0.5, UpAxis::Y, 0.6, 1.0, 1.0).eye.y, 0.5);
}

TEST(SampleCamera, BoundsWithoutExtentStillGiveACamera) {
  const float point[3] = {3.0f, 4.0f, 5.0f};
  const Camera camera = frameBounds(point, point, 0.3, 0.2, UpAxis::Y, 0.6, 1.0, 1.05);
  EXPECT_GT(camera.near_m, 0.0);
  EXPECT_GT(camera.far_m, camera.near_m);
  EXPECT_GT(glm::length(camera.eye - camera.target), 0.0);
}

}  // namespace
}  // namespace forelock::samples
