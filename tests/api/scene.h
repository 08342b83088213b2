// What the tests of this room share: a mock device, a context on it, a small asset and a frame that sees it.
#pragma once

#include "host_memory.h"
#include "mock_vulkan.h"

#include <forelock/forelock.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

// A tuft of `strands` strands of 8 vertices, 10 cm long, around `x` on the ground; `dressed`: with vertex colours and root UVs.
forelock::Asset makeAsset(uint32_t strands = 200, float x = 0.0f, const FlkHostAllocator* allocator = nullptr,
                          bool dressed = false);

class Scene {
public:
  // Everything but `desc` of a context is set up; change it before createContext().
  Scene();

  mock::Driver driver;
  HostMemory memory;
  std::vector<std::string> message_ids;
  std::string last_message;
  FlkContextDesc desc;
  forelock::Context context;

  FlkResult createContext() { return forelock::create(desc, context); }
  // Uploaded, unless there is no device or the test is about forgetting that.
  forelock::Hair createHair(FlkAsset asset, bool upload = true);
  // Of a dressed asset, with all that a hair may have: root image, follow strands, positions from the host.
  forelock::Hair createFullHair(FlkAsset asset);
  forelock::View createView(uint32_t frames_in_flight = 0, uint64_t pool_budget = 0);

  // A frame of 320 x 200 with the camera 0.6 m in front of the tuft, a light that casts a shadow, depth and all.
  // Valid as it is; `hairs` and `light` are kept here.
  FlkFrame frame(uint64_t number, uint64_t completed, std::vector<FlkHair> hairs);
  FlkLight light;
  // The same with everything that a frame may have: five lights of three kinds with 9 hair shadow maps, shadows and
  // visibility of the host, tiles, ambient harmonics, opacity modifiers, outputs, motion, counts. What it points to is kept below.
  FlkFrame fullFrame(uint64_t number, uint64_t completed, std::vector<FlkHair> hairs);
  std::vector<FlkLight> lights;
  FlkHostShadow host_shadow{};
  std::vector<FlkOpacityModifier> modifiers;
  std::vector<float> harmonics, previous_clip;
  std::vector<double> previous_view;

  // A queue without graphics, before createContext(); frames are then awaited and left by compute.
  void useComputeQueue();
  // Room for positions of a hair, to be reached by address.
  VkDeviceAddress positions(uint32_t vertex_count) { return driver.hostBuffer(VkDeviceSize{12} * vertex_count); }

  // Plans, and on success records, as frame `asked.frame_number`; the driver knows `completed_frame` to have completed.
  FlkResult render(FlkView view, const FlkFrame& asked, FlkPlan* plan = nullptr);

  // No breach of the driver's or the memory's rules so far.
  testing::AssertionResult clean() const;
  // And nothing of the SDK is left.
  testing::AssertionResult nothingLeft() const;

private:
  std::vector<FlkHair> hairs_;
  bool compute_queue_ = false;
  VkImage target_, depth_, host_maps_, host_visibility_, outputs_[FLK_OUTPUT_COUNT];
  VkImageView target_view_, depth_view_, host_maps_view_, host_visibility_view_, output_views_[FLK_OUTPUT_COUNT];
  VkDeviceAddress tiles_;
};

std::vector<FlkPassInfo> passesOf(FlkPlan plan);
std::vector<FlkResourceInfo> resourcesOf(FlkPlan plan);
FlkPlanInfo infoOf(FlkPlan plan);
