// From context to destruction: nothing leaks, nothing waits, and a context without a device plans the same.
#include "scene.h"

namespace {

TEST(Life, leavesNothing) {
  Scene scene;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
  const forelock::Asset asset = makeAsset(200, 0.0f, &scene.memory.callbacks);
  const forelock::Asset other = makeAsset(50, 0.05f, &scene.memory.callbacks);
  {
    forelock::Hair first = scene.createHair(asset), second = scene.createHair(other);
    const forelock::View view = scene.createView(2);
    scene.driver.frame = 1;
    EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, first), FLK_SUCCESS);
    EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, second), FLK_SUCCESS);
    for (uint64_t number = 1; number <= 8; ++number) {
      const uint64_t completed = number > 2 ? number - 2 : 0;
      FlkFrame frame = scene.frame(number, completed, {first, second});
      frame.method = static_cast<uint32_t>(number % 3);
      if (number == 3) {
        scene.driver.completed = completed;
        flkHairReleaseStaging(first);
        flkHairReleaseStaging(second);
      }
      ASSERT_EQ(scene.render(view, frame), FLK_SUCCESS) << scene.last_message;
      // Each frame has more to store than the one before.
      uint32_t* count = scene.driver.latestReadBack();
      ASSERT_NE(count, nullptr);
      *count = static_cast<uint32_t>(20000 * number * number);
    }
    scene.driver.completed = 8;
  }
  scene.context.reset();
  EXPECT_GT(scene.memory.live(), 0u);  // the assets
  EXPECT_EQ(scene.driver.leaks(), "");
  EXPECT_TRUE(scene.clean());
}

TEST(Life, twoContextsShareNothing) {
  Scene scene;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
  forelock::Context other;
  ASSERT_EQ(forelock::create(scene.desc, other), FLK_SUCCESS);
  const forelock::Asset asset = makeAsset();
  {
    const forelock::Hair hair = scene.createHair(asset);
    const forelock::View view = scene.createView();
    other.reset();
    EXPECT_EQ(scene.render(view, scene.frame(1, 0, {hair})), FLK_SUCCESS) << scene.last_message;
    scene.driver.completed = 1;
  }
  scene.context.reset();
  EXPECT_TRUE(scene.nothingLeft());
}

TEST(Life, assetMayGoBeforeHair) {
  Scene scene;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
  {
    forelock::Asset asset = makeAsset(30);
    const forelock::Hair hair = scene.createHair(asset);
    asset.reset();
    scene.driver.frame = 1;
    EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, hair), FLK_SUCCESS);
    FlkHairInfo info;
    ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
    EXPECT_EQ(info.strand_count, 30u);
    EXPECT_EQ(info.vertex_count, 240u);
    EXPECT_EQ(info.segment_count, 210u);
    EXPECT_EQ(info.bytes_device, 16u * 240 + 4u * 210);  // as documented at flkHairCreate
    EXPECT_GT(info.bytes_staging, 0u);
    scene.driver.completed = 1;
    flkHairReleaseStaging(hair);
    flkHairReleaseStaging(hair);
    ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
    EXPECT_EQ(info.bytes_staging, 0u);
  }
  scene.context.reset();
  EXPECT_TRUE(scene.nothingLeft());
}

// A plan lives on when its frame has completed and its hair is gone.
TEST(Life, planOutlivesHair) {
  Scene scene;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
  const forelock::Asset asset = makeAsset();
  forelock::Hair hair = scene.createHair(asset);
  {
    const forelock::View view = scene.createView();
    FlkPlan plan = nullptr;
    ASSERT_EQ(scene.render(view, scene.frame(1, 0, {hair}), &plan), FLK_SUCCESS);
    const uint64_t bytes = infoOf(plan).bytes_persistent;
    scene.driver.completed = 1;
    hair.reset();
    EXPECT_EQ(infoOf(plan).bytes_persistent, bytes);
    FlkStatistics statistics;
    EXPECT_EQ(flkViewGetStatistics(view, 1, &statistics), FLK_SUCCESS);
  }
  scene.context.reset();
  EXPECT_TRUE(scene.nothingLeft());
}

