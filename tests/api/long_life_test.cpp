// Thousands of frames with two or three in flight: hairs and views come, move and go, pictures change their size, methods and
// lights change every frame. Nothing grows, nothing goes while a frame in flight uses it.
#include "scene.h"

#include <algorithm>
#include <deque>
#include <functional>

namespace {

// What there is at one time.
struct Holdings {
  size_t buffers = 0, images = 0, memories = 0, sets = 0, pipelines = 0, host_blocks = 0, host_bytes = 0;
  VkDeviceSize device_bytes = 0;
  void most(const Holdings& other) {
    buffers = std::max(buffers, other.buffers), images = std::max(images, other.images);
    memories = std::max(memories, other.memories), sets = std::max(sets, other.sets);
    pipelines = std::max(pipelines, other.pipelines), host_blocks = std::max(host_blocks, other.host_blocks);
    host_bytes = std::max(host_bytes, other.host_bytes), device_bytes = std::max(device_bytes, other.device_bytes);
  }
};

void expectNoMore(const Holdings& later, const Holdings& earlier) {
  EXPECT_LE(later.buffers, earlier.buffers);
  EXPECT_LE(later.images, earlier.images);
  EXPECT_LE(later.memories, earlier.memories);
  EXPECT_LE(later.sets, earlier.sets);
  EXPECT_LE(later.pipelines, earlier.pipelines);
  EXPECT_LE(later.host_blocks, earlier.host_blocks);
  EXPECT_LE(later.host_bytes, earlier.host_bytes);
  EXPECT_LE(later.device_bytes, earlier.device_bytes);
}

class LongLife : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    plain = makeAsset(40);
    dressed = makeAsset(60, 0.01f, nullptr, true);
  }
  void TearDown() override {
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }

  Holdings holdings() const {
    const mock::Driver& driver = scene.driver;
    return {driver.alive(mock::Kind::Buffer),   driver.alive(mock::Kind::Image),   driver.alive(mock::Kind::Memory),
            driver.alive(mock::Kind::DescriptorSet), driver.alive(mock::Kind::Pipeline), scene.memory.live(),
            scene.memory.live_bytes,            driver.bytesAllocated()};
  }

  // A small picture, so that clearing it costs little here.
  static void shrink(FlkFrame& frame, uint32_t width = 96, uint32_t height = 60) {
    frame.target.width = width, frame.target.height = height;
  }

  // What a frame counted depends on its number alone.
  void count(uint64_t number) {
    if (uint32_t* counted = scene.driver.latestReadBack()) *counted = static_cast<uint32_t>(3000 + number % 16 * 500);
    scene.driver.commands.clear();
  }

  Scene scene;
  forelock::Asset plain, dressed;
};

// Frame `number` with everything that may change from one to the next, the same again after 48 frames.
void vary(FlkFrame& frame, uint64_t number) {
  frame.method = static_cast<uint32_t>(number % 6);
  frame.capture = 1 + static_cast<uint32_t>(number / 6 % 2);
  frame.overflow = static_cast<uint32_t>(number / 3 % 2);
  frame.tail = static_cast<uint32_t>(number % 3);
  frame.payload = static_cast<uint32_t>(number / 2 % 2);
  frame.light_count = static_cast<uint32_t>(number % 6);
  if (number % 16 == 5) frame.display = 1 + static_cast<uint32_t>(number / 16 % 3);
  if (number % 4 == 1) frame.light_tiles = FlkLightTiles{};
  if (number % 8 == 3) frame.depth = FlkDepthSource{};
  frame.opacity_modifier_count = static_cast<uint32_t>(number % 3);
  if (number % 4 == 2) for (FlkOutputImage& output : frame.outputs) output = FlkOutputImage{};
  frame.count_work = number % 2;
  frame.timestamps = number / 4 % 2;
  frame.count_only = number % 24 == 7;
  if (number % 24 == 11) frame.view_from_world[14] = 5.0;  // out of view
}

