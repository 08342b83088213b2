// The C boundary of render.h: check arguments, translate, call.
#include "api/boundary.h"
#include "gpu/view.h"

#include "forelock/render.h"

#include <cmath>
#include <iterator>

namespace {

using forelock::Context;
using forelock::Frame;
using forelock::guarded;
using forelock::Hair;
using forelock::HostMemory;
using forelock::Messages;
using forelock::View;

// A handle is the object's address.
Context* toContext(FlkContext handle) { return reinterpret_cast<Context*>(handle); }
Hair* toHair(FlkHair handle) { return reinterpret_cast<Hair*>(handle); }
View* toView(FlkView handle) { return reinterpret_cast<View*>(handle); }
Frame* toFrame(FlkPlan handle) { return reinterpret_cast<Frame*>(handle); }

FlkResult invalid(const Messages& messages, const char* what) {
  messages.say(FLK_SEVERITY_ERROR, "INVALID_ARGUMENT", "%s", what);
  return FLK_ERROR_INVALID_ARGUMENT;
}

bool within(float value, float low, float high) { return value >= low && value <= high; }  // false for NaN

const char* materialFault(const FlkMaterial& m) {
  for (float c : m.color)
    if (!within(c, 0, 1)) return "material.color must lie in [0, 1]";
  if (!within(m.opacity_root, 0, 1) || !within(m.opacity_tip, 0, 1))
    return "material.opacity_root and opacity_tip must lie in [0, 1]";
  if (!within(m.width_scale, 0, 1e6f)) return "material.width_scale must lie in [0, 1e6]";
  if (!within(m.diffuse, 0, 1e3f) || !within(m.specular_r, 0, 1e3f) || !within(m.specular_trt, 0, 1e3f))
    return "material.diffuse, specular_r and specular_trt must lie in [0, 1e3]";
  if (!within(m.exponent_r, 0, 1e6f) || !within(m.exponent_trt, 0, 1e6f))
    return "material.exponent_r and exponent_trt must lie in [0, 1e6]";
  if (!within(m.cuticle_tilt, -0.785399f, 0.785399f)) return "material.cuticle_tilt must lie in [-pi/4, pi/4]";
  if (!within(m.shadow_opacity, 0, 1)) return "material.shadow_opacity must lie in [0, 1]";
  if (!within(m.fibre_spacing, 1e-30f, 1e30f)) return "material.fibre_spacing must be positive";
  for (float c : m.tip_color)
    if (!within(c, 0, 1)) return "material.tip_color must lie in [0, 1]";
  if (!within(m.tip_blend, 0, 1)) return "material.tip_blend must lie in [0, 1]";
  return nullptr;
}

const char* hostShadowFault(const FlkHostShadow& shadow) {
  for (double v : shadow.map_from_world)
    if (!std::isfinite(v)) return "light.host_shadow->map_from_world holds a value that is not finite";
  for (float v : shadow.rect)
    if (!within(v, -1e6f, 1e6f)) return "light.host_shadow->rect must lie in [-1e6, 1e6]";
  if (!within(shadow.bias, 0, 1e6f)) return "light.host_shadow->bias must lie in [0, 1e6]";
  if (shadow.reversed > 1) return "light.host_shadow->reversed must be 0 or 1";
  if (shadow.layer > 65535) return "light.host_shadow->layer must be at most 65535";
  return nullptr;
}

const char* lightFault(const FlkLight& light) {
  if (light.kind > FLK_LIGHT_SPOT) return "light.kind is none of FLK_LIGHT_...";
  if (light.kind != FLK_LIGHT_POINT) {
    double square = 0;
    for (float c : light.direction) square += double(c) * c;
    if (!std::isfinite(square) || square <= 0) return "light.direction must be finite and not zero";
  }
  for (float c : light.radiance)
    if (!within(c, 0, 1e30f)) return "light.radiance must be finite and not negative";
  if (light.casts_shadow > 1) return "light.casts_shadow must be 0 or 1";
  if (light.shadow_size && (light.shadow_size < 64 || light.shadow_size > 8192 || light.shadow_size % 2))
    return "light.shadow_size must be even and lie in [64, 8192]";
  if (light.kind != FLK_LIGHT_DIRECTIONAL) {
    for (double c : light.position)
      if (!(std::abs(c) <= 1e15)) return "light.position must lie within 1e15 of the origin";
    if (!within(light.range, 0, 1e30f)) return "light.range must be finite and not negative";
    if (!within(light.source_radius, 0, 1e15f)) return "light.source_radius must be finite and not negative";
  }
  if (light.kind == FLK_LIGHT_SPOT &&
      !(light.inner_angle >= 0 && light.inner_angle < light.outer_angle && light.outer_angle <= 1.5708f))
    return "light.inner_angle and outer_angle must be 0 <= inner < outer <= pi / 2";
  if (light.shadow_cover > FLK_SHADOW_COVER_WIDTH) return "light.shadow_cover is none of FLK_SHADOW_COVER_...";
  if (light.visibility > 65536) return "light.visibility must be at most 65536";
  return light.host_shadow ? hostShadowFault(*light.host_shadow) : nullptr;
}

bool sampledLayout(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_GENERAL:
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL: return true;
    default: return false;
  }
}

