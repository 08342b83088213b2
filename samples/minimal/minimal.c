/* A host engine in one C99 file: where Forelock sits in a frame. SPDX-License-Identifier: MIT
 *
 *   forelock_minimal [STRANDS] [OUT.ppm]    STRANDS: a strand file (.tfx, .hair, .ply, .data), or "-" for the sphere made below
 *   FORELOCK_DEVICE=TEXT                    a device whose name contains TEXT; otherwise a discrete GPU, else any
 *
 * Whatever does not concern hair is as short as Vulkan allows. The five places where the engine meets the SDK are
 * marked [1] to [5]; an engine copies those and keeps its own device, command buffers, images and synchronisation.
 */
#include <forelock/render.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 640, HEIGHT = 480, FRAMES = 6, FRAMES_IN_FLIGHT = 2 };

static void check(int64_t result, const char* what) {
  if (result == 0) return;
  fprintf(stderr, "forelock_minimal: %s: result %lld\n", what, (long long)result);
  exit(1);
}

/* The SDK says here why a call failed, and what it warns of. */
static void printMessage(void* user, const FlkMessage* message) {
  (void)user;
  fprintf(stderr, "forelock_minimal: %s: %s\n", message->id, message->text);
}

/* ---- The engine's device ---- */

typedef struct Engine {
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkPhysicalDeviceProperties properties;
  VkPhysicalDeviceMemoryProperties memory;
  VkDevice device;
  uint32_t queue_family;
  VkQueue queue;
} Engine;

/* The first queue family that does all of `flags`, or -1. */
static int findQueueFamily(VkPhysicalDevice device, VkQueueFlags flags) {
  VkQueueFamilyProperties families[16];
  uint32_t count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families);
  for (uint32_t i = 0; i < count; ++i)
    if ((families[i].queueFlags & flags) == flags) return (int)i;
  return -1;
}

/* [1] Before the device exists, the SDK says what it must be able to do. An engine adds this to its own wishes. */
static void createDevice(Engine* engine) {
  FlkRequirements needs;
  flkGetRequirements(&needs);

  VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "forelock_minimal";
  application.apiVersion = needs.api_version;
  VkInstanceCreateInfo instance_info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  instance_info.pApplicationInfo = &application;
  check(vkCreateInstance(&instance_info, NULL, &engine->instance), "vkCreateInstance");

  VkPhysicalDevice devices[16];
  uint32_t count = 16;
  const VkResult found = vkEnumeratePhysicalDevices(engine->instance, &count, devices);
  check(found == VK_INCOMPLETE ? VK_SUCCESS : found, "vkEnumeratePhysicalDevices");
  const char* wanted = getenv("FORELOCK_DEVICE");
  for (uint32_t i = 0; i < count; ++i) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(devices[i], &properties);
    const int family = findQueueFamily(devices[i], needs.queue_flags | VK_QUEUE_GRAPHICS_BIT);
    if (properties.apiVersion < needs.api_version || family < 0) continue;
    if (wanted && !strstr(properties.deviceName, wanted)) continue;
    const int first = engine->physical_device == VK_NULL_HANDLE;
    const int better = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU &&
                       engine->properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    if (!first && !better) continue;
    engine->physical_device = devices[i];
    engine->properties = properties;
    engine->queue_family = (uint32_t)family;
  }
  if (!engine->physical_device) {
    fprintf(stderr, "forelock_minimal: no Vulkan 1.3 device%s%s\n", wanted ? " called " : "", wanted ? wanted : "");
    exit(3);
  }
  vkGetPhysicalDeviceMemoryProperties(engine->physical_device, &engine->memory);

  /* The features come as structs that can be chained as they are. */
  VkPhysicalDeviceFeatures2 features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.features = needs.features;
  features.pNext = &needs.features12;
  needs.features12.pNext = &needs.features13;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue_info.queueFamilyIndex = engine->queue_family;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkDeviceCreateInfo device_info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  device_info.pNext = &features;
  device_info.queueCreateInfoCount = 1;
  device_info.pQueueCreateInfos = &queue_info;
  device_info.enabledExtensionCount = needs.device_extension_count;
  device_info.ppEnabledExtensionNames = needs.device_extensions;
  check(vkCreateDevice(engine->physical_device, &device_info, NULL, &engine->device), "vkCreateDevice");
  vkGetDeviceQueue(engine->device, engine->queue_family, 0, &engine->queue);
}

