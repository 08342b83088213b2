#include "gpu/hair.h"

#include "gpu/context.h"

#include "shared/hair.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory_resource>
#include <utility>
#include <vector>

namespace forelock {
namespace {

// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": one step of SplitMix64.
uint64_t splitMix(uint64_t& state) {
  uint64_t z = state += 0x9E3779B97F4A7C15u;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9u;
  z = (z ^ z >> 27) * 0x94D049BB133111EBu;
  return z ^ z >> 31;
}

// docs/methods.md section 7.
Vec3 followOffset(const FlkFollowStrands& follow, uint32_t guide, uint32_t number, const Vec3& rest) {
  uint64_t state = follow.seed + (uint64_t(guide) * 1024 + number) * 2 * 0x9E3779B97F4A7C15u;
  const double u1 = double(splitMix(state) >> 11) * 0x1p-53, u2 = double(splitMix(state) >> 11) * 0x1p-53;
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(rest[i]) < std::abs(rest[axis])) axis = i;
  Vec3 e{};
  e[axis] = 1;
  const Vec3 x = normalize(e - rest * dot(e, rest)), y = cross(rest, x);
  const double turn = 2 * 3.14159265358979323846 * u2, away = double(follow.radius) * std::sqrt(u1);
  return x * (away * std::cos(turn)) + y * (away * std::sin(turn));
}

Vec3 positionOf(const FlkStrands& strands, uint32_t vertex) {
  const float* p = strands.positions + std::size_t(vertex) * 3;
  return {p[0], p[1], p[2]};
}

// The first segment that has a length; an asset holds no strand without one.
Vec3 restDirection(const FlkStrands& strands, uint32_t begin, uint32_t end) {
  for (uint32_t i = begin; i + 1 < end; ++i) {
    const Vec3 d = positionOf(strands, i + 1) - positionOf(strands, begin);
    if (length(d) > 0) return normalize(d);
  }
  return {0, 1, 0};
}

// Bilinear between pixel centres, clamped at the border.
Vec3 rootColor(const FlkRootImage& image, float u, float v) {
  const auto place = [](double t, uint32_t size, uint32_t& low, uint32_t& high) {
    const double at = std::clamp(t * size - 0.5, 0.0, double(size) - 1);  // NaN: 0
    low = uint32_t(at), high = std::min(low + 1, size - 1);
    return at - low;
  };
  uint32_t x0, x1, y0, y1;
  const double fx = place(std::isfinite(u) ? u : 0, image.width, x0, x1), fy = place(std::isfinite(v) ? v : 0, image.height, y0, y1);
  Vec3 color{};
  for (int c = 0; c < 3; ++c) {
    const auto pixel = [&](uint32_t x, uint32_t y) { return double(image.rgb[(std::size_t(y) * image.width + x) * 3 + std::size_t(c)]); };
    color[c] = (pixel(x0, y0) * (1 - fx) + pixel(x1, y0) * fx) * (1 - fy) + (pixel(x0, y1) * (1 - fx) + pixel(x1, y1) * fx) * fy;
  }
  return color;
}

// As packSharedExponent of shaders/lib/packing.glsl; c in [0, 1], NaN is 0.
uint32_t packSharedExponent(const Vec3& color) {
  Vec3 c{};
  double largest = 0;
  for (int i = 0; i < 3; ++i) c[i] = color[i] > 0 ? std::min(color[i], 1.0) : 0, largest = std::max(largest, c[i]);
  if (!(largest > 3e-8)) return 0;
  int exponent = std::max(std::ilogb(largest) + 1, -15);
  if (uint32_t(std::ldexp(largest, 9 - exponent) + 0.5) == 512) ++exponent;
  uint32_t word = uint32_t(exponent + 15) << 27;
  for (int i = 0; i < 3; ++i) word |= uint32_t(std::ldexp(c[i], 9 - exponent) + 0.5) << 9 * i;
  return word;
}

}  // namespace

