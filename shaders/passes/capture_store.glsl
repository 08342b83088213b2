// One fragment into the list of its pixel (Yang et al. 2010). Included by capture passes after bindings.glsl.
#ifndef FORELOCK_PASSES_CAPTURE_STORE
#define FORELOCK_PASSES_CAPTURE_STORE

bool behindHostDepth(float depth) {
#ifdef FLK_BIND_DEPTH
  return depth > linearDepth(texelFetch(host_depth, ivec2(gl_FragCoord.xy), 0).r, frame.proj_depth, frame.orthographic);
#else
  return false;
#endif
}

// The head changes only when the node has been stored: a full pool loses the new fragment and no other.
void storeFragment(float depth, uint payload) {
  uint index = atomicAdd(fragment_count, 1u);
  // Held far below 2^32: a count that wrapped would hand out nodes twice.
  if (index >= FLK_COUNT_SATURATED) atomicExchange(fragment_count, FLK_COUNT_SATURATED);
  if (index >= frame.node_capacity) return;
  uvec2 pixel = uvec2(gl_FragCoord.xy) - frame.rect.xy;  // the scissor keeps it inside
  uint previous = atomicExchange(heads[pixel.y * frame.rect.z + pixel.x], hair_slot << FLK_LINK_SLOT_SHIFT | index);
  NodePool nodes = NodePool(frame.node_pool);
  uint base = index * FLK_NODE_WORDS;
  nodes.words[base] = floatBitsToUint(depth);
  nodes.words[base + 1u] = payload;
  nodes.words[base + 2u] = previous;
}

#endif
