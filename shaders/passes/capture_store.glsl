// Where captured fragments go. Included by capture passes after bindings.glsl.
#ifndef FORELOCK_PASSES_CAPTURE_STORE
#define FORELOCK_PASSES_CAPTURE_STORE
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(constant_id = FLK_SPEC_STORE) const int kStore = FLK_STORE_LISTS;
layout(constant_id = FLK_SPEC_AGGREGATE) const bool kAggregate = false;
layout(constant_id = FLK_SPEC_SHARES) const bool kShares = false;

bool behindHostDepth(uvec2 pixel, float depth) {
#ifdef FLK_BIND_DEPTH
  return depth > linearDepth(texelFetch(host_depth, ivec2(pixel), 0).r, frame.proj_depth, frame.orthographic);
#else
  return false;
#endif
}

// The first of `count` numbers, which no other fragment has.
uint countFragments(uint count) {
  uint base = atomicAdd(counters[0], count);
  // Held far below 2^32: a count that wrapped would hand out nodes twice.
  if (base >= FLK_COUNT_SATURATED) atomicExchange(counters[0], FLK_COUNT_SATURATED);
  return base;
}

// A number of its own for every fragment: one atomic for all lanes that are here together.
uint countFragment() {
  uvec4 here = subgroupBallot(true);
  uint base = 0u;
  if (subgroupElect()) base = countFragments(subgroupBallotBitCount(here));
  return subgroupBroadcastFirst(base) + subgroupBallotExclusiveBitCount(here);
}

uint shareNodes(uint share) {
  return kStore == FLK_STORE_LISTS ? FLK_SHARE_NODES(share, frame.node_capacity) : FLK_COUNT_SATURATED;
}

// The share that a pixel's fragments take from while it lasts: of blocks that are drawn at the same time, which are neighbours, another.
uint shareOf(uvec2 pixel) {
  uvec2 block = pixel / FLK_SHARE_BLOCK;
  return (block.x + 5u * block.y) % FLK_SHARES;
}

// A number of its own for every fragment, from its block's share or else from the next that is not used up. Those are only read: a cache
// line that nobody writes any more costs nothing. One that finds no node has a number past them all, and counters[0] counts it.
uint countInShares(uvec2 pixel) {
  uint home = shareOf(pixel), tried = 0u, share = home;
  uint number = atomicAdd(counters[FLK_SHARE_COUNTER(share)], 1u);
  while (number >= shareNodes(share) && tried < FLK_SHARES) {
    ++tried;
    share = (home + tried) % FLK_SHARES;
    uint at = tried == FLK_SHARES ? 0u : FLK_SHARE_COUNTER(share);
    number = 0xFFFFFFFFu;
    if (tried == FLK_SHARES || counters[at] < shareNodes(share)) number = atomicAdd(counters[at], 1u);
  }
  return tried == FLK_SHARES ? 0xFFFFFFFFu : share * (frame.node_capacity / FLK_SHARES) + number;
}

// cuts: of a quad, through `pixel` of the target, which may lie beside the rectangle.
void countTile(vec2 pixel, uint cuts) {
  uvec2 size = frame.rect.zw, tiles = (size + FLK_TILE - 1u) / FLK_TILE;
  uvec2 tile = min(uvec2(clamp(pixel - vec2(frame.rect.xy), vec2(0.0), vec2(size - 1u))) / FLK_TILE, tiles - 1u);  // also of NaN
  atomicAdd(heads[size.x * size.y + tile.y * tiles.x + tile.x], ~cuts + 1u);
}

void countTiles(uint cuts) {
  uvec2 size = frame.rect.zw, tiles = (size + FLK_TILE - 1u) / FLK_TILE;
  atomicAdd(heads[size.x * size.y + tiles.x * tiles.y], ~cuts + 1u);
}

uint pixelIndex(uvec2 pixel) {
  uvec2 p = pixel - frame.rect.xy;
  return p.y * frame.rect.z + p.x;
}

