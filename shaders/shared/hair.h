// A hair's buffers, reached by address: positions (float3 a vertex), attributes (one word a vertex), segments (one word a segment),
// colours (one word a vertex, where it has any), and with host positions one StrandSource a strand.
#ifndef FORELOCK_SHARED_HAIR_H
#define FORELOCK_SHARED_HAIR_H
#include "types.h"

// Segment word: index of its first vertex, and whether it begins at the root or ends at the tip.
#define FLK_SEGMENT_VERTEX_MASK 0x3FFFFFFFu
#define FLK_SEGMENT_ROOT 0x80000000u
#define FLK_SEGMENT_TIP 0x40000000u

// Attribute word: radius = radius_max * (q / 2047)^2 in bits 0-10, arc-length fraction / 65535 in bits 11-26, a hash of the
// strand in bits 27-31 (for FLK_DISPLAY_STRAND).
#define FLK_RADIUS_STEPS 2047.0
#define FLK_FRACTION_STEPS 65535.0
#define FLK_FRACTION_SHIFT 11
#define FLK_HASH_SHIFT 27

#ifdef __cplusplus
namespace forelock::gpu {
#endif
// Where a strand's vertices come from when the host moves them.
struct StrandSource {
  uint vertex;       // of this hair
  uint guide_vertex; // of the host's positions
  uint count;
  vec3 offset;       // of a follow strand at its root, at rest
  vec3 rest;         // unit direction of the guide's first segment at rest
};
#ifdef __cplusplus
static_assert(sizeof(StrandSource) == 36);
}  // namespace forelock::gpu
#endif
#endif
