// Every optional part of a frame and of a hair, outside its range: docs of sdk/include/forelock/render.h.
#include "hostile.h"

namespace {

constexpr double kDoubleNan = std::numeric_limits<double>::quiet_NaN();

class HostileFeatures : public Hostile {
protected:
  void SetUp() override {
    Hostile::SetUp();
    full = true;
  }
};

// The frame that the cases spoil is good, and so are the ends of its ranges.
TEST_F(HostileFeatures, theWholeFrameIsGood) {
  uint64_t number = 1;
  const auto fine = [&](const char* what, const std::function<void(FlkFrame&)>& change) {
    FlkFrame frame = good(number++);
    change(frame);
    EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << what << ": " << scene.last_message;
  };
  fine("as it is", [](FlkFrame&) {});
  for (const uint32_t size : {0u, 64u, 1024u}) fine("map size", [&](FlkFrame&) { scene.lights[0].shadow_size = size; });
  fine("maps covered by width", [&](FlkFrame&) {
    for (FlkLight& light : scene.lights) light.shadow_cover = FLK_SHADOW_COVER_WIDTH;
  });
  fine("one map of several covered by width", [&](FlkFrame&) { scene.lights[2].shadow_cover = FLK_SHADOW_COVER_WIDTH; });
  fine("no range, no radius", [&](FlkFrame&) { scene.lights[1].range = 0.0f, scene.lights[1].source_radius = 0.0f; });
  fine("a spot of a half space", [&](FlkFrame&) { scene.lights[2].inner_angle = 0.0f, scene.lights[2].outer_angle = 1.57079632f; });
  fine("a spot like a ray", [&](FlkFrame&) { scene.lights[2].inner_angle = 0.0f, scene.lights[2].outer_angle = 1e-38f; });
  fine("a far light", [&](FlkFrame&) { scene.lights[1].position[0] = -1e15; });
  fine("a point light needs no direction", [&](FlkFrame&) {
    for (float& d : scene.lights[1].direction) d = kNan;
  });
  fine("a sun needs no position", [&](FlkFrame&) {
    scene.lights[0].position[0] = kDoubleNan, scene.lights[0].range = kNan, scene.lights[0].outer_angle = kNan;
  });
  fine("no light", [](FlkFrame& f) { f.light_count = 0, f.lights = nullptr; });
  fine("no harmonics", [](FlkFrame& f) { f.ambient_sh = nullptr; });
  fine("harmonics below 0", [&](FlkFrame&) { scene.harmonics.assign(27, -1e30f); });
  fine("no modifier", [](FlkFrame& f) { f.opacity_modifier_count = 0, f.opacity_modifiers = nullptr; });
  fine("four modifiers", [&](FlkFrame& f) {
    scene.modifiers.assign(4, scene.modifiers[1]);
    f.opacity_modifiers = scene.modifiers.data(), f.opacity_modifier_count = 4;
  });
  fine("a hard lens of nothing", [&](FlkFrame&) { scene.modifiers[1].radius = 0.0f, scene.modifiers[1].feather = 1e-3f, scene.modifiers[1].inside = 0.0f; });
  fine("a fade from the eye", [&](FlkFrame&) { scene.modifiers[0].start = 0.0f; });
  fine("no tiles", [](FlkFrame& f) { f.light_tiles = FlkLightTiles{}; });
  fine("tiles that just cover", [](FlkFrame& f) { f.light_tiles.tile_size = 1024, f.light_tiles.tiles_x = f.light_tiles.tiles_y = 1; });
  fine("a missing view stands for no output", [](FlkFrame& f) { f.outputs[1] = FlkOutputImage{}; });
  fine("the same camera before", [](FlkFrame& f) { f.previous_view_from_world = nullptr, f.previous_clip_from_view = nullptr; });
  fine("one picture of the host for both", [&](FlkFrame& f) {
    f.host_visibility = FlkSampledImage{};
    scene.lights[1].visibility = scene.lights[2].visibility = 0;
  });
  fine("no picture of the host", [&](FlkFrame& f) {
    f.host_visibility = f.host_shadow_maps = FlkSampledImage{};
    for (FlkLight& l : scene.lights) l.visibility = 0, l.host_shadow = nullptr;
  });
  EXPECT_TRUE(scene.clean());
}

TEST_F(HostileFeatures, choices) {
  check({
      {"tail", kInvalid, [](FlkFrame& f) { f.tail = 4; }},
      {"low shade", kInvalid, [](FlkFrame& f) { f.low_shade = 3; }},
      {"taps", kInvalid, [](FlkFrame& f) { f.core_taps = 5; }},
      {"tail", kInvalid, [](FlkFrame& f) { f.tail = UINT32_MAX; }},
      {"capture", kInvalid, [](FlkFrame& f) { f.capture = 3; }},
      {"overflow", kInvalid, [](FlkFrame& f) { f.overflow = 2; }},
      {"count_only", kInvalid, [](FlkFrame& f) { f.count_only = 2; }},
      {"count_work", kInvalid, [](FlkFrame& f) { f.count_work = 2; }},
      {"reversed_depth", kInvalid, [](FlkFrame& f) { f.reversed_depth = 2; }},
      {"k above k_sort", kInvalid, [](FlkFrame& f) { f.method = FLK_METHOD_CORE_ONLY, f.k = 9, f.k_sort = 8; }},
      {"default k above k_sort", kInvalid, [](FlkFrame& f) { f.k_sort = 7; }},
  });
}

TEST_F(HostileFeatures, lightsOfThreeKinds) {
  check({
      {"kind", kInvalid, [this](FlkFrame&) { scene.lights[0].kind = 3; }},
      {"casts_shadow", kInvalid, [this](FlkFrame&) { scene.lights[0].casts_shadow = 2; }},
      {"odd map", kInvalid, [this](FlkFrame&) { scene.lights[1].shadow_size = 101; }},
      {"map of 62", kInvalid, [this](FlkFrame&) { scene.lights[1].shadow_size = 62; }},
      {"map of 8194", kInvalid, [this](FlkFrame&) { scene.lights[1].shadow_size = 8194; }},
      {"NaN position", kInvalid, [this](FlkFrame&) { scene.lights[1].position[2] = kDoubleNan; }},
      {"infinite position", kInvalid, [this](FlkFrame&) { scene.lights[2].position[0] = HUGE_VAL; }},
      {"position beyond 1e15", kInvalid, [this](FlkFrame&) { scene.lights[2].position[0] = -1.1e15; }},
      {"range below 0", kInvalid, [this](FlkFrame&) { scene.lights[1].range = -1.0f; }},
      {"NaN range", kInvalid, [this](FlkFrame&) { scene.lights[2].range = kNan; }},
      {"infinite range", kInvalid, [this](FlkFrame&) { scene.lights[2].range = kInfinity; }},
      {"source_radius below 0", kInvalid, [this](FlkFrame&) { scene.lights[1].source_radius = -1.0f; }},
      {"NaN source_radius", kInvalid, [this](FlkFrame&) { scene.lights[1].source_radius = kNan; }},
      {"inner = outer", kInvalid, [this](FlkFrame&) { scene.lights[2].inner_angle = scene.lights[2].outer_angle; }},
      {"inner below 0", kInvalid, [this](FlkFrame&) { scene.lights[2].inner_angle = -0.1f; }},
      {"NaN inner", kInvalid, [this](FlkFrame&) { scene.lights[2].inner_angle = kNan; }},
      {"outer above pi / 2", kInvalid, [this](FlkFrame&) { scene.lights[2].outer_angle = 1.58f; }},
      {"NaN outer", kInvalid, [this](FlkFrame&) { scene.lights[2].outer_angle = kNan; }},
      {"a spot without a direction", kInvalid, [this](FlkFrame&) { for (float& d : scene.lights[2].direction) d = 0.0f; }},
      {"radiance of the last", kInvalid, [this](FlkFrame&) { scene.lights[4].radiance[1] = kInfinity; }},
      {"shadow_cover", kInvalid, [this](FlkFrame&) { scene.lights[0].shadow_cover = 2; }},
      {"largest shadow_cover", kInvalid, [this](FlkFrame&) { scene.lights[3].shadow_cover = UINT32_MAX; }},
      {"visibility layer", kInvalid, [this](FlkFrame&) { scene.lights[2].visibility = 65537; }},
  });
}

TEST_F(HostileFeatures, shadowMapsThatDoNotFit) {
  static std::vector<FlkLight> many;
  many.assign(97, scene.light);
  for (FlkLight& light : many) light.shadow_size = 64;
  static std::vector<FlkLight> large;
  large.assign(5, scene.light);
  for (FlkLight& light : large) light.shadow_size = 8192;
  check({
      {"97 maps", FLK_ERROR_LIMIT, [](FlkFrame& f) { f.lights = many.data(), f.light_count = 97; }},
      {"17 point lights amid hair", FLK_ERROR_LIMIT, [](FlkFrame& f) {
         for (FlkLight& light : many) light.kind = FLK_LIGHT_POINT, light.position[1] = 0.05;
         f.lights = many.data(), f.light_count = 17;
       }},
      {"five of 8192", FLK_ERROR_LIMIT, [](FlkFrame& f) { f.lights = large.data(), f.light_count = 5; }},
  });
  // 4096 lights are allowed, 96 of them with maps, and only to count none is needed.
  std::vector<FlkLight> all(4096, scene.light);
  for (size_t i = 0; i < all.size(); ++i) all[i].shadow_size = 64, all[i].casts_shadow = i < 96;
  FlkFrame frame = good(100);
  frame.lights = all.data(), frame.light_count = 4096;
  EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << scene.last_message;
  for (FlkLight& light : all) light.casts_shadow = 1;
  frame = good(101);
  frame.lights = all.data(), frame.light_count = 4096, frame.count_only = 1;
  EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << scene.last_message;
}

TEST_F(HostileFeatures, hostShadows) {
  check({
      {"NaN matrix", kInvalid, [this](FlkFrame&) { scene.host_shadow.map_from_world[3] = kDoubleNan; }},
      {"infinite matrix", kInvalid, [this](FlkFrame&) { scene.host_shadow.map_from_world[15] = HUGE_VAL; }},
      {"NaN rect", kInvalid, [this](FlkFrame&) { scene.host_shadow.rect[2] = kNan; }},
      {"rect beyond 1e6", kInvalid, [this](FlkFrame&) { scene.host_shadow.rect[0] = 1.1e6f; }},
      {"bias below 0", kInvalid, [this](FlkFrame&) { scene.host_shadow.bias = -1e-3f; }},
      {"bias beyond 1e6", kInvalid, [this](FlkFrame&) { scene.host_shadow.bias = 1.1e6f; }},
      {"NaN bias", kInvalid, [this](FlkFrame&) { scene.host_shadow.bias = kNan; }},
      {"reversed", kInvalid, [this](FlkFrame&) { scene.host_shadow.reversed = 2; }},
      {"layer", kInvalid, [this](FlkFrame&) { scene.host_shadow.layer = 65536; }},
      {"no maps", kImage, [](FlkFrame& f) { f.host_shadow_maps = FlkSampledImage{}; }},
      {"maps without an image", kImage, [](FlkFrame& f) { f.host_shadow_maps.image = VK_NULL_HANDLE; }},
      {"maps in a layout for writing", kImage, [](FlkFrame& f) { f.host_shadow_maps.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL; }},
      {"maps in no layout", kImage, [](FlkFrame& f) { f.host_shadow_maps.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"no visibility", kImage, [](FlkFrame& f) { f.host_visibility = FlkSampledImage{}; }},
      {"visibility without an image", kImage, [](FlkFrame& f) { f.host_visibility.image = VK_NULL_HANDLE; }},
      {"visibility in a layout for copies", kImage, [](FlkFrame& f) { f.host_visibility.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL; }},
  });
}

TEST_F(HostileFeatures, lightTiles) {
  check({
      {"address", kInvalid, [](FlkFrame& f) { f.light_tiles.address += 2; }},
      {"size 0", kInvalid, [](FlkFrame& f) { f.light_tiles.tile_size = 0; }},
      {"size 7", kInvalid, [](FlkFrame& f) { f.light_tiles.tile_size = 7; }},
      {"size 1025", kInvalid, [](FlkFrame& f) { f.light_tiles.tile_size = 1025; }},
      {"too few across", kInvalid, [](FlkFrame& f) { f.light_tiles.tiles_x = 19; }},
      {"too few down", kInvalid, [](FlkFrame& f) { f.light_tiles.tiles_y = 12; }},
      {"too many", kInvalid, [](FlkFrame& f) { f.light_tiles.tiles_x = UINT32_MAX; }},
      {"too many down", kInvalid, [](FlkFrame& f) { f.light_tiles.tiles_y = 2049; }},
  });
}

TEST_F(HostileFeatures, ambientHarmonics) {
  check({
      {"NaN", kInvalid, [this](FlkFrame&) { scene.harmonics[26] = kNan; }},
      {"infinite", kInvalid, [this](FlkFrame&) { scene.harmonics[0] = -kInfinity; }},
      {"beyond 1e30", kInvalid, [this](FlkFrame&) { scene.harmonics[13] = 2e30f; }},
  });
}

TEST_F(HostileFeatures, opacityModifiers) {
  check({
      {"five", kInvalid, [](FlkFrame& f) { f.opacity_modifier_count = 5; }},
      {"very many", kInvalid, [](FlkFrame& f) { f.opacity_modifier_count = UINT32_MAX; }},
      {"none there", kInvalid, [](FlkFrame& f) { f.opacity_modifiers = nullptr; }},
      {"kind 0", kInvalid, [this](FlkFrame&) { scene.modifiers[0].kind = 0; }},
      {"kind 3", kInvalid, [this](FlkFrame&) { scene.modifiers[1].kind = 3; }},
      {"start below 0", kInvalid, [this](FlkFrame&) { scene.modifiers[0].start = -0.1f; }},
      {"NaN start", kInvalid, [this](FlkFrame&) { scene.modifiers[0].start = kNan; }},
      {"end = start", kInvalid, [this](FlkFrame&) { scene.modifiers[0].end = scene.modifiers[0].start; }},
      {"NaN end", kInvalid, [this](FlkFrame&) { scene.modifiers[0].end = kNan; }},
      {"infinite end", kInvalid, [this](FlkFrame&) { scene.modifiers[0].end = kInfinity; }},
      {"a ramp of nothing", kInvalid, [this](FlkFrame&) { scene.modifiers[0].start = 0.0f, scene.modifiers[0].end = 1e-40f; }},
      {"NaN center", kInvalid, [this](FlkFrame&) { scene.modifiers[1].center[1] = kNan; }},
      {"infinite center", kInvalid, [this](FlkFrame&) { scene.modifiers[1].center[0] = kInfinity; }},
      {"radius below 0", kInvalid, [this](FlkFrame&) { scene.modifiers[1].radius = -1.0f; }},
      {"NaN radius", kInvalid, [this](FlkFrame&) { scene.modifiers[1].radius = kNan; }},
      {"feather 0", kInvalid, [this](FlkFrame&) { scene.modifiers[1].feather = 0.0f; }},
      {"NaN feather", kInvalid, [this](FlkFrame&) { scene.modifiers[1].feather = kNan; }},
      {"inside below 0", kInvalid, [this](FlkFrame&) { scene.modifiers[1].inside = -0.01f; }},
      {"inside above 1", kInvalid, [this](FlkFrame&) { scene.modifiers[1].inside = 1.01f; }},
      {"NaN inside", kInvalid, [this](FlkFrame&) { scene.modifiers[1].inside = kNan; }},
  });
}

TEST_F(HostileFeatures, outputsAndMotion) {
  check({
      {"no image", kImage, [](FlkFrame& f) { f.outputs[FLK_OUTPUT_FRONT_DEPTH].image = VK_NULL_HANDLE; }},
      {"exit layout UNDEFINED", kImage, [](FlkFrame& f) { f.outputs[FLK_OUTPUT_VELOCITY].exit.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"exit layout PREINITIALIZED", kImage,
       [](FlkFrame& f) { f.outputs[FLK_OUTPUT_DEPTH_RANGE].exit.layout = VK_IMAGE_LAYOUT_PREINITIALIZED; }},
      {"NaN view before", kInvalid, [this](FlkFrame&) { scene.previous_view[5] = kDoubleNan; }},
      {"infinite view before", kInvalid, [this](FlkFrame&) { scene.previous_view[14] = HUGE_VAL; }},
      {"NaN projection before", kInvalid, [this](FlkFrame&) { scene.previous_clip[10] = kNan; }},
      {"infinite projection before", kInvalid, [this](FlkFrame&) { scene.previous_clip[0] = kInfinity; }},
  });
}

TEST_F(HostileFeatures, hairDescs) {
  const forelock::Asset dressed = makeAsset(20, 0.0f, nullptr, true);
  const float pixels[12] = {};
  FlkRootImage image{pixels, 2, 2};
  const auto creates = [&](const std::function<void(FlkHairDesc&)>& change) {
    FlkHairDesc desc = forelock::hairDesc();
    desc.asset = dressed;
    change(desc);
    const VkDeviceSize bytes = scene.driver.bytesAllocated();
    scene.message_ids.clear();
    FlkHair made = nullptr;
    const FlkResult result = flkHairCreate(scene.context, &desc, &made);
    EXPECT_EQ(result == FLK_SUCCESS, made != nullptr);
    if (result != FLK_SUCCESS) {
      EXPECT_EQ(scene.driver.bytesAllocated(), bytes);
      EXPECT_FALSE(scene.message_ids.empty()) << "nothing is said";
    }
    flkHairDestroy(made);
    return result;
  };
  EXPECT_EQ(creates([](FlkHairDesc&) {}), FLK_SUCCESS);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.flags = 7; }), FLK_SUCCESS);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.flags = 8; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.flags = 0x80000000u; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow = {1023, 1e6f, 1e3f, UINT32_MAX}; }), FLK_SUCCESS);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.count = 1024; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.count = UINT32_MAX; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.radius = -1.0f; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.radius = kNan; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.radius = 1.1e6f; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.spread_tip = -0.1f; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.spread_tip = 1001.0f; }), kInvalid);
  EXPECT_EQ(creates([](FlkHairDesc& d) { d.follow.spread_tip = kNan; }), kInvalid);
  EXPECT_EQ(creates([&](FlkHairDesc& d) { d.root_image = &image; }), FLK_SUCCESS);
  EXPECT_EQ(creates([&](FlkHairDesc& d) { d.root_image = &image, d.asset = asset; }), kInvalid) << "without root UVs";
  for (const FlkRootImage& bad : {FlkRootImage{nullptr, 2, 2}, FlkRootImage{pixels, 0, 2}, FlkRootImage{pixels, 2, 0},
                                  FlkRootImage{pixels, 16385, 2}, FlkRootImage{pixels, 2, UINT32_MAX}})
    EXPECT_EQ(creates([&](FlkHairDesc& d) { d.root_image = &bad; }), kInvalid) << bad.width << ' ' << bad.height;
  // Pixels out of range are held within it.
  const float wild[12] = {kNan, -1.0f, kInfinity, 1e38f, -kInfinity, kNan, 2.0f, 3.0f, 4.0f, kNan, kNan, kNan};
  image.rgb = wild;
  EXPECT_EQ(creates([&](FlkHairDesc& d) { d.root_image = &image; }), FLK_SUCCESS);
  // Follow strands beyond what an asset may hold.
  const forelock::Asset large = makeAsset(33000);
  EXPECT_EQ(creates([&](FlkHairDesc& d) { d.asset = large, d.follow.count = 1023; }), FLK_ERROR_LIMIT);
}