// What cannot be drawn to or read from, as a sentence.
const char* targetFault(const FlkColorTarget& target, bool planning) {
  if (target.format != VK_FORMAT_R16G16B16A16_SFLOAT) return "target.format must be VK_FORMAT_R16G16B16A16_SFLOAT";
  if (target.samples != VK_SAMPLE_COUNT_1_BIT)
    return "target.samples must be VK_SAMPLE_COUNT_1_BIT: resolve it before hair is drawn";
  if (!planning && (!target.image || !target.view)) return "target.image and target.view must be set";
  if (!planning &&
      (target.exit.layout == VK_IMAGE_LAYOUT_UNDEFINED || target.exit.layout == VK_IMAGE_LAYOUT_PREINITIALIZED))
    return "target.exit.layout must be one that an image can be brought into";
  return nullptr;
}

const char* depthFault(const FlkDepthSource& depth, bool planning) {
  if (!depth.image && !depth.view) return nullptr;
  if (!planning && (!depth.image || !depth.view)) return "depth.image and depth.view must be set together";
  switch (depth.format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT: break;
    default: return "depth.format is no depth format";
  }
  if (depth.samples != VK_SAMPLE_COUNT_1_BIT)
    return "depth.samples must be VK_SAMPLE_COUNT_1_BIT: resolve it before hair is drawn";
  if (!sampledLayout(depth.layout)) return "depth.layout must be one in which depth can be sampled";
  return nullptr;
}

// The host's pictures of its shadows, against the lights that name them.
const char* hostLightFault(const FlkFrame& frame, bool planning) {
  bool maps = false, visibility = false;
  for (uint32_t i = 0; i < frame.light_count; ++i)
    maps |= frame.lights[i].host_shadow != nullptr, visibility |= frame.lights[i].visibility != 0;
  const struct {
    const FlkSampledImage& image;
    bool needed;
    const char *missing, *half, *layout;
  } given[] = {
      {frame.host_shadow_maps, maps, "a light has a host_shadow, but frame.host_shadow_maps.view is missing",
       "frame.host_shadow_maps.image must be set", "frame.host_shadow_maps.layout must be one that can be sampled"},
      {frame.host_visibility, visibility, "a light has visibility, but frame.host_visibility.view is missing",
       "frame.host_visibility.image must be set", "frame.host_visibility.layout must be one that can be sampled"}};
  for (const auto& g : given) {
    if (g.needed && !g.image.view && !planning) return g.missing;
    if (!g.image.view || planning) continue;
    if (!g.image.image) return g.half;
    if (!sampledLayout(g.image.layout)) return g.layout;
  }
  return nullptr;
}

const char* outputFault(const FlkFrame& frame, bool planning) {
  for (const FlkOutputImage& output : frame.outputs) {
    if (!output.view || planning) continue;
    if (!output.image) return "outputs[].image must be set with outputs[].view";
    if (output.exit.layout == VK_IMAGE_LAYOUT_UNDEFINED || output.exit.layout == VK_IMAGE_LAYOUT_PREINITIALIZED)
      return "outputs[].exit.layout must be one that an image can be brought into";
  }
  return nullptr;
}

