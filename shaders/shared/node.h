// Fragment lists: one head a pixel of the hair's rectangle, nodes in one pool. Two nodes share 24 bytes: key (depth, payload), link,
// link, key. So a node is two aligned reads, which lie in one 32-byte sector of a cache more often than not: neither three words together
// (three reads) nor keys and links apart (two sectors) has both. Colours, where the frame has them, follow all nodes.
#ifndef FORELOCK_SHARED_NODE_H
#define FORELOCK_SHARED_NODE_H

// A link names a node and the hair it belongs to: hair slot << 26 | node index.
#define FLK_LINK_SLOT_SHIFT 26u
#define FLK_LINK_INDEX_MASK 0x03FFFFFFu
#define FLK_LINK_END 0xFFFFFFFFu
#define FLK_MAX_HAIRS 63u
#define FLK_NODE_KEY(index) ((3u * (index) + 1u) >> 1u)                   // in units of two words
#define FLK_NODE_LINK(index) (3u * (index) + 2u - 2u * ((index) & 1u))    // in words
#define FLK_COUNT_SATURATED 0xF0000000u

// Aggregate of a pixel's fragments that found the lists full, all words 0 where there are none. Optical depth tau = -log2(1 - a), at
// most FLK_TAU_MOST. Of tangents: sum of tau (2^-16), ~key of the nearest, largest depth bits, count; the key has its depth within
// the frame's hair in 12 bits, its tangent in 7 + 7 and its slot. Of colours: sum of tau (2^-16), sums of tau (2^-6) times colour
// (1/255 of the range).
#define FLK_AGGREGATE_WORDS 4u
#define FLK_TAU_MOST 12.0
#define FLK_TAU_STEPS 65536.0
#define FLK_TAU_SATURATED 0x80000000u
#define FLK_TAU_COLOR_STEPS 64.0
#define FLK_NEAREST_DEPTH_STEPS 4095.0
#define FLK_NEAREST_DEPTH_SHIFT 20
#define FLK_NEAREST_TANGENT_BITS 7
#define FLK_NEAREST_TANGENT_SHIFT 6
#define FLK_SLOT_BITS 63u

// Frames by compute: behind the heads lies a word for each tile of FLK_TILE x FLK_TILE pixels, row after row, and one for all of them: how
// much capture has drawn there, counted down from FLK_LINK_END, so that what empties the heads empties them too.
#define FLK_TILE 8u
#define FLK_LONG_TILE 2.0  // times the mean: such a tile's lists are long

// Counters: fragments that have no share's counter, then what FLK_SPEC_COUNT_WORK counts, then those of shares.
#define FLK_COUNTER_FULL 1
#define FLK_COUNTER_LOW 2
#define FLK_COUNTER_TAPS 3  // low word, high word
#define FLK_COUNTER_PIXELS 5
#define FLK_COUNTER_WORDS 6

// Shares: where drawing processors pass a cache line to each other slowly (a CPU's cores), nodes come in FLK_SHARES equal parts, the last
// with what is left over, each with a counter in a cache line of its own. A block of pixels takes from its own share until that is
// used up, then from the next, so that all nodes are found.
#define FLK_SHARES 16u
#define FLK_SHARE_BLOCK 64u // pixels a side
#define FLK_SHARE_COUNTER(share) (16u * ((share) + 1u))
#define FLK_SHARED_COUNTER_WORDS FLK_SHARE_COUNTER(FLK_SHARES)
#define FLK_SHARE_NODES(share, capacity) ((capacity) / FLK_SHARES + ((share) + 1u == FLK_SHARES ? (capacity) % FLK_SHARES : 0u))

// Specialisation constants.
#define FLK_SPEC_PAYLOAD 0   // FLK_PAYLOAD_...
#define FLK_SPEC_K 1         // fragments shaded fully
#define FLK_SPEC_K_SORT 2    // fragments sorted
#define FLK_SPEC_DISPLAY 3   // FLK_DISPLAY_...
#define FLK_SPEC_ONE_HAIR 4  // 1: the frame has one hair, and keys need no slot
#define FLK_SPEC_STORE 5     // FLK_STORE_...
#define FLK_SPEC_AGGREGATE 6 // 1: fragments that find the lists full are summed up
#define FLK_SPEC_TAIL 7      // FLK_TAIL_KIND_...
#define FLK_SPEC_LIGHTS 8    // FLK_LIGHTS_...
#define FLK_SPEC_LIGHT_KINDS 9 // bits 1 << FLK_KIND_...
#define FLK_SPEC_FACES 10    // FLK_FACES_... of hair shadow maps
#define FLK_SPEC_HOST 11     // FLK_HOST_...
#define FLK_SPEC_AMBIENT 12  // 1: ambient light depends on the tangent
#define FLK_SPEC_COLOR 13    // 1: nodes carry the fibre's colour
#define FLK_SPEC_MODIFIERS 14 // 2 bits for each modifier: its FLK_MODIFIER_...
#define FLK_SPEC_COUNT_WORK 15 // 1: shades, taps and pixels are counted
#define FLK_SPEC_COLORS_LISTED 16 // 1: the lists hold colours (output passes)
#define FLK_SPEC_TAPS 17     // shadow map reads of a full shade: 1, 4, 9, 25
#define FLK_SPEC_LOW_SHADE 18 // FLK_LOW_SHADE_...
#define FLK_SPEC_LONG_FIRST 19 // 1: tiles with long lists are resolved before the others
#define FLK_SPEC_SHARES 20   // 1: nodes come in shares (raster capture)
#define FLK_SPEC_LOCKSTEP 21 // 1: a CPU emulates lanes: they leave a loop together
#define FLK_SPEC_COUNT 22

#define FLK_CLEAR_SIDE 32u // texels of a shadow map that a group of the clear pass empties, along either axis

#define FLK_STORE_LISTS 0
#define FLK_STORE_COUNT 1        // nothing is stored
#define FLK_STORE_HARD_DEPTH 2   // the nearest depth
#define FLK_STORE_HARD_PAYLOAD 3 // what lies at that depth

#define FLK_TAIL_KIND_LIST 0
#define FLK_TAIL_KIND_MEAN 1
#define FLK_TAIL_KIND_NONE 2     // opacity only
#define FLK_TAIL_KIND_ONCE 3     // its nearest fragment's colour for all of it

// FLK_LOW_SHADE_... of render.h.
#define FLK_LOW_PLAIN 0
#define FLK_LOW_MEAN_LOBES 1
#define FLK_LOW_LOBES 2

#define FLK_LIGHTS_NONE 0
#define FLK_LIGHTS_SUN 1   // one, directional: read once a pixel
#define FLK_LIGHTS_ALL 2
#define FLK_LIGHTS_TILES 3 // those of the tile's mask

#define FLK_FACES_ORTHOGRAPHIC 1
#define FLK_FACES_PERSPECTIVE 2
#define FLK_FACES_CUBE 4

#define FLK_HOST_MAP 1
#define FLK_HOST_VISIBILITY 2

#define FLK_MODIFIER_COUNT 4
#define FLK_MODIFIER_FADE 1u
#define FLK_MODIFIER_LENS 2u

// Codings, as in render.h.
#define FLK_CODING_DEFAULT 0
#define FLK_CODING_PAPER 1

#endif