TEST_F(HostileFeatures, tipColours) {
  FlkMaterial standard;
  flkMaterialDefault(&standard);
  const auto sets = [&](const std::function<void(FlkMaterial&)>& change) {
    FlkMaterial material = standard;
    change(material);
    return flkHairSetMaterial(hair, &material);
  };
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_color[0] = m.tip_blend = 1.0f; }), FLK_SUCCESS);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_color[0] = 1.1f; }), kInvalid);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_color[1] = -0.1f; }), kInvalid);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_color[2] = kNan; }), kInvalid);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_blend = 1.1f; }), kInvalid);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_blend = -0.1f; }), kInvalid);
  EXPECT_EQ(sets([](FlkMaterial& m) { m.tip_blend = kNan; }), kInvalid);
}

TEST_F(HostileFeatures, hostPositions) {
  FlkHairPositions good_positions{};
  good_positions.address = scene.positions(1600);
  for (int axis = 0; axis < 3; ++axis) good_positions.min_bounds[axis] = -0.1f, good_positions.max_bounds[axis] = 0.2f;
  EXPECT_EQ(flkHairSetPositions(nullptr, &good_positions), kInvalid);
  EXPECT_EQ(flkHairSetPositions(hair, nullptr), FLK_SUCCESS) << "back to its own, which it has";
  scene.message_ids.clear();
  EXPECT_EQ(flkHairSetPositions(hair, &good_positions), kInvalid) << "made without FLK_HAIR_HOST_POSITIONS";
  EXPECT_FALSE(scene.message_ids.empty());

  FlkHairDesc desc = forelock::hairDesc();
  desc.asset = asset;
  desc.flags = FLK_HAIR_HOST_POSITIONS;
  forelock::Hair moving;
  ASSERT_EQ(forelock::create(scene.context, desc, moving), FLK_SUCCESS);
  const auto sets = [&](const std::function<void(FlkHairPositions&)>& change) {
    FlkHairPositions positions = good_positions;
    change(positions);
    scene.message_ids.clear();
    const FlkResult result = flkHairSetPositions(moving, &positions);
    EXPECT_EQ(result == FLK_SUCCESS, scene.message_ids.empty());
    return result;
  };
  EXPECT_EQ(sets([](FlkHairPositions&) {}), FLK_SUCCESS);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.stride = 12; }), FLK_SUCCESS);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.stride = 4096; }), FLK_SUCCESS);
  EXPECT_EQ(sets([](FlkHairPositions& p) { for (int i = 0; i < 3; ++i) p.max_bounds[i] = p.min_bounds[i]; }), FLK_SUCCESS);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.address = 0; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.address += 1; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.stride = 4; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.stride = 14; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.stride = 4100; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.min_bounds[1] = 0.3f; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.min_bounds[0] = kNan; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.max_bounds[2] = kNan; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.max_bounds[2] = kInfinity; }), kInvalid);
  EXPECT_EQ(sets([](FlkHairPositions& p) { p.min_bounds[2] = -1.1e6f; }), kInvalid);
}