const char* modifierFault(const FlkOpacityModifier& m) {
  if (m.kind == FLK_OPACITY_NEAR_FADE)
    return m.start >= 0 && m.end > m.start && m.end <= 1e30f && 1 / (m.end - m.start) <= 1e30f
               ? nullptr
               : "opacity modifier: a near fade needs 0 <= start < end";
  if (m.kind != FLK_OPACITY_LENS) return "opacity modifier: kind is none of FLK_OPACITY_...";
  if (!within(m.center[0], -1e6f, 1e6f) || !within(m.center[1], -1e6f, 1e6f) || !within(m.radius, 0, 1e6f))
    return "opacity modifier: a lens needs a centre and a radius within 1e6 pixels";
  if (!within(m.feather, 1e-3f, 1e6f)) return "opacity modifier: a lens needs a feather in [1e-3, 1e6]";
  return within(m.inside, 0, 1) ? nullptr : "opacity modifier: inside must lie in [0, 1]";
}

const char* previousFault(const FlkFrame& frame) {
  for (int i = 0; i < 16; ++i)
    if ((frame.previous_view_from_world && !std::isfinite(frame.previous_view_from_world[i])) ||
        (frame.previous_clip_from_view && !std::isfinite(frame.previous_clip_from_view[i])))
      return "previous_view_from_world or previous_clip_from_view holds a value that is not finite";
  return nullptr;
}

const char* frameFault(const FlkFrame& frame) {
  if (frame.type != FLK_TYPE_FRAME || frame.next) return "frame.type must be FLK_TYPE_FRAME and frame.next NULL";
  if (frame.target.width < 1 || frame.target.width > 16384 || frame.target.height < 1 || frame.target.height > 16384)
    return "target.width and target.height must lie in [1, 16384]";
  if (frame.reversed_depth > 1) return "frame.reversed_depth must be 0 or 1";
  if (frame.hair_count > forelock::kMaxHairs)
    return "frame.hair_count must be at most 63: draw the rest in another view";
  if (frame.hair_count && !frame.hairs) return "frame.hairs is NULL";
  if (frame.light_count > forelock::kMaxLights) return "frame.light_count must be at most 4096";
  if (frame.light_count && !frame.lights) return "frame.lights is NULL";
  for (uint32_t i = 0; i < frame.light_count; ++i)
    if (const char* fault = lightFault(frame.lights[i])) return fault;
  for (float c : frame.ambient)
    if (!within(c, 0, 1e30f)) return "frame.ambient must be finite and not negative";
  if (!within(frame.exposure, 0, 1e30f) || (frame.exposure != 0 && frame.exposure < 1e-30f))
    return "frame.exposure must be positive, or 0 for 1";
  if (frame.method >= std::size(forelock::kMethods)) return "frame.method is none of FLK_METHOD_...";
  if (frame.payload > FLK_PAYLOAD_PAPER) return "frame.payload is none of FLK_PAYLOAD_...";
  if (frame.display > FLK_DISPLAY_LAYERS) return "frame.display is none of FLK_DISPLAY_...";
  if (frame.k != FLK_K_NONE && frame.k > forelock::kMaxSort) return "frame.k must be at most 32, or FLK_K_NONE";
  if (frame.k_sort > forelock::kMaxSort) return "frame.k_sort must be at most 32";
  if ((frame.method == FLK_METHOD_CORE_TAIL || frame.method == FLK_METHOD_CORE_ONLY) && frame.k_sort && frame.k != FLK_K_NONE &&
      frame.k_sort < (frame.k ? frame.k : 8))
    return "frame.k_sort must not be less than k";
  if (frame.tail > FLK_TAIL_ONCE) return "frame.tail is none of FLK_TAIL_...";
  if (frame.timestamps > FLK_TIMESTAMPS_FRAME) return "frame.timestamps is none of FLK_TIMESTAMPS_...";
  if (frame.low_shade > FLK_LOW_SHADE_LOBES) return "frame.low_shade is none of FLK_LOW_SHADE_...";
  const uint32_t taps = frame.core_taps;
  if (taps != 0 && taps != 1 && taps != 4 && taps != 9 && taps != 25) return "frame.core_taps must be 1, 4, 9 or 25, or 0 for 25";
  if (frame.capture > FLK_CAPTURE_COMPUTE) return "frame.capture is none of FLK_CAPTURE_...";
  if (frame.overflow > FLK_OVERFLOW_DROP) return "frame.overflow is none of FLK_OVERFLOW_...";
  if (frame.count_only > 1 || frame.count_work > 1) return "frame.count_only and count_work must be 0 or 1";
  for (int i = 0; frame.ambient_sh && i < 27; ++i)
    if (!within(frame.ambient_sh[i], -1e30f, 1e30f)) return "frame.ambient_sh holds a value that is not finite";
  if (frame.opacity_modifier_count > FLK_MAX_OPACITY_MODIFIERS)
    return "frame.opacity_modifier_count must be at most FLK_MAX_OPACITY_MODIFIERS";
  if (frame.opacity_modifier_count && !frame.opacity_modifiers) return "frame.opacity_modifiers is NULL";
  for (uint32_t i = 0; i < frame.opacity_modifier_count; ++i)
    if (const char* fault = modifierFault(frame.opacity_modifiers[i])) return fault;
  const FlkLightTiles& tiles = frame.light_tiles;
  if (tiles.address) {
    if (tiles.address % 4) return "frame.light_tiles.address must be a multiple of 4";
    if (tiles.tile_size < 8 || tiles.tile_size > 1024) return "frame.light_tiles.tile_size must lie in [8, 1024]";
    if (uint64_t(tiles.tiles_x) * tiles.tile_size < frame.target.width ||
        uint64_t(tiles.tiles_y) * tiles.tile_size < frame.target.height || tiles.tiles_x > 2048 || tiles.tiles_y > 2048)
      return "frame.light_tiles.tiles_x and tiles_y must cover the target, and be at most 2048";
  }
  return previousFault(frame);
}

