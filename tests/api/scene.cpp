#include "scene.h"

#include <cmath>

namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "\n  " + line;
  return text;
}

}  // namespace

forelock::Asset makeAsset(uint32_t strands, float x, const FlkHostAllocator* allocator, bool dressed) {
  constexpr uint32_t kVertices = 8;
  std::vector<uint32_t> first_vertex;
  std::vector<float> positions, radii, colors, root_uvs;
  for (uint32_t s = 0; s < strands; ++s) {
    first_vertex.push_back(s * kVertices);
    const float turn = 2.3999632f * static_cast<float>(s);
    root_uvs.insert(root_uvs.end(), {0.5f + 0.5f * std::cos(turn), 0.5f + 0.5f * std::sin(turn)});
    const float away = 0.03f * std::sqrt(static_cast<float>(s) / static_cast<float>(strands));
    for (uint32_t v = 0; v < kVertices; ++v) {
      const float along = static_cast<float>(v) / (kVertices - 1);
      const float out = away * (1.0f + along);
      positions.insert(positions.end(), {x + out * std::cos(turn), 0.1f * along, out * std::sin(turn)});
      radii.push_back(0.2e-3f * (1.0f - 0.8f * along));
      colors.insert(colors.end(), {along, 0.5f, 1.0f - along});
    }
  }
  first_vertex.push_back(strands * kVertices);
  FlkStrands description = forelock::strandsDesc();
  description.strand_count = strands;
  description.vertex_count = strands * kVertices;
  description.first_vertex = first_vertex.data();
  description.positions = positions.data();
  description.radii = radii.data();
  if (dressed) description.colors = colors.data(), description.root_uvs = root_uvs.data();
  FlkAssetOptions options = forelock::assetOptions();
  options.allocator = allocator;
  forelock::Asset asset;
  EXPECT_EQ(forelock::create(description, &options, asset), FLK_SUCCESS);
  return asset;
}

Scene::Scene() : desc(forelock::contextDesc()) {
  desc.instance = driver.instance;
  desc.physical_device = driver.physical_device;
  desc.device = driver.device;
  desc.get_instance_proc_addr = mock::Driver::getInstanceProcAddr();
  desc.allocator = &memory.callbacks;
  desc.message = [](void* user, const FlkMessage* message) {
    auto* scene = static_cast<Scene*>(user);
    scene->message_ids.emplace_back(message->id);
    scene->last_message = message->text;
  };
  desc.message_user = this;
  light = FlkLight{};
  for (int i = 0; i < 3; ++i) light.direction[i] = i == 1 ? 1.0f : 0.4f, light.radiance[i] = 2.0f;
  light.casts_shadow = 1;
  light.shadow_size = 512;
  target_ = driver.hostImage(&target_view_, VK_IMAGE_USAGE_STORAGE_BIT);
  depth_ = driver.hostImage(&depth_view_, VK_IMAGE_USAGE_SAMPLED_BIT);
  host_maps_ = driver.hostImage(&host_maps_view_, VK_IMAGE_USAGE_SAMPLED_BIT);
  host_visibility_ = driver.hostImage(&host_visibility_view_, VK_IMAGE_USAGE_SAMPLED_BIT);
  for (int i = 0; i < FLK_OUTPUT_COUNT; ++i) outputs_[i] = driver.hostImage(&output_views_[i], VK_IMAGE_USAGE_STORAGE_BIT);
  tiles_ = driver.hostBuffer(64 * 64 * 4);
}

void Scene::useComputeQueue() {
  compute_queue_ = true;
  driver.queue_flags = VK_QUEUE_COMPUTE_BIT | VK_QUEUE_TRANSFER_BIT;
  desc.queue_family = static_cast<uint32_t>(driver.claims.queue_families.size());
  driver.claims.queue_families.push_back({driver.queue_flags, 1, 64, {1, 1, 1}});
}

forelock::Hair Scene::createHair(FlkAsset asset, bool upload) {
  FlkHairDesc hair_desc = forelock::hairDesc();
  hair_desc.asset = asset;
  forelock::Hair hair;
  EXPECT_EQ(forelock::create(context, hair_desc, hair), FLK_SUCCESS) << last_message;
  if (desc.device && upload) {
    driver.beginCommandBuffer();
    EXPECT_EQ(flkCmdUpload(driver.command_buffer, hair), FLK_SUCCESS);
  }
  return hair;
}

