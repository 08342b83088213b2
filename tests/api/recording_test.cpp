// What flkCmdRender records is what the plan lists: every pass once, nothing else, and nothing for what is not there.
#include "scene.h"

#include <algorithm>
#include <set>

namespace {

class Recording : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    asset = makeAsset();
    hair = scene.createHair(asset);
    view = scene.createView();
  }

  void TearDown() override {
    scene.driver.completed = number;
    view.reset();
    hair.reset();
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }

  FlkFrame next() {
    ++number;
    return scene.frame(number, number - 1, {hair});
  }

  void render(const FlkFrame& frame) {
    scene.driver.commands.clear();
    ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
    expectPlanRecorded(frame);
  }

  // A grid of groups of 64 items.
  static std::vector<uint64_t> gridOf(uint64_t items, uint64_t group) {
    const uint64_t groups = (items + group - 1) / group;
    return {std::min<uint64_t>(groups, 32768), (groups + 32767) / 32768, 1};
  }

  // Raster passes in order with the indices that each draws, and compute passes with their groups. All hairs of the frame are
  // taken to be in view and uploaded, those with host positions to be `moved`.
  void expectPlanRecorded(const FlkFrame& frame) {
    std::vector<uint64_t> raster_indices;
    std::vector<std::vector<uint64_t>> dispatches;
    for (const mock::Command& command : scene.driver.commands) {
      if (command.name == "vkCmdBeginRendering") raster_indices.push_back(0);
      if (command.name == "vkCmdDrawIndexed") raster_indices.back() += command.numbers[0] * command.numbers[1];
      if (command.name == "vkCmdDraw") raster_indices.back() += command.numbers[0] * command.numbers[1];
      if (command.name == "vkCmdDispatch") dispatches.push_back(command.numbers);
    }
    std::vector<uint64_t> planned_indices;
    std::vector<std::vector<uint64_t>> planned_dispatches;
    for (const FlkPassInfo& pass : passesOf(plan)) {
      if (pass.indices) planned_indices.push_back(pass.indices);
      if (pass.groups[0]) planned_dispatches.push_back({pass.groups[0], pass.groups[1], pass.groups[2]});
      uint64_t segments = 0;
      for (bool more = pass.segments != 0; more; more = segments < pass.segments)  // once, or once a shadow map
        for (uint32_t i = 0; i < frame.hair_count; ++i) {
          FlkHairInfo info{};
          ASSERT_EQ(flkHairGetInfo(frame.hairs[i], &info), FLK_SUCCESS);
          planned_dispatches.push_back(gridOf(info.segment_count, 16));
          segments += info.segment_count;
        }
      EXPECT_EQ(segments, pass.segments) << pass.name;
      if (pass.stage != FLK_STAGE_PREPARE) continue;
      for (const FlkHair& hair_moved : moved) {
        FlkHairInfo info{};
        ASSERT_EQ(flkHairGetInfo(hair_moved, &info), FLK_SUCCESS);
        planned_dispatches.push_back(gridOf(info.strand_count, 64));
      }
    }
    EXPECT_EQ(raster_indices, planned_indices);
    EXPECT_EQ(dispatches, planned_dispatches);
  }

  std::vector<uint32_t> stages() const {
    std::vector<uint32_t> list;
    for (const FlkPassInfo& pass : passesOf(plan)) list.push_back(pass.stage);
    return list;
  }

  bool hasResource(const std::string& name) const {
    const auto resources = resourcesOf(plan);
    return std::any_of(resources.begin(), resources.end(), [&](const FlkResourceInfo& r) { return name == r.name; });
  }

  Scene scene;
  forelock::Asset asset;
  forelock::Hair hair;
  forelock::View view;
  FlkPlan plan = nullptr;
  std::vector<FlkHair> moved;
  uint64_t number = 0;
};

