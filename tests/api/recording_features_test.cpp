// Optional parts of a frame as commands: capture by compute, counting, hard, host positions, shadow maps in one image, outputs.
#include "scene.h"

#include <algorithm>
#include <functional>
#include <set>

namespace {

class RecordingFeatures : public testing::Test {
protected:
  void create(bool compute_queue = false) {
    if (compute_queue) scene.useComputeQueue();
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    asset = makeAsset(200, 0.0f, nullptr, true);
    hair = scene.createFullHair(asset);
    view = scene.createView();
  }
  void TearDown() override {
    scene.driver.completed = UINT64_MAX;
    view.reset();
    hair.reset();
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }

  FlkFrame next(bool full = true) {
    ++number;
    return full ? scene.fullFrame(number, number - 1, {hair}) : scene.frame(number, number - 1, {hair});
  }
  void render(const FlkFrame& frame) {
    scene.driver.commands.clear();
    ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
  }
  std::vector<std::string> passNames() const {
    std::vector<std::string> names;
    for (const FlkPassInfo& pass : passesOf(plan)) names.emplace_back(pass.name);
    return names;
  }
  std::set<std::string> resourceNames() const {
    std::set<std::string> names;
    for (const FlkResourceInfo& resource : resourcesOf(plan)) names.insert(resource.name);
    return names;
  }
  std::vector<VkImageMemoryBarrier2> barriersOf(VkImage image) const {
    std::vector<VkImageMemoryBarrier2> found;
    for (const mock::Command& command : scene.driver.commands)
      for (const VkImageMemoryBarrier2& barrier : command.image_barriers)
        if (barrier.image == image) found.push_back(barrier);
    return found;
  }
  // Whether a barrier of any kind stands between the first and the second command for which `is` holds.
  bool barrierBetween(const std::string& first, const std::string& second) const {
    size_t at = 0;
    const auto& commands = scene.driver.commands;
    while (at < commands.size() && commands[at].name != first) ++at;
    for (++at; at < commands.size() && commands[at].name != second; ++at)
      if (commands[at].name == "vkCmdPipelineBarrier2") return true;
    return false;
  }