forelock::Hair Scene::createFullHair(FlkAsset asset) {
  const float pixels[] = {1.0f, 0.5f, 0.25f, 0.0f, 0.5f, 1.0f, 0.2f, 0.4f, 0.6f, 0.9f, 0.9f, 0.9f};
  const FlkRootImage image{pixels, 2, 2};
  FlkHairDesc hair_desc = forelock::hairDesc();
  hair_desc.asset = asset;
  hair_desc.flags = FLK_HAIR_HOST_POSITIONS;
  hair_desc.root_image = &image;
  hair_desc.follow = {2, 0.002f, 0.5f, 7};
  forelock::Hair hair;
  EXPECT_EQ(forelock::create(context, hair_desc, hair), FLK_SUCCESS) << last_message;
  if (!hair) return hair;
  FlkHairInfo info{};
  EXPECT_EQ(flkHairGetInfo(hair, &info), FLK_SUCCESS);
  FlkHairPositions moved{};
  moved.address = positions(info.vertex_count / 3);
  for (int axis = 0; axis < 3; ++axis) moved.min_bounds[axis] = -0.1f, moved.max_bounds[axis] = 0.15f;
  moved.entry_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  moved.entry_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  EXPECT_EQ(flkHairSetPositions(hair, &moved), FLK_SUCCESS) << last_message;
  if (desc.device) {
    driver.beginCommandBuffer();
    EXPECT_EQ(flkCmdUpload(driver.command_buffer, hair), FLK_SUCCESS);
  }
  return hair;
}

forelock::View Scene::createView(uint32_t frames_in_flight, uint64_t pool_budget) {
  FlkViewDesc view_desc = forelock::viewDesc();
  view_desc.frames_in_flight = frames_in_flight;
  view_desc.pool_budget = pool_budget;
  forelock::View view;
  EXPECT_EQ(forelock::create(context, view_desc, view), FLK_SUCCESS) << last_message;
  return view;
}

FlkFrame Scene::frame(uint64_t number, uint64_t completed, std::vector<FlkHair> hairs) {
  hairs_ = std::move(hairs);
  FlkFrame frame = forelock::frameDesc();
  frame.frame_number = number;
  frame.completed_frame = completed;
  for (int i = 0; i < 4; ++i) frame.view_from_world[5 * i] = 1.0;
  frame.view_from_world[13] = -0.05;
  frame.view_from_world[14] = -0.6;
  const float focal = 2.5f, near_plane = 0.05f, far_plane = 10.0f;
  frame.clip_from_view[0] = focal * 200.0f / 320.0f;
  frame.clip_from_view[5] = -focal;
  frame.clip_from_view[10] = far_plane / (near_plane - far_plane);
  frame.clip_from_view[11] = -1.0f;
  frame.clip_from_view[14] = near_plane * far_plane / (near_plane - far_plane);
  frame.hair_count = static_cast<uint32_t>(hairs_.size());
  frame.hairs = hairs_.data();
  frame.light_count = 1;
  frame.lights = &light;
  frame.timestamps = 1;
  FlkColorTarget& target = frame.target;
  target.image = target_;
  target.view = target_view_;
  target.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  target.samples = VK_SAMPLE_COUNT_1_BIT;
  target.range = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  target.width = 320;
  target.height = 200;
  target.entry = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                  VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
  target.exit = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                 VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
  FlkDepthSource& depth = frame.depth;
  depth.image = depth_;
  depth.view = depth_view_;
  depth.format = VK_FORMAT_D32_SFLOAT;
  depth.samples = VK_SAMPLE_COUNT_1_BIT;
  depth.range = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
  depth.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
  depth.entry_stages = VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  depth.entry_access = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  if (compute_queue_) {
    target.entry = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
    target.exit = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
    depth.entry_stages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    depth.entry_access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  }
  return frame;
}

