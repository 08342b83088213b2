// What flkPlanGetInfo, flkPlanGetResource and flkHairGetInfo say is what is allocated, to the byte and through the host's functions.
#include "scene.h"

#include <cstdlib>
#include <functional>
#include <map>

namespace {

// A host that hands out device memory itself and keeps the books.
class DeviceMemory {
public:
  explicit DeviceMemory(mock::Driver& owner) : callbacks{this, allocate, free}, driver_(owner) {}
  FlkDeviceAllocator callbacks;
  std::map<std::string, VkDeviceSize> bytes;  // by name, of what is alive
  VkDeviceSize total() const {
    VkDeviceSize sum = 0;
    for (const auto& [name, size] : bytes) sum += size;
    return sum;
  }
  uint64_t allocations = 0;

private:
  static VkResult allocate(void* user, const VkMemoryRequirements* requirements, VkMemoryPropertyFlags properties, const char* name,
                           FlkDeviceAllocation* allocation) {
    auto& self = *static_cast<DeviceMemory*>(user);
    mock::Object* block = self.driver_.make(mock::Kind::Memory);
    block->of_host = true;
    block->size = requirements->size;
    block->memory_type = properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT ? 1 : 0;
    block->bytes = std::calloc(1, block->size);
    self.names_[block] = name;
    self.bytes[name] += block->size;
    ++self.allocations;
    allocation->memory = mock::handleOf<VkDeviceMemory>(block);
    allocation->mapped = properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT ? block->bytes : nullptr;
    allocation->user = block;
    return VK_SUCCESS;
  }
  static void free(void* user, const FlkDeviceAllocation* allocation) {
    auto& self = *static_cast<DeviceMemory*>(user);
    auto* block = static_cast<mock::Object*>(allocation->user);
    EXPECT_TRUE(block->alive);
    EXPECT_FALSE(self.driver_.busy(block)) << self.names_[block];
    block->alive = false;
    const std::string& name = self.names_[block];
    if ((self.bytes[name] -= block->size) == 0) self.bytes.erase(name);
  }
  mock::Driver& driver_;
  std::map<mock::Object*, std::string> names_;
};

constexpr uint64_t kIndexBytes = 192 << 10;  // of the context, for queues that rasterise: render.h, flkContextCreate

class Memory : public testing::Test {
protected:
  void create(bool compute_queue = false) {
    if (compute_queue) scene.useComputeQueue();
    scene.desc.device_allocator = &device_memory.callbacks;
    ASSERT_EQ(scene.createContext(), FLK_SUCCESS) << scene.last_message;
    EXPECT_EQ(scene.driver.bytesOfResources(), compute_queue ? 0 : kIndexBytes);
    asset = makeAsset(200, 0.0f, nullptr, true);
  }
  void TearDown() override {
    scene.driver.completed = UINT64_MAX;
    view.reset();
    hair.reset();
    scene.context.reset();
    EXPECT_EQ(device_memory.total(), 0u);
    EXPECT_EQ(scene.driver.calls.count("vkAllocateMemory"), 0u);
    EXPECT_TRUE(scene.nothingLeft());
  }

  // The first frame of a new view.
  void expectReported(const FlkFrame& frame, const char* what, uint32_t frames_in_flight) {
    const VkDeviceSize before = scene.driver.bytesOfResources();
    const auto named_before = device_memory.bytes;
    view = scene.createView(frames_in_flight);
    FlkPlan plan = nullptr;
    ASSERT_EQ(flkPlanFrame(view, &frame, &plan), FLK_SUCCESS) << what << ": " << scene.last_message;
    EXPECT_EQ(scene.driver.bytesOfResources() - before, infoOf(plan).bytes_transient) << what;
    uint64_t sum = 0;
    for (const FlkResourceInfo& resource : resourcesOf(plan)) {
      const std::string name = std::string(resource.name) == "nearest fragments" ? "heads" : resource.name;
      const auto found = device_memory.bytes.find(name);
      ASSERT_NE(found, device_memory.bytes.end()) << what << ' ' << name;
      EXPECT_EQ(found->second, (resource.bytes + 255) / 256 * 256) << what << ' ' << name;  // the mock's alignment
      sum += resource.bytes;
    }
    EXPECT_EQ(sum, infoOf(plan).bytes_transient) << what;
    EXPECT_EQ(device_memory.bytes.size(), named_before.size() + infoOf(plan).resource_count) << what << ": something is not reported";
    view.reset();
    EXPECT_EQ(device_memory.bytes, named_before) << what;
  }

