// Arguments that break what the headers say: the documented error, words that tell why, and nothing changed.
#pragma once

#include "scene.h"

#include <cmath>
#include <functional>
#include <limits>

inline const float kNan = std::numeric_limits<float>::quiet_NaN();
inline const float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr FlkResult kInvalid = FLK_ERROR_INVALID_ARGUMENT, kImage = FLK_ERROR_UNSUPPORTED_IMAGE;

class Hostile : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    asset = makeAsset();
    hair = scene.createHair(asset);
    view = scene.createView(3);
  }
  void TearDown() override {
    scene.driver.completed = 1000;
    view.reset();
    hair.reset();
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }

  struct Case {
    const char* what;
    FlkResult expected;
    std::function<void(FlkFrame&)> spoil;
  };

  // A spoilt frame fails, says why, takes no memory, records nothing; the same frame unspoilt succeeds.
  void check(const std::vector<Case>& cases) {
    ASSERT_EQ(scene.render(view, good(1)), FLK_SUCCESS) << scene.last_message;
    uint64_t number = 2;
    for (const Case& test : cases) {
      FlkFrame frame = good(number);
      const FlkLight light_before = scene.light;
      test.spoil(frame);
      const VkDeviceSize bytes = scene.driver.bytesAllocated();
      const size_t recorded = scene.driver.commands.size();
      scene.message_ids.clear();
      scene.driver.completed = number - 1;
      FlkPlan plan = nullptr;
      EXPECT_EQ(flkPlanFrame(view, &frame, &plan), test.expected) << test.what;
      EXPECT_FALSE(scene.message_ids.empty()) << test.what << ": nothing is said";
      EXPECT_EQ(scene.driver.bytesAllocated(), bytes) << test.what;
      EXPECT_EQ(scene.driver.commands.size(), recorded) << test.what;
      scene.light = light_before;
      ASSERT_EQ(scene.render(view, good(number)), FLK_SUCCESS) << "after " << test.what << ": " << scene.last_message;
      ++number;
    }
    EXPECT_TRUE(scene.clean());
  }

  FlkFrame good(uint64_t number) {
    return full ? scene.fullFrame(number, number - 1, {hair}) : scene.frame(number, number - 1, {hair});
  }

  Scene scene;
  forelock::Asset asset;
  forelock::Hair hair;
  forelock::View view;
  bool full = false;  // good() has everything
};
