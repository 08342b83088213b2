// The camera that the mouse moves.
#include "orbit.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace forelock::samples;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kHeight = 800.0, kWidth = 1200.0;

// Pixels from the middle, y down.
glm::dvec2 pixelOf(const Camera& camera, const glm::dvec3& point) {
  const CameraBasis basis = cameraBasis(camera);
  const glm::dvec3 d = point - camera.eye;
  const double depth = -glm::dot(d, basis.back), focal = 0.5 * kHeight / std::tan(0.5 * camera.vertical_fov);
  return {focal * glm::dot(d, basis.right) / depth, -focal * glm::dot(d, basis.up) / depth};
}

double depthOf(const Camera& camera, const glm::dvec3& point) { return -glm::dot(point - camera.eye, cameraBasis(camera).back); }

Bounds boundsOf(double size) { return {glm::dvec3(-0.5 * size), glm::dvec3(0.5 * size, 0.3 * size, 0.2 * size)}; }

Orbit randomOrbit(std::mt19937& dice, double size) {
  const auto real = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  Orbit orbit;
  orbit.target = glm::dvec3(real(-1, 1), real(-1, 1), real(-1, 1)) * size;
  orbit.distance = size * std::exp(real(-3, 3));
  orbit.azimuth = real(-kPi, kPi);
  orbit.elevation = real(-kMostElevation, kMostElevation);
  orbit.up = dice() % 2 ? UpAxis::Y : UpAxis::Z;
  orbit.vertical_fov = real(0.05, 2.0);
  return orbit;
}

}  // namespace

TEST(Orbit, CamerasGiveTheirOrbitBack) {
  std::mt19937 dice(7);
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (int i = 0; i < 1000; ++i) {
      const Orbit orbit = randomOrbit(dice, size);
      const Orbit back = orbitOf(cameraOf(orbit, boundsOf(size)), orbit.up);
      EXPECT_EQ(back.target, orbit.target);
      EXPECT_NEAR(back.distance / orbit.distance, 1.0, 1e-9);
      EXPECT_NEAR(std::remainder(back.azimuth - orbit.azimuth, 2 * kPi), 0.0, 1e-9);
      EXPECT_NEAR(back.elevation, orbit.elevation, 1e-9);
      EXPECT_EQ(back.vertical_fov, orbit.vertical_fov);
      EXPECT_EQ(back.up, orbit.up);
    }
  }
}

TEST(Orbit, LooksFromWhereFramingDoes) {
  const float low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
  for (const UpAxis up : {UpAxis::Y, UpAxis::Z}) {
    const Camera framed = frameBounds(low, high, 0.7, -0.3, up, 0.5, 1.5, 1.0);
    const Orbit orbit = orbitOf(framed, up);
    EXPECT_NEAR(orbit.azimuth, 0.7, 1e-12);
    EXPECT_NEAR(orbit.elevation, -0.3, 1e-12);
    const Camera camera = cameraOf(orbit, {glm::dvec3(-1), glm::dvec3(1)});
    EXPECT_NEAR(glm::length(camera.eye - framed.eye), 0.0, 1e-12);
  }
}

TEST(Orbit, OrthographicCamerasKeepTheSizeOfTheTarget) {
  Camera flat;
  flat.orthographic = true;
  flat.view_height = 3.0;
  const Orbit orbit = orbitOf(flat, UpAxis::Y);
  EXPECT_NEAR(2.0 * orbit.distance * std::tan(0.5 * orbit.vertical_fov), 3.0, 1e-12);
}