FlkResult Hair::init(const FlkHairDesc& desc, const FlkStrands& strands) {
  if (desc.material)
    material = *desc.material;
  else
    flkMaterialDefault(&material);
  const uint64_t copies = uint64_t(desc.follow.count) + 1;
  Device& device = context_.device;
  if (strands.vertex_count * copies > 268435456u) {
    device.messages.say(FLK_SEVERITY_ERROR, "HAIR_TOO_LARGE",
                        "%u vertices with %u follow strands each are more than 268,435,456: make fewer",
                        strands.vertex_count, desc.follow.count);
    return FLK_ERROR_LIMIT;
  }
  strand_count = uint32_t(strands.strand_count * copies);
  vertex_count = uint32_t(strands.vertex_count * copies);
  segment_count = vertex_count - strand_count;
  spread_tip = desc.follow.spread_tip;
  takes_host_positions_ = desc.flags & FLK_HAIR_HOST_POSITIONS;
  const bool colors = (strands.colors && !(desc.flags & FLK_HAIR_IGNORE_COLORS)) || desc.root_image;
  bytes_[kPositions] = uint64_t(vertex_count) * 12;
  bytes_[kAttributes] = uint64_t(vertex_count) * 4;
  bytes_[kSegments] = uint64_t(segment_count) * 4;
  bytes_[kColors] = colors ? uint64_t(vertex_count) * 4 : 0;
  bytes_[kSources] = takes_host_positions_ ? uint64_t(strand_count) * sizeof(gpu::StrandSource) : 0;
  bytes_[kMoved] = takes_host_positions_ ? bytes_[kPositions] : 0;

  for (uint32_t i = 0; i < strands.vertex_count; ++i) radius_max = std::max(radius_max, strands.radii[i]);
  follow_reach_ = desc.follow.count ? double(desc.follow.radius) * std::max(1.0, double(spread_tip)) : 0;

  const char* names[kPartCount] = {"hair positions", "hair attributes", "hair segments",
                                   "hair colours",   "strand sources",  "moved positions"};
  FlkResult result = FLK_SUCCESS;
  for (int i = 0; i < kPartCount && result == FLK_SUCCESS; ++i)
    if (bytes_[i])
      result = device.createBuffer(bytes_[i], VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, false,
                                   names[i], buffers_[i]);
  if (result == FLK_SUCCESS)
    result = device.createBuffer(bytesDevice() - bytes_[kMoved], VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true, "hair staging", staging_);
  if (result != FLK_SUCCESS) return destroy(), result;

  try {
    fill(strands, desc, static_cast<unsigned char*>(staging_.memory.mapped));
  } catch (...) {
    destroy();
    throw;
  }
  return FLK_SUCCESS;
}