FlkFrame Scene::fullFrame(uint64_t number, uint64_t completed, std::vector<FlkHair> hairs) {
  FlkFrame full = frame(number, completed, std::move(hairs));
  host_shadow = FlkHostShadow{};
  for (int i = 0; i < 4; ++i) host_shadow.map_from_world[5 * i] = 1.0;
  host_shadow.rect[2] = host_shadow.rect[3] = 512.0f;
  host_shadow.bias = 0.01f;
  lights.assign(5, FlkLight{});
  for (FlkLight& l : lights) {
    l.casts_shadow = 1;
    l.shadow_size = 64;
    l.direction[1] = 1.0f;
    for (float& r : l.radiance) r = 0.5f;
    l.position[1] = 2.0;
  }
  lights[0].shadow_size = 256;
  lights[1].kind = FLK_LIGHT_POINT;
  lights[1].shadow_size = 128;
  lights[1].host_shadow = &host_shadow;
  lights[1].visibility = 1;
  lights[1].range = 5.0f;
  lights[2].kind = FLK_LIGHT_SPOT;
  lights[2].inner_angle = 0.1f, lights[2].outer_angle = 0.3f;
  lights[2].visibility = 2;
  lights[3].kind = FLK_LIGHT_POINT;
  lights[3].position[1] = 0.05;  // amid the hair
  lights[4].casts_shadow = 0;
  lights[4].host_shadow = &host_shadow;
  full.lights = lights.data();
  full.light_count = static_cast<uint32_t>(lights.size());
  full.ambient[0] = full.ambient[1] = full.ambient[2] = 0.1f;
  harmonics.assign(27, 0.01f);
  full.ambient_sh = harmonics.data();
  const VkPipelineStageFlags2 compute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const auto sampled = [&](VkImage image, VkImageView view) {
    return FlkSampledImage{image, view, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 2}, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                           compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
  };
  full.host_shadow_maps = sampled(host_maps_, host_maps_view_);
  full.host_visibility = sampled(host_visibility_, host_visibility_view_);
  full.light_tiles = {tiles_, 16, 64, 64, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
  modifiers.assign(2, FlkOpacityModifier{});
  modifiers[0].kind = FLK_OPACITY_NEAR_FADE;
  modifiers[0].start = 0.1f, modifiers[0].end = 0.2f;
  modifiers[1].kind = FLK_OPACITY_LENS;
  modifiers[1].center[0] = 160.0f, modifiers[1].center[1] = 100.0f;
  modifiers[1].radius = 20.0f, modifiers[1].feather = 10.0f, modifiers[1].inside = 0.25f;
  full.opacity_modifiers = modifiers.data();
  full.opacity_modifier_count = 2;
  for (int i = 0; i < FLK_OUTPUT_COUNT; ++i) {
    full.outputs[i] = {outputs_[i], output_views_[i], {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1},
                       {VK_IMAGE_LAYOUT_GENERAL, compute, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                       {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, compute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT}};
  }
  previous_view.assign(full.view_from_world, full.view_from_world + 16);
  previous_view[12] = 0.01;
  previous_clip.assign(full.clip_from_view, full.clip_from_view + 16);
  full.previous_view_from_world = previous_view.data();
  full.previous_clip_from_view = previous_clip.data();
  full.count_work = 1;
  return full;
}

FlkResult Scene::render(FlkView view, const FlkFrame& asked, FlkPlan* planned) {
  driver.completed = std::max(driver.completed, asked.completed_frame);
  FlkPlan plan = nullptr;
  const FlkResult result = flkPlanFrame(view, &asked, &plan);
  if (planned) *planned = plan;
  if (result != FLK_SUCCESS) return result;
  driver.frame = asked.frame_number;
  driver.beginCommandBuffer();
  const uint64_t allocations = memory.allocations, created = driver.calledOutsideRecording();
  driver.recording_only = true;
  flkCmdRender(driver.command_buffer, plan);
  driver.recording_only = false;
  EXPECT_EQ(memory.allocations, allocations) << "flkCmdRender allocates";
  EXPECT_EQ(driver.calledOutsideRecording(), created) << "flkCmdRender calls more than vkCmd...";
  EXPECT_FALSE(driver.inside_rendering);
  return result;
}

testing::AssertionResult Scene::clean() const {
  if (driver.breaches.empty() && memory.breaches.empty()) return testing::AssertionSuccess();
  return testing::AssertionFailure() << joined(driver.breaches) << joined(memory.breaches);
}

testing::AssertionResult Scene::nothingLeft() const {
  if (const auto result = clean(); !result) return result;
  if (memory.live() != 0) return testing::AssertionFailure() << memory.live() << " blocks of host memory";
  if (!driver.leaks().empty()) return testing::AssertionFailure() << driver.leaks();
  return testing::AssertionSuccess();
}

FlkPlanInfo infoOf(FlkPlan plan) {
  FlkPlanInfo info{};
  EXPECT_EQ(flkPlanGetInfo(plan, &info), FLK_SUCCESS);
  return info;
}

std::vector<FlkPassInfo> passesOf(FlkPlan plan) {
  std::vector<FlkPassInfo> passes(infoOf(plan).pass_count);
  for (uint32_t i = 0; i < passes.size(); ++i) EXPECT_EQ(flkPlanGetPass(plan, i, &passes[i]), FLK_SUCCESS);
  return passes;
}

std::vector<FlkResourceInfo> resourcesOf(FlkPlan plan) {
  std::vector<FlkResourceInfo> resources(infoOf(plan).resource_count);
  for (uint32_t i = 0; i < resources.size(); ++i) EXPECT_EQ(flkPlanGetResource(plan, i, &resources[i]), FLK_SUCCESS);
  return resources;
}
