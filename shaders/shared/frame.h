// What every pass of a frame reads: one buffer, written once a frame; bound as a uniform buffer (at most 16384 bytes, what every device
// binds) and as a storage buffer (passes/bindings.glsl).
#ifndef FORELOCK_SHARED_FRAME_H
#define FORELOCK_SHARED_FRAME_H
#include "types.h"
#include "node.h"
#ifdef __cplusplus
namespace forelock::gpu {
#endif

// Addresses (uvec2) name buffers of shared/hair.h.
struct HairConstants {
  mat4x3 view_from_hair;
  float radius_max;         // metre in view space, material's scale included
  float opacity_root;
  float opacity_tip;
  float diffuse;
  vec3 color;
  float specular_r;
  float exponent_r;
  float specular_trt;
  float exponent_trt;
  float shadow_log2;        // log2(1 - opacity of a fibre); -inf is sent as -FLT_MAX
  float fibres_per_metre;
  float cos_r, sin_r;       // of 2 x tilt
  float cos_trt, sin_trt;   // of 3 x tilt
  float mean_r, mean_trt;   // weights times the means of the lobes over all angles
  vec3 tip_color;
  float tip_blend;
  uvec2 positions, attributes, segments;
  uvec2 colors;             // 0: none
};

struct OpacityModifier {
  uint kind;                // FLK_MODIFIER_...
  vec2 center;              // lens: pixel
  float start;              // fade: metre; lens: radius
  float inverse_ramp;       // 1 / (end - start), 1 / feather
  float inside;             // lens
};

struct FrameConstants {
  vec2 proj_scale;      // P00, P11
  vec2 proj_offset;     // P20, P21 (perspective) or P30, P31 (orthographic)
  vec2 proj_depth;      // P22, P32
  float orthographic;   // 1 or 0
  float near_plane;     // metre
  vec2 size;            // pixels of the target
  vec2 pixels_per_unit; // |P00| W / 2, |P11| H / 2
  uvec4 rect;           // x, y, width, height in pixels: where heads exist
  uvec2 nodes;          // device addresses (a storage buffer binding may be limited to 128 MiB) of all nodes: shared/node.h,
  uvec2 node_colors;    // and of their fibres' colours
  uvec2 aggregates;     // device address of FLK_AGGREGATE_WORDS a pixel of the rectangle
  uint node_capacity;
  float color_range;    // of 8-bit colours: the radiance that codes as 1
  float tail_range;     // the brightest low shade, for the deterministic tail
  uint light_count;
  uvec2 lights;         // device address of LightConstants
  uvec2 faces;          // device address of FaceConstants
  uvec2 light_tiles;    // device address of the host's masks
  uint light_tile_size; // pixels
  uint light_tiles_x, light_tiles_y;
  vec2 depth_range;     // nearest and farthest hair (metre), for FLK_DISPLAY_DEPTH
  vec3 ambient;         // what does not depend on the tangent
  vec3 ambient_squares[6]; // of tangent products xx, yy, zz, xy, xz, yz
  OpacityModifier modifiers[FLK_MODIFIER_COUNT];
  HairConstants hairs[FLK_MAX_HAIRS];
};

#ifdef __cplusplus
static_assert(sizeof(HairConstants) == 172);
static_assert(sizeof(OpacityModifier) == 24);
static_assert(sizeof(FrameConstants) == 328 + FLK_MAX_HAIRS * sizeof(HairConstants));
static_assert(sizeof(FrameConstants) <= 16384, "the least that maxUniformBufferRange may be");
}  // namespace forelock::gpu
#endif
#endif
