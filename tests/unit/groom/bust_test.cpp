// SPDX-License-Identifier: MIT
#include "bust.h"

#include "bust_shape.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace forelock::samples {
namespace {

// Every depth in the image is a point on the surface; every hole is a ray that a plain march also finds empty.
TEST(Bust, DepthImageLiesOnTheSurface) {
  for (bool orthographic : {false, true}) {
    float low[3], high[3];
    bustBounds(low, high);
    Camera camera = frameBounds(low, high, 0.6, 0.2, UpAxis::Y, 0.5, 4.0 / 3.0, 1.05);
    camera.orthographic = orthographic;
    camera.view_height = 0.65;
    constexpr uint32_t width = 160, height = 120;
    const BustImage image = drawBust(camera, width, height, BustLook{});
    const CameraBasis basis = cameraBasis(camera);
    const double half = orthographic ? 0.5 * camera.view_height : std::tan(0.5 * camera.vertical_fov);
    uint32_t covered = 0;
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const double px = (x + 0.5 - 0.5 * width) * 2.0 * half / height;
        const double py = (0.5 * height - y - 0.5) * 2.0 * half / height;
        const glm::dvec3 across = basis.right * px + basis.up * py;
        const glm::dvec3 origin = orthographic ? camera.eye + across : camera.eye;
        const glm::dvec3 direction = orthographic ? -basis.back : across - basis.back;  // view depth 1
        const float depth = image.depth[y * width + x];
        if (std::isfinite(depth)) {
          ++covered;
          EXPECT_EQ(image.color.pixel(x, y)[3], 1.0f);
          // A third of a pixel's footprint (about 6 mm here) is called a hit.
          EXPECT_LT(std::fabs(shape::bust<double>(origin + direction * static_cast<double>(depth))), 0.0025);
        } else {
          double nearest = 1.0;
          for (double t = camera.near_m; t < camera.far_m; t += 0.004) {
            nearest = std::min(nearest, shape::bust<double>(origin + direction * t));
          }
          EXPECT_GT(nearest, -0.001) << x << " " << y;
        }
      }
    }
    EXPECT_GT(covered, width * height / 6);
  }
}

}  // namespace
}  // namespace forelock::samples