const char* followFault(const FlkFollowStrands& follow) {
  if (follow.count > 1023) return "hair desc: follow.count must be at most 1023";
  if (!within(follow.radius, 0, 1e6f)) return "hair desc: follow.radius must lie in [0, 1e6]";
  return within(follow.spread_tip, 0, 1e3f) ? nullptr : "hair desc: follow.spread_tip must lie in [0, 1e3]";
}

const char* rootImageFault(const FlkRootImage& image, const FlkStrands& strands) {
  if (!strands.root_uvs) return "hair desc: a root_image needs an asset with root UVs";
  if (!image.rgb || image.width < 1 || image.width > 16384 || image.height < 1 || image.height > 16384)
    return "hair desc: root_image needs pixels, and sides in [1, 16384]";
  return nullptr;
}

// Null, or why `matrix` places nothing.
const char* transformFault(const double* matrix, forelock::Mat4& m) {
  for (int i = 0; i < 16; ++i) {
    if (!(std::abs(matrix[i]) <= 1e15)) return "world_from_hair holds a value that is not within 1e15";
    m[i] = matrix[i];
  }
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) return "the last row of world_from_hair must be 0 0 0 1";
  const double volume = std::abs(forelock::determinant3(m));
  return volume > 0 && std::isfinite(volume) ? nullptr : "world_from_hair flattens the hair";
}

}  // namespace

void flkGetRequirements(FlkRequirements* requirements) {
  if (!requirements) return;
  *requirements = {};
  requirements->api_version = VK_API_VERSION_1_3;
  requirements->queue_flags = VK_QUEUE_COMPUTE_BIT;
  requirements->features.fragmentStoresAndAtomics = VK_TRUE;
  requirements->output_features.shaderStorageImageExtendedFormats = VK_TRUE;
  requirements->subgroup_operations = VK_SUBGROUP_FEATURE_BASIC_BIT | VK_SUBGROUP_FEATURE_BALLOT_BIT;
  requirements->subgroup_stages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
  requirements->features12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  requirements->features12.scalarBlockLayout = VK_TRUE;
  requirements->features12.bufferDeviceAddress = VK_TRUE;
  requirements->features13.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
  requirements->features13.dynamicRendering = VK_TRUE;
  requirements->features13.synchronization2 = VK_TRUE;
}

FlkResult flkContextCreate(const FlkContextDesc* desc, FlkContext* context) {
  if (!context) return FLK_ERROR_INVALID_ARGUMENT;
  *context = nullptr;
  if (!desc || desc->type != FLK_TYPE_CONTEXT || desc->next) return FLK_ERROR_INVALID_ARGUMENT;
  const Messages messages(desc->message, desc->message_user);
  if (!HostMemory::valid(desc->allocator)) return invalid(messages, "allocator needs both functions or neither");
  if (desc->device_allocator && (!desc->device_allocator->allocate || !desc->device_allocator->free))
    return invalid(messages, "device_allocator needs both functions");
  const int given = (desc->instance != nullptr) + (desc->physical_device != nullptr) + (desc->device != nullptr) +
                    (desc->get_instance_proc_addr != nullptr);
  if (given != 0 && given != 4)
    return invalid(messages,
                   "instance, physical_device, device and get_instance_proc_addr go together: all, or none for a "
                   "planning context");
  return guarded([&] {
    HostMemory memory(desc->allocator);
    Context* object = memory.create<Context>(desc->allocator);
    FlkResult result = FLK_ERROR_OUT_OF_HOST_MEMORY;
    try {
      result = object->init(*desc);
    } catch (...) {
      object->destroy();
    }
    if (result != FLK_SUCCESS) return memory.destroy(object), result;
    *context = reinterpret_cast<FlkContext>(object);
    return result;
  });
}