TEST_F(Recording, allPassesOfALitFrame) {
  scene.driver.frame = 1;
  ASSERT_EQ(flkCmdUpload(scene.driver.command_buffer, hair), FLK_SUCCESS);
  render(next());
  EXPECT_EQ(stages(), (std::vector<uint32_t>{FLK_STAGE_CLEAR, FLK_STAGE_SHADOW, FLK_STAGE_CAPTURE, FLK_STAGE_RESOLVE}));
  EXPECT_EQ(scene.driver.countCommands("vkCmdBeginRendering"), 2u);
  EXPECT_TRUE(hasResource("shadow map"));
  const FlkPlanInfo info = infoOf(plan);
  uint64_t transient = 0;
  for (const FlkResourceInfo& resource : resourcesOf(plan)) {
    EXPECT_NE(resource.why[0], '\0');
    transient += resource.transient ? resource.bytes : 0;
  }
  EXPECT_EQ(info.bytes_transient, transient);
  FlkHairInfo hair_info;
  ASSERT_EQ(flkHairGetInfo(hair, &hair_info), FLK_SUCCESS);
  EXPECT_EQ(info.bytes_persistent, hair_info.bytes_device);
  EXPECT_EQ(info.segment_count, hair_info.segment_count);
  EXPECT_GT(info.rect[2] * info.rect[3], 0u);
  EXPECT_LE(info.rect[0] + info.rect[2], 320u);
  EXPECT_LE(info.rect[1] + info.rect[3], 200u);
}

// The mistake of a first day: its buffers hold anything, so it is left out and said.
TEST_F(Recording, hairThatWasNotUploadedIsLeftOut) {
  forelock::Hair forgotten = scene.createHair(asset, false);
  ++number;
  FlkFrame frame = scene.frame(number, number - 1, {forgotten});
  ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS);
  EXPECT_EQ(scene.driver.countCommands("vkCmdDrawIndexed"), 0u);
  EXPECT_EQ(scene.message_ids.back(), "HAIR_NOT_UPLOADED");
  // With host positions neither, nor by compute.
  forelock::Hair moving;
  FlkHairDesc desc = forelock::hairDesc();
  desc.asset = asset;
  desc.flags = FLK_HAIR_HOST_POSITIONS;
  ASSERT_EQ(forelock::create(scene.context, desc, moving), FLK_SUCCESS);
  FlkHairPositions positions{};
  positions.address = scene.positions(1600);
  for (int axis = 0; axis < 3; ++axis) positions.min_bounds[axis] = -0.1f, positions.max_bounds[axis] = 0.1f;
  ASSERT_EQ(flkHairSetPositions(moving, &positions), FLK_SUCCESS);
  ++number;
  frame = scene.frame(number, number - 1, {moving});
  frame.capture = FLK_CAPTURE_COMPUTE;
  scene.driver.commands.clear();
  ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS);
  EXPECT_EQ(scene.driver.countCommands("vkCmdDispatch"), 2u);  // clear and resolve
  scene.driver.completed = number;
}

TEST_F(Recording, everyMethodAndDisplay) {
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
    for (uint32_t display = 0; display <= FLK_DISPLAY_LAYERS; ++display)
      for (uint32_t payload = 0; payload <= FLK_PAYLOAD_PAPER; ++payload)
        for (uint32_t capture = FLK_CAPTURE_RASTER; capture <= FLK_CAPTURE_COMPUTE; ++capture)
          for (const bool depth : {false, true})
            for (const bool shadow : {false, true}) {
              FlkFrame frame = next();
              frame.method = method;
              frame.display = display;
              frame.payload = payload;
              frame.capture = capture;
              scene.light.casts_shadow = shadow;
              if (!depth) frame.depth = FlkDepthSource{};
              render(frame);
              const bool planned = infoOf(plan).full_shade_taps + infoOf(plan).low_shade_taps > 0 && hasResource("shadow map");
              EXPECT_EQ(planned, shadow && display == FLK_DISPLAY_SHADED) << method << ' ' << display;
            }
  EXPECT_TRUE(scene.clean());
}

TEST_F(Recording, pipelinesAreCompiledOnce) {
  render(next());
  const auto compiled = [&] {
    return scene.driver.calls["vkCreateGraphicsPipelines"] + scene.driver.calls["vkCreateComputePipelines"];
  };
  const uint64_t after_first = compiled();
  EXPECT_EQ(after_first, 3u);  // shadow, capture, resolve
  for (int i = 0; i < 5; ++i) render(next());
  EXPECT_EQ(compiled(), after_first);
  // A steady view takes no memory either.
  const uint64_t allocations = scene.driver.calls["vkAllocateMemory"];
  for (int i = 0; i < 5; ++i) render(next());
  EXPECT_EQ(scene.driver.calls["vkAllocateMemory"], allocations);
}