TEST(Orbit, WhatFacesTheEyeGoesWithTheMouse) {
  std::mt19937 dice(3);
  for (int i = 0; i < 200; ++i) {
    Orbit orbit = randomOrbit(dice, 1.0);
    orbit.elevation *= 0.5;
    const Camera before = cameraOf(orbit, boundsOf(1));
    const glm::dvec3 front = orbit.target + (before.eye - orbit.target) * 0.1;
    Orbit turned = orbit;
    turned.turn(20.0, 0.0, kHeight);
    EXPECT_GT(pixelOf(cameraOf(turned, boundsOf(1)), front).x, 0.0);
    turned = orbit;
    turned.turn(0.0, 20.0, kHeight);
    EXPECT_GT(pixelOf(cameraOf(turned, boundsOf(1)), front).y, 0.0);
    EXPECT_EQ(turned.target, orbit.target);
    EXPECT_EQ(turned.distance, orbit.distance);
  }
}

TEST(Orbit, TurnsWrapAroundAndStopAtThePoles) {
  Orbit orbit;
  for (int i = 0; i < 100; ++i) {
    orbit.turn(-333.0, 0.0, kHeight);
    EXPECT_LE(std::fabs(orbit.azimuth), kPi);
  }
  EXPECT_NEAR(std::remainder(orbit.azimuth - 33300.0 * kPi / kHeight, 2 * kPi), 0.0, 1e-9);
  orbit.turn(0.0, 1e6, kHeight);
  EXPECT_EQ(orbit.elevation, kMostElevation);
  orbit.turn(0.0, -1e6, kHeight);
  EXPECT_EQ(orbit.elevation, -kMostElevation);
  orbit.turn(5.0, 0.0, 0.0);
  EXPECT_TRUE(std::isfinite(orbit.azimuth)) << "a window without height";
}

TEST(Orbit, PanningMovesWhatIsUnderTheMouse) {
  std::mt19937 dice(4);
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (int i = 0; i < 200; ++i) {
      Orbit orbit = randomOrbit(dice, size);
      const Camera before = cameraOf(orbit, boundsOf(size));
      const CameraBasis basis = cameraBasis(before);
      const glm::dvec3 point = orbit.target + (basis.right * 0.1 - basis.up * 0.07) * orbit.distance;
      const glm::dvec2 at = pixelOf(before, point);
      orbit.pan(13.0, -57.0, kHeight);
      const glm::dvec2 now = pixelOf(cameraOf(orbit, boundsOf(size)), point);
      EXPECT_NEAR(now.x - at.x, 13.0, 1e-6);
      EXPECT_NEAR(now.y - at.y, -57.0, 1e-6);
    }
  }
}

TEST(Orbit, ZoomingKeepsWhatIsUnderTheCursor) {
  std::mt19937 dice(5);
  for (const double size : {1e-3, 1.0, 1e3}) {
    for (int i = 0; i < 200; ++i) {
      Orbit orbit = randomOrbit(dice, size);
      const Camera before = cameraOf(orbit, boundsOf(size));
      const CameraBasis basis = cameraBasis(before);
      const glm::dvec3 point = orbit.target + (basis.right * -0.1 + basis.up * 0.2) * orbit.distance;
      const glm::dvec2 cursor = pixelOf(before, point);
      orbit.zoom(i % 2 ? 2.5 : -2.5, cursor, kHeight, size);
      const glm::dvec2 now = pixelOf(cameraOf(orbit, boundsOf(size)), point);
      EXPECT_NEAR(now.x, cursor.x, 1e-6);
      EXPECT_NEAR(now.y, cursor.y, 1e-6);
    }
  }
}

TEST(Orbit, ZoomIsExponentialAndBounded) {
  Orbit orbit;
  orbit.distance = 2.0;
  orbit.zoom(1.0, {0, 0}, kHeight, 1.0);
  const double factor = orbit.distance / 2.0;
  EXPECT_NEAR(factor, 0.875, 0.001);
  orbit.zoom(1.0, {0, 0}, kHeight, 1.0);
  EXPECT_NEAR(orbit.distance, 2.0 * factor * factor, 1e-12);
  orbit.zoom(-2.0, {0, 0}, kHeight, 1.0);
  EXPECT_NEAR(orbit.distance, 2.0, 1e-12);
  for (const double size : {1e-3, 1.0, 1e3}) {
    orbit.distance = size;
    orbit.target = glm::dvec3(0.0);
    orbit.zoom(1e5, {300, 200}, kHeight, size);
    EXPECT_NEAR(orbit.distance, 1e-6 * size, 1e-18 * size);
    const glm::dvec3 stopped = orbit.target;
    orbit.zoom(3.0, {300, 200}, kHeight, size);
    EXPECT_EQ(orbit.target, stopped) << "at the bound nothing moves";
    orbit.zoom(-1e5, {0, 0}, kHeight, size);
    EXPECT_NEAR(orbit.distance, 1e6 * size, 1e-3 * size);
    const Camera camera = cameraOf(orbit, boundsOf(size));
    EXPECT_GT(camera.near_m, 0.0);
    EXPECT_LT(camera.near_m, camera.far_m);
  }
}