void flkContextDestroy(FlkContext context) {
  if (!context) return;
  Context* object = toContext(context);
  object->destroy();
  HostMemory memory = object->memory();
  memory.destroy(object);
}

void flkMaterialDefault(FlkMaterial* material) {
  if (!material) return;
  *material = {{0.22f, 0.13f, 0.07f}, 0.63f, 0.63f,  1.0f, 0.22f, 0.012f, 14.4f, 0.136f, 11.8f,
               0.174532925f,          0.35f, 1.5e-3f, {0.0f, 0.0f, 0.0f},  0.0f};
}

FlkResult flkHairCreate(FlkContext context, const FlkHairDesc* desc, FlkHair* hair) {
  if (!hair) return FLK_ERROR_INVALID_ARGUMENT;
  *hair = nullptr;
  if (!context) return FLK_ERROR_INVALID_ARGUMENT;
  Context& owner = *toContext(context);
  const Messages& messages = owner.device.messages;
  if (!desc || desc->type != FLK_TYPE_HAIR || desc->next)
    return invalid(messages, "hair desc: type must be FLK_TYPE_HAIR and next NULL");
  if (!desc->asset) return invalid(messages, "hair desc: asset is NULL");
  if (desc->flags & ~uint32_t(FLK_HAIR_KEEP_ORDER | FLK_HAIR_IGNORE_COLORS | FLK_HAIR_HOST_POSITIONS))
    return invalid(messages, "hair desc: unknown flags");
  if (const char* fault = followFault(desc->follow)) return invalid(messages, fault);
  if (desc->material)
    if (const char* fault = materialFault(*desc->material)) return invalid(messages, fault);
  FlkStrands strands{};
  const FlkResult given = flkAssetGetStrands(desc->asset, &strands);
  if (given != FLK_SUCCESS) return given;
  if (desc->root_image)
    if (const char* fault = rootImageFault(*desc->root_image, strands)) return invalid(messages, fault);
  return guarded([&] {
    Hair* object = owner.memory().create<Hair>(owner);
    FlkResult result = FLK_ERROR_OUT_OF_HOST_MEMORY;
    try {
      result = object->init(*desc, strands);
    } catch (...) {
    }
    if (result != FLK_SUCCESS) return owner.memory().destroy(object), result;
    *hair = reinterpret_cast<FlkHair>(object);
    return result;
  });
}

FlkResult flkCmdUpload(VkCommandBuffer cmd, FlkHair hair) {
  if (!cmd || !hair) return FLK_ERROR_INVALID_ARGUMENT;
  Hair& object = *toHair(hair);
  const forelock::Device& device = object.context().device;
  if (device.planning()) return invalid(device.messages, "flkCmdUpload needs a context with a device");
  if (!object.bytesStaging())
    return invalid(device.messages, "flkCmdUpload: the staging memory of this hair has been released");
  object.upload(cmd);
  return FLK_SUCCESS;
}

void flkHairReleaseStaging(FlkHair hair) {
  if (hair) toHair(hair)->releaseStaging();
}

FlkResult flkHairSetTransform(FlkHair hair, const double world_from_hair[16]) {
  if (!hair || !world_from_hair) return FLK_ERROR_INVALID_ARGUMENT;
  Hair& object = *toHair(hair);
  forelock::Mat4 m;
  if (const char* fault = transformFault(world_from_hair, m)) return invalid(object.context().device.messages, fault);
  object.world_from_hair = m;
  return FLK_SUCCESS;
}

FlkResult flkHairSetPreviousTransform(FlkHair hair, const double world_from_hair[16]) {
  if (!hair) return FLK_ERROR_INVALID_ARGUMENT;
  Hair& object = *toHair(hair);
  if (!world_from_hair) return object.moves = false, FLK_SUCCESS;
  forelock::Mat4 m;
  if (const char* fault = transformFault(world_from_hair, m)) return invalid(object.context().device.messages, fault);
  object.previous_world_from_hair = m;
  object.moves = true;
  return FLK_SUCCESS;
}

