// How the fragment lists grow and shrink.
#include "plan/pool.h"

#include <gtest/gtest.h>

namespace forelock {
namespace {

TEST(PoolCapacity, TheFirstFrameTakesTheEstimateWithinTheLimit) {
  PoolState state;
  EXPECT_GE(choosePoolCapacity(state, 100000, 1u << 26), 100000u);
  EXPECT_EQ(choosePoolCapacity(state, 100000, 5000), 5000u);
  EXPECT_EQ(choosePoolCapacity(state, 0, 1), 1u);
}

// The bound of the issue: settled, at most a quarter more than the frame needs, and never less.
TEST(PoolCapacity, SettlesWithinAQuarterAboveTheCount) {
  for (const uint64_t count : {20000u, 1000000u, 3960000u}) {
    PoolState state;
    state.capacity = choosePoolCapacity(state, count * 5, 1u << 26);
    for (int frame = 0; frame < 6; ++frame) {
      state.last_count = count, state.last_estimate = count * 5, state.counted = true;
      state.capacity = choosePoolCapacity(state, count * 5, 1u << 26);
      EXPECT_GE(state.capacity, count);
    }
    EXPECT_LE(double(state.capacity), 1.25 * double(count));
  }
}

TEST(PoolCapacity, GrowsAtOnceWhenTheCameraComesNearer) {
  PoolState state;
  state.capacity = 112500, state.last_count = 100000, state.last_estimate = 500000;
  EXPECT_GE(choosePoolCapacity(state, 1000000, 1u << 26), 200000u);
}

TEST(PoolCapacity, DoesNotAllocateForASwingingCamera) {
  PoolState state;
  state.capacity = choosePoolCapacity(state, 1000000, 1u << 26);
  int changes = 0;
  for (int frame = 0; frame < 100; ++frame) {
    state.last_count = 200000 + (frame % 2) * 20000, state.last_estimate = 1000000 + (frame % 2) * 100000,
    state.counted = true;
    const uint64_t next = choosePoolCapacity(state, 1000000 + ((frame + 1) % 2) * 100000, 1u << 26);
    changes += next != state.capacity;
    state.capacity = next;
  }
  EXPECT_LE(changes, 3);
}

TEST(PoolCapacity, AFrameWithoutFragmentsTeachesNothing) {
  PoolState state;
  state.capacity = 1024, state.last_count = 0, state.last_estimate = 10;
  EXPECT_GE(choosePoolCapacity(state, 50000, 1u << 26), 50000u);
}

// Nodes that carry a colour are larger: fewer of them fit into the same budget, also before anything was counted.
TEST(PoolCapacity, ALimitThatFallsHolds) {
  PoolState state;
  state.capacity = choosePoolCapacity(state, 100000, 60000);
  EXPECT_EQ(state.capacity, 60000u);
  EXPECT_EQ(choosePoolCapacity(state, 100000, 45000), 45000u);
  state.last_count = 80000, state.last_estimate = 100000, state.counted = true;
  EXPECT_EQ(choosePoolCapacity(state, 100000, 45000), 45000u);
  EXPECT_EQ(choosePoolCapacity(state, 100000, 60000), 60000u);
}

}  // namespace
}  // namespace forelock