TEST_F(LongLife, hairsAndViewsComeMoveAndGo) {
  constexpr uint64_t kFrames = 4096, kInFlight = 3;
  struct Going {
    uint64_t last_frame;
    forelock::Hair hair;
    forelock::View view;
  };
  std::deque<Going> going;
  std::deque<forelock::Hair> hairs;
  std::deque<forelock::View> views;
  Holdings early, late;
  for (uint64_t number = 1; number <= kFrames; ++number) {
    const uint64_t completed = number > kInFlight ? number - kInFlight : 0;
    scene.driver.completed = completed;
    while (!going.empty() && going.front().last_frame <= completed) going.pop_front();
    scene.driver.frame = number;
    if (number % 4 == 1) hairs.push_back(number % 8 == 1 ? scene.createHair(plain) : scene.createFullHair(dressed));
    if (number % 32 == 1) views.push_back(scene.createView(kInFlight));
    if (number % 16 == 9) flkHairReleaseStaging(hairs.front());  // uploaded some frames ago
    const double moved[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.001 * double(number % 32), 0, 0, 1};
    for (forelock::Hair& hair : hairs) ASSERT_EQ(flkHairSetTransform(hair, moved), FLK_SUCCESS);
    ASSERT_EQ(flkHairSetPreviousTransform(hairs.back(), number % 2 ? moved : nullptr), FLK_SUCCESS);
    std::vector<FlkHair> drawn;
    for (forelock::Hair& hair : hairs) drawn.push_back(hair);
    for (size_t v = 0; v < views.size(); ++v) {
      FlkFrame frame = scene.fullFrame(number, completed, drawn);
      shrink(frame);
      vary(frame, number + v * 7);
      ASSERT_EQ(scene.render(views[v], frame), FLK_SUCCESS) << number << ' ' << scene.last_message;
      count(number + v);
    }
    ASSERT_TRUE(scene.clean()) << "frame " << number;
    if (hairs.size() > 4) going.push_back({number, std::move(hairs.front()), {}}), hairs.pop_front();
    if (views.size() > 2) going.push_back({number, {}, std::move(views.front())}), views.pop_front();
    if (number > 512 && number <= 1536 && number % 5 == 0) early.most(holdings());
    if (number > kFrames - 1024 && number % 7 == 0) late.most(holdings());
  }
  expectNoMore(late, early);
  scene.driver.completed = kFrames;
  going.clear(), hairs.clear(), views.clear();
}

TEST_F(LongLife, aViewIsResizedEveryFrame) {
  constexpr uint64_t kFrames = 1000;
  for (const uint64_t in_flight : {2u, 3u}) {
    forelock::Hair hair = scene.createFullHair(dressed);
    forelock::View view = scene.createView(static_cast<uint32_t>(in_flight));
    const uint64_t first = scene.driver.frame;
    scene.driver.completed = first;
    Holdings early, late;
    for (uint64_t i = 1; i <= kFrames; ++i) {
      const uint64_t number = first + i, completed = i > in_flight ? number - in_flight : 0;
      FlkFrame frame = scene.fullFrame(number, completed, {hair});
      shrink(frame, 16 + static_cast<uint32_t>(i * 37 % 64) * 4, 16 + static_cast<uint32_t>(i * 53 % 32) * 4);
      scene.lights[0].shadow_size = 64 + static_cast<uint32_t>(i % 8) * 32;
      ASSERT_EQ(scene.render(view, frame), FLK_SUCCESS) << i << ' ' << scene.last_message;
      count(i);
      ASSERT_TRUE(scene.clean()) << "frame " << i;
      if (i > 128 && i <= 384) early.most(holdings());
      if (i > kFrames - 256) late.most(holdings());
    }
    expectNoMore(late, early);
    scene.driver.completed = first + kFrames;
  }
}