TEST(Orbit, PlanesEncloseTheScene) {
  std::mt19937 dice(6);
  for (const double size : {1e-3, 1.0, 1e3}) {
    const Bounds bounds = boundsOf(size);
    for (int i = 0; i < 2000; ++i) {
      const Camera camera = cameraOf(randomOrbit(dice, size), bounds);
      EXPECT_GE(camera.near_m, camera.far_m / 1e5 * (1 - 1e-12));
      EXPECT_LT(camera.near_m, camera.far_m);
      EXPECT_GT(camera.near_m, 0.0);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) ? bounds.high.x : bounds.low.x, (corner & 2) ? bounds.high.y : bounds.low.y,
                           (corner & 4) ? bounds.high.z : bounds.low.z);
        const double depth = depthOf(camera, p);
        EXPECT_TRUE(depth < 1e-5 * camera.far_m * (1 + 1e-12) || depth >= camera.near_m) << depth;
        EXPECT_LE(depth, camera.far_m);
      }
    }
  }
}

TEST(Orbit, AllBehindTheEyeStillHasPlanes) {
  Orbit orbit;
  orbit.target = {0, 0, -100};
  orbit.distance = 1.0;
  const Camera camera = cameraOf(orbit, boundsOf(1));
  EXPECT_GT(camera.far_m, camera.near_m);
  EXPECT_GT(camera.near_m, 0.0);
}

TEST(Orbit, FramingSeesEverythingAndFillsThePicture) {
  std::mt19937 dice(8);
  for (const double size : {1e-3, 1.0, 1e3}) {
    Orbit orbit = randomOrbit(dice, size);
    orbit.vertical_fov = 0.5;
    std::vector<glm::vec3> points;
    for (int i = 0; i < 300; ++i) {
      const auto normal = [&](float spread) { return std::normal_distribution<float>(0, spread)(dice) * float(size); };
      points.emplace_back(normal(0.1f), normal(0.2f), normal(0.1f));
    }
    const double azimuth = orbit.azimuth;
    orbit.frame(points, 0.0, kWidth / kHeight, 1.0);
    EXPECT_EQ(orbit.azimuth, azimuth);
    const Camera camera = cameraOf(orbit, {glm::dvec3(-1.0) * size, glm::dvec3(1.0) * size});
    double x = 0.0, y = 0.0;
    for (const glm::vec3& p : points) {
      const glm::dvec2 pixel = pixelOf(camera, glm::dvec3(p));
      x = std::max(x, std::fabs(pixel.x)), y = std::max(y, std::fabs(pixel.y));
    }
    EXPECT_LE(x, 0.5 * kWidth * 1.0001);
    EXPECT_LE(y, 0.5 * kHeight * 1.0001);
    EXPECT_GT(std::max(x / kWidth, y / kHeight), 0.499) << "as near as it can be";
  }
}