FlkResult flkHairSetPositions(FlkHair hair, const FlkHairPositions* positions) {
  if (!hair) return FLK_ERROR_INVALID_ARGUMENT;
  Hair& object = *toHair(hair);
  const Messages& messages = object.context().device.messages;
  if (!positions) return object.host_positions = false, FLK_SUCCESS;
  if (!object.takesHostPositions())
    return invalid(messages, "flkHairSetPositions: the hair was made without FLK_HAIR_HOST_POSITIONS");
  if (!positions->address || positions->address % 4)
    return invalid(messages, "positions.address must be set and a multiple of 4");
  if (positions->stride && (positions->stride < 12 || positions->stride > 4096 || positions->stride % 4))
    return invalid(messages, "positions.stride must be a multiple of 4 in [12, 4096]");
  for (int axis = 0; axis < 3; ++axis)
    if (!within(positions->min_bounds[axis], -1e6f, positions->max_bounds[axis]) || !within(positions->max_bounds[axis], -1e6f, 1e6f))
      return invalid(messages, "positions.min_bounds must not exceed max_bounds, and both lie within 1e6");
  object.moved = *positions;
  object.host_positions = true;
  return FLK_SUCCESS;
}

FlkResult flkHairSetMaterial(FlkHair hair, const FlkMaterial* material) {
  if (!hair || !material) return FLK_ERROR_INVALID_ARGUMENT;
  if (const char* fault = materialFault(*material)) return invalid(toHair(hair)->context().device.messages, fault);
  toHair(hair)->material = *material;
  return FLK_SUCCESS;
}

FlkResult flkHairGetInfo(FlkHair hair, FlkHairInfo* info) {
  if (!hair || !info) return FLK_ERROR_INVALID_ARGUMENT;
  const Hair& object = *toHair(hair);
  *info = {object.strand_count, object.vertex_count, object.segment_count, object.bytesDevice(), object.bytesStaging()};
  return FLK_SUCCESS;
}

void flkHairDestroy(FlkHair hair) {
  if (!hair) return;
  Hair* object = toHair(hair);
  object->destroy();
  object->context().memory().destroy(object);
}

FlkResult flkViewCreate(FlkContext context, const FlkViewDesc* desc, FlkView* view) {
  if (!view) return FLK_ERROR_INVALID_ARGUMENT;
  *view = nullptr;
  if (!context) return FLK_ERROR_INVALID_ARGUMENT;
  Context& owner = *toContext(context);
  const Messages& messages = owner.device.messages;
  if (!desc || desc->type != FLK_TYPE_VIEW || desc->next)
    return invalid(messages, "view desc: type must be FLK_TYPE_VIEW and next NULL");
  if (desc->frames_in_flight > forelock::kMaxFramesInFlight)
    return invalid(messages, "view desc: frames_in_flight must be at most 8");
  return guarded([&] {
    View* object = owner.memory().create<View>(owner);
    FlkResult result = FLK_ERROR_OUT_OF_HOST_MEMORY;
    try {
      result = object->init(*desc);
    } catch (...) {
    }
    if (result != FLK_SUCCESS) return owner.memory().destroy(object), result;
    *view = reinterpret_cast<FlkView>(object);
    return result;
  });
}

void flkViewDestroy(FlkView view) {
  if (!view) return;
  View* object = toView(view);
  object->destroy();
  object->context().memory().destroy(object);
}

