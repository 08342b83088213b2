#include "plan/plan.h"

#include "shared/frame.h"
#include "shared/light.h"
#include "shared/node.h"

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

uint64_t tileCount(const Rect& rect) {
  return uint64_t((rect.width + FLK_TILE - 1) / FLK_TILE) * ((rect.height + FLK_TILE - 1) / FLK_TILE);
}

// 128 strips of tiles, bit-reversed: see shaders/passes/tile_order.glsl. rounds: over all tiles.
Pass tilePass(PassId id, const char* name, const Rect& rect, uint32_t rounds = 1) {
  Pass pass{id, name};
  pass.groups[0] = uint32_t((tileCount(rect) + 127) / 128), pass.groups[1] = 128 * rounds, pass.groups[2] = 1;
  return pass;
}

Pass segmentPass(PassId id, const char* name, uint64_t segments, bool compute) {
  Pass pass{id, name};
  (compute ? pass.segments : pass.indices) = compute ? segments : segments * 6;
  return pass;
}

void planLights(const FrameFacts& facts, FramePlan& plan) {
  const Method& method = *plan.method;
  if (plan.count_only) {
    plan.omissions.add("lights, lists and the picture: the frame only counts");
    return;
  }
  if (!method.shaded) {
    plan.omissions.add("lights and shadow maps: the picture shows data, not light");
    return;
  }
  plan.ambient_sh = facts.ambient_sh;
  if (!plan.ambient_sh) plan.omissions.add("ambient light by direction: the frame has no spherical harmonics");
  plan.light_count = uint32_t(facts.lights.size());
  if (facts.lights.empty()) {
    plan.omissions.add("the shadow pass and its map: the frame has no light");
    return;
  }
  for (const LightFacts& light : facts.lights) {
    plan.light_kinds |= 1u << uint32_t(light.kind);
    plan.host_light |= (light.host_shadow ? FLK_HOST_MAP : 0) | (light.host_visibility ? FLK_HOST_VISIBILITY : 0);
  }
  plan.fault = layoutShadowMaps(facts.lights, facts.hairs, facts.image_limit, plan.shadow);
  if (!plan.hasShadow()) plan.omissions.add("the shadow pass and its map: no light casts hair shadows");
  for (const ShadowFace& face : plan.shadow.faces) {
    plan.face_kinds |= face.focal == 0 ? FLK_FACES_ORTHOGRAPHIC : face.face ? FLK_FACES_CUBE : FLK_FACES_PERSPECTIVE;
    plan.cover_width |= face.cover_width;
  }
  if (plan.hasShadow() && !plan.cover_width) plan.omissions.add("coverage by width in shadow maps: no light asks for it");
  if (!plan.host_light) plan.omissions.add("the host's shadows: no light has any");
  if (facts.light_tiles) {
    plan.light_mode = FLK_LIGHTS_TILES;
  } else if (facts.lights.size() == 1 && plan.light_kinds == 1 && !plan.host_light) {
    plan.light_mode = FLK_LIGHTS_SUN;
    plan.omissions.add("the loop over lights: there is one, and it is directional");
  } else {
    plan.light_mode = FLK_LIGHTS_ALL;
  }
}