// A scene a thousandth or a thousand times as large gives the same picture of every step. Powers of two, which make it exact but for
// sums: 1e-9 of the size is far above what these lose.
TEST(Orbit, IsTheSameAtEveryScale) {
  const auto walk = [](double size) {
    std::vector<glm::vec3> points{{0.1f, 0.2f, 0.3f}, {-0.4f, 0.1f, 0.0f}, {0.0f, -0.5f, 0.2f}};
    for (glm::vec3& p : points) p *= float(size);
    Orbit orbit;
    orbit.target *= size;
    orbit.frame(points, 0.001 * size, 1.5);
    orbit.turn(120, -60, kHeight);
    orbit.zoom(9, {200, -100}, kHeight, size);
    orbit.pan(-40, 70, kHeight);
    orbit.zoom(-3, {-20, 10}, kHeight, size);
    return orbit;
  };
  const Orbit one = walk(1.0);
  const Camera camera = cameraOf(one, boundsOf(1));
  for (const double size : {0x1p-10, 0x1p-20, 0x1p10, 0x1p20}) {
    const Orbit other = walk(size);
    EXPECT_NEAR(other.distance / size, one.distance, 1e-9);
    EXPECT_EQ(other.azimuth, one.azimuth);
    EXPECT_EQ(other.elevation, one.elevation);
    EXPECT_NEAR(glm::length(other.target / size - one.target), 0.0, 1e-9);
    const Camera scaled = cameraOf(other, boundsOf(size));
    EXPECT_NEAR(scaled.near_m / size, camera.near_m, 1e-9);
    EXPECT_NEAR(scaled.far_m / size, camera.far_m, 1e-9);
  }
}

TEST(Orbit, ApproachBeginsAndEndsExactlyAndNeverTurnsBack) {
  std::mt19937 dice(9);
  for (int i = 0; i < 100; ++i) {
    Orbit from = randomOrbit(dice, 1.0), to = randomOrbit(dice, 1.0);
    from.up = to.up;
    const Orbit start = approach(from, to, 0.0), end = approach(from, to, kApproachSeconds);
    EXPECT_EQ(start.distance, from.distance);
    EXPECT_EQ(start.target, from.target);
    EXPECT_EQ(end.distance, to.distance);
    EXPECT_EQ(end.azimuth, to.azimuth);
    EXPECT_EQ(end.target, to.target);
    EXPECT_EQ(approach(from, to, 9.0).elevation, to.elevation);
    double before = glm::length(from.target - to.target), step_before = 1e9;
    for (int step = 1; step <= 25; ++step) {
      const Orbit now = approach(from, to, 0.01 * step);
      const double left = glm::length(now.target - to.target);
      EXPECT_LT(left, before);
      EXPECT_LE(before - left, step_before * (1 + 1e-9)) << "slower towards the end";
      step_before = before - left;
      before = left;
      EXPECT_GE(now.distance, std::min(from.distance, to.distance) * (1 - 1e-12));
      EXPECT_LE(now.distance, std::max(from.distance, to.distance) * (1 + 1e-12));
    }
  }
  Orbit from, to;
  from.azimuth = 3.0, to.azimuth = -3.0;
  EXPECT_GT(std::fabs(approach(from, to, 0.05).azimuth), 3.0) << "the short way round";
}

TEST(ViewDepth, IsTheInverseOfTheProjection) {
  for (const bool flat : {false, true}) {
    for (const bool reversed : {false, true}) {
      Camera camera;
      camera.orthographic = flat;
      camera.reversed_depth = reversed;
      camera.near_m = 0.02;
      camera.far_m = 50.0;
      float projection[16];
      projectionMatrix(camera, 1.5, projection);
      for (const double depth : {0.02, 0.1, 1.0, 7.0, 49.0}) {
        const double z = static_cast<double>(projection[10]) * -depth + static_cast<double>(projection[14]);
        const double w = flat ? 1.0 : depth;
        // The matrix has 24 bits: of a perspective depth that is d^2 / near of the value's 2^-24, twice over.
        const double tolerance = (flat ? 50.0 : depth * depth / 0.02) * 0x1p-22 + 1e-9;
        EXPECT_NEAR(viewDepth(camera, z / w), depth, tolerance) << flat << reversed;
      }
      EXPECT_TRUE(std::isinf(viewDepth(camera, reversed ? 0.0 : 1.0)));
    }
  }
}