TEST_F(HostileFeatures, previousTransforms) {
  const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(flkHairSetPreviousTransform(nullptr, identity), kInvalid);
  EXPECT_EQ(flkHairSetPreviousTransform(hair, identity), FLK_SUCCESS);
  EXPECT_EQ(flkHairSetPreviousTransform(hair, nullptr), FLK_SUCCESS) << "the same as now";
  for (const int at : {0, 3, 12, 15}) {
    double matrix[16];
    std::copy(identity, identity + 16, matrix);
    matrix[at] = kDoubleNan;
    EXPECT_EQ(flkHairSetPreviousTransform(hair, matrix), kInvalid) << at;
  }
  double flat[16];
  std::copy(identity, identity + 16, flat);
  flat[5] = 0.0;
  EXPECT_EQ(flkHairSetPreviousTransform(hair, flat), kInvalid);
}

TEST_F(HostileFeatures, shadowMapQueries) {
  FlkShadowMap map;
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 0, &map), FLK_NOT_READY) << "no plan yet";
  ASSERT_EQ(scene.render(view, good(1)), FLK_SUCCESS) << scene.last_message;
  EXPECT_EQ(flkViewGetShadowMap(view, 4096, 0, &map), kInvalid);
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 6, &map), kInvalid);
  EXPECT_EQ(flkViewGetShadowMap(view, 0, UINT32_MAX, &map), kInvalid);
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 1, &map), FLK_NOT_READY) << "a sun has one";
  EXPECT_EQ(flkViewGetShadowMap(view, 4, 0, &map), FLK_NOT_READY) << "casts none";
  EXPECT_EQ(flkViewGetShadowMap(view, 5, 0, &map), FLK_NOT_READY) << "no such light";
}

