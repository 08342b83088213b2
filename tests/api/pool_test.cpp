// The fragment lists follow what completed frames counted, within the budget, and what they replace goes in time.
#include "scene.h"

namespace {

class Pool : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    asset = makeAsset();
    hair = scene.createHair(asset);
  }

  // The frame after the last, with `in_flight` - 1 before it not yet completed, which counts `fragments`.
  FlkPlanInfo render(FlkView view, uint64_t in_flight, uint32_t fragments) {
    ++number;
    const uint64_t completed = number > in_flight ? number - in_flight : 0;
    FlkPlan plan = nullptr;
    EXPECT_EQ(scene.render(view, scene.frame(number, completed, {hair}), &plan), FLK_SUCCESS) << scene.last_message;
    if (!plan) return {};
    uint32_t* count = scene.driver.latestReadBack();
    if (count) *count = fragments;
    else ADD_FAILURE() << "the count is not read back";
    return infoOf(plan);
  }

  void finish(forelock::View& view) {
    scene.driver.completed = number;
    view.reset();
    hair.reset();
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }

  Scene scene;
  forelock::Asset asset;
  forelock::Hair hair;
  uint64_t number = 0;
};

TEST_F(Pool, growsAfterAFrameThatCountedMore) {
  forelock::View view = scene.createView(1);
  const FlkPlanInfo first = render(view, 1, 0);
  ASSERT_GT(first.node_capacity, 0u);
  const auto many = static_cast<uint32_t>(first.node_capacity * 3);
  *scene.driver.latestReadBack() = many;
  FlkStatistics statistics;
  ASSERT_EQ(flkViewGetStatistics(view, 1, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.frame_number, 1u);
  EXPECT_EQ(statistics.fragments, many);
  EXPECT_EQ(statistics.overflow_fragments, many - first.node_capacity);

  const FlkPlanInfo second = render(view, 1, many);
  EXPECT_GE(second.node_capacity, many);
  ASSERT_EQ(flkViewGetStatistics(view, 2, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.overflow_fragments, 0u);
  EXPECT_EQ(statistics.frame_number, 2u);

  // Steady from then on.
  for (int i = 0; i < 6; ++i) EXPECT_EQ(render(view, 1, many).node_capacity, second.node_capacity);
  finish(view);
}

// The estimate before the first count is an upper one; afterwards the memory that it took too much is given back.
TEST_F(Pool, shrinksToTheCount) {
  forelock::View view = scene.createView(1);
  const FlkPlanInfo first = render(view, 1, 2000);
  FlkPlanInfo last{};
  for (int i = 0; i < 8; ++i) last = render(view, 1, 2000);
  EXPECT_LT(last.node_capacity, first.node_capacity);
  EXPECT_GE(last.node_capacity, 2000u);
  EXPECT_LE(last.node_capacity, 2000u * 3 / 2 + 1024);
  finish(view);
}

// Frames 2 and 3 are in flight when the count of frame 1 asks for more: the lists they use stay until they complete.
TEST_F(Pool, replacedMemoryWaitsForFramesInFlight) {
  forelock::View view = scene.createView(3);
  const uint64_t capacity = render(view, 3, 0).node_capacity;
  const auto many = static_cast<uint32_t>(capacity * 4);
  *scene.driver.latestReadBack() = many;
  render(view, 3, many);
  render(view, 3, many);
  const size_t before = scene.driver.alive(mock::Kind::Buffer);
  EXPECT_GE(render(view, 3, many).node_capacity, many);
  EXPECT_GT(scene.driver.alive(mock::Kind::Buffer), before) << "the old lists went while frames 2 and 3 use them";
  for (int i = 0; i < 4; ++i) render(view, 3, many);
  EXPECT_EQ(scene.driver.alive(mock::Kind::Buffer), before) << "the old lists are still there";
  EXPECT_TRUE(scene.clean());
  finish(view);
}

TEST_F(Pool, budgetHolds) {
  constexpr uint64_t kBudget = 64 * 1024;
  forelock::View view = scene.createView(1, kBudget);
  for (int i = 0; i < 5; ++i) EXPECT_LE(render(view, 1, 4000000).node_capacity * 12, kBudget);
  FlkStatistics statistics;
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.fragments, 4000000u);
  EXPECT_GE(statistics.overflow_fragments, 4000000u - kBudget / 12);
  finish(view);
}

// The least there is: one node, and a count that says what is missing.
TEST_F(Pool, budgetBelowOneNode) {
  forelock::View view = scene.createView(1, 11);
  EXPECT_EQ(render(view, 1, 5000).node_capacity, 1u);
  FlkStatistics statistics;
  ASSERT_EQ(flkViewGetStatistics(view, 1, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.overflow_fragments, 4999u);
  EXPECT_EQ(render(view, 1, 5000).node_capacity, 1u);
  finish(view);
}

// 128 MiB is all that a binding may hold on many devices; here much less. Lists are reached by address and may be
// larger; what is bound stays below, which the driver watches.
TEST_F(Pool, bindingLimitOfTheDeviceHolds) {
  hair.reset();
  scene.context.reset();
  scene.driver.claims.properties.limits.maxStorageBufferRange = 1 << 19;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
  hair = scene.createHair(asset);
  forelock::View view = scene.createView(1);
  FlkPlanInfo info{};
  for (int i = 0; i < 5; ++i) info = render(view, 1, 4000000);
  EXPECT_GE(info.node_capacity, 4000000u);
  EXPECT_TRUE(scene.clean());

  // Hairs are reached by address too.
  const forelock::Asset large_asset = makeAsset(12000);
  forelock::Hair large = scene.createHair(large_asset);
  ++number;
  const FlkFrame frame = scene.frame(number, number - 1, {large});
  EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << scene.last_message;
  scene.driver.completed = number;
  large.reset();
  finish(view);
}

// A camera inside the hair of a huge picture: heads of 16384 x 16384 pixels are beyond what lavapipe binds.
TEST_F(Pool, pictureBeyondWhatCanBeBound) {
  forelock::View view = scene.createView(1);
  FlkFrame frame = scene.frame(1, 0, {hair});
  frame.target.width = frame.target.height = 16384;
  frame.view_from_world[14] = -0.05;
  FlkPlan plan = nullptr;
  EXPECT_LT(flkPlanFrame(view, &frame, &plan), 0);
  EXPECT_FALSE(scene.message_ids.empty());
  EXPECT_TRUE(scene.clean());
  // The view still works.
  render(view, 1, 1000);
  finish(view);
}

// One short strand that is a speck on the screen: an estimate below one fragment still needs a list.
TEST_F(Pool, speckFarAway) {
  const forelock::Asset strand = makeAsset(1);
  forelock::Hair speck = scene.createHair(strand);
  forelock::View view = scene.createView(1);
  for (number = 1; number <= 3; ++number) {
    FlkFrame frame = scene.frame(number, number - 1, {speck});
    frame.view_from_world[14] = -500.0;
    FlkPlan plan = nullptr;
    ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
    if (infoOf(plan).pass_count > 0) { EXPECT_GT(infoOf(plan).node_capacity, 0u); }
  }
  EXPECT_TRUE(scene.clean());
  scene.driver.completed = number;
  speck.reset();
  finish(view);
}

// A count of nothing (all hidden behind the scene) is a count, and growth from it works.
TEST_F(Pool, hiddenAndSeenAgain) {
  forelock::View view = scene.createView(2);
  for (int i = 0; i < 6; ++i) render(view, 2, 0);
  FlkPlanInfo info{};
  for (int i = 0; i < 6; ++i) info = render(view, 2, 500000);
  EXPECT_GE(info.node_capacity, 500000u);
  finish(view);
}

// Results are there for the last completed frame, and not before.
TEST_F(Pool, statisticsOfCompletedFramesOnly) {
  forelock::View view = scene.createView(3);
  FlkStatistics statistics;
  EXPECT_EQ(flkViewGetStatistics(view, 0, &statistics), FLK_NOT_READY);
  render(view, 3, 101);
  render(view, 3, 102);
  render(view, 3, 103);
  EXPECT_EQ(flkViewGetStatistics(view, 0, &statistics), FLK_NOT_READY);
  ASSERT_EQ(flkViewGetStatistics(view, 1, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.fragments, 101u);
  ASSERT_EQ(flkViewGetStatistics(view, 3, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.fragments, 103u);
  EXPECT_EQ(statistics.frame_number, 3u);
  finish(view);
}

}  // namespace
