// Walking a pixel's list, and the aggregate of what it had no room for. Included after bindings.glsl with FLK_BIND_LISTS.
#ifndef FORELOCK_PASSES_LIST
#define FORELOCK_PASSES_LIST
#include "../lib/order.glsl"
#include "../lib/packing.glsl"

layout(constant_id = FLK_SPEC_PAYLOAD) const int kPayload = 0;
layout(constant_id = FLK_SPEC_ONE_HAIR) const bool kOneHair = false;
layout(constant_id = FLK_SPEC_AGGREGATE) const bool kAggregate = false;
layout(constant_id = FLK_SPEC_COLOR) const bool kColor = false;

// The fragment that a link names; link becomes the next.
Key readNode(inout uint link) {
  uint index = link & FLK_LINK_INDEX_MASK, slot = link >> FLK_LINK_SLOT_SHIFT;
  link = NodeWords(frame.nodes).at[FLK_NODE_LINK(index)];
  uvec2 held = NodeKeys(frame.nodes).at[FLK_NODE_KEY(index)];
  return Key(held.x, held.y, kOneHair ? 0u : slot, kColor ? NodeWords(frame.node_colors).at[index] : 0u);
}

// What the lists had no room for, as one fragment.
struct Aggregate {
  float tau;         // 0: nothing
  float least, greatest;  // depths (metre)
  uint slot;         // of the nearest
  vec3 tangent;      // of the nearest
  float count;
  vec3 color;        // in lists of colours
};

bool hasAggregate(uint pixel) { return kAggregate && AggregatePool(frame.aggregates).words[pixel * FLK_AGGREGATE_WORDS] != 0u; }

Aggregate readAggregate(uint pixel, bool colors) {
  Aggregate a = Aggregate(0.0, 0.0, 0.0, 0u, vec3(0.0), 1.0, vec3(0.0));
  if (!kAggregate) return a;
  AggregatePool pool = AggregatePool(frame.aggregates);
  uint base = pixel * FLK_AGGREGATE_WORDS;
  a.tau = float(pool.words[base]) / FLK_TAU_STEPS;
  if (!(a.tau > 0.0)) return a;
  if (colors) {
    vec3 sums = vec3(pool.words[base + 1u], pool.words[base + 2u], pool.words[base + 3u]);
    a.color = min(sums / (255.0 * FLK_TAU_COLOR_STEPS * a.tau), vec3(1.0)) * frame.color_range;
  } else {
    uint key = ~pool.words[base + 1u];
    a.slot = min(key & FLK_SLOT_BITS, FLK_MAX_HAIRS - 1u);
    a.tangent = octDecode(key >> FLK_NEAREST_TANGENT_SHIFT, FLK_NEAREST_TANGENT_BITS);
    a.greatest = uintBitsToFloat(pool.words[base + 2u]);
    a.count = max(float(pool.words[base + 3u]), 1.0);
    a.least = min(mix(frame.depth_range.x, frame.depth_range.y, float(key >> FLK_NEAREST_DEPTH_SHIFT) / FLK_NEAREST_DEPTH_STEPS), a.greatest);
  }
  return a;
}

// What of an aggregate is not yet blended: its nearest fragment, which is given an even share of the optical depth, and the rest,
// spread evenly between its least and greatest depth, so that the fragments of the list find their place in it.
struct Slab {
  float nearest_tau;  // 0: blended
  vec3 nearest_color;
  float tau, done;    // done: the share of the rest that lies before the depths passed so far
  vec3 color;
};

Slab slabOf(Aggregate a) {
  float nearest = a.tau / a.count;
  return Slab(nearest, a.color, a.tau - nearest, 0.0, a.color);
}

// The slab up to `depth` over what lies behind: adds to color_sum, takes from transmittance.
void passSlab(inout Slab slab, Aggregate a, float depth, inout vec3 color_sum, inout float transmittance) {
  if (depth >= a.least) {
    float nearest = exp2(-min(slab.nearest_tau, 126.0));
    color_sum += transmittance * (1.0 - nearest) * slab.nearest_color;
    transmittance *= nearest;
    slab.nearest_tau = 0.0;
  }
  float share = a.greatest > a.least ? clamp((depth - a.least) / (a.greatest - a.least), slab.done, 1.0) : depth > a.least ? 1.0 : slab.done;
  float through = exp2(-min(slab.tau * (share - slab.done), 126.0));
  color_sum += transmittance * (1.0 - through) * slab.color;
  transmittance *= through;
  slab.done = share;
}

#endif