TEST_F(Recording, noShadowWithoutAShadowingLight) {
  scene.light.casts_shadow = 0;
  render(next());
  EXPECT_EQ(stages(), (std::vector<uint32_t>{FLK_STAGE_CLEAR, FLK_STAGE_CAPTURE, FLK_STAGE_RESOLVE}));
  EXPECT_FALSE(hasResource("shadow map"));
  EXPECT_EQ(infoOf(plan).full_shade_taps, 0u);
  EXPECT_EQ(infoOf(plan).low_shade_taps, 0u);
  EXPECT_EQ(scene.driver.alive(mock::Kind::Image), 0u);
  EXPECT_EQ(scene.driver.countCommands("vkCmdBeginRendering"), 1u);
  FlkShadowMap map;
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 0, &map), FLK_NOT_READY);

  // And the same without any light.
  FlkFrame frame = next();
  frame.light_count = 0;
  frame.lights = nullptr;
  render(frame);
  EXPECT_EQ(stages(), (std::vector<uint32_t>{FLK_STAGE_CLEAR, FLK_STAGE_CAPTURE, FLK_STAGE_RESOLVE}));
  EXPECT_EQ(scene.driver.alive(mock::Kind::Image), 0u);

  // A light that casts one again brings the map.
  scene.light.casts_shadow = 1;
  render(next());
  EXPECT_TRUE(hasResource("shadow map"));
  EXPECT_EQ(scene.driver.alive(mock::Kind::Image), 1u);
  ASSERT_EQ(flkViewGetShadowMap(view, 0, 0, &map), FLK_SUCCESS);
  EXPECT_EQ(map.size, 512u);
  EXPECT_NE(map.image, VkImage{});
  EXPECT_NE(map.view, VkImageView{});
  EXPECT_GT(map.depth_range, 0.0f);
  EXPECT_NE(flkViewGetShadowMap(view, 1, 0, &map), FLK_SUCCESS);

  // Without it, its memory goes again once no frame in flight uses it.
  scene.light.casts_shadow = 0;
  for (int i = 0; i < 8; ++i) render(next());
  EXPECT_EQ(scene.driver.alive(mock::Kind::Image), 0u) << "memory of a shadow map that nobody needs";
}

TEST_F(Recording, nothingInView) {
  // Behind the camera, not there, and beside the picture.
  for (int kind = 0; kind < 3; ++kind) {
    FlkFrame frame = next();
    if (kind == 0) frame.view_from_world[14] = 5.0;
    if (kind == 1) frame.hair_count = 0, frame.hairs = nullptr;
    if (kind == 2) frame.view_from_world[12] = 50.0;
    const size_t memories = scene.driver.alive(mock::Kind::Memory);
    render(frame);
    const FlkPlanInfo info = infoOf(plan);
    EXPECT_EQ(info.pass_count, 0u);
    EXPECT_EQ(info.bytes_transient, 0u);
    EXPECT_EQ(info.node_capacity, 0u);
    for (const uint32_t side : info.rect) EXPECT_EQ(side, 0u);
    EXPECT_EQ(scene.driver.alive(mock::Kind::Memory), memories);
    ASSERT_EQ(scene.driver.commandNames(), std::vector<std::string>{"vkCmdPipelineBarrier2"});
    const mock::Command& command = scene.driver.commands[0];
    ASSERT_EQ(command.image_barriers.size(), 1u);
    const VkImageMemoryBarrier2& barrier = command.image_barriers[0];
    EXPECT_EQ(barrier.image, frame.target.image);
    EXPECT_EQ(barrier.oldLayout, frame.target.entry.layout);
    EXPECT_EQ(barrier.newLayout, frame.target.exit.layout);
    FlkStatistics statistics;
    ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
    EXPECT_EQ(statistics.frame_number, number);
    EXPECT_EQ(statistics.fragments, 0u);
    EXPECT_EQ(statistics.overflow_fragments, 0u);
    EXPECT_EQ(statistics.milliseconds_frame, -1.0);
  for (const double time : statistics.milliseconds) EXPECT_EQ(time, -1.0);
  }
}

