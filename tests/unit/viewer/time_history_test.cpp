// The ring of frame times.
#include "time_history.h"

#include <gtest/gtest.h>

using namespace forelock::samples;

namespace {

FrameTimes frame(double capture_ms, double total_ms) {
  FrameTimes times;
  times.stage_ms.fill(-1.0);
  times.stage_ms[FLK_STAGE_CAPTURE] = capture_ms;
  times.total_ms = total_ms;
  return times;
}

}  // namespace

TEST(TimeHistory, EmptyHasNoMedian) {
  const TimeHistory history;
  EXPECT_EQ(history.size(), 0u);
  EXPECT_EQ(history.median(TimeHistory::kTotal), -1.0);
}

TEST(TimeHistory, KeepsTheLast240) {
  TimeHistory history;
  for (int i = 0; i < 300; ++i) history.add(frame(i, 2 * i));
  EXPECT_EQ(history.size(), 240u);
  EXPECT_EQ(history.at(0).total_ms, 598.0);
  EXPECT_EQ(history.at(239).total_ms, 120.0);
  EXPECT_EQ(history.percentile(FLK_STAGE_CAPTURE, 0.0), 60.0);
  EXPECT_EQ(history.percentile(FLK_STAGE_CAPTURE, 100.0), 299.0);
  EXPECT_EQ(history.median(FLK_STAGE_CAPTURE), 179.5);
  EXPECT_EQ(history.median(FLK_STAGE_CAPTURE, 3), 298.0);
  EXPECT_EQ(history.median(TimeHistory::kTotal, 1), 598.0);
  history.clear();
  EXPECT_EQ(history.size(), 0u);
}

TEST(TimeHistory, FramesThatDidNotRunAStageDoNotCount) {
  TimeHistory history;
  history.add(frame(4.0, -1.0));
  history.add(frame(-1.0, 10.0));
  EXPECT_EQ(history.median(FLK_STAGE_CAPTURE), 4.0);
  EXPECT_EQ(history.median(TimeHistory::kTotal), 10.0);
  EXPECT_EQ(history.median(FLK_STAGE_SHADOW), -1.0);
  EXPECT_EQ(history.median(FLK_STAGE_CAPTURE, 1), -1.0);
}

TEST(TimeHistory, MediansAreOfFramesLikeTheNewest) {
  TimeHistory history;
  FrameTimes frame;
  for (const bool reduced : {false, true, true, false}) {
    frame.reduced = reduced;
    frame.total_ms = reduced ? 5.0 : 100.0;
    history.add(frame);
  }
  EXPECT_EQ(history.median(TimeHistory::kTotal), 100.0);
  frame.reduced = true;  // whatever its share of the resolution
  frame.total_ms = 6.0;
  history.add(frame);
  EXPECT_EQ(history.median(TimeHistory::kTotal), 5.0);
  EXPECT_EQ(history.percentile(TimeHistory::kTotal, 100.0), 100.0);
}