// The host may hand out device memory itself; then vkAllocateMemory is not called.
TEST(Life, deviceMemoryFromTheHost) {
  Scene scene;
  struct Host {
    mock::Driver* driver;
    int live = 0, refuse_at = 0, asked = 0;
  } host{&scene.driver};
  FlkDeviceAllocator allocator{
      &host,
      [](void* user, const VkMemoryRequirements* requirements, VkMemoryPropertyFlags properties, const char* name,
         FlkDeviceAllocation* allocation) -> VkResult {
        Host& self = *static_cast<Host*>(user);
        EXPECT_NE(name, nullptr);
        if (++self.asked == self.refuse_at) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
        // One block behind an offset, as a sub-allocator gives it.
        mock::Object* block = self.driver->make(mock::Kind::Memory);
        block->of_host = true;
        block->size = requirements->size + 1024;
        block->memory_type = properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT ? 1 : 0;
        block->bytes = std::calloc(1, block->size);
        ++self.live;
        allocation->memory = mock::handleOf<VkDeviceMemory>(block);
        allocation->offset = 1024;
        allocation->mapped =
            properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT ? static_cast<char*>(block->bytes) + 1024 : nullptr;
        allocation->user = block;
        return VK_SUCCESS;
      },
      [](void* user, const FlkDeviceAllocation* allocation) {
        Host& self = *static_cast<Host*>(user);
        auto* block = static_cast<mock::Object*>(allocation->user);
        EXPECT_EQ(allocation->offset, 1024u);
        EXPECT_FALSE(self.driver->busy(block));
        EXPECT_TRUE(block->alive);
        block->alive = false;
        --self.live;
      }};
  scene.desc.device_allocator = &allocator;
  const forelock::Asset asset = makeAsset();
  for (int refuse_at = 0;; ++refuse_at) {
    host.asked = 0;
    host.refuse_at = refuse_at;
    scene.driver.frame = scene.driver.completed = 0;
    const bool made = scene.createContext() == FLK_SUCCESS;
    if (made) {
      FlkHairDesc hair_desc = forelock::hairDesc();
      hair_desc.asset = asset;
      forelock::Hair hair;
      const FlkResult hair_result = forelock::create(scene.context, hair_desc, hair);
      const forelock::View view = scene.createView();
      if (hair_result == FLK_SUCCESS) {
        scene.driver.frame = 1;
        EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, hair), FLK_SUCCESS);
        scene.render(view, scene.frame(1, 0, {hair}));
      }
      scene.driver.completed = 1;
    }
    scene.context.reset();
    EXPECT_EQ(host.live, 0) << "refused " << refuse_at;
    ASSERT_TRUE(scene.nothingLeft()) << "refused " << refuse_at;
    if (refuse_at > host.asked) break;
    ASSERT_LT(refuse_at, 100);
  }
  EXPECT_EQ(scene.driver.calls.count("vkAllocateMemory"), 0u);
}