static VkDeviceMemory allocate(const Engine* engine, VkMemoryRequirements needs, VkMemoryPropertyFlags properties) {
  VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  while (info.memoryTypeIndex < engine->memory.memoryTypeCount) {
    const VkMemoryType* type = &engine->memory.memoryTypes[info.memoryTypeIndex];
    if ((needs.memoryTypeBits >> info.memoryTypeIndex & 1u) && (type->propertyFlags & properties) == properties) break;
    ++info.memoryTypeIndex;
  }
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vkAllocateMemory(engine->device, &info, NULL, &memory), "vkAllocateMemory");
  return memory;
}

/* ---- The engine's scene: a furry sphere and a camera ---- */

enum { STRANDS = 6000, VERTICES = 16 };

/* Strands on the upper part of a sphere of 10 cm, starting along the normal and falling, kept outside the sphere. */
static FlkResult growHair(FlkAsset* asset) {
  static uint32_t first_vertex[STRANDS + 1];
  static float positions[STRANDS * VERTICES * 3], radii[STRANDS * VERTICES];
  const float head = 0.1f, step = 0.16f / (VERTICES - 1);
  for (uint32_t s = 0; s < STRANDS; ++s) {
    /* A Fibonacci spiral spreads the roots evenly. */
    const float up = 1.0f - 1.3f * ((float)s + 0.5f) / STRANDS, ring = sqrtf(1.0f - up * up),
                turn = 2.3999632f * (float)s;
    const float normal[3] = {ring * cosf(turn), up, ring * sinf(turn)};
    float p[3] = {head * normal[0], head * normal[1], head * normal[2]};
    first_vertex[s] = s * VERTICES;
    for (uint32_t v = 0; v < VERTICES; ++v) {
      const uint32_t i = s * VERTICES + v;
      memcpy(&positions[3 * i], p, sizeof p);
      radii[i] = 0.15e-3f;
      const float fall = (float)v / (VERTICES - 1), stand = expf(-6.0f * fall);
      const float wave = 0.25f * sinf(18.0f * fall + (float)(s % 7));
      const float way[3] = {stand * normal[0] + wave * normal[2], stand * normal[1] - (1.0f - stand),
                            stand * normal[2] - wave * normal[0]};
      const float length = sqrtf(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
      for (int c = 0; c < 3; ++c) p[c] += step * way[c] / length;
      const float distance = sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      if (distance < head * 1.005f)
        for (int c = 0; c < 3; ++c) p[c] *= head * 1.005f / distance;
    }
  }
  first_vertex[STRANDS] = STRANDS * VERTICES;
  FlkStrands strands = {.type = FLK_TYPE_STRANDS};
  strands.strand_count = STRANDS;
  strands.vertex_count = STRANDS * VERTICES;
  strands.first_vertex = first_vertex;
  strands.positions = positions;
  strands.radii = radii;
  return flkAssetCreate(&strands, NULL, asset);
}

/* A camera on +z that sees the box of the asset; matrices as in docs/conventions.md. */
static void aimCamera(const FlkAssetInfo* info, FlkFrame* frame) {
  double center[3], radius = 0.0;
  for (int c = 0; c < 3; ++c) {
    const double half = 0.5 * ((double)info->max_bounds[c] - info->min_bounds[c]);
    center[c] = info->min_bounds[c] + half;
    radius += half * half;
  }
  radius = sqrt(radius);
  const double focal = 3.0; /* 1 / tan(half the vertical field of view) */
  const double distance = radius * sqrt(focal * focal + 1.0), near_plane = 0.1 * radius,
               far_plane = distance + 2.0 * radius;
  for (int i = 0; i < 4; ++i) frame->view_from_world[5 * i] = 1.0;
  for (int c = 0; c < 3; ++c) frame->view_from_world[12 + c] = -center[c];
  frame->view_from_world[14] -= distance;
  frame->clip_from_view[0] = (float)(focal * HEIGHT / WIDTH);
  frame->clip_from_view[5] = (float)-focal; /* clip space is y down */
  frame->clip_from_view[10] = (float)(far_plane / (near_plane - far_plane));
  frame->clip_from_view[11] = -1.0f;
  frame->clip_from_view[14] = (float)(near_plane * far_plane / (near_plane - far_plane));
}

/* ---- The picture ---- */

static float halfToFloat(uint16_t half) {
  const int exponent = half >> 10 & 31, mantissa = half & 1023;
  const float value = exponent ? ldexpf((float)(1024 + mantissa), exponent - 25) : ldexpf((float)mantissa, -24);
  return half >> 15 ? -value : value;
}

/* Linear to sRGB, 8 bits. Returns the number of pixels with hair on them. */
static uint32_t writePicture(const char* path, const uint16_t* pixels) {
  FILE* file = fopen(path, "wb");
  if (!file) {
    fprintf(stderr, "forelock_minimal: %s: cannot be written\n", path);
    exit(1);
  }
  fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT);
  uint32_t covered = 0;
  for (uint32_t i = 0; i < WIDTH * HEIGHT; ++i) {
    covered += halfToFloat(pixels[4 * i + 3]) > 0.0f;
    for (int c = 0; c < 3; ++c) {
      const float x = fminf(fmaxf(halfToFloat(pixels[4 * i + c]), 0.0f), 1.0f);
      const float coded = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
      fputc((int)(255.0f * coded + 0.5f), file);
    }
  }
  check(fclose(file), path);
  return covered;
}