// With a planning device only lengths are taken.
void Hair::fill(const FlkStrands& strands, const FlkHairDesc& desc, unsigned char* staging) {
  const bool store = staging != nullptr;
  const uint32_t copies = desc.follow.count + 1;
  unsigned char* parts[kPartCount] = {};
  for (int i = 0; store && i < kMoved; ++i) parts[i] = staging, staging += bytes_[i];
  auto* positions = reinterpret_cast<float*>(parts[kPositions]);
  auto* attributes = reinterpret_cast<uint32_t*>(parts[kAttributes]);
  auto* segments = reinterpret_cast<uint32_t*>(parts[kSegments]);
  auto* colors = bytes_[kColors] ? reinterpret_cast<uint32_t*>(parts[kColors]) : nullptr;
  auto* sources = bytes_[kSources] ? reinterpret_cast<gpu::StrandSource*>(parts[kSources]) : nullptr;
  const float* vertex_colors = desc.flags & FLK_HAIR_IGNORE_COLORS ? nullptr : strands.colors;
  std::pmr::vector<uint32_t> order(strand_count, &context_.memory());
  for (uint32_t i = 0; i < strand_count; ++i) order[i] = i;
  if (!(desc.flags & FLK_HAIR_KEEP_ORDER)) {
    uint64_t state = desc.shuffle_seed;
    for (uint32_t i = strand_count; i > 1; --i) std::swap(order[i - 1], order[splitMix(state) % i]);
  }

  uint32_t vertex = 0;
  length_ = 0;
  bounds_.min = bounds_.max = positionOf(strands, 0);
  for (const uint32_t number : order) {
    const uint32_t guide = number / copies, follow = number % copies;
    const uint32_t begin = strands.first_vertex[guide], end = strands.first_vertex[guide + 1];
    auto segmentLength = [&](uint32_t i) { return forelock::length(positionOf(strands, i + 1) - positionOf(strands, i)); };
    double strand_length = 0;
    for (uint32_t i = begin; i + 1 < end; ++i) strand_length += segmentLength(i);
    length_ += strand_length;
    const Vec3 rest = restDirection(strands, begin, end);
    const Vec3 offset = follow ? followOffset(desc.follow, guide, follow, rest) : Vec3{};
    const auto place = [&](uint32_t i, double fraction) {
      const Vec3 p = positionOf(strands, i) + offset * (1 + (double(spread_tip) - 1) * fraction);
      for (int axis = 0; axis < 3; ++axis)
        bounds_.min[axis] = std::min(bounds_.min[axis], p[axis]), bounds_.max[axis] = std::max(bounds_.max[axis], p[axis]);
      return p;
    };
    if (!store) {
      double walked = 0;
      for (uint32_t i = begin; i < end; ++i) {
        place(i, std::min(walked / strand_length, 1.0));
        if (i + 1 < end) walked += segmentLength(i);
      }
      continue;
    }
    if (sources)
      *sources++ = {vertex, begin, end - begin, {float(offset[0]), float(offset[1]), float(offset[2])},
                    {float(rest[0]), float(rest[1]), float(rest[2])}};
    const Vec3 root = desc.root_image ? rootColor(*desc.root_image, strands.root_uvs[guide * std::size_t(2)],
                                                  strands.root_uvs[guide * std::size_t(2) + 1])
                                      : Vec3{1, 1, 1};
    uint64_t hash_state = number;
    const uint32_t hash = uint32_t(splitMix(hash_state) & 0x1F);
    double walked = 0;
    for (uint32_t i = begin; i < end; ++i, ++vertex) {
      const double radius = radius_max > 0 ? std::sqrt(double(strands.radii[i]) / radius_max) : 0;
      const double fraction = std::min(walked / strand_length, 1.0);  // an asset holds no strand without length
      const uint32_t fraction_code = uint32_t(std::lround(fraction * FLK_FRACTION_STEPS));
      const Vec3 p = place(i, fraction);
      for (int axis = 0; axis < 3; ++axis) positions[std::size_t(vertex) * 3 + std::size_t(axis)] = float(p[axis]);
      attributes[vertex] = uint32_t(std::lround(radius * FLK_RADIUS_STEPS)) | fraction_code << FLK_FRACTION_SHIFT |
                           hash << FLK_HASH_SHIFT;
      if (colors) {
        Vec3 color = root;
        for (int c = 0; vertex_colors && c < 3; ++c) color[c] *= double(vertex_colors[std::size_t(i) * 3 + std::size_t(c)]);
        colors[vertex] = packSharedExponent(color);
      }
      if (i + 1 == end) continue;
      walked += segmentLength(i);
      *segments++ = vertex | (i == begin ? FLK_SEGMENT_ROOT : 0) | (i + 2 == end ? FLK_SEGMENT_TIP : 0);
    }
  }
}

uint64_t Hair::bytesDevice() const {
  uint64_t sum = 0;
  for (const uint64_t bytes : bytes_) sum += bytes;
  return sum;
}

void Hair::destroy() {
  Device& device = context_.device;
  for (Buffer& buffer : buffers_) device.destroy(buffer);
  device.destroy(staging_);
}

void Hair::upload(VkCommandBuffer cmd) {
  uploaded = true;
  const Device& device = context_.device;
  const Functions& fn = device.fn;
  uint64_t offset = 0;
  for (int i = 0; i < kMoved; ++i) {
    if (!bytes_[i]) continue;
    const VkBufferCopy region{offset, 0, bytes_[i]};
    fn.vkCmdCopyBuffer(cmd, staging_.handle, buffers_[i].handle, 1, &region);
    offset += bytes_[i];
  }
  VkMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                         (device.graphics ? VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT : VkPipelineStageFlags2(0));
  barrier.dstAccessMask = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  VkDependencyInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  fn.vkCmdPipelineBarrier2(cmd, &info);
}

void Hair::releaseStaging() { context_.device.destroy(staging_); }

HairFacts Hair::facts() const {
  HairFacts facts;
  const double scale = std::cbrt(std::abs(determinant3(world_from_hair)));
  facts.segments = segment_count;
  facts.strands = strand_count;
  facts.bounds = bounds_;
  facts.host_positions = host_positions;
  if (host_positions)
    for (int axis = 0; axis < 3; ++axis)
      facts.bounds.min[axis] = double(moved.min_bounds[axis]) - follow_reach_,
      facts.bounds.max[axis] = double(moved.max_bounds[axis]) + follow_reach_;
  facts.world_from_hair = world_from_hair;
  facts.radius = double(radius_max) * material.width_scale * scale;
  facts.length = length_ * scale;
  facts.colors = bytes_[kColors] || material.tip_blend > 0;
  return facts;
}

}  // namespace forelock
