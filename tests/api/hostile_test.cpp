// Arguments that break what the headers say: the documented error, words that tell why, and nothing changed.
#include "hostile.h"

namespace {

TEST_F(Hostile, structs) {
  static int extension = 0;
  check({
      {"tag", kInvalid, [](FlkFrame& f) { f.type = FLK_TYPE_VIEW; }},
      {"tag 0", kInvalid, [](FlkFrame& f) { f.type = 0; }},
      {"next", kInvalid, [](FlkFrame& f) { f.next = &extension; }},
  });
}

TEST_F(Hostile, cameras) {
  check({
      {"NaN view", kInvalid, [](FlkFrame& f) { f.view_from_world[3] = std::nan(""); }},
      {"NaN view position", kInvalid, [](FlkFrame& f) { f.view_from_world[12] = std::nan(""); }},
      {"infinite view position", kInvalid, [](FlkFrame& f) { f.view_from_world[14] = -double{kInfinity}; }},
      {"view from beyond 1e15", kInvalid, [](FlkFrame& f) { f.view_from_world[13] = 1.1e15; }},
      {"zero view", kInvalid, [](FlkFrame& f) { for (double& m : f.view_from_world) m = 0.0; }},
      {"scaled view", kInvalid, [](FlkFrame& f) { f.view_from_world[0] = 2.0; }},
      {"projective view", kInvalid, [](FlkFrame& f) { f.view_from_world[3] = 0.5; }},
      {"NaN projection", kInvalid, [](FlkFrame& f) { f.clip_from_view[0] = kNan; }},
      {"infinite projection", kInvalid, [](FlkFrame& f) { f.clip_from_view[14] = kInfinity; }},
      {"zero projection", kInvalid, [](FlkFrame& f) { for (float& m : f.clip_from_view) m = 0.0f; }},
      {"flat projection", kInvalid, [](FlkFrame& f) { f.clip_from_view[5] = 0.0f; }},
      {"skewed projection", kInvalid, [](FlkFrame& f) { f.clip_from_view[1] = 0.1f; }},
      {"depth the other way round", kInvalid, [](FlkFrame& f) { f.reversed_depth = 1; }},
  });
}

TEST_F(Hostile, numbers) {
  check({
      {"method", kInvalid, [](FlkFrame& f) { f.method = 6; }},
      {"method", kInvalid, [](FlkFrame& f) { f.method = UINT32_MAX; }},
      {"k 33", kInvalid, [](FlkFrame& f) { f.k = 33; }},
      {"k one below FLK_K_NONE", kInvalid, [](FlkFrame& f) { f.k = FLK_K_NONE - 1; }},
      {"k_sort 33", kInvalid, [](FlkFrame& f) { f.k_sort = 33; }},
      {"k_sort below k", kInvalid, [](FlkFrame& f) { f.k = 8, f.k_sort = 7; }},
      {"payload", kInvalid, [](FlkFrame& f) { f.payload = 2; }},
      {"display", kInvalid, [](FlkFrame& f) { f.display = 6; }},
      {"exposure below 0", kInvalid, [](FlkFrame& f) { f.exposure = -1.0f; }},
      {"NaN exposure", kInvalid, [](FlkFrame& f) { f.exposure = kNan; }},
      {"infinite exposure", kInvalid, [](FlkFrame& f) { f.exposure = kInfinity; }},
      {"ambient below 0", kInvalid, [](FlkFrame& f) { f.ambient[2] = -0.1f; }},
      {"NaN ambient", kInvalid, [](FlkFrame& f) { f.ambient[0] = kNan; }},
  });
}

TEST_F(Hostile, lights) {
  check({
      {"4097", kInvalid, [](FlkFrame& f) { f.light_count = 4097; }},
      {"none there", kInvalid, [](FlkFrame& f) { f.lights = nullptr; }},
      {"zero direction", kInvalid, [this](FlkFrame&) { for (float& d : scene.light.direction) d = 0.0f; }},
      {"NaN direction", kInvalid, [this](FlkFrame&) { scene.light.direction[1] = kNan; }},
      {"infinite direction", kInvalid, [this](FlkFrame&) { scene.light.direction[1] = kInfinity; }},
      {"radiance below 0", kInvalid, [this](FlkFrame&) { scene.light.radiance[0] = -1.0f; }},
      {"NaN radiance", kInvalid, [this](FlkFrame&) { scene.light.radiance[2] = kNan; }},
      {"map of 63", kInvalid, [this](FlkFrame&) { scene.light.shadow_size = 63; }},
      {"map of 129", kInvalid, [this](FlkFrame&) { scene.light.shadow_size = 129; }},
      {"map of 8193", kInvalid, [this](FlkFrame&) { scene.light.shadow_size = 8193; }},
  });
}

TEST_F(Hostile, hairs) {
  static FlkHair many[64];
  static FlkHair twice[2];
  static FlkHair null_hair[1] = {nullptr};
  forelock::Context other;
  ASSERT_EQ(forelock::create(scene.desc, other), FLK_SUCCESS);
  {
    forelock::Hair foreign;
    FlkHairDesc desc = forelock::hairDesc();
    desc.asset = asset;
    ASSERT_EQ(forelock::create(other, desc, foreign), FLK_SUCCESS);
    static FlkHair others[1];
    others[0] = foreign;
    std::vector<forelock::Hair> more;
    for (int i = 0; i < 64; ++i) {
      more.push_back(scene.createHair(asset));
      many[i] = more.back();
    }
    twice[0] = twice[1] = hair;
    check({
        {"64", kInvalid, [](FlkFrame& f) { f.hairs = many, f.hair_count = 64; }},
        {"very many", kInvalid, [](FlkFrame& f) { f.hair_count = UINT32_MAX; }},
        {"one twice", kInvalid, [](FlkFrame& f) { f.hairs = twice, f.hair_count = 2; }},
        {"none there", kInvalid, [](FlkFrame& f) { f.hairs = nullptr; }},
        {"a NULL", kInvalid, [](FlkFrame& f) { f.hairs = null_hair; }},
        {"another context's", kInvalid, [](FlkFrame& f) { f.hairs = others; }},
    });
    // 63 are allowed.
    FlkFrame frame = good(100);
    frame.hairs = many;
    frame.hair_count = 63;
    EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << scene.last_message;
    scene.driver.completed = 100;
  }
}

TEST_F(Hostile, targets) {
  check({
      {"no image", kImage, [](FlkFrame& f) { f.target.image = VK_NULL_HANDLE; }},
      {"no view", kImage, [](FlkFrame& f) { f.target.view = VK_NULL_HANDLE; }},
      {"format", kImage, [](FlkFrame& f) { f.target.format = VK_FORMAT_R8G8B8A8_UNORM; }},
      {"depth format", kImage, [](FlkFrame& f) { f.target.format = VK_FORMAT_D32_SFLOAT; }},
      {"no format", kImage, [](FlkFrame& f) { f.target.format = VK_FORMAT_UNDEFINED; }},
      {"4 samples", kImage, [](FlkFrame& f) { f.target.samples = VK_SAMPLE_COUNT_4_BIT; }},
      {"width 0", kInvalid, [](FlkFrame& f) { f.target.width = 0; }},
      {"height 0", kInvalid, [](FlkFrame& f) { f.target.height = 0; }},
      {"width 16385", kInvalid, [](FlkFrame& f) { f.target.width = 16385; }},
      {"height 16385", kInvalid, [](FlkFrame& f) { f.target.height = 16385; }},
      {"exit layout UNDEFINED", kImage, [](FlkFrame& f) { f.target.exit.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"exit layout PREINITIALIZED", kImage,
       [](FlkFrame& f) { f.target.exit.layout = VK_IMAGE_LAYOUT_PREINITIALIZED; }},
  });
}

TEST_F(Hostile, depthSources) {
  check({
      {"no view", kImage, [](FlkFrame& f) { f.depth.view = VK_NULL_HANDLE; }},
      {"colour format", kImage, [](FlkFrame& f) { f.depth.format = VK_FORMAT_R32_SFLOAT; }},
      {"stencil format", kImage, [](FlkFrame& f) { f.depth.format = VK_FORMAT_S8_UINT; }},
      {"2 samples", kImage, [](FlkFrame& f) { f.depth.samples = VK_SAMPLE_COUNT_2_BIT; }},
      {"layout UNDEFINED", kImage, [](FlkFrame& f) { f.depth.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"layout of an attachment", kImage,
       [](FlkFrame& f) { f.depth.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL; }},
  });
  const VkFormat formats[] = {VK_FORMAT_D16_UNORM, VK_FORMAT_X8_D24_UNORM_PACK32, VK_FORMAT_D32_SFLOAT,
                              VK_FORMAT_D16_UNORM_S8_UINT, VK_FORMAT_D24_UNORM_S8_UINT, VK_FORMAT_D32_SFLOAT_S8_UINT};
  const VkImageLayout layouts[] = {VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
                                   VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL};
  uint64_t number = 200;
  for (const VkFormat format : formats)
    for (const VkImageLayout layout : layouts) {
      FlkFrame frame = good(number++);
      frame.depth.format = format;
      frame.depth.layout = layout;
      EXPECT_EQ(scene.render(view, frame), FLK_SUCCESS) << format << ' ' << layout << ' ' << scene.last_message;
    }
}

TEST_F(Hostile, frameNumbers) {
  FlkPlan plan = nullptr;
  const auto planAs = [&](uint64_t number, uint64_t completed) {
    scene.driver.completed = std::max(scene.driver.completed, completed);
    const FlkFrame frame = scene.frame(number, completed, {hair});
    return flkPlanFrame(view, &frame, &plan);
  };
  EXPECT_EQ(planAs(0, 0), FLK_ERROR_INVALID_ARGUMENT);
  for (uint64_t number = 1; number <= 3; ++number) ASSERT_EQ(planAs(number, 0), FLK_SUCCESS) << number;
  EXPECT_EQ(planAs(4, 0), FLK_ERROR_TOO_MANY_FRAMES);
  EXPECT_EQ(planAs(3, 0), FLK_ERROR_INVALID_ARGUMENT) << "the same number again";
  EXPECT_EQ(planAs(2, 0), FLK_ERROR_INVALID_ARGUMENT) << "a number before";
  EXPECT_EQ(planAs(4, 1), FLK_SUCCESS);
  EXPECT_EQ(planAs(5, 6), FLK_ERROR_INVALID_ARGUMENT) << "completed before it is planned";
  EXPECT_EQ(planAs(5, 5), FLK_ERROR_INVALID_ARGUMENT) << "completed before it is planned";
  EXPECT_EQ(planAs(5, 2), FLK_SUCCESS);
  // Numbers may leave gaps: what counts is how many frames are planned and have not completed.
  EXPECT_EQ(planAs(1000, 998), FLK_SUCCESS);
  EXPECT_EQ(planAs(UINT64_MAX, UINT64_MAX - 1), FLK_SUCCESS);
  EXPECT_EQ(planAs(1, 0), FLK_ERROR_INVALID_ARGUMENT);
}

TEST_F(Hostile, materials) {
  FlkMaterial standard;
  flkMaterialDefault(&standard);
  EXPECT_EQ(flkHairSetMaterial(hair, &standard), FLK_SUCCESS);
  const std::vector<std::pair<const char*, std::function<void(FlkMaterial&)>>> cases = {
      {"color", [](FlkMaterial& m) { m.color[1] = 1.5f; }},
      {"color", [](FlkMaterial& m) { m.color[2] = -0.1f; }},
      {"color", [](FlkMaterial& m) { m.color[0] = kNan; }},
      {"opacity_root", [](FlkMaterial& m) { m.opacity_root = 1.01f; }},
      {"opacity_tip", [](FlkMaterial& m) { m.opacity_tip = -0.01f; }},
      {"opacity_tip", [](FlkMaterial& m) { m.opacity_tip = kNan; }},
      {"width_scale", [](FlkMaterial& m) { m.width_scale = -1.0f; }},
      {"width_scale", [](FlkMaterial& m) { m.width_scale = 2e6f; }},
      {"diffuse", [](FlkMaterial& m) { m.diffuse = 2e3f; }},
      {"specular_r", [](FlkMaterial& m) { m.specular_r = kNan; }},
      {"exponent_r", [](FlkMaterial& m) { m.exponent_r = 2e6f; }},
      {"specular_trt", [](FlkMaterial& m) { m.specular_trt = -1.0f; }},
      {"exponent_trt", [](FlkMaterial& m) { m.exponent_trt = kInfinity; }},
      {"cuticle_tilt", [](FlkMaterial& m) { m.cuticle_tilt = 0.8f; }},
      {"shadow_opacity", [](FlkMaterial& m) { m.shadow_opacity = 1.1f; }},
      {"fibre_spacing", [](FlkMaterial& m) { m.fibre_spacing = 0.0f; }},
      {"fibre_spacing", [](FlkMaterial& m) { m.fibre_spacing = kNan; }},
      {"fibre_spacing", [](FlkMaterial& m) { m.fibre_spacing = kInfinity; }},
  };
  for (const auto& [what, spoil] : cases) {
    FlkMaterial material = standard;
    spoil(material);
    scene.message_ids.clear();
    EXPECT_EQ(flkHairSetMaterial(hair, &material), FLK_ERROR_INVALID_ARGUMENT) << what;
    EXPECT_FALSE(scene.message_ids.empty()) << what;
    EXPECT_NE(scene.last_message.find(what), std::string::npos)
        << "'" << scene.last_message << "' does not name " << what;
    FlkHairDesc desc = forelock::hairDesc();
    desc.asset = asset;
    desc.material = &material;
    forelock::Hair refused;
    EXPECT_EQ(forelock::create(scene.context, desc, refused), FLK_ERROR_INVALID_ARGUMENT) << what;
  }
  // The ends of the ranges are inside.
  FlkMaterial ends = standard;
  ends.width_scale = 1e6f;
  ends.diffuse = ends.specular_r = ends.specular_trt = 1e3f;
  ends.exponent_r = ends.exponent_trt = 1e6f;
  ends.cuticle_tilt = -0.785398f;
  ends.shadow_opacity = 1.0f;
  EXPECT_EQ(flkHairSetMaterial(hair, &ends), FLK_SUCCESS) << scene.last_message;
  EXPECT_EQ(flkHairSetMaterial(hair, nullptr), FLK_ERROR_INVALID_ARGUMENT);
}

TEST_F(Hostile, transforms) {
  const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(flkHairSetTransform(hair, identity), FLK_SUCCESS);
  const std::vector<std::pair<const char*, std::function<void(double*)>>> cases = {
      {"NaN", [](double* m) { m[5] = std::nan(""); }},
      {"infinite", [](double* m) { m[12] = HUGE_VAL; }},
      {"projective", [](double* m) { m[3] = 0.1; }},
      {"w 0", [](double* m) { m[15] = 0.0; }},
      {"flat", [](double* m) { m[10] = 0.0; }},
  };
  for (const auto& [what, spoil] : cases) {
    double matrix[16];
    std::copy(identity, identity + 16, matrix);
    spoil(matrix);
    EXPECT_EQ(flkHairSetTransform(hair, matrix), FLK_ERROR_INVALID_ARGUMENT) << what;
  }
  EXPECT_EQ(flkHairSetTransform(hair, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  // Far away is no error: the plan finds it out of view. But where floats end, it could not be placed any more.
  double far_away[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e15, 0, 0, 1};
  ASSERT_EQ(flkHairSetTransform(hair, far_away), FLK_SUCCESS) << scene.last_message;
  FlkPlan plan = nullptr;
  EXPECT_EQ(scene.render(view, good(1), &plan), FLK_SUCCESS);
  EXPECT_EQ(infoOf(plan).pass_count, 0u);
  far_away[12] = 1e300;
  EXPECT_EQ(flkHairSetTransform(hair, far_away), FLK_ERROR_INVALID_ARGUMENT);
}

TEST_F(Hostile, nullsAndTags) {
  static int extension = 0;
  const auto spoilt = [](auto desc, const std::function<void(decltype(desc)&)>& spoil) {
    spoil(desc);
    return desc;
  };
  FlkContext context = nullptr;
  const auto contextFails = [&](const std::function<void(FlkContextDesc&)>& spoil) {
    const FlkContextDesc desc = spoilt(scene.desc, spoil);
    const FlkResult result = flkContextCreate(&desc, &context);
    EXPECT_EQ(context, nullptr);
    if (context) flkContextDestroy(context);
    return result;
  };
  EXPECT_EQ(flkContextCreate(nullptr, &context), kInvalid);
  EXPECT_EQ(flkContextCreate(&scene.desc, nullptr), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.type = FLK_TYPE_HAIR; }), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.next = &extension; }), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.device = VK_NULL_HANDLE; }), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.instance = VK_NULL_HANDLE; }), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.physical_device = VK_NULL_HANDLE; }), kInvalid);
  EXPECT_EQ(contextFails([](FlkContextDesc& d) { d.get_instance_proc_addr = nullptr; }), kInvalid);
  EXPECT_LT(contextFails([](FlkContextDesc& d) { d.queue_family = 1; }), 0);
  EXPECT_LT(contextFails([](FlkContextDesc& d) { d.queue_family = 7; }), 0);
  FlkHostAllocator half = scene.memory.callbacks;
  half.free = nullptr;
  EXPECT_EQ(contextFails([&](FlkContextDesc& d) { d.allocator = &half; }), kInvalid);
  const FlkDeviceAllocator half_device{nullptr, nullptr, [](void*, const FlkDeviceAllocation*) {}};
  EXPECT_EQ(contextFails([&](FlkContextDesc& d) { d.device_allocator = &half_device; }), kInvalid);

  FlkHairDesc hair_desc = forelock::hairDesc();
  hair_desc.asset = asset;
  FlkHair made = nullptr;
  EXPECT_EQ(flkHairCreate(nullptr, &hair_desc, &made), kInvalid);
  EXPECT_EQ(flkHairCreate(scene.context, nullptr, &made), kInvalid);
  EXPECT_EQ(flkHairCreate(scene.context, &hair_desc, nullptr), kInvalid);
  for (const auto& spoil : std::vector<std::function<void(FlkHairDesc&)>>{
           [](FlkHairDesc& d) { d.type = FLK_TYPE_CONTEXT; }, [](FlkHairDesc& d) { d.next = &extension; },
           [](FlkHairDesc& d) { d.asset = nullptr; }, [](FlkHairDesc& d) { d.flags = 8; }}) {
    const FlkHairDesc desc = spoilt(hair_desc, spoil);
    EXPECT_EQ(flkHairCreate(scene.context, &desc, &made), kInvalid);
    EXPECT_EQ(made, nullptr);
  }

  FlkViewDesc view_desc = forelock::viewDesc();
  FlkView made_view = nullptr;
  EXPECT_EQ(flkViewCreate(nullptr, &view_desc, &made_view), kInvalid);
  EXPECT_EQ(flkViewCreate(scene.context, nullptr, &made_view), kInvalid);
  EXPECT_EQ(flkViewCreate(scene.context, &view_desc, nullptr), kInvalid);
  for (const auto& spoil : std::vector<std::function<void(FlkViewDesc&)>>{
           [](FlkViewDesc& d) { d.type = 0; }, [](FlkViewDesc& d) { d.next = &extension; },
           [](FlkViewDesc& d) { d.frames_in_flight = 9; }}) {
    const FlkViewDesc desc = spoilt(view_desc, spoil);
    EXPECT_EQ(flkViewCreate(scene.context, &desc, &made_view), kInvalid);
    EXPECT_EQ(made_view, nullptr);
  }

  const FlkFrame frame = good(1);
  FlkPlan plan = nullptr;
  EXPECT_EQ(flkPlanFrame(nullptr, &frame, &plan), kInvalid);
  EXPECT_EQ(flkPlanFrame(view, nullptr, &plan), kInvalid);
  EXPECT_EQ(flkPlanFrame(view, &frame, nullptr), kInvalid);
  ASSERT_EQ(flkPlanFrame(view, &frame, &plan), FLK_SUCCESS);
  FlkPlanInfo info;
  ASSERT_EQ(flkPlanGetInfo(plan, &info), FLK_SUCCESS);
  EXPECT_EQ(flkPlanGetInfo(nullptr, &info), kInvalid);
  EXPECT_EQ(flkPlanGetInfo(plan, nullptr), kInvalid);
  FlkPassInfo pass;
  EXPECT_EQ(flkPlanGetPass(plan, info.pass_count, &pass), kInvalid);
  EXPECT_EQ(flkPlanGetPass(plan, UINT32_MAX, &pass), kInvalid);
  EXPECT_EQ(flkPlanGetPass(plan, 0, nullptr), kInvalid);
  EXPECT_EQ(flkPlanGetPass(nullptr, 0, &pass), kInvalid);
  FlkResourceInfo resource;
  EXPECT_EQ(flkPlanGetResource(plan, info.resource_count, &resource), kInvalid);
  EXPECT_EQ(flkPlanGetResource(plan, 0, nullptr), kInvalid);
  EXPECT_EQ(flkPlanGetResource(nullptr, 0, &resource), kInvalid);
  EXPECT_EQ(flkPlanGetOmission(plan, info.omission_count), nullptr);
  for (uint32_t i = 0; i < info.omission_count; ++i) EXPECT_NE(flkPlanGetOmission(plan, i), nullptr);
  EXPECT_EQ(flkPlanGetOmission(nullptr, 0), nullptr);

  FlkStatistics statistics;
  FlkShadowMap map;
  FlkHairInfo hair_info;
  const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  FlkMaterial material;
  flkMaterialDefault(&material);
  EXPECT_EQ(flkViewGetStatistics(nullptr, 0, &statistics), kInvalid);
  EXPECT_EQ(flkViewGetStatistics(view, 0, nullptr), kInvalid);
  EXPECT_EQ(flkViewGetShadowMap(nullptr, 0, 0, &map), kInvalid);
  EXPECT_EQ(flkViewGetShadowMap(view, 0, 0, nullptr), kInvalid);
  EXPECT_EQ(flkHairGetInfo(nullptr, &hair_info), kInvalid);
  EXPECT_EQ(flkHairGetInfo(hair, nullptr), kInvalid);
  EXPECT_EQ(flkHairSetTransform(nullptr, identity), kInvalid);
  EXPECT_EQ(flkHairSetMaterial(nullptr, &material), kInvalid);
  EXPECT_EQ(flkCmdUpload(VK_NULL_HANDLE, hair), kInvalid);
  EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, nullptr), kInvalid);
  flkHairReleaseStaging(hair);
  EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, hair), kInvalid) << "its staging memory is gone";

  flkHairDestroy(nullptr);
  flkViewDestroy(nullptr);
  flkContextDestroy(nullptr);
  flkAssetDestroy(nullptr);
}

