// SPDX-License-Identifier: MIT
#include "portable_math.h"

#include <gtest/gtest.h>

#include <cmath>

namespace forelock::samples {
namespace {

constexpr double kTurn = 6.283185307179586;

TEST(PortableMath, SineAgreesWithTheLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const double turns = i * 0.00137;
    // The series is cut below 3e-14; the reference's argument is rounded once more.
    EXPECT_NEAR(sinTurns(turns), std::sin(turns * kTurn), 1e-12) << turns;
    EXPECT_NEAR(cosTurns(turns), std::cos(turns * kTurn), 1e-12) << turns;
  }
}

TEST(PortableMath, ArcTangentAgreesWithTheLibrary) {
  for (int i = 0; i < 5000; ++i) {
    const double x = hashSigned(1, 2, static_cast<uint64_t>(i));
    const double y = hashSigned(1, 3, static_cast<uint64_t>(i));
    EXPECT_NEAR(atan2Turns(y, x), std::atan2(y, x) / kTurn, 1e-9) << y << " " << x;
  }
  EXPECT_EQ(atan2Turns(0.0, 0.0), 0.0);
  EXPECT_NEAR(atan2Turns(0.0, -1.0), 0.5, 1e-12);
}

TEST(PortableMath, HashIsUniform) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double u = hashUnit(9, 4, static_cast<uint64_t>(i));
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  // Five standard deviations of the mean: 5 sqrt(1/12 / n) = 0.0102; of the second moment: 5 sqrt(4/45 / n) = 0.0105.
  EXPECT_NEAR(sum / count, 0.5, 0.0102);
  EXPECT_NEAR(squares / count, 1.0 / 3.0, 0.0105);
}

TEST(PortableMath, NoiseIsBoundedAndContinuous) {
  double before = noise1(3, 5, -10.0);
  for (int i = 1; i < 20000; ++i) {
    const double value = noise1(3, 5, -10.0 + i * 0.001);
    EXPECT_LE(std::fabs(value), 1.0);
    EXPECT_LE(std::fabs(value - before), 0.012);  // slope at most about 8 a unit
    before = value;
  }
}

// Stored once: the same integers and doubles must come out on every machine.
TEST(PortableMath, KnownBits) {
  EXPECT_EQ(hashBits(1, 2, 3, 4), 15374388949593934587ull);
  EXPECT_EQ(sinTurns(0.1), 0x1.2cf2304755a5ep-1);
}

}  // namespace
}  // namespace forelock::samples