TEST(Life, planningContextPlansTheSame) {
  Scene scene;
  ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
  const forelock::Asset asset = makeAsset();
  const forelock::Hair hair = scene.createHair(asset);
  const forelock::View view = scene.createView();
  FlkPlan with_device = nullptr;
  ASSERT_EQ(scene.render(view, scene.frame(1, 0, {hair}), &with_device), FLK_SUCCESS) << scene.last_message;
  scene.driver.completed = 1;

  const uint64_t calls = scene.driver.calledOutsideRecording();
  FlkContextDesc planning_desc = forelock::contextDesc();
  forelock::Context planning;
  ASSERT_EQ(forelock::create(planning_desc, planning), FLK_SUCCESS);
  forelock::Hair planned_hair;
  FlkHairDesc hair_desc = forelock::hairDesc();
  hair_desc.asset = asset;
  ASSERT_EQ(forelock::create(planning, hair_desc, planned_hair), FLK_SUCCESS);
  forelock::View planned_view;
  ASSERT_EQ(forelock::create(planning, forelock::viewDesc(), planned_view), FLK_SUCCESS);
  FlkPlan plan = nullptr;
  const FlkFrame frame = scene.frame(1, 0, {planned_hair});
  ASSERT_EQ(flkPlanFrame(planned_view, &frame, &plan), FLK_SUCCESS);
  EXPECT_EQ(scene.driver.calledOutsideRecording(), calls) << "a planning context calls Vulkan";

  const FlkPlanInfo a = infoOf(with_device), b = infoOf(plan);
  EXPECT_EQ(a.bytes_persistent, b.bytes_persistent);
  EXPECT_EQ(a.bytes_transient, b.bytes_transient);
  EXPECT_EQ(a.node_capacity, b.node_capacity);
  EXPECT_EQ(a.segment_count, b.segment_count);
  EXPECT_EQ(a.omission_count, b.omission_count);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(a.rect[i], b.rect[i]);
  const auto a_passes = passesOf(with_device), b_passes = passesOf(plan);
  ASSERT_EQ(a_passes.size(), b_passes.size());
  for (size_t i = 0; i < a_passes.size(); ++i) {
    EXPECT_STREQ(a_passes[i].name, b_passes[i].name);
    EXPECT_EQ(a_passes[i].stage, b_passes[i].stage);
    EXPECT_EQ(a_passes[i].indices, b_passes[i].indices);
  }
  const auto a_resources = resourcesOf(with_device), b_resources = resourcesOf(plan);
  ASSERT_EQ(a_resources.size(), b_resources.size());
  for (size_t i = 0; i < a_resources.size(); ++i) {
    EXPECT_STREQ(a_resources[i].name, b_resources[i].name);
    EXPECT_EQ(a_resources[i].bytes, b_resources[i].bytes);
  }

  EXPECT_EQ(flkCmdUpload(scene.driver.command_buffer, planned_hair), FLK_ERROR_INVALID_ARGUMENT);
  FlkStatistics statistics;
  EXPECT_EQ(flkViewGetStatistics(planned_view, 1, &statistics), FLK_NOT_READY);
  EXPECT_TRUE(scene.clean());
}

// Only through a device that offers everything that flkGetRequirements lists.
TEST(Life, refusesADeviceThatLacksSomething) {
  struct Lack {
    const char* what;
    void (*take)(mock::Claims&);
  };
  const Lack lacks[] = {
      {"version", [](mock::Claims& claims) { claims.properties.apiVersion = VK_API_VERSION_1_2; }},
      {"fragmentStoresAndAtomics", [](mock::Claims& claims) { claims.features.fragmentStoresAndAtomics = VK_FALSE; }},
      {"scalarBlockLayout", [](mock::Claims& claims) { claims.features12.scalarBlockLayout = VK_FALSE; }},
      {"bufferDeviceAddress", [](mock::Claims& claims) { claims.features12.bufferDeviceAddress = VK_FALSE; }},
      {"dynamicRendering", [](mock::Claims& claims) { claims.features13.dynamicRendering = VK_FALSE; }},
      {"synchronization2", [](mock::Claims& claims) { claims.features13.synchronization2 = VK_FALSE; }},
      {"ballots", [](mock::Claims& claims) { claims.properties11.subgroupSupportedOperations = VK_SUBGROUP_FEATURE_BASIC_BIT; }},
      {"subgroups", [](mock::Claims& claims) { claims.properties11.subgroupSupportedOperations = 0; }},
      {"ballots in fragment shaders",
       [](mock::Claims& claims) { claims.properties11.subgroupSupportedStages = VK_SHADER_STAGE_COMPUTE_BIT; }},
      {"ballots in compute shaders",
       [](mock::Claims& claims) { claims.properties11.subgroupSupportedStages = VK_SHADER_STAGE_FRAGMENT_BIT; }},
      {"queue", [](mock::Claims& claims) { claims.queue_families[0].queueFlags = VK_QUEUE_GRAPHICS_BIT; }},
      {"vkCreateComputePipelines",
       [](mock::Claims& claims) { claims.missing_functions.insert("vkCreateComputePipelines"); }},
      {"vkGetPhysicalDeviceFeatures2",
       [](mock::Claims& claims) { claims.missing_functions.insert("vkGetPhysicalDeviceFeatures2"); }},
      {"vkCmdPipelineBarrier2",
       [](mock::Claims& claims) { claims.missing_functions.insert("vkCmdPipelineBarrier2"); }},
  };
  for (const Lack& lack : lacks) {
    Scene scene;
    lack.take(scene.driver.claims);
    EXPECT_EQ(scene.createContext(), FLK_ERROR_UNSUPPORTED_DEVICE) << lack.what;
    EXPECT_EQ(scene.context.get(), nullptr);
    EXPECT_FALSE(scene.message_ids.empty()) << lack.what;
    EXPECT_TRUE(scene.nothingLeft()) << lack.what;
  }
}

