// FLIP: constants that follow from its definitions, and properties.
#include "flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::study {
namespace {

FlipInput uniform(float r, float g, float b, uint32_t size = 32) {
  FlipInput image{size, size, {}};
  for (uint32_t i = 0; i < size * size; ++i) image.rgb.insert(image.rgb.end(), {r, g, b});
  return image;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += double(v);
  return sum / double(values.size());
}

// Hashed noise: the same on every machine.
FlipInput noise(uint32_t seed) {
  FlipInput image = uniform(0, 0, 0);
  uint32_t state = seed;
  for (float& c : image.rgb) c = float((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f;
  return image;
}

TEST(Flip, LabOfWhiteGreenAndBlue) {
  // CIE L*a*b* of the primaries of Rec. 709 under D65, as tables print them.
  const auto white = labOfLinear(1, 1, 1), green = labOfLinear(0, 1, 0), blue = labOfLinear(0, 0, 1);
  EXPECT_NEAR(white[0], 100, 1e-4);
  EXPECT_NEAR(white[1], 0, 1e-4);
  EXPECT_NEAR(white[2], 0, 1e-4);
  EXPECT_NEAR(green[0], 87.74, 0.02);
  EXPECT_NEAR(green[1], -86.18, 0.03);
  EXPECT_NEAR(green[2], 83.18, 0.03);
  EXPECT_NEAR(blue[0], 32.30, 0.02);
  EXPECT_NEAR(blue[1], 79.19, 0.03);
  EXPECT_NEAR(blue[2], -107.86, 0.03);
  // 308.11^0.7 by these: the largest colour difference that the method knows.
  EXPECT_NEAR(flipColorMaximum(), std::pow(hyab(huntAdjusted(green), huntAdjusted(blue)), 0.7), 1e-9);
  EXPECT_NEAR(std::pow(flipColorMaximum(), 1 / 0.7), 55.44 + std::hypot(-75.61 - 25.58, 72.98 + 34.84), 0.2);
}

TEST(Flip, RedistributionHasItsKnee) {
  EXPECT_EQ(redistributed(0), 0);
  EXPECT_NEAR(redistributed(0.4 * flipColorMaximum()), 0.95, 1e-9);
  EXPECT_NEAR(redistributed(flipColorMaximum()), 1, 1e-9);
  EXPECT_EQ(redistributed(2 * flipColorMaximum()), 1);
}

TEST(Flip, EqualPicturesDifferNowhere) {
  for (const FlipInput& image : {uniform(0.2f, 0.5f, 0.1f), noise(1)})
    for (const float v : flip(image, image)) EXPECT_EQ(v, 0);
}

TEST(Flip, BlackAgainstWhiteByHand) {
  // Uniform pictures have no features: what is left is the colour term of L = 0 against 100.
  const double by_hand = redistributed(std::pow(100.0, 0.7));
  EXPECT_NEAR(mean(flip(uniform(0, 0, 0), uniform(1, 1, 1))), by_hand, 1e-3);
  EXPECT_NEAR(mean(flip(uniform(0, 1, 0), uniform(0, 0, 1))), 1, 1e-3);
}

TEST(Flip, StaysWithinZeroAndOneAndIsSymmetric) {
  const FlipInput a = noise(2), b = noise(3);
  const std::vector<float> forth = flip(a, b), back = flip(b, a);
  for (std::size_t i = 0; i < forth.size(); ++i) {
    EXPECT_GE(forth[i], 0);
    EXPECT_LE(forth[i], 1);
    EXPECT_NEAR(forth[i], back[i], 1e-6);  // neither term knows which picture is the reference
  }
}

TEST(Flip, GrowsWithAnOffset) {
  const FlipInput grey = uniform(0.2f, 0.2f, 0.2f);
  double before = 0;
  for (const float offset : {0.01f, 0.03f, 0.1f, 0.3f, 0.8f}) {
    const double now = mean(flip(grey, uniform(0.2f + offset, 0.2f + offset, 0.2f + offset)));
    EXPECT_GT(now, before);
    before = now;
  }
}

TEST(Flip, AnEdgeIsSeenBeyondItsColor) {
  // The same change of brightness, once everywhere and once as a line: the line's pixels are told apart by features too.
  FlipInput line = uniform(0.2f, 0.2f, 0.2f);
  for (uint32_t y = 0; y < 32; ++y)
    for (uint32_t c = 0; c < 3; ++c) line.rgb[(y * 32 + 16) * 3 + c] = 0.3f;
  const std::vector<float> values = flip(uniform(0.2f, 0.2f, 0.2f), line);
  EXPECT_GT(values[16 * 32 + 16], values[16 * 32 + 2]);
  EXPECT_LT(values[16 * 32 + 2], 0.01f);
}

TEST(Flip, FineNoiseVanishesFromAfar) {
  const FlipInput a = noise(4), b = noise(5);
  EXPECT_LT(mean(flip(a, b, 120)), mean(flip(a, b, 20)));
}

}  // namespace
}  // namespace forelock::study