// docs/methods.md section 6, "Overflow". What is held is never wrapped: an optical depth beyond 32768 lets nothing through.
void aggregateFragment(uint index, float depth, uint payload, float alpha, vec3 color) {
  AggregatePool pool = AggregatePool(frame.aggregates);
  uint base = index * FLK_AGGREGATE_WORDS;
  float tau = min(-log2(max(1.0 - alpha, 1.0 / 8192.0)), FLK_TAU_MOST);
  if (pool.words[base] >= FLK_TAU_SATURATED) return;
#ifdef FLK_CAPTURE_COLORS
  uvec3 weighted = uvec3(tau * FLK_TAU_COLOR_STEPS * clamp(color / frame.color_range, 0.0, 1.0) * 255.0 + 0.5);
  atomicAdd(pool.words[base + 1u], weighted.x);
  atomicAdd(pool.words[base + 2u], weighted.y);
  atomicAdd(pool.words[base + 3u], weighted.z);
#else
  vec3 tangent;
  float coded;
  unpackTangent(payload, kPayload, tangent, coded);
  float within = (depth - frame.depth_range.x) / max(frame.depth_range.y - frame.depth_range.x, 1e-30);
  uint key = uint(clamp(within, 0.0, 1.0) * FLK_NEAREST_DEPTH_STEPS) << FLK_NEAREST_DEPTH_SHIFT |
             octEncode(tangent, FLK_NEAREST_TANGENT_BITS) << FLK_NEAREST_TANGENT_SHIFT | hair_slot;
  atomicMax(pool.words[base + 1u], ~key);
  atomicMax(pool.words[base + 2u], floatBitsToUint(depth));
  atomicAdd(pool.words[base + 3u], 1u);
#endif
  atomicAdd(pool.words[base], max(uint(tau * FLK_TAU_STEPS + 0.5), 1u));  // the faintest is there too
}

// Lists of colours have the fibre's colour in them already.
#ifdef FLK_CAPTURE_COLORS
const bool kColorWord = false;
#else
const bool kColorWord = kColor;
#endif

// One fragment into the list of its pixel (Yang et al. 2010), in two steps, so that a lane may have many exchanges under way. The head
// changes only where there is a node to name: full lists keep what they hold. index: a number of its own for every fragment.
uint linkFragment(uvec2 pixel, uint index) {
  if (index >= frame.node_capacity) return FLK_LINK_END;
  return atomicExchange(heads[pixelIndex(pixel)], hair_slot << FLK_LINK_SLOT_SHIFT | index);
}

// link: of linkFragment().
void storeFragment(uvec2 pixel, float depth, uint index, uint link, uint payload, uint fibre_color, float alpha, vec3 color) {
  if (index >= frame.node_capacity) {
    if (kAggregate) aggregateFragment(pixelIndex(pixel), depth, payload, alpha, color);
    return;
  }
  NodeKeys(frame.nodes).at[FLK_NODE_KEY(index)] = uvec2(floatBitsToUint(depth), payload);
  if (kColorWord) NodeWords(frame.node_colors).at[index] = fibre_color;
  NodeWords(frame.nodes).at[FLK_NODE_LINK(index)] = link;
}

// FLK_METHOD_HARD, in two passes over the strands: the least depth of a pixel, then the least key at that depth. No order of
// arrival shows.
void storeHard(uvec2 pixel, float depth, uint key, uint fibre_color) {
  uint at = pixelIndex(pixel), plane = frame.rect.z * frame.rect.w, bits = floatBitsToUint(depth);
  if (kStore == FLK_STORE_HARD_DEPTH) {
    countFragment();
    atomicMin(heads[at], bits);
  } else if (heads[at] == bits) {
    atomicMin(heads[plane + at], key);
    if (kColor) atomicMin(heads[2u * plane + at], fibre_color);
  }
}

#endif