  Scene scene;
  DeviceMemory device_memory{scene.driver};
  forelock::Asset asset;
  forelock::Hair hair;
  forelock::View view;
};

TEST_F(Memory, ofHairs) {
  create();
  const auto expectHair = [&](uint32_t flags, uint32_t follow, bool dressed_hair, uint64_t vertex_bytes, uint64_t strand_bytes) {
    const forelock::Asset plain = makeAsset(200);
    FlkHairDesc desc = forelock::hairDesc();
    desc.asset = dressed_hair ? asset : plain;
    desc.flags = flags;
    desc.follow.count = follow;
    hair.reset();
    const VkDeviceSize before = scene.driver.bytesOfResources();
    ASSERT_EQ(forelock::create(scene.context, desc, hair), FLK_SUCCESS);
    FlkHairInfo info{};
    ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
    EXPECT_EQ(info.strand_count, 200 * (follow + 1));
    EXPECT_EQ(info.vertex_count, 1600 * (follow + 1));
    EXPECT_EQ(info.segment_count, 1400 * (follow + 1));
    EXPECT_EQ(info.bytes_device, vertex_bytes * info.vertex_count + 4 * info.segment_count + strand_bytes * info.strand_count);
    EXPECT_EQ(scene.driver.bytesOfResources() - before, info.bytes_device + info.bytes_staging);
    flkHairReleaseStaging(hair);
    EXPECT_EQ(scene.driver.bytesOfResources() - before, info.bytes_device);
  };
  // As documented at flkHairCreate and FLK_HAIR_...
  expectHair(0, 0, false, 16, 0);
  expectHair(0, 0, true, 20, 0);
  expectHair(FLK_HAIR_IGNORE_COLORS, 0, true, 16, 0);
  expectHair(0, 7, true, 20, 0);
  expectHair(FLK_HAIR_HOST_POSITIONS, 3, true, 32, 36);
}

TEST_F(Memory, ofViewsAndPlans) {
  create();
  hair = scene.createFullHair(asset);
  FlkHairInfo info{};
  ASSERT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
  uint64_t number = 1;
  for (uint32_t method = 0; method <= FLK_METHOD_HARD; ++method)
    for (uint32_t capture = FLK_CAPTURE_RASTER; capture <= FLK_CAPTURE_COMPUTE; ++capture)
      for (const bool everything : {false, true})
        for (uint32_t overflow = 0; overflow <= FLK_OVERFLOW_DROP; ++overflow) {
          FlkFrame frame = everything ? scene.fullFrame(number, number - 1, {hair}) : scene.frame(number, number - 1, {hair});
          ++number;
          frame.method = method, frame.capture = capture, frame.overflow = overflow;
          expectReported(frame, "method", 1 + uint32_t(number % 8));
        }
  for (uint32_t display = 1; display <= FLK_DISPLAY_LAYERS; ++display) {
    FlkFrame frame = scene.fullFrame(number, number - 1, {hair});
    ++number;
    frame.display = display;
    expectReported(frame, "display", 3);
  }
  FlkFrame frame = scene.fullFrame(number, number - 1, {hair});
  frame.count_only = 1;
  expectReported(frame, "count_only", 3);
  frame.hair_count = 0;
  expectReported(frame, "no hair", 3);
}

TEST_F(Memory, ofAComputeQueue) {
  create(true);
  hair = scene.createFullHair(asset);
  expectReported(scene.fullFrame(1, 0, {hair}), "compute queue", 3);
}

// What no frame needs any more is given back, so that after some frames the view holds again what its plan says.
TEST_F(Memory, comesBackToWhatThePlanSays) {
  create();
  hair = scene.createFullHair(asset);
  view = scene.createView(3);
  const VkDeviceSize without = scene.driver.bytesOfResources();
  uint64_t number = 1;
  FlkPlan plan = nullptr;
  const auto run = [&](int frames, const std::function<void(FlkFrame&)>& change) {
    for (int i = 0; i < frames; ++i, ++number) {
      FlkFrame frame = scene.fullFrame(number, number > 3 ? number - 3 : 0, {hair});
      change(frame);
      scene.driver.commands.clear();
      ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
      if (uint32_t* count = scene.driver.latestReadBack()) *count = 20000;
    }
  };
  const auto held = [&] { return scene.driver.bytesOfResources() - without; };
  run(20, [](FlkFrame&) {});
  EXPECT_EQ(held(), infoOf(plan).bytes_transient);
  run(20, [](FlkFrame& f) { f.light_count = 0, f.overflow = FLK_OVERFLOW_DROP; });
  EXPECT_EQ(held(), infoOf(plan).bytes_transient) << "without shadow maps and aggregates";
  run(20, [](FlkFrame& f) { f.method = FLK_METHOD_HARD; });
  EXPECT_EQ(held(), infoOf(plan).bytes_transient) << "without lists";
  run(20, [](FlkFrame& f) { f.display = FLK_DISPLAY_WIDTH; });
  EXPECT_LE(held(), 2 * infoOf(plan).bytes_transient) << "heads of the hard method are up to twice those of lists";
  run(20, [](FlkFrame& f) { f.target.width = 80, f.target.height = 50; });
  EXPECT_LE(held(), 2 * infoOf(plan).bytes_transient) << "a small picture";
}

// The budget counts bytes, also when nodes grow by a colour before anything was counted.
TEST_F(Memory, budgetHoldsWithColours) {
  create();
  constexpr uint64_t kBudget = 120000;
  hair = scene.createHair(asset);
  const forelock::Asset plain_asset = makeAsset(200);
  const forelock::Hair plain = scene.createHair(plain_asset);
  view = scene.createView(3, kBudget);
  for (uint64_t number = 1; number <= 12; ++number) {
    const FlkFrame frame = scene.frame(number, number > 3 ? number - 3 : 0, {number % 2 ? plain : hair});
    FlkPlan plan = nullptr;
    ASSERT_EQ(scene.render(view, frame, &plan), FLK_SUCCESS) << scene.last_message;
    *scene.driver.latestReadBack() = 5000000;
    for (const FlkResourceInfo& resource : resourcesOf(plan))
      if (std::string(resource.name) == "nodes") { EXPECT_LE(resource.bytes, kBudget) << number; }
  }
  scene.driver.completed = 12;
}

}  // namespace
