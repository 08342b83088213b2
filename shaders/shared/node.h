// Fragment lists: one head a pixel of the hair's rectangle, nodes of three words in one pool.
#ifndef FORELOCK_SHARED_NODE_H
#define FORELOCK_SHARED_NODE_H

// A link names a node and the hair it belongs to: hair slot << 26 | node index.
#define FLK_NODE_WORDS 3u
#define FLK_LINK_SLOT_SHIFT 26u
#define FLK_LINK_INDEX_MASK 0x03FFFFFFu
#define FLK_LINK_END 0xFFFFFFFFu
#define FLK_MAX_HAIRS 63u
#define FLK_COUNT_SATURATED 0xF0000000u

// Specialisation constants.
#define FLK_SPEC_PAYLOAD 0  // FLK_PAYLOAD_...
#define FLK_SPEC_K 1        // fragments shaded fully
#define FLK_SPEC_K_SORT 2   // fragments sorted
#define FLK_SPEC_DISPLAY 3  // FLK_DISPLAY_...
#define FLK_SPEC_ONE_HAIR 4 // 1: the frame has one hair, and keys need no slot
#define FLK_SPEC_COUNT 5

// Codings, as in render.h.
#define FLK_CODING_DEFAULT 0
#define FLK_CODING_PAPER 1

#endif
