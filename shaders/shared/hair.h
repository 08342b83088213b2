// A hair's buffers: positions (float3 a vertex), attributes (one word a vertex), segments (one word a segment).
#ifndef FORELOCK_SHARED_HAIR_H
#define FORELOCK_SHARED_HAIR_H

// Segment word: index of its first vertex, and whether it begins at the root or ends at the tip.
#define FLK_SEGMENT_VERTEX_MASK 0x3FFFFFFFu
#define FLK_SEGMENT_ROOT 0x80000000u
#define FLK_SEGMENT_TIP 0x40000000u

// Attribute word: radius = radius_max * (q / 4095)^2 in bits 0-11, arc-length fraction / 4095 in bits 12-23, a hash of the
// strand in bits 24-31 (for FLK_DISPLAY_STRAND).
#define FLK_ATTRIBUTE_STEPS 4095.0

#endif