int main(int argc, char** argv) {
  const char* strand_file = argc > 1 && strcmp(argv[1], "-") != 0 ? argv[1] : NULL;
  const char* picture_file = argc > 2 ? argv[2] : "forelock_minimal.ppm";
  Engine engine;
  memset(&engine, 0, sizeof engine);
  createDevice(&engine);
  VkDevice device = engine.device;

  /* The engine's frame: a colour image, a buffer to read it back, per frame in flight a command buffer and a fence. */
  VkImageCreateInfo image_info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  image_info.imageType = VK_IMAGE_TYPE_2D;
  image_info.format = VK_FORMAT_R16G16B16A16_SFLOAT;
  image_info.extent.width = WIDTH;
  image_info.extent.height = HEIGHT;
  image_info.extent.depth = image_info.mipLevels = image_info.arrayLayers = 1;
  image_info.samples = VK_SAMPLE_COUNT_1_BIT;
  /* STORAGE is what the SDK asks for; the rest is this program's. */
  image_info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  VkImage image;
  check(vkCreateImage(device, &image_info, NULL, &image), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, image, &needs);
  VkDeviceMemory image_memory = allocate(&engine, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device, image, image_memory, 0), "vkBindImageMemory");
  const VkImageSubresourceRange whole = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkImageViewCreateInfo view_info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view_info.image = image;
  view_info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view_info.format = image_info.format;
  view_info.subresourceRange = whole;
  VkImageView image_view;
  check(vkCreateImageView(device, &view_info, NULL, &image_view), "vkCreateImageView");

  VkBufferCreateInfo buffer_info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  buffer_info.size = (VkDeviceSize)WIDTH * HEIGHT * 8;
  buffer_info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer read_back;
  check(vkCreateBuffer(device, &buffer_info, NULL, &read_back), "vkCreateBuffer");
  vkGetBufferMemoryRequirements(device, read_back, &needs);
  VkDeviceMemory read_back_memory =
      allocate(&engine, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device, read_back, read_back_memory, 0), "vkBindBufferMemory");
  void* pixels;
  check(vkMapMemory(device, read_back_memory, 0, VK_WHOLE_SIZE, 0, &pixels), "vkMapMemory");

  VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool_info.queueFamilyIndex = engine.queue_family;
  VkCommandPool pool;
  check(vkCreateCommandPool(device, &pool_info, NULL, &pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo command_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  command_info.commandPool = pool;
  command_info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  command_info.commandBufferCount = FRAMES_IN_FLIGHT;
  VkCommandBuffer commands[FRAMES_IN_FLIGHT];
  check(vkAllocateCommandBuffers(device, &command_info, commands), "vkAllocateCommandBuffers");
  VkFence fences[FRAMES_IN_FLIGHT];
  VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  fence_info.flags = VK_FENCE_CREATE_SIGNALED_BIT;
  for (int i = 0; i < FRAMES_IN_FLIGHT; ++i)
    check(vkCreateFence(device, &fence_info, NULL, &fences[i]), "vkCreateFence");

  /* [2] Once: a context for the device, and a view for each thing that hair is drawn into. */
  FlkContextDesc context_desc = {.type = FLK_TYPE_CONTEXT};
  context_desc.instance = engine.instance;
  context_desc.physical_device = engine.physical_device;
  context_desc.device = device;
  context_desc.get_instance_proc_addr = vkGetInstanceProcAddr;
  context_desc.queue_family = engine.queue_family;
  context_desc.message = printMessage;
  FlkContext context;
  check(flkContextCreate(&context_desc, &context), "flkContextCreate");
  FlkViewDesc view_desc = {.type = FLK_TYPE_VIEW};
  view_desc.frames_in_flight = FRAMES_IN_FLIGHT;
  FlkView view;
  check(flkViewCreate(context, &view_desc, &view), "flkViewCreate");

  /* [3] Per asset: strands on the CPU, then a hair on the device. The strands are not needed afterwards. */
  FlkAsset asset;
  FlkAssetOptions options = {.type = FLK_TYPE_ASSET_OPTIONS};
  options.message = printMessage;
  check(strand_file ? flkAssetLoadFile(strand_file, &options, &asset) : growHair(&asset), "hair asset");
  FlkAssetInfo asset_info;
  check(flkAssetGetInfo(asset, &asset_info), "flkAssetGetInfo");
  FlkMaterial material;
  flkMaterialDefault(&material);
  FlkHairDesc hair_desc = {.type = FLK_TYPE_HAIR};
  hair_desc.asset = asset;
  hair_desc.material = &material;
  FlkHair hair;
  check(flkHairCreate(context, &hair_desc, &hair), "flkHairCreate");
  flkAssetDestroy(asset);

  FlkLight light = {.direction = {0.7f, 0.7f, 0.5f}, .radiance = {8.0f, 7.6f, 7.0f}, .casts_shadow = 1};
  FlkFrame frame = {.type = FLK_TYPE_FRAME};
  aimCamera(&asset_info, &frame);
  frame.hair_count = 1;
  frame.hairs = &hair;
  frame.light_count = 1;
  frame.lights = &light;
  frame.ambient[0] = frame.ambient[1] = frame.ambient[2] = 0.3f;
  frame.timestamps = 1;
  frame.target.image = image;
  frame.target.view = image_view;
  frame.target.format = image_info.format;
  frame.target.samples = VK_SAMPLE_COUNT_1_BIT;
  frame.target.range = whole;
  frame.target.width = WIDTH;
  frame.target.height = HEIGHT;
  /* What the engine does with the image around the hair; Forelock puts in every barrier between. An engine with a depth
   * buffer also fills frame.depth, so that the scene hides the hair behind it. */
  frame.target.entry.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  frame.target.entry.stages = VK_PIPELINE_STAGE_2_CLEAR_BIT;
  frame.target.entry.access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  frame.target.exit.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  frame.target.exit.stages = VK_PIPELINE_STAGE_2_COPY_BIT;
  frame.target.exit.access = VK_ACCESS_2_TRANSFER_READ_BIT;

  for (uint64_t number = 1; number <= FRAMES; ++number) {
    VkFence fence = fences[number % FRAMES_IN_FLIGHT];
    VkCommandBuffer cmd = commands[number % FRAMES_IN_FLIGHT];
    check(vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    check(vkResetFences(device, 1, &fence), "vkResetFences");

    /* [4] Per frame: what is wanted, and what the engine knows to be done. Compiles and allocates what is new; the
     * counts of completed frames size the lists. */
    frame.frame_number = number;
    frame.completed_frame = number > FRAMES_IN_FLIGHT ? number - FRAMES_IN_FLIGHT : 0;
    FlkPlan plan;
    check(flkPlanFrame(view, &frame, &plan), "flkPlanFrame");

    VkCommandBufferBeginInfo begin_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin_info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(cmd, &begin_info), "vkBeginCommandBuffer");
    if (number == 1) check(flkCmdUpload(cmd, hair), "flkCmdUpload");

    /* The engine's own drawing: here a clear, after the copy that the frame before made of the same image. */
    VkImageMemoryBarrier2 barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
    barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    barrier.dstStageMask = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    barrier.dstAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.newLayout = frame.target.entry.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = whole;
    VkDependencyInfo dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    dependency.imageMemoryBarrierCount = 1;
    dependency.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(cmd, &dependency);
    const VkClearColorValue nothing = {{0.0f, 0.0f, 0.0f, 0.0f}};
    vkCmdClearColorImage(cmd, image, frame.target.entry.layout, &nothing, 1, &whole);

    /* [5] The hair: records what was planned, over the opaque scene and before post-processing. */
    flkCmdRender(cmd, plan);

    /* The engine goes on with the image in the layout that it asked for. */
    if (number == FRAMES) {
      VkBufferImageCopy region;
      memset(&region, 0, sizeof region);
      region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
      region.imageSubresource.layerCount = 1;
      region.imageExtent = image_info.extent;
      vkCmdCopyImageToBuffer(cmd, image, frame.target.exit.layout, read_back, 1, &region);
      VkMemoryBarrier2 to_host = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
      to_host.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
      to_host.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
      to_host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
      to_host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
      VkDependencyInfo host_dependency = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
      host_dependency.memoryBarrierCount = 1;
      host_dependency.pMemoryBarriers = &to_host;
      vkCmdPipelineBarrier2(cmd, &host_dependency);
    }
    check(vkEndCommandBuffer(cmd), "vkEndCommandBuffer");
    VkCommandBufferSubmitInfo command = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    command.commandBuffer = cmd;
    VkSubmitInfo2 submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &command;
    check(vkQueueSubmit2(engine.queue, 1, &submit, fence), "vkQueueSubmit2");
    /* The upload is done once its frame is: the staging memory can go. */
    if (number == 1 + FRAMES_IN_FLIGHT) flkHairReleaseStaging(hair);
  }
  check(vkDeviceWaitIdle(device), "vkDeviceWaitIdle");

  const uint32_t covered = writePicture(picture_file, (const uint16_t*)pixels);
  FlkStatistics statistics;
  check(flkViewGetStatistics(view, FRAMES, &statistics), "flkViewGetStatistics");
  printf("device     %s\n", engine.properties.deviceName);
  printf("strands    %u\n", asset_info.strand_count);
  printf("picture    %s, %u pixels with hair\n", picture_file, covered);
  printf("fragments  %llu, %llu beyond the lists\n", (unsigned long long)statistics.fragments,
         (unsigned long long)statistics.overflow_fragments);
  static const char* const stages[FLK_STAGE_COUNT] = {"clear", "shadow", "capture", "resolve", "prepare", "output"};
  for (int i = 0; i < FLK_STAGE_COUNT; ++i)
    if (statistics.milliseconds[i] >= 0.0) printf("%-10s %.3f ms\n", stages[i], statistics.milliseconds[i]);

  /* Nothing is in flight any more: hairs and views first, then the context, then the device. */
  flkHairDestroy(hair);
  flkViewDestroy(view);
  flkContextDestroy(context);
  for (int i = 0; i < FRAMES_IN_FLIGHT; ++i) vkDestroyFence(device, fences[i], NULL);
  vkDestroyCommandPool(device, pool, NULL);
  vkDestroyBuffer(device, read_back, NULL);
  vkFreeMemory(device, read_back_memory, NULL);
  vkDestroyImageView(device, image_view, NULL);
  vkDestroyImage(device, image, NULL);
  vkFreeMemory(device, image_memory, NULL);
  vkDestroyDevice(device, NULL);
  vkDestroyInstance(engine.instance, NULL);
  return covered > 0 ? 0 : 1;
}
