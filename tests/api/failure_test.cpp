// Every call that can fail does so in turn, of Vulkan and of host memory: the SDK returns an error, loses nothing, and
// the same call succeeds when it is made again.
#include "scene.h"

#include <functional>

namespace {

constexpr uint64_t kEnough = 2000;  // a life has fewer calls than this that can fail

struct Failures {
  std::vector<FlkResult> results;  // of steps that failed
};

// A whole life in steps. A step that fails is noted, what was to fail is called off, and the step is made again.
void live(Scene& scene, const std::function<void()>& call_off, Failures& failures) {
  const auto step = [&](const char* name, const std::function<FlkResult()>& call) {
    const FlkResult result = call();
    if (result >= 0) return;
    failures.results.push_back(result);
    call_off();
    EXPECT_EQ(call(), FLK_SUCCESS) << name << " after it failed once: " << scene.last_message;
  };
  forelock::Asset asset;
  step("flkAssetCreate", [&] {
    static const float positions[] = {0, 0, 0, 0, 0.05f, 0, 0.02f, 0.1f, 0, 0.01f, 0, 0, 0.01f, 0.1f, 0};
    static const uint32_t first_vertex[] = {0, 3, 5};
    FlkStrands strands = forelock::strandsDesc();
    strands.strand_count = 2;
    strands.vertex_count = 5;
    strands.first_vertex = first_vertex;
    strands.positions = positions;
    FlkAssetOptions options = forelock::assetOptions();
    options.allocator = &scene.memory.callbacks;
    return forelock::create(strands, &options, asset);
  });
  step("flkContextCreate", [&] { return scene.createContext(); });
  {
    forelock::Hair hair;
    step("flkHairCreate", [&] {
      FlkHairDesc desc = forelock::hairDesc();
      desc.asset = asset;
      return forelock::create(scene.context, desc, hair);
    });
    forelock::View view;
    step("flkViewCreate", [&] {
      FlkViewDesc desc = forelock::viewDesc();
      desc.frames_in_flight = 2;
      return forelock::create(scene.context, desc, view);
    });
    scene.driver.frame = 1;
    step("flkCmdUpload", [&] { return flkCmdUpload(scene.driver.command_buffer, hair); });
    for (uint64_t number = 1; number <= 6; ++number) {
      const uint64_t completed = number > 2 ? number - 2 : 0;
      FlkFrame frame = scene.frame(number, completed, {hair});
      // Other pipelines, another shadow map, other sizes: each frame needs something new.
      frame.method = static_cast<uint32_t>(number % 3);
      scene.light.casts_shadow = number != 2;
      scene.light.shadow_size = number < 4 ? 256 : 512;
      if (number >= 5) frame.target.width = 640;
      step("flkPlanFrame", [&] { return scene.render(view, frame); });
      if (uint32_t* count = scene.driver.latestReadBack()) *count = static_cast<uint32_t>(30000 * number);
      FlkStatistics statistics;
      step("flkViewGetStatistics", [&] { return flkViewGetStatistics(view, completed, &statistics); });
    }
    scene.driver.completed = 6;
  }
  scene.context.reset();
}

// The same with everything: a hair of all parts, frames of all features, by raster and by compute, outputs, a count first.
void liveFully(Scene& scene, const std::function<void()>& call_off, Failures& failures) {
  const auto step = [&](const char* name, const std::function<FlkResult()>& call) {
    const FlkResult result = call();
    if (result >= 0) return;
    failures.results.push_back(result);
    call_off();
    EXPECT_EQ(call(), FLK_SUCCESS) << name << " after it failed once: " << scene.last_message;
  };
  const forelock::Asset asset = makeAsset(12, 0.0f, nullptr, true);
  step("flkContextCreate", [&] { return scene.createContext(); });
  {
    const float pixel[3] = {1.0f, 0.5f, 0.0f};
    const FlkRootImage image{pixel, 1, 1};
    forelock::Hair hair;
    step("flkHairCreate", [&] {
      FlkHairDesc desc = forelock::hairDesc();
      desc.asset = asset;
      desc.flags = FLK_HAIR_HOST_POSITIONS;
      desc.root_image = &image;
      desc.follow.count = 3;
      return forelock::create(scene.context, desc, hair);
    });
    FlkHairPositions positions{};
    positions.address = scene.positions(96);
    for (int axis = 0; axis < 3; ++axis) positions.min_bounds[axis] = -0.1f, positions.max_bounds[axis] = 0.15f;
    step("flkHairSetPositions", [&] { return flkHairSetPositions(hair, &positions); });
    forelock::View view;
    step("flkViewCreate", [&] {
      FlkViewDesc desc = forelock::viewDesc();
      desc.frames_in_flight = 2;
      return forelock::create(scene.context, desc, view);
    });
    scene.driver.frame = 1;
    step("flkCmdUpload", [&] { return flkCmdUpload(scene.driver.command_buffer, hair); });
    for (uint64_t number = 1; number <= 9; ++number) {
      const uint64_t completed = number > 2 ? number - 2 : 0;
      FlkFrame frame = scene.fullFrame(number, completed, {hair});
      frame.target.width = 64, frame.target.height = 40;
      frame.count_only = number == 1;
      frame.method = static_cast<uint32_t>(number % 6);
      frame.capture = 1 + static_cast<uint32_t>(number / 4 % 2);
      frame.overflow = static_cast<uint32_t>(number / 3 % 2);
      if (number == 5) frame.light_count = 1, frame.ambient_sh = nullptr;
      if (number == 7) frame.display = FLK_DISPLAY_LAYERS;
      step("flkPlanFrame", [&] { return scene.render(view, frame); });
      if (uint32_t* count = scene.driver.latestReadBack()) *count = static_cast<uint32_t>(2000 * number);
      FlkStatistics statistics;
      step("flkViewGetStatistics", [&] { return flkViewGetStatistics(view, completed, &statistics); });
    }
    scene.driver.completed = 9;
  }
  scene.context.reset();
}

TEST(Failure, ofEveryVulkanCallOfEverything) {
  uint64_t n = 1;
  for (; n < kEnough; ++n) {
    Scene scene;
    scene.driver.fail_at = n;
    Failures failures;
    liveFully(scene, [&] { scene.driver.fail_at = 0; }, failures);
    ASSERT_TRUE(scene.nothingLeft()) << "call " << n << ", " << scene.driver.failed_call << " failed";
    if (scene.driver.failed_call.empty()) break;
    if (scene.driver.failed_call == "vkGetQueryPoolResults" && failures.results.empty()) continue;
    ASSERT_EQ(failures.results.size(), 1u) << "call " << n << ", " << scene.driver.failed_call;
    EXPECT_EQ(failures.results[0], FLK_ERROR_OUT_OF_DEVICE_MEMORY) << "call " << n << ", " << scene.driver.failed_call;
  }
  EXPECT_GT(n, 150u);
  EXPECT_LT(n, kEnough);
}

TEST(Failure, ofEveryHostAllocationOfEverything) {
  uint64_t n = 1;
  for (; n < kEnough; ++n) {
    Scene scene;
    scene.memory.fail_at = n;
    Failures failures;
    liveFully(scene, [&] { scene.memory.fail_at = 0; }, failures);
    ASSERT_TRUE(scene.nothingLeft()) << "allocation " << n;
    if (!scene.memory.failed) break;
    ASSERT_EQ(failures.results.size(), 1u) << "allocation " << n;
    EXPECT_EQ(failures.results[0], FLK_ERROR_OUT_OF_HOST_MEMORY) << "allocation " << n;
  }
  EXPECT_GT(n, 30u);
  EXPECT_LT(n, kEnough);
}

TEST(Failure, ofEveryVulkanCall) {
  const struct {
    VkResult failure;
    FlkResult expected;
  } kinds[] = {{VK_ERROR_OUT_OF_DEVICE_MEMORY, FLK_ERROR_OUT_OF_DEVICE_MEMORY},
               {VK_ERROR_OUT_OF_HOST_MEMORY, FLK_ERROR_OUT_OF_HOST_MEMORY},
               {VK_ERROR_DEVICE_LOST, FLK_ERROR_DEVICE_LOST}};
  for (const auto& kind : kinds) {
    uint64_t n = 1;
    for (; n < kEnough; ++n) {
      Scene scene;
      scene.driver.fail_at = n;
      scene.driver.failure = kind.failure;
      Failures failures;
      live(scene, [&] { scene.driver.fail_at = 0; }, failures);
      ASSERT_TRUE(scene.nothingLeft()) << "call " << n << ", " << scene.driver.failed_call << " failed";
      if (scene.driver.failed_call.empty()) break;
      // A picture can do without its timing.
      if (scene.driver.failed_call == "vkGetQueryPoolResults" && failures.results.empty()) continue;
      ASSERT_EQ(failures.results.size(), 1u) << "call " << n << ", " << scene.driver.failed_call;
      EXPECT_EQ(failures.results[0], kind.expected) << "call " << n << ", " << scene.driver.failed_call;
    }
    EXPECT_GT(n, 30u);
    EXPECT_LT(n, kEnough);
  }
}

TEST(Failure, ofEveryHostAllocation) {
  uint64_t n = 1;
  for (; n < kEnough; ++n) {
    Scene scene;
    scene.memory.fail_at = n;
    Failures failures;
    live(scene, [&] { scene.memory.fail_at = 0; }, failures);
    ASSERT_TRUE(scene.nothingLeft()) << "allocation " << n;
    if (!scene.memory.failed) break;
    ASSERT_EQ(failures.results.size(), 1u) << "allocation " << n;
    EXPECT_EQ(failures.results[0], FLK_ERROR_OUT_OF_HOST_MEMORY) << "allocation " << n;
  }
  EXPECT_GT(n, 4u);
  EXPECT_LT(n, kEnough);
}

}  // namespace
