// Lights and the faces of their shadow maps, as arrays reached by address. docs/methods.md sections 4 and 5.
#ifndef FORELOCK_SHARED_LIGHT_H
#define FORELOCK_SHARED_LIGHT_H
#include "types.h"
#ifdef __cplusplus
namespace forelock::gpu {
#endif

#define FLK_KIND_DIRECTIONAL 0u
#define FLK_KIND_POINT 1u
#define FLK_KIND_SPOT 2u
#define FLK_NO_LAYER 0xFFFFFFFFu

struct LightConstants {
  vec3 place;             // view space: unit vector to the light (directional), its position (others)
  uint kind;
  vec3 radiance;
  float inverse_range;    // 0: no end
  vec3 axis;              // spot: unit, from the light, view space
  float cos_outer;
  float inverse_cone;     // 1 / (cos inner - cos outer)
  float source_radius_squared;
  uint first_face;        // of its hair shadow maps
  uint face_count;        // 0: hair casts no shadow
  mat4 host_from_view;    // x, y texel, z value, w divisor
  vec4 host_rect;         // texels: least x, y, greatest x, y
  uint host_layer;        // FLK_NO_LAYER: none
  float host_bias;        // negative in a reversed map
  float host_sign;        // 1; -1 in a reversed map: sign * z <= sign * value + |bias|
  uint visibility_layer;  // FLK_NO_LAYER: none
};

#define FLK_FACE_BY_WIDTH 0x80000000u // added to the index of a map that strands cover by their width

// A hair shadow map: a rectangle of the atlas.
struct FaceConstants {
  mat4x3 map_from_view;   // orthographic: x, y in texels from the map's middle, z in metre from its front; perspective: metre, z along the axis
  float focal;            // perspective: texels at z 1; 0: orthographic
  float texel;            // metre; perspective: at z 1
  float range;            // metre of a full depth value
  float near;             // perspective: metre
  uvec2 offset;           // of the rectangle (texel)
  uint size;              // a side
};

#ifdef __cplusplus
static_assert(sizeof(LightConstants) == 160);
static_assert(sizeof(FaceConstants) == 76);
}  // namespace forelock::gpu
#endif
#endif