// The picture comes in the host's layout and goes in the host's layout, with the host's stages waited for.
TEST_F(Recording, layoutsOfTheTarget) {
  const FlkFrame frame = next();
  render(frame);
  std::vector<VkImageMemoryBarrier2> barriers;
  for (const mock::Command& command : scene.driver.commands)
    for (const VkImageMemoryBarrier2& barrier : command.image_barriers)
      if (barrier.image == frame.target.image) barriers.push_back(barrier);
  ASSERT_EQ(barriers.size(), 2u);
  EXPECT_EQ(barriers[0].oldLayout, frame.target.entry.layout);
  EXPECT_EQ(barriers[0].srcStageMask & frame.target.entry.stages, frame.target.entry.stages);
  EXPECT_EQ(barriers[0].srcAccessMask & frame.target.entry.access, frame.target.entry.access);
  EXPECT_EQ(barriers[0].newLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_TRUE(barriers[0].dstStageMask & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_EQ(barriers[1].oldLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_TRUE(barriers[1].srcStageMask & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_TRUE(barriers[1].srcAccessMask & VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  EXPECT_EQ(barriers[1].newLayout, frame.target.exit.layout);
  EXPECT_EQ(barriers[1].dstStageMask & frame.target.exit.stages, frame.target.exit.stages);
  EXPECT_EQ(barriers[1].dstAccessMask & frame.target.exit.access, frame.target.exit.access);
  // The depth source is made visible and keeps its layout.
  bool depth_awaited = false;
  for (const mock::Command& command : scene.driver.commands)
    for (const VkImageMemoryBarrier2& barrier : command.image_barriers)
      if (barrier.image == frame.depth.image) {
        EXPECT_EQ(barrier.oldLayout, barrier.newLayout);
        EXPECT_EQ(barrier.srcStageMask & frame.depth.entry_stages, frame.depth.entry_stages);
        EXPECT_TRUE(barrier.dstStageMask & VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
        depth_awaited = true;
      }
  EXPECT_TRUE(depth_awaited);
}

// Timestamps are written only when asked for, and read without waiting.
TEST_F(Recording, timesOfPasses) {
  FlkFrame frame = next();
  frame.timestamps = 0;
  render(frame);
  EXPECT_EQ(scene.driver.countCommands("vkCmdWriteTimestamp2"), 0u);
  EXPECT_EQ(scene.driver.alive(mock::Kind::QueryPool), 0u) << "queries that nobody asked for";
  render(next());
  EXPECT_GT(scene.driver.countCommands("vkCmdWriteTimestamp2"), 0u);
  FlkStatistics statistics;
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.frame_number, number);
  for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage)
    EXPECT_NEAR(statistics.milliseconds[stage], stage == FLK_STAGE_PREPARE || stage == FLK_STAGE_OUTPUT ? -1.0 : 1.0, 1e-9) << stage;

  EXPECT_NEAR(statistics.milliseconds_frame, double(FLK_STAGE_COUNT), 1e-9);

  frame = next();
  frame.timestamps = FLK_TIMESTAMPS_FRAME;
  render(frame);
  EXPECT_EQ(scene.driver.countCommands("vkCmdWriteTimestamp2"), 2u);
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_GT(statistics.milliseconds_frame, 0.0);
  for (uint32_t stage = 0; stage < FLK_STAGE_COUNT; ++stage) EXPECT_EQ(statistics.milliseconds[stage], -1.0) << stage;

  scene.light.casts_shadow = 0;
  render(next());
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.milliseconds[FLK_STAGE_SHADOW], -1.0);
  EXPECT_GT(statistics.milliseconds[FLK_STAGE_CAPTURE], 0.0);

  frame = next();
  frame.timestamps = 0;
  render(frame);
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.milliseconds_frame, -1.0);
  for (const double time : statistics.milliseconds) EXPECT_EQ(time, -1.0);
}

// Hairs that are not in view are not captured; they may still cast shadows on those that are.
TEST_F(Recording, onlyHairsInView) {
  const forelock::Hair second = scene.createHair(asset);
  double beside[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 40, 0, 0, 1};
  ASSERT_EQ(flkHairSetTransform(second, beside), FLK_SUCCESS);
  FlkFrame frame = next();
  const FlkHair hairs[] = {hair, second};
  frame.hairs = hairs;
  frame.hair_count = 2;
  render(frame);
  FlkHairInfo info;
  ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
  for (const FlkPassInfo& pass : passesOf(plan))
    if (pass.stage == FLK_STAGE_CAPTURE) { EXPECT_EQ(pass.indices, uint64_t{6} * info.segment_count); }
  scene.driver.completed = number;
}

// A hair of more segments than one draw of 16-bit indices holds.
TEST_F(Recording, largeHairIsDrawnWhole) {
  const forelock::Asset large_asset = makeAsset(12000);
  const forelock::Hair large = scene.createHair(large_asset);
  FlkFrame frame = next();
  const FlkHair hairs[] = {large};
  frame.hairs = hairs;
  render(frame);
  EXPECT_EQ(infoOf(plan).segment_count, 84000u);
  scene.driver.completed = number;
}

}  // namespace
