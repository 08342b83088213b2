// The study's metrics against the reference's own, and by hand.
#include "metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace forelock::study {
namespace {

Picture picture(std::initializer_list<float> grays, std::initializer_list<uint32_t> fragments) {
  Picture p;
  p.width = uint32_t(grays.size()), p.height = 1;
  for (const float g : grays) {
    p.rgb.resize(p.rgb.size() + 3, g);
    p.transmittance.push_back(1 - g);
  }
  p.fragments = fragments;
  return p;
}

TEST(StudyMetrics, AgreeWithTheReference) {
  reference::Image a, b;
  a.width = b.width = 40, a.height = b.height = 25;
  uint32_t state = 7;
  const auto next = [&] { return double((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0; };
  for (int i = 0; i < 1000; ++i) {
    reference::Pixel pa, pb;
    for (int c = 0; c < 3; ++c) pa.rgb[c] = 1.3 * next(), pb.rgb[c] = 1.3 * next();
    pa.fragments = next() > 0.4, pb.fragments = next() > 0.4;
    a.pixels.push_back(pa), b.pixels.push_back(pb);
  }
  const reference::Difference expected = reference::compare(a, b);
  const Errors errors = compare(fromReference(a), fromReference(b));
  EXPECT_NEAR(errors.rmse, expected.rmse, 1e-4);
  EXPECT_NEAR(errors.rmse_channel, std::max({expected.rmse_channel[0], expected.rmse_channel[1], expected.rmse_channel[2]}), 1e-4);
  EXPECT_NEAR(errors.p999, expected.p999, 1e-3);
}

TEST(StudyMetrics, ChannelsAreSummedAndLightIsClamped) {
  const Errors e = compare(picture({2.0f, 0.5f}, {1, 0}), picture({0.0f, 0.5f}, {0, 0}));
  EXPECT_NEAR(e.rmse, 255 * std::sqrt(3.0), 1e-9);  // the second pixel has no hair
  EXPECT_NEAR(e.rmse_channel, 255, 1e-9);
  EXPECT_TRUE(std::isnan(compare(picture({1.0f}, {0}), picture({1.0f}, {0})).rmse));
}

TEST(StudyMetrics, RadianceIsNotClamped) {
  EXPECT_NEAR(compare(picture({3.0f}, {1}), picture({1.5f}, {1})).radiance_ratio, 2, 1e-9);
  EXPECT_NEAR(meanRadiance(picture({3.0f, 1.0f, 9.0f}, {1, 4, 0})), 2, 1e-6);
}

TEST(StudyMetrics, DriftIsOfChangesNotOfValues) {
  // A constant offset drifts along; a lag of one step does not.
  const std::vector<Picture> reference{picture({0.1f}, {1}), picture({0.2f}, {1}), picture({0.4f}, {1})};
  const std::vector<Picture> offset{picture({0.3f}, {1}), picture({0.4f}, {1}), picture({0.6f}, {1})};
  const std::vector<Picture> lag{picture({0.1f}, {1}), picture({0.1f}, {1}), picture({0.2f}, {1})};
  EXPECT_NEAR(drift(offset, reference), 0, 1e-5);
  EXPECT_NEAR(drift(lag, reference), 255 * (0.1 + 0.1) / 2, 1e-4);
}

TEST(StudyMetrics, OpacityOverHairOfEither) {
  const std::vector<float> cover{0.5f, 0.0f, 0.25f};
  EXPECT_NEAR(compareOpacity(picture({0.5f, 0.0f, 0.0f}, {1, 0, 0}), cover), 255 * std::sqrt(0.0625 / 2), 1e-5);
}

TEST(StudyMetrics, MediansPercentilesAndPairs) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(percentile({5, 1, 4, 2, 3}, 0.05), 1);
  EXPECT_EQ(percentile({5, 1, 4, 2, 3}, 0.95), 5);
  const std::vector<double> baseline{2, 2, 2, 2, 2}, row{1, 1, 2, 1, 1};
  EXPECT_EQ(pairRatio(baseline, row, 5).ratio, 2);
  EXPECT_EQ(pairRatio(baseline, row, 5).spread, 0.5);
  EXPECT_EQ(pairRatio(baseline, row, 2).spread, 0);  // the odd one is no batch's median
  EXPECT_TRUE(std::isnan(pairRatio({baseline.data(), 1}, {row.data(), 1}, 5).spread));
}

}  // namespace
}  // namespace forelock::study
