// Descriptor interface of all passes: one set, the view's; what grows with the scene is reached by address, because a storage
// buffer binding may be limited to 128 MiB. A pass defines FLK_BIND_... for what it reads.
#ifndef FORELOCK_PASSES_BINDINGS
#define FORELOCK_PASSES_BINDINGS
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "../shared/frame.h"
#include "../shared/hair.h"
#include "../shared/light.h"

// A uniform buffer: capture and shadow passes need a quarter fewer registers with it. With FLK_FRAME_STORED the same as a storage buffer, for
// loops that read it all the time and have registers for it (docs/results.md).
#ifdef FLK_FRAME_STORED
layout(set = 0, binding = 9, scalar) readonly buffer FrameBuffer { FrameConstants frame; };
#else
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { FrameConstants frame; };
#endif
#ifdef FLK_BIND_LISTS
// Heads; for FLK_METHOD_HARD depths, payloads and (with colours) colours of the nearest fragments, plane after plane.
layout(set = 0, binding = 1, scalar) buffer HeadBuffer { uint heads[]; };
layout(set = 0, binding = 2, scalar) buffer CounterBuffer { uint counters[]; };
layout(buffer_reference, std430, buffer_reference_align = 8) buffer NodeKeys { uvec2 at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer NodeWords { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer AggregatePool { uint words[]; };
#endif
#ifdef FLK_BIND_DEPTH
layout(set = 0, binding = 3) uniform texture2D host_depth;
#endif
#ifdef FLK_BIND_SHADOW
layout(set = 0, binding = 4) uniform sampler2D shadow_map;  // nearest, clamped to the edge
#endif
#ifdef FLK_BIND_TARGET
layout(set = 0, binding = 5, rgba16f) uniform image2D target;
#endif
#ifdef FLK_BIND_HOST_LIGHT
layout(set = 0, binding = 6) uniform texture2DArray host_shadow_maps;
layout(set = 0, binding = 7) uniform texture2DArray host_visibility;
#endif
#ifdef FLK_BIND_SHADOW_STORE
layout(set = 0, binding = 8, r32ui) uniform uimage2D shadow_store;
#endif

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightList { LightConstants at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FaceList { FaceConstants at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer WordList { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PositionList { vec3 at[]; };

#ifdef FLK_BIND_HAIR
layout(push_constant, scalar) uniform PushConstants {
  uint hair_slot;
  uint segment_count;     // of a dispatch, from `first_segment`
  uint first_segment;
  uint face;              // of a shadow pass; with FLK_COVER_WIDTH perhaps and FLK_FACE_BY_WIDTH
  mat4x3 map_from_hair;   // of a shadow pass
};
#endif

#endif