  Scene scene;
  forelock::Asset asset;
  forelock::Hair hair;
  forelock::View view;
  FlkPlan plan = nullptr;
  uint64_t number = 0;
};

TEST_F(RecordingFeatures, everythingAtOnce) {
  create();
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
    for (uint32_t capture = FLK_CAPTURE_RASTER; capture <= FLK_CAPTURE_COMPUTE; ++capture) {
      FlkFrame frame = next();
      frame.method = method, frame.capture = capture;
      render(frame);
      std::vector<std::string> expected{"clear", "prepare", "shadow"};
      if (method == FLK_METHOD_HARD) expected.insert(expected.end(), {"capture depth", "capture nearest"});
      else expected.emplace_back("capture");
      expected.insert(expected.end(), {"resolve", "output front depth", "output transmittance", "output velocity", "output depth range"});
      EXPECT_EQ(passNames(), expected);
      const bool raster = capture == FLK_CAPTURE_RASTER;
      EXPECT_EQ(scene.driver.countCommands("vkCmdBeginRendering"), raster ? (method == FLK_METHOD_HARD ? 3u : 2u) : 0u);
      for (const FlkPassInfo& pass : passesOf(plan)) {
        EXPECT_EQ(pass.hash == 0, pass.stage == FLK_STAGE_CLEAR && raster) << pass.name;  // shadow maps by compute are cleared so
        const bool draws = pass.stage == FLK_STAGE_SHADOW || pass.stage == FLK_STAGE_CAPTURE;
        EXPECT_EQ(pass.indices != 0, draws && raster) << pass.name;
        EXPECT_EQ(pass.segments != 0, draws && !raster) << pass.name;
      }
    }
  EXPECT_TRUE(scene.clean());
}

// Compute: the default without graphics; the rasteriser is refused; nothing of graphics is recorded, which the driver watches.
TEST_F(RecordingFeatures, aQueueWithoutGraphics) {
  create(true);
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
    for (uint32_t display = 0; display <= FLK_DISPLAY_LAYERS; ++display) {
      FlkFrame frame = next();
      frame.method = method, frame.display = display;
      frame.capture = method % 2 ? FLK_CAPTURE_DEFAULT : FLK_CAPTURE_COMPUTE;
      render(frame);
      for (const FlkPassInfo& pass : passesOf(plan)) EXPECT_EQ(pass.indices, 0u) << pass.name;
    }
  FlkFrame counting = next();
  counting.count_only = 1;
  render(counting);
  FlkFrame empty = next();
  empty.hair_count = 0;
  render(empty);
  EXPECT_EQ(scene.driver.calls.count("vkCreateGraphicsPipelines"), 0u);
  EXPECT_EQ(scene.driver.calls.count("vkCmdBeginRendering"), 0u);
  EXPECT_EQ(scene.driver.calls.count("vkCmdBindIndexBuffer"), 0u);

  FlkFrame raster = next();
  raster.capture = FLK_CAPTURE_RASTER;
  scene.message_ids.clear();
  FlkPlan refused = nullptr;
  EXPECT_EQ(flkPlanFrame(view, &raster, &refused), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(refused, nullptr);
  EXPECT_FALSE(scene.message_ids.empty());
  raster.capture = FLK_CAPTURE_DEFAULT;
  render(raster);
  EXPECT_TRUE(scene.clean());
}

TEST(ComputeQueue, needsNoFragmentBallots) {
  Scene scene;
  scene.useComputeQueue();
  scene.driver.claims.properties11.subgroupSupportedStages = VK_SHADER_STAGE_COMPUTE_BIT;
  EXPECT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
  scene.context.reset();
  scene.driver.claims.properties11.subgroupSupportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT;
  EXPECT_EQ(scene.createContext(), FLK_ERROR_UNSUPPORTED_DEVICE);
  EXPECT_EQ(scene.message_ids.back(), "DEVICE_SUBGROUP");
  EXPECT_NE(scene.last_message.find("ballot"), std::string::npos) << scene.last_message;
  EXPECT_TRUE(scene.nothingLeft());
}

TEST_F(RecordingFeatures, rasterIsTheDefaultWithGraphics) {
  create();
  render(next());
  EXPECT_GT(scene.driver.countCommands("vkCmdDrawIndexed"), 0u);
}

// A count, then a frame whose lists suffice, however far the estimate was off.
TEST_F(RecordingFeatures, countFirst) {
  create();
  for (uint32_t method = 0; method < FLK_METHOD_HARD; ++method) {
    view = scene.createView();
    FlkFrame frame = next();
    frame.method = method;
    frame.count_only = 1;
    render(frame);
    EXPECT_EQ(passNames(), (std::vector<std::string>{"clear", "prepare", "count"}));
    EXPECT_EQ(resourceNames(), (std::set<std::string>{"constants", "counters", "read-back"}));
    EXPECT_EQ(infoOf(plan).node_capacity, 0u);
    EXPECT_GT(infoOf(plan).rect[2], 0u);
    // The pictures go from the host to the host, untouched.
    std::vector<VkImage> pictures{frame.target.image};
    for (const FlkOutputImage& output : frame.outputs) pictures.push_back(output.image);
    for (size_t i = 0; i < pictures.size(); ++i) {
      const auto barriers = barriersOf(pictures[i]);
      ASSERT_EQ(barriers.size(), 1u) << i;
      EXPECT_EQ(barriers[0].oldLayout, i ? frame.outputs[i - 1].entry.layout : frame.target.entry.layout);
      EXPECT_EQ(barriers[0].newLayout, i ? frame.outputs[i - 1].exit.layout : frame.target.exit.layout);
    }
    constexpr uint32_t kMany = 3000000;
    *scene.driver.latestReadBack() = kMany;
    FlkStatistics statistics{};
    ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
    EXPECT_EQ(statistics.fragments, kMany);
    EXPECT_EQ(statistics.overflow_fragments, 0u) << "nothing was to be stored";

    frame = next();
    frame.method = method;
    render(frame);
    EXPECT_GE(infoOf(plan).node_capacity, kMany);
    EXPECT_LE(infoOf(plan).node_capacity, kMany * 5 / 4);
    *scene.driver.latestReadBack() = kMany;
    ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
    EXPECT_EQ(statistics.overflow_fragments, 0u);
    scene.driver.completed = number;
  }
}

TEST_F(RecordingFeatures, countsOfWork) {
  create();
  render(next());
  uint32_t* counters = scene.driver.latestReadBack();
  ASSERT_NE(counters, nullptr);
  // As FLK_COUNTER_... of shaders/shared/node.h.
  const uint32_t values[6] = {1000, 20, 300, 5, 1, 77};
  std::copy(values, values + 6, counters);
  FlkStatistics statistics{};
  ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.fragments, 1000u);
  EXPECT_EQ(statistics.full_shades, 20u);
  EXPECT_EQ(statistics.low_shades, 300u);
  EXPECT_EQ(statistics.shadow_taps, (uint64_t{1} << 32) + 5);
  EXPECT_EQ(statistics.pixels, 77u);
  for (const double ms : statistics.milliseconds) EXPECT_NEAR(ms, 1.0, 1e-9);
}

TEST_F(RecordingFeatures, hardIsTwoCaptures) {
  create();
  for (uint32_t capture = FLK_CAPTURE_RASTER; capture <= FLK_CAPTURE_COMPUTE; ++capture) {
    FlkFrame frame = next(false);
    frame.method = FLK_METHOD_HARD, frame.capture = capture;
    frame.light_count = 0;
    render(frame);
    EXPECT_FALSE(resourceNames().count("nodes"));
    EXPECT_FALSE(resourceNames().count("aggregates"));
    if (capture == FLK_CAPTURE_RASTER) { EXPECT_TRUE(barrierBetween("vkCmdEndRendering", "vkCmdBeginRendering")); }
    FlkStatistics statistics{};
    *scene.driver.latestReadBack() = 1000000;
    ASSERT_EQ(flkViewGetStatistics(view, number, &statistics), FLK_SUCCESS);
    EXPECT_EQ(statistics.overflow_fragments, 0u);
  }
}

TEST_F(RecordingFeatures, aggregatesAreClearedOrNotThere) {
  create();
  FlkFrame frame = next(false);
  render(frame);
  EXPECT_TRUE(resourceNames().count("aggregates"));
  const size_t fills = scene.driver.countCommands("vkCmdFillBuffer");
  frame = next(false);
  frame.overflow = FLK_OVERFLOW_DROP;
  render(frame);
  EXPECT_FALSE(resourceNames().count("aggregates"));
  EXPECT_EQ(scene.driver.countCommands("vkCmdFillBuffer"), fills - 1);
}

// Positions of the host are read once a frame, after what wrote them, and no more once they are taken back.
TEST_F(RecordingFeatures, hostPositions) {
  create();
  forelock::Hair still = scene.createHair(asset);
  const FlkHair both[] = {still, hair};
  FlkFrame frame = next();
  frame.hairs = both, frame.hair_count = 2;
  render(frame);
  EXPECT_EQ(passNames()[1], "prepare");
  const auto& commands = scene.driver.commands;
  const auto prepare = std::find_if(commands.begin(), commands.end(), [](const mock::Command& c) { return c.name == "vkCmdDispatch"; });
  ASSERT_NE(prepare, commands.end());
  EXPECT_EQ(prepare->numbers, (std::vector<uint64_t>{(600 + 63) / 64, 1, 1}));  // a thread a strand
  EXPECT_EQ((prepare - 1)->name, "vkCmdPushConstants");
  EXPECT_EQ((prepare - 2)->name, "vkCmdPipelineBarrier2");
  EXPECT_EQ((prepare + 1)->name, "vkCmdPipelineBarrier2");

  // Bounds that lie elsewhere: the host moved it out of view.
  FlkHairPositions away{};
  away.address = scene.positions(1600);
  for (int axis = 0; axis < 3; ++axis) away.min_bounds[axis] = 50.0f, away.max_bounds[axis] = 51.0f;
  ASSERT_EQ(flkHairSetPositions(hair, &away), FLK_SUCCESS);
  frame = next(false);
  frame.light_count = 0;
  render(frame);
  EXPECT_EQ(infoOf(plan).pass_count, 0u);

  ASSERT_EQ(flkHairSetPositions(hair, nullptr), FLK_SUCCESS);
  render(next());
  const auto names = passNames();
  EXPECT_EQ(std::count(names.begin(), names.end(), "prepare"), 0);
  EXPECT_EQ(names[1], "shadow");
  scene.driver.completed = number;
}

// Every map is a rectangle of the one image, drawn with its own viewport, and told to the host as it is drawn.
TEST_F(RecordingFeatures, shadowMapsOfOneImage) {
  create();
  for (uint32_t capture = FLK_CAPTURE_RASTER; capture <= FLK_CAPTURE_COMPUTE; ++capture) {
    FlkFrame frame = next();
    frame.capture = capture;
    render(frame);
    // The map of the other capture goes with the plan after.
    EXPECT_EQ(scene.driver.alive(mock::Kind::Image), capture == FLK_CAPTURE_RASTER ? 1u : 2u);
    std::vector<FlkShadowMap> maps;
    for (uint32_t light = 0; light < 4; ++light) {
      FlkShadowMap map{};
      ASSERT_EQ(flkViewGetShadowMap(view, light, 0, &map), FLK_SUCCESS) << light;
      EXPECT_EQ(map.face_count, light == 3 ? 6u : 1u);
      EXPECT_EQ(map.perspective, light ? 1u : 0u);
      for (uint32_t face = 0; face < map.face_count; ++face) {
        ASSERT_EQ(flkViewGetShadowMap(view, light, face, &map), FLK_SUCCESS);
        EXPECT_EQ(map.face, face);
        EXPECT_EQ(map.size, frame.lights[light].shadow_size);
        EXPECT_EQ(map.format, capture == FLK_CAPTURE_RASTER ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R32_SFLOAT);
        EXPECT_EQ(reinterpret_cast<const mock::Object*>(map.view)->format, map.format);
        EXPECT_GT(map.depth_range, 0.0f);
        EXPECT_GT(map.texel, 0.0f);
        maps.push_back(map);
      }
    }
    ASSERT_EQ(maps.size(), 9u);
    for (const FlkShadowMap& map : maps) {
      EXPECT_EQ(map.image, maps[0].image);
      EXPECT_EQ(map.view, maps[0].view);
    }
    std::vector<uint64_t> scissors;
    for (const mock::Command& command : scene.driver.commands)
      if (command.name == "vkCmdSetScissor") scissors.push_back(command.numbers[0]);
    if (capture == FLK_CAPTURE_RASTER) {
      ASSERT_EQ(scissors.size(), maps.size() + 1);  // and one to capture
      for (size_t i = 0; i < maps.size(); ++i) EXPECT_EQ(scissors[i], maps[i].size);
    }
    // Left so that the host can read it.
    const auto barriers = barriersOf(maps[0].image);
    EXPECT_EQ(barriers.back().newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }
}

TEST_F(RecordingFeatures, layoutsOfOutputs) {
  create();
  FlkFrame frame = next();
  render(frame);
  for (const FlkOutputImage& output : frame.outputs) {
    const auto barriers = barriersOf(output.image);
    ASSERT_EQ(barriers.size(), 2u);
    EXPECT_EQ(barriers[0].oldLayout, output.entry.layout);
    EXPECT_EQ(barriers[0].srcStageMask, output.entry.stages);
    EXPECT_EQ(barriers[0].newLayout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(barriers[1].oldLayout, VK_IMAGE_LAYOUT_GENERAL);
    EXPECT_EQ(barriers[1].newLayout, output.exit.layout);
    EXPECT_EQ(barriers[1].dstStageMask, output.exit.stages);
    EXPECT_EQ(barriers[1].dstAccessMask, output.exit.access);
  }
  // The host's pictures are awaited and keep their layout; once a frame.
  for (const FlkSampledImage* image : {&frame.host_shadow_maps, &frame.host_visibility}) {
    const auto barriers = barriersOf(image->image);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].oldLayout, barriers[0].newLayout);
    EXPECT_EQ(barriers[0].srcStageMask, image->entry_stages);
  }
  // Out of view: from entry to exit all the same.
  frame = next();
  frame.view_from_world[14] = 5.0;
  render(frame);
  EXPECT_EQ(infoOf(plan).pass_count, 0u);
  for (const FlkOutputImage& output : frame.outputs) {
    const auto barriers = barriersOf(output.image);
    ASSERT_EQ(barriers.size(), 1u);
    EXPECT_EQ(barriers[0].oldLayout, output.entry.layout);
    EXPECT_EQ(barriers[0].newLayout, output.exit.layout);
  }
}

// A frame that could have everything and names nothing runs the very code of one that has never heard of it.
TEST_F(RecordingFeatures, whatIsOffCostsNothing) {
  create();
  forelock::Hair plain_hair;
  {
    FlkHairDesc desc = forelock::hairDesc();
    desc.asset = asset;
    desc.flags = FLK_HAIR_IGNORE_COLORS;
    ASSERT_EQ(forelock::create(scene.context, desc, plain_hair), FLK_SUCCESS);
    EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, plain_hair), FLK_SUCCESS);
  }
  const auto described = [&](const FlkFrame& frame) {
    forelock::View fresh = scene.createView();
    scene.driver.commands.clear();
    EXPECT_EQ(scene.render(fresh, frame, &plan), FLK_SUCCESS) << scene.last_message;
    std::string text;
    for (const FlkPassInfo& pass : passesOf(plan)) text += std::string(pass.name) + ' ' + std::to_string(pass.hash) + '\n';
    for (const FlkResourceInfo& resource : resourcesOf(plan)) text += std::string(resource.name) + ' ' + std::to_string(resource.bytes) + '\n';
    for (const std::string& name : scene.driver.commandNames()) text += name + '\n';
    scene.driver.completed = frame.frame_number;
    return text;
  };
  ++number;
  const std::string plain = described(scene.frame(number, number - 1, {plain_hair}));
  ++number;
  FlkFrame off = scene.fullFrame(number, number - 1, {plain_hair});
  off.lights = &scene.light, off.light_count = 1;
  off.ambient_sh = nullptr;
  off.light_tiles = FlkLightTiles{};
  off.opacity_modifier_count = 0;
  for (FlkOutputImage& output : off.outputs) output = FlkOutputImage{};
  off.count_work = 0;
  // The host's pictures without a light that looks at them, a motion that no output shows.
  EXPECT_EQ(described(off), plain);
  // And another ambient colour, another light, another material are other numbers, not other code.
  ++number;
  FlkFrame other = scene.frame(number, number - 1, {plain_hair});
  other.ambient[1] = 3.0f, other.exposure = 2.0f;
  scene.light.radiance[0] = 7.0f;
  EXPECT_EQ(described(other), plain);
}

}  // namespace