// Every choice changes every frame, and memory, sets and pipelines are those of the first rounds.
TEST_F(LongLife, everythingChangesEveryFrame) {
  constexpr uint64_t kFrames = 960, kInFlight = 2;
  forelock::Hair hair = scene.createFullHair(dressed), other = scene.createHair(plain);
  forelock::View view = scene.createView(kInFlight);
  Holdings early, late;
  for (uint64_t number = 1; number <= kFrames; ++number) {
    const uint64_t completed = number > kInFlight ? number - kInFlight : 0;
    FlkFrame frame = number % 5 ? scene.fullFrame(number, completed, {hair, other}) : scene.fullFrame(number, completed, {other});
    shrink(frame);
    vary(frame, number);
    ASSERT_EQ(scene.render(view, frame), FLK_SUCCESS) << number << ' ' << scene.last_message;
    count(number);
    FlkStatistics statistics{};
    const FlkResult known = flkViewGetStatistics(view, completed, &statistics);
    ASSERT_EQ(known, completed ? FLK_SUCCESS : FLK_NOT_READY);
    if (completed) { EXPECT_EQ(statistics.frame_number, completed); }
    ASSERT_TRUE(scene.clean()) << "frame " << number;
    if (number > 240 && number <= 480) early.most(holdings());
    if (number > kFrames - 240) late.most(holdings());
  }
  expectNoMore(late, early);
  scene.driver.completed = kFrames;
}

// As many hairs as a frame may have, each of its own kind of material, place and motion.
TEST_F(LongLife, hairs63) {
  std::vector<forelock::Hair> hairs;
  std::vector<FlkHair> drawn;
  for (uint32_t i = 0; i < 63; ++i) {
    hairs.push_back(i % 3 ? scene.createHair(i % 2 ? dressed : plain) : scene.createFullHair(dressed));
    drawn.push_back(hairs.back());
    FlkMaterial material;
    flkMaterialDefault(&material);
    material.tip_blend = i % 4 ? 0.0f : 0.5f;
    ASSERT_EQ(flkHairSetMaterial(hairs.back(), &material), FLK_SUCCESS);
  }
  forelock::View view = scene.createView(3);
  for (uint64_t number = 1; number <= 24; ++number) {
    const uint64_t completed = number > 3 ? number - 3 : 0;
    FlkFrame frame = scene.fullFrame(number, completed, drawn);
    frame.method = static_cast<uint32_t>(number % 6), frame.capture = 1 + static_cast<uint32_t>(number % 2);
    FlkPlan plan = nullptr;
    ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
    uint64_t bytes = 0, segments = 0;
    for (forelock::Hair& hair : hairs) {
      FlkHairInfo info{};
      ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
      bytes += info.bytes_device, segments += info.segment_count;
    }
    EXPECT_EQ(infoOf(plan).bytes_persistent, bytes);
    EXPECT_EQ(infoOf(plan).segment_count, segments);
    count(number);
  }
  EXPECT_TRUE(scene.clean());
  scene.driver.completed = 24;
}

// Views of one context, each with a frame of its own, planned together and recorded in any order.
TEST_F(LongLife, severalViews) {
  constexpr size_t kViews = 6;
  forelock::Hair hair = scene.createFullHair(dressed), other = scene.createHair(plain);
  std::vector<forelock::View> views;
  for (size_t v = 0; v < kViews; ++v) views.push_back(scene.createView(2));
  for (uint64_t number = 1; number <= 60; ++number) {
    const uint64_t completed = number > 2 ? number - 2 : 0;
    scene.driver.completed = completed;
    FlkPlan plans[kViews] = {};
    for (size_t v = 0; v < kViews; ++v) {
      FlkFrame frame = v % 2 ? scene.frame(number, completed, {hair, other}) : scene.fullFrame(number, completed, {other, hair});
      shrink(frame, 64 + uint32_t(v) * 16);
      frame.method = uint32_t(v);
      ASSERT_EQ(flkPlanFrame(views[v], &frame, &plans[v]), FLK_SUCCESS) << scene.last_message;
    }
    scene.driver.frame = number;
    for (size_t v = kViews; v-- > 0;) {
      scene.driver.beginCommandBuffer();
      flkCmdRender(scene.driver.command_buffer, plans[v]);
      EXPECT_GT(infoOf(plans[v]).pass_count, 0u);
      if (uint32_t* counted = scene.driver.latestReadBack()) *counted = uint32_t(1000 * v + number);
    }
    scene.driver.commands.clear();
    for (size_t v = 0; v < kViews && completed; ++v) {
      FlkStatistics statistics{};
      ASSERT_EQ(flkViewGetStatistics(views[v], completed, &statistics), FLK_SUCCESS);
      EXPECT_EQ(statistics.fragments, 1000 * v + completed);
    }
    ASSERT_TRUE(scene.clean()) << number;
  }
  scene.driver.completed = 60;
  views.clear();
}

}  // namespace