TEST(Life, requirementsMatchWhatIsChecked) {
  FlkRequirements needs;
  flkGetRequirements(&needs);
  EXPECT_EQ(needs.api_version, VK_API_VERSION_1_3);
  EXPECT_EQ(needs.queue_flags, VkQueueFlags{VK_QUEUE_COMPUTE_BIT});  // graphics only for FLK_CAPTURE_RASTER
  EXPECT_EQ(needs.subgroup_operations, VkSubgroupFeatureFlags{VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT});
  EXPECT_EQ(needs.subgroup_stages, VkShaderStageFlags{VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT});
  EXPECT_TRUE(needs.output_features.shaderStorageImageExtendedFormats);
  EXPECT_EQ(needs.features12.sType, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
  EXPECT_EQ(needs.features13.sType, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  EXPECT_EQ(needs.features12.pNext, nullptr);
  EXPECT_EQ(needs.features13.pNext, nullptr);
  EXPECT_TRUE(needs.features.fragmentStoresAndAtomics && needs.features12.scalarBlockLayout &&
              needs.features12.bufferDeviceAddress &&
              needs.features13.dynamicRendering && needs.features13.synchronization2);
  EXPECT_EQ(needs.device_extension_count, 0u);
}

// One memory type that is everything, as on integrated GPUs and lavapipe; host memory without coherence is not taken.
TEST(Life, memoryTypes) {
  {
    Scene scene;
    scene.driver.claims.memory.memoryTypeCount = 1;
    scene.driver.claims.memory.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                                              VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                                              VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS);
    const forelock::Asset asset = makeAsset();
    {
      const forelock::Hair hair = scene.createHair(asset);
      const forelock::View view = scene.createView();
      EXPECT_EQ(scene.render(view, scene.frame(1, 0, {hair})), FLK_SUCCESS);
      scene.driver.completed = 1;
    }
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }
  {
    Scene scene;
    scene.driver.claims.memory.memoryTypes[1].propertyFlags = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
    scene.driver.claims.memory.memoryTypes[2].propertyFlags = 0;
    const FlkResult result = scene.createContext();
    if (result == FLK_SUCCESS) {
      const forelock::Asset asset = makeAsset();
      FlkHairDesc hair_desc = forelock::hairDesc();
      hair_desc.asset = asset;
      forelock::Hair hair;
      EXPECT_EQ(forelock::create(scene.context, hair_desc, hair), FLK_ERROR_OUT_OF_DEVICE_MEMORY);
    } else {
      EXPECT_EQ(result, FLK_ERROR_OUT_OF_DEVICE_MEMORY);
    }
    scene.context.reset();
    EXPECT_TRUE(scene.nothingLeft());
  }
}

}  // namespace