FlkResult flkPlanFrame(FlkView view, const FlkFrame* frame, FlkPlan* plan) {
  if (!plan) return FLK_ERROR_INVALID_ARGUMENT;
  *plan = nullptr;
  if (!view || !frame) return FLK_ERROR_INVALID_ARGUMENT;
  View& object = *toView(view);
  const forelock::Device& device = object.context().device;
  if (const char* fault = frameFault(*frame)) return invalid(device.messages, fault);
  const char* image_fault = targetFault(frame->target, device.planning());
  if (!image_fault) image_fault = depthFault(frame->depth, device.planning());
  if (!image_fault) image_fault = hostLightFault(*frame, device.planning());
  if (!image_fault) image_fault = outputFault(*frame, device.planning());
  if (image_fault) {
    device.messages.say(FLK_SEVERITY_ERROR, "UNSUPPORTED_IMAGE", "%s", image_fault);
    return FLK_ERROR_UNSUPPORTED_IMAGE;
  }
  Hair* hairs[forelock::kMaxHairs];
  for (uint32_t i = 0; i < frame->hair_count; ++i) {
    hairs[i] = toHair(frame->hairs[i]);
    if (!hairs[i]) return invalid(device.messages, "frame.hairs holds a NULL");
    if (&hairs[i]->context() != &object.context())
      return invalid(device.messages, "frame.hairs holds a hair of another context");
    for (uint32_t j = 0; j < i; ++j)
      if (hairs[j] == hairs[i]) return invalid(device.messages, "frame.hairs holds a hair twice");
  }
  return guarded([&] {
    Frame* planned = nullptr;
    const FlkResult result = object.plan(*frame, hairs, planned);
    *plan = reinterpret_cast<FlkPlan>(planned);
    return result;
  });
}

void flkCmdRender(VkCommandBuffer cmd, FlkPlan plan) {
  if (!cmd || !plan || toFrame(plan)->view->context().device.planning()) return;
  toFrame(plan)->view->record(cmd, *toFrame(plan));
}

FlkResult flkPlanGetInfo(FlkPlan plan, FlkPlanInfo* info) {
  if (!plan || !info) return FLK_ERROR_INVALID_ARGUMENT;
  const Frame& frame = *toFrame(plan);
  const forelock::FramePlan& p = frame.plan;
  *info = {};
  info->pass_count = uint32_t(p.passes.count);
  info->resource_count = uint32_t(p.resources.count);
  info->omission_count = uint32_t(p.omissions.count);
  info->bytes_persistent = frame.bytes_persistent;
  info->bytes_transient = p.transientBytes();
  info->rect[0] = p.rect.x, info->rect[1] = p.rect.y, info->rect[2] = p.rect.width, info->rect[3] = p.rect.height;
  info->segment_count = p.segments;
  info->node_capacity = p.node_capacity;
  info->full_shade_taps = p.full_taps, info->low_shade_taps = p.low_taps;
  return FLK_SUCCESS;
}

FlkResult flkPlanGetPass(FlkPlan plan, uint32_t index, FlkPassInfo* info) {
  if (!plan || !info || index >= toFrame(plan)->plan.passes.count) return FLK_ERROR_INVALID_ARGUMENT;
  const forelock::Pass& pass = toFrame(plan)->plan.passes.items[index];
  static_assert(forelock::kDisplayLayers == FLK_DISPLAY_LAYERS && forelock::kPayloadDefault == FLK_PAYLOAD_DEFAULT);
  static_assert(forelock::kTailList == FLK_TAIL_LIST && forelock::kTailOnce == FLK_TAIL_ONCE && forelock::kOutputCount == FLK_OUTPUT_COUNT);
  *info = {pass.name,    forelock::stageOf(pass.id), {pass.groups[0], pass.groups[1], pass.groups[2]}, pass.indices,
           pass.segments, toFrame(plan)->hashes[index]};
  return FLK_SUCCESS;
}

FlkResult flkPlanGetResource(FlkPlan plan, uint32_t index, FlkResourceInfo* info) {
  if (!plan || !info || index >= toFrame(plan)->plan.resources.count) return FLK_ERROR_INVALID_ARGUMENT;
  const forelock::Resource& resource = toFrame(plan)->plan.resources.items[index];
  *info = {resource.name, resource.bytes, resource.transient ? 1u : 0u, resource.why};
  return FLK_SUCCESS;
}

const char* flkPlanGetOmission(FlkPlan plan, uint32_t index) {
  return plan && index < toFrame(plan)->plan.omissions.count ? toFrame(plan)->plan.omissions.items[index] : nullptr;
}

FlkResult flkViewGetStatistics(FlkView view, uint64_t completed_frame, FlkStatistics* statistics) {
  if (!view || !statistics) return FLK_ERROR_INVALID_ARGUMENT;
  return toView(view)->statistics(completed_frame, *statistics);
}

FlkResult flkViewGetShadowMap(FlkView view, uint32_t index, uint32_t face, FlkShadowMap* map) {
  if (!view || !map || index >= forelock::kMaxLights || face > 5) return FLK_ERROR_INVALID_ARGUMENT;
  return toView(view)->shadowMap(index, face, *map);
}
