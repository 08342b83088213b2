#include "plan/plan.h"

#include "shared/frame.h"

#include <algorithm>

namespace forelock {
namespace {

// Mean extent of a pixel across a line of random direction: (|cos| + |sin|) averaged, 4 / pi.
constexpr double kMeanPixelExtent = 1.2732395447351628;

const Method& methodOf(const FrameFacts& facts) {
  if (facts.display == kDisplayLayers) return kLayersMethod;
  return facts.display ? kDisplayMethod : kMethods[facts.method];
}

// Corners of a strand's quads lie at most this many radii (and some pixels) from it: shaders/lib/strand_quad.glsl.
constexpr double kMitreReach = 2.2360679774997898;  // sqrt(1 + 2^2)

// Area of the quads with their margins, every strand seen from the side at the nearest depth of its hair.
double estimateHair(const Camera& camera, const HairFacts& hair, double nearest) {
  const double scale = camera.pixelsPerMetre(nearest);
  return hair.length * scale * (2 * hair.radius * scale + kMeanPixelExtent);
}

}  // namespace

bool FramePlan::has(PassId id) const {
  return std::any_of(passes.begin(), passes.end(), [&](const Pass& pass) { return pass.id == id; });
}

uint64_t FramePlan::bytes(ResourceId id) const {
  for (const Resource& resource : resources)
    if (resource.id == id) return resource.bytes;
  return 0;
}

uint64_t FramePlan::transientBytes() const {
  uint64_t sum = 0;
  for (const Resource& resource : resources) sum += resource.transient ? resource.bytes : 0;
  return sum;
}

uint64_t estimateFragments(const FrameFacts& facts) {
  double sum = 0;
  for (const HairFacts& hair : facts.hairs) {
    double nearest = 0, farthest = 0;
    const Rect rect =
        screenRect(facts.camera, hair.world_from_hair, hair.bounds, kMitreReach * hair.radius, nearest, farthest);
    if (!rect.empty()) sum += estimateHair(facts.camera, hair, nearest);
  }
  return uint64_t(std::min(sum, double(kMaxNodes)));
}

FramePlan planFrame(const FrameFacts& facts, uint64_t node_capacity) {
  FramePlan plan;
  plan.method = &methodOf(facts);
  plan.display = facts.display;
  plan.payload = facts.display ? kPayloadDefault : facts.payload;
  plan.k = facts.k, plan.k_sort = facts.k_sort;

  bool first = true;
  uint64_t all_segments = 0;
  for (std::size_t i = 0; i < facts.hairs.size(); ++i) {
    const HairFacts& hair = facts.hairs[i];
    all_segments += hair.segments;
    double nearest = 0, farthest = 0;
    const Rect rect =
        screenRect(facts.camera, hair.world_from_hair, hair.bounds, kMitreReach * hair.radius, nearest, farthest);
    if (rect.empty()) continue;
    plan.visible |= uint64_t(1) << i;
    plan.rect = unite(plan.rect, rect);
    plan.segments += hair.segments;
    plan.nearest = first ? nearest : std::min(plan.nearest, nearest);
    plan.farthest = first ? farthest : std::max(plan.farthest, farthest);
    first = false;
  }
  if (plan.rect.empty()) {
    plan.omissions.add(facts.hairs.empty() ? "every pass and all memory: the frame has no hair"
                                           : "every pass and all memory: no hair is in view");
    return plan;
  }
  plan.estimate = estimateFragments(facts);
  plan.node_capacity = node_capacity;
  plan.one_hair = facts.hairs.size() == 1;
  plan.has_depth = facts.has_depth;
  plan.timestamps = facts.timestamps;

  const Method& method = *plan.method;
  if (!method.shaded) {
    plan.omissions.add("lights and shadow maps: the picture shows data, not light");
  } else if (facts.lights.empty()) {
    plan.omissions.add("the shadow pass and its map: the frame has no light");
  } else if (!facts.lights[0].casts_shadow) {
    plan.omissions.add("the shadow pass and its map: no light casts hair shadows");
  } else {
    plan.shadow_size = facts.lights[0].shadow_size;
  }
  if (!plan.has_depth) plan.omissions.add("the depth test: the frame has no depth source");
  if (!plan.timestamps) plan.omissions.add("timestamps: not asked for");

  plan.passes.add({PassId::clear, "clear", {0, 0, 0}, 0});
  if (plan.shadow_size) plan.passes.add({PassId::shadow, "shadow", {0, 0, 0}, all_segments * 6});
  plan.passes.add({PassId::capture, "capture", {0, 0, 0}, plan.segments * 6});
  // Columns of 128 bit-reversed tiles: see shaders/passes/tile_order.glsl.
  const uint64_t tiles = uint64_t((plan.rect.width + 7) / 8) * ((plan.rect.height + 7) / 8);
  plan.passes.add({PassId::resolve, "resolve", {uint32_t((tiles + 127) / 128), 128, 1}, 0});

  plan.resources.add({ResourceId::constants, "constants", sizeof(gpu::FrameConstants), true,
                      "camera, light and materials, for every pass"});
  plan.resources.add({ResourceId::heads, "heads", uint64_t(plan.rect.width) * plan.rect.height * 4, true,
                      "a list head for each pixel of the hair's rectangle"});
  plan.resources.add({ResourceId::nodes, "nodes", node_capacity * kNodeBytes, true, "12 bytes for each fragment"});
  plan.resources.add({ResourceId::counters, "counters", 16, true, "the exact fragment count"});
  plan.resources.add({ResourceId::read_back, "read-back", 16, true, "the count, for sizing the next frame's lists"});
  if (plan.shadow_size)
    plan.resources.add({ResourceId::shadow_map, "shadow map", uint64_t(plan.shadow_size) * plan.shadow_size * 4, true,
                        "depth of the hair's front towards the light"});
  return plan;
}

}  // namespace forelock