// Beside the assets' own tests: what the C boundary itself says of them.
TEST(HostileAsset, nullsAndTags) {
  static int extension = 0;
  const float positions[] = {0, 0, 0, 0, 0, 1};
  const uint32_t first_vertex[] = {0, 2};
  FlkStrands strands = forelock::strandsDesc();
  strands.strand_count = 1;
  strands.vertex_count = 2;
  strands.first_vertex = first_vertex;
  strands.positions = positions;
  FlkAsset asset = nullptr;
  const auto fails = [&](const std::function<void(FlkStrands&)>& spoil) {
    FlkStrands spoilt = strands;
    spoil(spoilt);
    const FlkResult result = flkAssetCreate(&spoilt, nullptr, &asset);
    EXPECT_EQ(asset, nullptr);
    return result;
  };
  EXPECT_EQ(flkAssetCreate(nullptr, nullptr, &asset), kInvalid);
  EXPECT_EQ(flkAssetCreate(&strands, nullptr, nullptr), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.type = FLK_TYPE_ASSET_OPTIONS; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.next = &extension; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.first_vertex = nullptr; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.positions = nullptr; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.strand_count = 0; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.vertex_count = 3; }), kInvalid);
  EXPECT_EQ(fails([](FlkStrands& s) { s.strand_count = UINT32_MAX; }), FLK_ERROR_LIMIT);
  const float nowhere[] = {0, 0, 0, kNan, 0, 1};
  EXPECT_EQ(fails([&](FlkStrands& s) { s.positions = nowhere; }), FLK_ERROR_EMPTY_ASSET);

  FlkAssetInfo info;
  FlkFinding finding;
  size_t size = 0;
  EXPECT_EQ(flkAssetGetInfo(nullptr, &info), kInvalid);
  EXPECT_EQ(flkAssetGetFinding(nullptr, 0, &finding), kInvalid);
  EXPECT_EQ(flkAssetGetStrands(nullptr, &strands), kInvalid);
  EXPECT_EQ(flkAssetSaveMemory(nullptr, FLK_FORMAT_TFX, nullptr, &size), kInvalid);
  EXPECT_EQ(flkAssetLoadFile(nullptr, nullptr, &asset), kInvalid);
  EXPECT_EQ(flkAssetLoadMemory(nullptr, 10, nullptr, &asset), kInvalid);
  EXPECT_STREQ(flkResultName(FLK_ERROR_TOO_MANY_FRAMES), "FLK_ERROR_TOO_MANY_FRAMES");
  EXPECT_STREQ(flkResultName(-1000), "unknown");
}

}  // namespace