TEST_F(HostileFeatures, aPlanningContextTakesAFrameByItsWishes) {
  FlkContextDesc planning_desc = forelock::contextDesc();
  forelock::Context planning;
  ASSERT_EQ(forelock::create(planning_desc, planning), FLK_SUCCESS);
  FlkHairDesc desc = forelock::hairDesc();
  desc.asset = asset;
  forelock::Hair planned;
  ASSERT_EQ(forelock::create(planning, desc, planned), FLK_SUCCESS);
  forelock::View planned_view;
  ASSERT_EQ(forelock::create(planning, forelock::viewDesc(), planned_view), FLK_SUCCESS);
  FlkFrame frame = scene.fullFrame(1, 0, {planned});
  frame.capture = FLK_CAPTURE_COMPUTE;
  frame.target.image = VK_NULL_HANDLE, frame.target.view = VK_NULL_HANDLE;
  frame.host_shadow_maps = frame.host_visibility = FlkSampledImage{};
  for (FlkOutputImage& output : frame.outputs) output = FlkOutputImage{};
  int token = 0;
  frame.outputs[FLK_OUTPUT_VELOCITY].view = reinterpret_cast<VkImageView>(&token);
  FlkPlan plan = nullptr;
  ASSERT_EQ(flkPlanFrame(planned_view, &frame, &plan), FLK_SUCCESS);
  bool velocity = false;
  for (const FlkPassInfo& pass : passesOf(plan)) velocity |= std::string(pass.name) == "output velocity";
  EXPECT_TRUE(velocity);
  FlkShadowMap map{};
  EXPECT_EQ(flkViewGetShadowMap(planned_view, 3, 5, &map), FLK_SUCCESS);
  EXPECT_EQ(map.face_count, 6u);
  flkCmdRender(scene.driver.command_buffer, plan);  // ignored
  EXPECT_TRUE(scene.clean());
}

}  // namespace