void planPasses(const FrameFacts& facts, uint64_t all_segments, FramePlan& plan) {
  const Method& method = *plan.method;
  const uint64_t pixels = uint64_t(plan.rect.width) * plan.rect.height;
  Pass clear{PassId::clear, "clear"};
  if (plan.compute && plan.hasShadow()) {  // else the device fills the buffers
    clear.groups[0] = (plan.shadow.width + FLK_CLEAR_SIDE - 1) / FLK_CLEAR_SIDE;
    // Past a small map as well, where a large picture has more to empty: 16 pixels a lane, within what every device dispatches.
    const uint64_t groups = std::min<uint64_t>(pixels / (64 * 16) / clear.groups[0] + 1, 65535);
    clear.groups[1] = std::max((plan.shadow.height + FLK_CLEAR_SIDE - 1) / FLK_CLEAR_SIDE, uint32_t(groups));
    clear.groups[2] = 1;
  }
  plan.passes.add(clear);
  uint32_t moved = 0;
  for (std::size_t i = 0; i < facts.hairs.size(); ++i)
    if (facts.hairs[i].host_positions && (plan.visible >> i & 1 || plan.hasShadow())) ++moved;
  if (moved) plan.passes.add({PassId::prepare, "prepare"});
  else plan.omissions.add("the prepare pass: no hair takes positions from the host");
  if (plan.hasShadow())
    plan.passes.add(segmentPass(PassId::shadow, "shadow", all_segments * plan.shadow.faces.count, plan.compute));
  if (plan.count_only) {
    plan.passes.add(segmentPass(PassId::count, "count", plan.segments, plan.compute));
  } else if (!method.lists()) {
    plan.passes.add(segmentPass(PassId::hard_depth, "capture depth", plan.segments, plan.compute));
    plan.passes.add(segmentPass(PassId::hard_payload, "capture nearest", plan.segments, plan.compute));
  } else {
    plan.passes.add(segmentPass(PassId::capture, "capture", plan.segments, plan.compute));
  }
  if (!plan.count_only) {
    plan.passes.add(tilePass(PassId::resolve, "resolve", plan.rect, plan.long_first ? 2 : 1));
    static constexpr const char* kNames[kOutputCount] = {"output front depth", "output transmittance", "output velocity",
                                                         "output depth range"};
    for (uint32_t i = 0; i < kOutputCount; ++i) {
      if (!(plan.outputs >> i & 1)) continue;
      Pass pass = tilePass(PassId::output, kNames[i], plan.rect);
      pass.output = i;
      plan.passes.add(pass);
    }
    if (!plan.outputs) plan.omissions.add("output passes: no picture besides the colour is asked for");
  }

  plan.resources.add({ResourceId::constants, "constants", sizeof(gpu::FrameConstants), true,
                      "camera, light and materials, for every pass"});
  const uint64_t light_bytes = uint64_t(plan.light_count) * sizeof(gpu::LightConstants) +
                               plan.shadow.faces.count * sizeof(gpu::FaceConstants) +
                               (plan.outputs >> 2 & 1 ? facts.hairs.size() * sizeof(gpu::mat4) : 0);
  if (light_bytes)
    plan.resources.add({ResourceId::lights, "lights", light_bytes, true, "lights, the maps of those that cast shadows, motion of hairs"});
  if (!plan.count_only && method.lists()) {
    plan.resources.add({ResourceId::heads, "heads", (pixels + (plan.long_first ? tileCount(plan.rect) + 1 : 0)) * 4, true,
                        plan.long_first ? "a list head for each pixel of the hair's rectangle, a count for each 8x8 of them"
                                        : "a list head for each pixel of the hair's rectangle"});
    plan.resources.add({ResourceId::nodes, "nodes", plan.node_capacity * (plan.colors ? kColorNodeBytes : kNodeBytes), true,
                        plan.colors ? "16 bytes for each fragment, its colour included" : "12 bytes for each fragment"});
  } else if (!plan.count_only) {
    plan.resources.add({ResourceId::heads, "nearest fragments", pixels * (plan.colors ? 12 : 8), true,
                        "depth and what lies there, for each pixel of the hair's rectangle"});
    plan.omissions.add("lists of fragments: strands are opaque");
  }
  if (plan.aggregate)
    plan.resources.add({ResourceId::aggregates, "aggregates", pixels * FLK_AGGREGATE_WORDS * 4, true,
                        "16 bytes a pixel for fragments that find the lists full"});
  const uint64_t counter_bytes = (facts.cpu ? FLK_SHARED_COUNTER_WORDS : FLK_COUNTER_WORDS) * 4;
  plan.resources.add({ResourceId::counters, "counters", counter_bytes, true, "the exact fragment count"});
  plan.resources.add({ResourceId::read_back, "read-back", uint64_t(facts.frames_in_flight) * counter_bytes, true,
                      "the count of each frame in flight, for sizing the next frame's lists"});
  if (plan.hasShadow())
    plan.resources.add({ResourceId::shadow_map, "shadow map", uint64_t(plan.shadow.width) * plan.shadow.height * 4, true,
                        "depth of the hair's front towards each light that casts shadows"});
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

uint64_t nodeBytes(const FrameFacts& facts) {
  if (methodOf(facts).capture != CaptureKind::tangent || facts.display) return kNodeBytes;
  double nearest = 0, farthest = 0;
  for (const HairFacts& hair : facts.hairs)
    if (hair.colors &&
        !screenRect(facts.camera, hair.world_from_hair, hair.bounds, kMitreReach * hair.radius, nearest, farthest).empty())
      return kColorNodeBytes;
  return kNodeBytes;
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
    plan.fibre_colors |= hair.colors;
    first = false;
  }
  if (plan.rect.empty()) {
    plan.omissions.add(facts.hairs.empty() ? "every pass and all memory: the frame has no hair"
                                           : "every pass and all memory: no hair is in view");
    return plan;
  }
  const Method& method = *plan.method;
  plan.estimate = estimateFragments(facts);
  plan.one_hair = facts.hairs.size() == 1;
  plan.has_depth = facts.has_depth;
  plan.timestamps = facts.timestamps;
  plan.compute = facts.compute;
  plan.node_shares = facts.cpu && !facts.compute;
  plan.lockstep = facts.cpu;
  plan.count_only = facts.count_only;
  plan.count_work = facts.count_work && method.shaded && !facts.count_only;
  plan.fibre_colors = plan.fibre_colors && method.shaded && !plan.count_only;
  plan.colors = plan.fibre_colors && method.capture != CaptureKind::color;
  const bool lists = method.lists() && !plan.count_only;
  plan.node_capacity = lists ? node_capacity : 0;
  plan.long_first = lists && plan.compute;  // wherever capture.comp stores lists, it counts tiles
  plan.aggregate = lists && !facts.drop_overflow;
  plan.modifiers = facts.modifiers;
  plan.outputs = plan.count_only ? 0 : facts.outputs;
  switch (method.tail) {
    case TailKind::none: break;
    case TailKind::list: plan.tail = FLK_TAIL_KIND_LIST; break;
    case TailKind::opacity: plan.tail = FLK_TAIL_KIND_NONE; break;
    case TailKind::choice: plan.tail = facts.tail == kTailList ? FLK_TAIL_KIND_LIST : facts.tail == kTailOnce ? FLK_TAIL_KIND_ONCE : FLK_TAIL_KIND_MEAN; break;
  }

  planLights(facts, plan);
  if (plan.hasShadow()) plan.full_taps = method.full_taps ? facts.core_taps : 0, plan.low_taps = method.low_taps;
  if (method.low_taps) plan.low_shade = facts.low_shade;
  if (plan.fault) return plan;
  if (!plan.has_depth) plan.omissions.add("the depth test: the frame has no depth source");
  if (!plan.timestamps) plan.omissions.add("timestamps: not asked for");
  if (!plan.fibre_colors) plan.omissions.add("a fragment's own colour: no hair in view has colours that vary");
  if (!plan.modifiers) plan.omissions.add("opacity modifiers: the frame has none");
  if (lists && !plan.aggregate) plan.omissions.add("aggregates: fragments that find the lists full may be dropped");
  planPasses(facts, all_segments, plan);
  return plan;
}

}  // namespace forelock
