// Descriptor interface of all passes. Set 0 belongs to the view, set 1 to a hair. A pass defines FLK_BIND_... for what it reads.
#ifndef FORELOCK_PASSES_BINDINGS
#define FORELOCK_PASSES_BINDINGS
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "../shared/frame.h"
#include "../shared/hair.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { FrameConstants frame; };
#ifdef FLK_BIND_LISTS
layout(set = 0, binding = 1, scalar) buffer HeadBuffer { uint heads[]; };
layout(set = 0, binding = 2, scalar) buffer CounterBuffer { uint fragment_count; uint unused_counters[3]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer NodePool { uint words[]; };
#endif
#ifdef FLK_BIND_DEPTH
layout(set = 0, binding = 3) uniform texture2D host_depth;
#endif
#ifdef FLK_BIND_SHADOW
layout(set = 0, binding = 4) uniform texture2D shadow_map;
#endif
#ifdef FLK_BIND_TARGET
layout(set = 0, binding = 5, rgba16f) uniform image2D target;
#endif
#ifdef FLK_BIND_HAIR
layout(set = 1, binding = 0, scalar) readonly buffer PositionBuffer { vec3 positions[]; };
layout(set = 1, binding = 1, scalar) readonly buffer AttributeBuffer { uint attributes[]; };
layout(set = 1, binding = 2, scalar) readonly buffer SegmentBuffer { uint segments[]; };
layout(push_constant) uniform PushConstants { uint hair_slot; };
#endif

#endif
