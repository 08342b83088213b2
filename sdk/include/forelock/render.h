/* Forelock: hair into the host's command buffers, Vulkan 1.3. SPDX-License-Identifier: MIT
 *
 *   once         flkGetRequirements -> create the VkDevice -> flkContextCreate -> flkViewCreate
 *   per asset    flkHairCreate -> flkCmdUpload
 *   per frame    flkPlanFrame (CPU; may allocate and compile) -> flkCmdRender (records; cannot fail) -> the host submits
 *   afterwards   flkViewGetStatistics, once the host knows that the frame has completed
 *
 * The host owns instance, device, queues, command buffers, images and synchronisation. Forelock never submits, never
 * waits, never creates a queue, and reaches Vulkan only through the host's vkGetInstanceProcAddr.
 * Threads: calls on one context must not overlap, except that flkCmdUpload and flkCmdRender of different views may run
 * at the same time as each other. Two contexts share nothing. Lifetimes: asset -> hair (copied), context > hairs and views.
 * Axes, matrices, depth and colour: docs/conventions.md. Methods and their sources: docs/methods.md.
 */
#ifndef FORELOCK_RENDER_H
#define FORELOCK_RENDER_H

#include "asset.h"

#include <vulkan/vulkan.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct FlkContext_T* FlkContext; /* one per VkDevice */
typedef struct FlkHair_T* FlkHair;       /* an asset on the GPU, with material and transform */
typedef struct FlkView_T* FlkView;       /* what belongs to one render target: lists, shadow maps, statistics */
typedef struct FlkPlan_T* FlkPlan;       /* what one frame of one view needs; made and owned by the view */

/* ---- Device ------------------------------------------------------------------------------------------------------- */

/* What a device must offer and have enabled. Strings and arrays are static. */
typedef struct FlkRequirements {
  uint32_t api_version;                       /* least Vulkan version of instance and device: 1.3 */
  VkQueueFlags queue_flags;                   /* of the queue family that flkCmdRender's command buffers go to: COMPUTE;
                                                 GRAPHICS too for FLK_CAPTURE_RASTER */
  VkPhysicalDeviceFeatures features;          /* to enable: fragmentStoresAndAtomics */
  VkPhysicalDeviceFeatures output_features;   /* to enable as well for FlkFrame.outputs: shaderStorageImageExtendedFormats */
  VkSubgroupFeatureFlags subgroup_operations; /* BASIC and BALLOT, in the stages */
  VkShaderStageFlags subgroup_stages;         /* COMPUTE, and FRAGMENT for FLK_CAPTURE_RASTER */
  VkPhysicalDeviceVulkan12Features features12;/* to enable: scalarBlockLayout, bufferDeviceAddress (sType set,
                                                 pNext NULL) */
  VkPhysicalDeviceVulkan13Features features13;/* to enable: dynamicRendering, synchronization2 (likewise) */
  uint32_t device_extension_count;            /* 0 */
  const char* const* device_extensions;
} FlkRequirements;

/* Needs no device. Any thread. */
FLK_API void flkGetRequirements(FlkRequirements* requirements);

/* Optional: device memory from the host. `allocate` gives memory for one resource (bind offset included), `free` takes it
 * back when no frame in flight uses it; its VkDeviceMemory is made with VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT.
 * Without it Forelock allocates with vkAllocateMemory, one allocation a resource: about eight a view and five a hair. */
typedef struct FlkDeviceAllocation {
  VkDeviceMemory memory;
  VkDeviceSize offset;
  void* mapped;      /* host address of `offset` where the memory was asked for as host visible, else NULL */
  void* user;        /* the host's, handed back to `free` */
} FlkDeviceAllocation;
typedef struct FlkDeviceAllocator {
  void* user;
  VkResult (*allocate)(void* user, const VkMemoryRequirements* requirements, VkMemoryPropertyFlags properties,
                       const char* name, FlkDeviceAllocation* allocation);
  void (*free)(void* user, const FlkDeviceAllocation* allocation);
} FlkDeviceAllocator;

typedef struct FlkContextDesc {
  uint32_t type;    /* FLK_TYPE_CONTEXT */
  const void* next; /* NULL */
  /* All five, or none: without a device the context is for planning. Hairs, views and plans then hold counts and bytes
   * but no memory, and flkCmd... must not be called. */
  VkInstance instance;
  VkPhysicalDevice physical_device;
  VkDevice device;
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  uint32_t queue_family;                      /* of the command buffers given to flkCmd... */
  VkPipelineCache pipeline_cache;             /* optional, the host's */
  const FlkHostAllocator* allocator;          /* optional, copied */
  const FlkDeviceAllocator* device_allocator; /* optional, copied */
  FlkMessageFunction message;                 /* optional: why a call failed, and warnings */
  void* message_user;
} FlkContextDesc;

/* Cost: loads functions, checks the device, makes layouts and 192 KiB of index memory; no pipeline. FLK_ERROR_UNSUPPORTED_DEVICE: the message names
 * what is missing. (Whether a feature was *enabled* cannot be asked of Vulkan: validation layers tell.) */
FLK_API FlkResult flkContextCreate(const FlkContextDesc* desc, FlkContext* context);

/* All hairs and views of the context must have been destroyed, and no work of it be in flight. NULL is allowed. */
FLK_API void flkContextDestroy(FlkContext context);

/* ---- Hair --------------------------------------------------------------------------------------------------------- */

/* How hair looks. Taken as given: start from flkMaterialDefault. Ranges are checked. */
typedef struct FlkMaterial {
  float color[3];          /* reflectance of the fibre (linear) [0, 1], times the asset's vertex colours and root image */
  float opacity_root;      /* of a pixel wholly covered, at the root [0, 1] */
  float opacity_tip;       /* at the tip, linear in between [0, 1] */
  float width_scale;       /* of the asset's radii [0, 1e6] */
  float diffuse;           /* Kajiya-Kay diffuse weight [0, 1e3] */
  float specular_r;        /* first lobe (R), colourless [0, 1e3] */
  float exponent_r;        /* [0, 1e6] */
  float specular_trt;      /* second lobe (TRT), times color [0, 1e3] */
  float exponent_trt;      /* [0, 1e6] */
  float cuticle_tilt;      /* of the scales (radian) [-pi/4, pi/4]: lobes turn by 2x to the root, 3x to the tip */
  float shadow_opacity;    /* one fibre's, towards light [0, 1] */
  float fibre_spacing;     /* mean distance between fibres (metre) > 0: half of light is lost every
                              fibre_spacing / -log2(1 - shadow_opacity) of depth */
  float tip_color[3];      /* what color turns into towards the tip [0, 1] */
  float tip_blend;         /* share of tip_color at the tip, linear from 0 at the root [0, 1]; 0: color all along. Above 0 a
                              fragment takes a fourth word */
} FlkMaterial;

/* Brown hair: color 0.22 0.13 0.07, opacity 0.63, width_scale 1, diffuse 0.22, R 0.012 exp 14.4, TRT 0.136 exp 11.8,
 * tilt 10 degrees, shadow_opacity 0.35, fibre_spacing 1.5 mm, tip_blend 0. Weights and exponents as in AMD's TressFX 4.1 sample. */
FLK_API void flkMaterialDefault(FlkMaterial* material);

enum {
  FLK_HAIR_KEEP_ORDER = 1u,  /* draw strands in the asset's order, not shuffled */
  FLK_HAIR_IGNORE_COLORS = 2u, /* leave the asset's vertex colours out, and their memory */
  FLK_HAIR_HOST_POSITIONS = 4u /* positions will come from flkHairSetPositions: 12 bytes more a vertex, 36 a strand */
};

/* A picture of the scalp: each strand's colours are multiplied by the pixel at its root's UV (docs/methods.md section 2). */
typedef struct FlkRootImage {
  const float* rgb;        /* 3 x width x height, linear [0, 1], row 0 at v = 0; read during flkHairCreate only */
  uint32_t width, height;  /* [1, 16384] */
} FlkRootImage;

/* Strands beside each strand of the asset (docs/methods.md section 7). */
typedef struct FlkFollowStrands {
  uint32_t count;          /* beside each strand [0, 1023]; 0: none */
  float radius;            /* of the disc they start in, around the guide's root (unit of the positions) [0, 1e6] */
  float spread_tip;        /* radius at the tip, as a factor of that at the root [0, 1e3] */
  uint32_t seed;
} FlkFollowStrands;
typedef struct FlkHairDesc {
  uint32_t type;    /* FLK_TYPE_HAIR */
  const void* next; /* NULL */
  FlkAsset asset;   /* copied; may be destroyed afterwards */
  const FlkMaterial* material; /* optional: flkMaterialDefault */
  uint32_t flags;              /* FLK_HAIR_... */
  uint32_t shuffle_seed;       /* of the order of strands, so that what overflows is spread evenly */
  const FlkRootImage* root_image;  /* optional; needs root UVs */
  FlkFollowStrands follow;         /* optional: zero is none */
} FlkHairDesc;

/* Device memory: 16 bytes a vertex and 4 a segment, 4 more a vertex with colours (see FlkHairInfo); staging of the same size
 * until the upload is released. Cost: one pass over the strands, follow strands included. Transform: identity.
 * FLK_ERROR_LIMIT: with follow strands more vertices than FlkStrands allows; FLK_ERROR_INVALID_ARGUMENT: also a root image
 * without root UVs; FLK_ERROR_OUT_OF_HOST_MEMORY, FLK_ERROR_OUT_OF_DEVICE_MEMORY. */
FLK_API FlkResult flkHairCreate(FlkContext context, const FlkHairDesc* desc, FlkHair* hair);

/* Records the copy of a hair to the device. Once, before the first frame that draws it is recorded, on a queue of the
 * context's family or ordered with it by the host.
 *   reads: staging memory (host visible)   writes: the hair's buffers   stages: COPY; made visible to VERTEX_SHADER and
 *   COMPUTE_SHADER storage reads of later commands of the same queue   outside rendering   clobbers: nothing
 * FLK_ERROR_INVALID_ARGUMENT: a planning context. */
FLK_API FlkResult flkCmdUpload(VkCommandBuffer cmd, FlkHair hair);

/* Frees the staging memory: call once the command buffer of flkCmdUpload has completed. Optional: otherwise it goes with
 * the hair. */
FLK_API void flkHairReleaseStaging(FlkHair hair);

/* Rigid transform, with a uniform scale if need be, as a column-major 4x4 (last row 0 0 0 1), from asset to world, values
 * within 1e15. Widths scale by the cube root of its determinant. Holds for plans made afterwards. */
FLK_API FlkResult flkHairSetTransform(FlkHair hair, const double world_from_hair[16]);
/* The transform that the frame before drew it with, for velocity. NULL: the same as now, which is also how a hair starts.
 * Holds for plans made afterwards. */
FLK_API FlkResult flkHairSetPreviousTransform(FlkHair hair, const double world_from_hair[16]);
FLK_API FlkResult flkHairSetMaterial(FlkHair hair, const FlkMaterial* material);

/* Positions from the host, for engines with a solver of their own: one for each vertex of the asset, in the asset's order.
 * Every plan that draws the hair then reads them once (pass "prepare") and moves follow strands with their guides' roots. */
typedef struct FlkHairPositions {
  VkDeviceAddress address; /* of 3 floats a vertex, 4-byte aligned; the buffer lives until the frames that use it complete */
  uint32_t stride;         /* bytes from vertex to vertex, a multiple of 4 [12, 4096]; optional: 0 is 12 */
  float min_bounds[3], max_bounds[3]; /* that hold all of them (hair space); too large costs memory, too small cuts hair off */
  VkPipelineStageFlags2 entry_stages; /* that wrote them */
  VkAccessFlags2 entry_access;        /* inside: COMPUTE_SHADER storage read */
} FlkHairPositions;
/* Holds for plans made afterwards; NULL: back to the asset's own once no plan with host positions is to be recorded any more.
 * FLK_ERROR_INVALID_ARGUMENT: the hair was made without FLK_HAIR_HOST_POSITIONS, or a field is out of its range. */
FLK_API FlkResult flkHairSetPositions(FlkHair hair, const FlkHairPositions* positions);

typedef struct FlkHairInfo {
  uint32_t strand_count, vertex_count, segment_count; /* with follow strands */
  uint64_t bytes_device;  /* persistent */
  uint64_t bytes_staging; /* until flkHairReleaseStaging */
} FlkHairInfo;
FLK_API FlkResult flkHairGetInfo(FlkHair hair, FlkHairInfo* info);

/* No plan that is still to be recorded and no frame in flight may use it; NULL is allowed. */
FLK_API void flkHairDestroy(FlkHair hair);

/* ---- View --------------------------------------------------------------------------------------------------------- */

typedef struct FlkViewDesc {
  uint32_t type;    /* FLK_TYPE_VIEW */
  const void* next; /* NULL */
  uint32_t frames_in_flight;   /* frames planned and not yet completed, at most [1, 8]; optional: 0 is 3 */
  uint64_t pool_budget;        /* bytes the fragment lists of this view may take; at 12 a fragment; optional: 0 is
                                  256 MiB (22 million). Also limited by 2^26 - 1 fragments */
} FlkViewDesc;

/* Cost: none to speak of; memory is taken by flkPlanFrame, as far as a frame needs it. */
FLK_API FlkResult flkViewCreate(FlkContext context, const FlkViewDesc* desc, FlkView* view);

/* No frame of it may be in flight; NULL is allowed. */
FLK_API void flkViewDestroy(FlkView view);

/* ---- Frame -------------------------------------------------------------------------------------------------------- */

/* Where an image is left by the host and where the host wants it afterwards. */
typedef struct FlkImageState {
  VkImageLayout layout;
  VkPipelineStageFlags2 stages; /* that wrote or read it before (entry), that will use it next (exit) */
  VkAccessFlags2 access;
} FlkImageState;

/* The image that hair is composited over. */
typedef struct FlkColorTarget {
  VkImage image;           /* VK_FORMAT_R16G16B16A16_SFLOAT, 1 sample, VK_IMAGE_USAGE_STORAGE_BIT, premultiplied alpha */
  VkImageView view;        /* 2D, of the level and layer to draw */
  VkFormat format;
  VkSampleCountFlagBits samples;
  VkImageSubresourceRange range;
  uint32_t width, height;  /* [1, 16384] */
  FlkImageState entry, exit; /* inside: VK_IMAGE_LAYOUT_GENERAL, COMPUTE_SHADER storage read and write */
} FlkColorTarget;

/* The opaque scene's depth, same size as the target; it is read, never written, and its layout does not change. */
typedef struct FlkDepthSource {
  VkImage image;           /* any depth format, 1 sample, VK_IMAGE_USAGE_SAMPLED_BIT; VK_NULL_HANDLE, and view too: nothing
                              hides hair. In a planning context any other `view` says that there is depth */
  VkImageView view;        /* 2D, depth aspect only */
  VkFormat format;
  VkSampleCountFlagBits samples;
  VkImageSubresourceRange range; /* the aspects of the format */
  VkImageLayout layout;    /* a read-only depth layout, SHADER_READ_ONLY_OPTIMAL or GENERAL */
  VkPipelineStageFlags2 entry_stages; /* that wrote it */
  VkAccessFlags2 entry_access;        /* inside: FRAGMENT_SHADER sampled read */
} FlkDepthSource;

/* Anything the SDK reads as a picture. */
typedef struct FlkSampledImage {
  VkImage image;           /* VK_NULL_HANDLE, and view too: none. 1 sample, VK_IMAGE_USAGE_SAMPLED_BIT */
  VkImageView view;        /* 2D array, of one aspect, float, unorm or depth */
  VkImageSubresourceRange range;
  VkImageLayout layout;    /* kept; one that can be sampled */
  VkPipelineStageFlags2 entry_stages; /* that wrote it */
  VkAccessFlags2 entry_access;        /* inside: COMPUTE_SHADER and FRAGMENT_SHADER sampled read */
} FlkSampledImage;

/* A light's place in FlkFrame.host_shadow_maps: the scene's shadow on hair (docs/methods.md section 4). For cascades give the
 * one that covers the hair. */
typedef struct FlkHostShadow {
  double map_from_world[16];/* column-major; x, y in texels, z the value that the map holds, w the divisor */
  uint32_t layer;           /* of the array */
  float rect[4];            /* x, y, width, height in texels: outside is lit */
  float bias;               /* of the value [0, 1e6] */
  uint32_t reversed;        /* 1: nearer to the light is the larger value */
} FlkHostShadow;

enum { FLK_LIGHT_DIRECTIONAL = 0, FLK_LIGHT_POINT = 1, FLK_LIGHT_SPOT = 2 };
enum { /* how a strand covers a hair shadow map: docs/methods.md section 4 */
  FLK_SHADOW_COVER_TEXEL = 0, /* every texel that it touches, as in the paper: the coarser the map, the darker the hair */
  FLK_SHADOW_COVER_WIDTH = 1  /* as many of them as its width and opacity ask for, picked at random: the same light whatever the
                                 map's size, and for fewer, wider strands. The pick follows strands and texels, and stays */
};
typedef struct FlkLight {
  float direction[3];      /* directional: from the scene to the light; spot: against its axis, back to the light. World space;
                              normalised here; not zero. Point: ignored */
  float radiance[3];       /* directional: irradiance on a surface facing it / pi; point and spot: the same, at one metre.
                              Host's unit, >= 0 */
  uint32_t casts_shadow;   /* 1: hair attenuates it, through a shadow map of this view */
  uint32_t shadow_size;    /* texels a side, even [64, 8192]; optional: 0 is 1024. A point light amid hair has six maps */
  uint32_t kind;           /* FLK_LIGHT_...; optional: 0 is directional */
  double position[3];      /* point, spot: world space (metre), within 1e15 of the origin */
  float range;             /* point, spot: nothing arrives beyond (metre) >= 0; optional: 0 is no end */
  float source_radius;     /* point, spot: radiance is that of this distance for all that is nearer (metre); 0 is 1 mm */
  float inner_angle, outer_angle; /* spot: half angles of full light and of none (radian) 0 <= inner < outer <= pi / 2 */
  const FlkHostShadow* host_shadow; /* optional: its map of FlkFrame.host_shadow_maps */
  uint32_t visibility;     /* optional: 1 + the light's layer of FlkFrame.host_visibility; 0: none */
  uint32_t shadow_cover;   /* FLK_SHADOW_COVER_... of its hair shadow map; optional: 0 is FLK_SHADOW_COVER_TEXEL */
} FlkLight;

/* Which lights reach which pixels (docs/methods.md section 4), as an engine with tiled or clustered lighting has them. */
typedef struct FlkLightTiles {
  VkDeviceAddress address; /* of layers x tiles_y x tiles_x words, 4-byte aligned, layers = ceil(light_count / 32); 0: no
                              masks, every light reaches every pixel */
  uint32_t tile_size;      /* pixels a side [8, 1024] */
  uint32_t tiles_x, tiles_y; /* that cover the target */
  VkPipelineStageFlags2 entry_stages; /* that wrote them */
  VkAccessFlags2 entry_access;        /* inside: COMPUTE_SHADER and FRAGMENT_SHADER storage read */
} FlkLightTiles;

enum { /* methods: docs/methods.md section 6 */
  FLK_METHOD_CORE_TAIL = 0, /* the nearest k in full quality, the rest cheaply */
  FLK_METHOD_EXACT = 1,     /* every fragment in full quality and in order; bit-identical from run to run */
  FLK_METHOD_FORWARD = 2,   /* every fragment shaded at capture; nearest k_sort in order (the paper's reference) */
  FLK_METHOD_CORE_ONLY = 3, /* core_tail whose tail has opacity but no colour (the paper's tailless) */
  FLK_METHOD_ALL_LOW = 4,   /* core_tail with every fragment shaded cheaply */
  FLK_METHOD_HARD = 5       /* the nearest fragment, opaque and at least a pixel wide: no lists, no blending */
};
enum { /* the tail of core_tail, core_only and all_low: docs/methods.md section 6 */
  FLK_TAIL_DEFAULT = 0,      /* FLK_TAIL_DETERMINISTIC */
  FLK_TAIL_DETERMINISTIC = 1,/* weighted by optical depth: the same bits whatever the order */
  FLK_TAIL_LIST = 2,         /* blended in list order, as in the paper */
  FLK_TAIL_ONCE = 3          /* one shade a pixel: of the tail's nearest fragment, for all of it; the same bits whatever the order */
};
enum { /* the cheap shade of core_tail and all_low: docs/methods.md section 5 */
  FLK_LOW_SHADE_DEFAULT = 0,    /* diffuse, as in the paper */
  FLK_LOW_SHADE_MEAN_LOBES = 1, /* and what the lobes give on average over all angles */
  FLK_LOW_SHADE_LOBES = 2       /* and the lobes */
};
enum { /* who turns strands into fragments */
  FLK_CAPTURE_DEFAULT = 0, /* FLK_CAPTURE_RASTER on a queue with graphics, else FLK_CAPTURE_COMPUTE */
  FLK_CAPTURE_RASTER = 1,
  FLK_CAPTURE_COMPUTE = 2  /* shadow maps too: for devices with few raster units, and queues without graphics */
};
enum { /* fragments that find the lists full: docs/methods.md section 6 */
  FLK_OVERFLOW_AGGREGATE = 0, /* summed up in 16 bytes a pixel: opacity stays, order and shade are approximate */
  FLK_OVERFLOW_DROP = 1       /* left out of the picture, and the 16 bytes too: for views whose lists surely suffice */
};
enum { /* payload coding: docs/methods.md section 3 */
  FLK_PAYLOAD_DEFAULT = 0,
  FLK_PAYLOAD_PAPER = 1
};
enum { /* what the picture shows; all but SHADED ignore lights and draw with FLK_METHOD_FORWARD */
  FLK_DISPLAY_SHADED = 0,
  FLK_DISPLAY_STRAND = 1,   /* a colour a strand */
  FLK_DISPLAY_ROOT_TIP = 2, /* root dark blue, tip yellow */
  FLK_DISPLAY_WIDTH = 3,    /* log2 of the width in pixel: blue below 1/8, green 1, red 8 and above */
  FLK_DISPLAY_DEPTH = 4,    /* near bright, far dark, over the extent of the hair */
  FLK_DISPLAY_LAYERS = 5    /* fragments of the pixel: grey 1, blue 8, green 50, red 100 and above */
};

/* A factor of every fragment's opacity (docs/methods.md section 2). */
enum { FLK_OPACITY_NEAR_FADE = 1, FLK_OPACITY_LENS = 2 };
typedef struct FlkOpacityModifier {
  uint32_t kind;           /* FLK_OPACITY_... */
  float start, end;        /* NEAR_FADE: no hair before `start`, all of it from `end` on (metre of view depth), 0 <= start < end */
  float center[2];         /* LENS: (pixel) */
  float radius, feather;   /* LENS: the disc, and the ramp around it (pixel) >= 0, > 0 */
  float inside;            /* LENS: what is left of opacity in the disc [0, 1] */
} FlkOpacityModifier;
#define FLK_MAX_OPACITY_MODIFIERS 4u

/* Pictures besides the colour, each optional. Written where hair is, untouched elsewhere: clear them before. */
enum {
  FLK_OUTPUT_FRONT_DEPTH = 0,   /* R32_SFLOAT: view depth of the nearest fragment (metre) */
  FLK_OUTPUT_TRANSMITTANCE = 1, /* R32_SFLOAT: what the hair lets through [0, 1] */
  FLK_OUTPUT_VELOCITY = 2,      /* R16G16_SFLOAT: pixels that the nearest fragment moved since the frame before, x right, y down */
  FLK_OUTPUT_DEPTH_RANGE = 3,   /* R32G32_SFLOAT: view depth of the nearest and the farthest fragment (metre), for sorting hair
                                   against other transparent things */
  FLK_OUTPUT_COUNT = 4
};
typedef struct FlkOutputImage {
  VkImage image;           /* of the target's size, 1 sample, VK_IMAGE_USAGE_STORAGE_BIT; VK_NULL_HANDLE, and view too: not
                              wanted. In a planning context any other `view` says that it is wanted */
  VkImageView view;        /* 2D, of the format above */
  VkImageSubresourceRange range;
  FlkImageState entry, exit; /* inside: VK_IMAGE_LAYOUT_GENERAL, COMPUTE_SHADER storage write */
} FlkOutputImage;

/* Device times of a frame. A stamp between two stages keeps them apart: shadow maps and the capture of a method that does not shade there
   may else run at the same time. */
enum { FLK_TIMESTAMPS_NONE = 0, FLK_TIMESTAMPS_STAGES = 1, FLK_TIMESTAMPS_FRAME = 2 /* the whole frame alone, as it runs untimed */ };

typedef struct FlkFrame {
  uint32_t type;    /* FLK_TYPE_FRAME */
  const void* next; /* NULL */
  uint64_t frame_number;     /* of this view; rises with every plan, from 1 */
  uint64_t completed_frame;  /* the last frame of this view whose commands the host knows to have completed; 0: none */
  double view_from_world[16];/* rigid, values within 1e15 */
  float clip_from_view[16];  /* perspective or orthographic, Vulkan clip space */
  uint32_t reversed_depth;   /* 1: near is depth 1 */
  uint32_t hair_count;       /* [0, 63] */
  const FlkHair* hairs;      /* in drawing order; each at most once */
  uint32_t light_count;      /* [0, 4096], with at most 96 hair shadow maps, which share one image (FLK_ERROR_LIMIT: they
                                do not fit into maxImageDimension2D squared) */
  const FlkLight* lights;
  float ambient[3];          /* radiance from everywhere, >= 0 */
  float exposure;            /* FLK_METHOD_FORWARD with FLK_PAYLOAD_PAPER cuts colours at 1 / exposure; optional: 0 is 1 */
  uint32_t method;           /* FLK_METHOD_... */
  uint32_t k;                /* fragments shaded fully [1, 32]; optional: 0 is 8 (use FLK_K_NONE for none) */
  uint32_t k_sort;           /* fragments sorted [k, 32]; optional: 0 is max(8, k) */
  uint32_t payload;          /* FLK_PAYLOAD_... */
  uint32_t display;          /* FLK_DISPLAY_... */
  uint32_t timestamps;       /* FLK_TIMESTAMPS_... (see FlkStatistics) */
  FlkColorTarget target;
  FlkDepthSource depth;
  /* All below is optional: zero leaves it out, with its passes, memory and shader code. */
  uint32_t tail;             /* FLK_TAIL_... */
  uint32_t capture;          /* FLK_CAPTURE_... */
  uint32_t overflow;         /* FLK_OVERFLOW_... */
  uint32_t count_only;       /* 1: only count fragments and draw nothing, so that the next plan has lists that suffice: once, at
                                a camera cut or before a first frame, with a wait before the next plan */
  uint32_t count_work;       /* 1: count shades and shadow map reads (see FlkStatistics); costs time */
  const float* ambient_sh;   /* 9 x 3: radiance over directions, real spherical harmonics in world space (docs/methods.md
                                section 5), added to `ambient` */
  FlkSampledImage host_shadow_maps; /* of lights with host_shadow: depth or float */
  FlkSampledImage host_visibility;  /* of lights with visibility: layers of the target's size, the first channel is read */
  FlkLightTiles light_tiles;
  uint32_t opacity_modifier_count;  /* [0, FLK_MAX_OPACITY_MODIFIERS] */
  const FlkOpacityModifier* opacity_modifiers;
  FlkOutputImage outputs[FLK_OUTPUT_COUNT]; /* by FLK_OUTPUT_... */
  const double* previous_view_from_world;   /* 16, of the frame before, for velocity; NULL: the same as now */
  const float* previous_clip_from_view;     /* 16; NULL: the same as now */
  uint32_t core_taps;        /* reads of a hair shadow map for a full shade: 1, 4, 9 or 25; 0 is 25 */
  uint32_t low_shade;        /* FLK_LOW_SHADE_... */
} FlkFrame;
#define FLK_K_NONE 0xFFFFFFFFu

/* Decides what the frame needs and readies it: memory, pipelines (compiled here, in this call, when first needed; some
 * 10 ms each), descriptors. Uses the fragment count of the last completed frame to size the lists; before there is one,
 * an upper estimate within the budget. The plan lives until its frame has completed and frames_in_flight later ones are
 * planned, or the view's end. A plan whose commands will never be submitted (a minimised window) counts as completed.
 * Memory that a smaller or larger one replaces is freed when `completed_frame` allows it.
 * FLK_ERROR_UNSUPPORTED_IMAGE: target, depth or another image (the message says which field); FLK_ERROR_TOO_MANY_FRAMES:
 * frames_in_flight plans of this view have not completed; FLK_ERROR_LIMIT: target or shadow maps exceed what the device
 * draws to, or the hair covers more pixels than list heads of 4 bytes can be bound for (maxStorageBufferRange; 33 million at
 * 128 MiB, by compute 1.5 % fewer); FLK_ERROR_INVALID_ARGUMENT: the message says which field; FLK_ERROR_OUT_OF_HOST_MEMORY, ..._DEVICE_MEMORY. */
FLK_API FlkResult flkPlanFrame(FlkView view, const FlkFrame* frame, FlkPlan* plan);

/* Records the plan: no allocation, no compilation, no file. Once a plan. Outside rendering, on a queue with compute, and with
 * graphics for FLK_CAPTURE_RASTER; the same VkCommandBuffer may hold other work before and after.
 *   reads: hairs, depth source, host shadows, light tiles   writes: colour target, outputs, the view's own memory
 *   stages: CLEAR and COPY, COMPUTE_SHADER (prepare, resolve, outputs; with FLK_CAPTURE_COMPUTE shadow and capture), else for
 *   these VERTEX_SHADER, FRAGMENT_SHADER and fragment tests
 *   clobbers: pipelines, descriptor set 0, push constants, index buffer and all dynamic state, of graphics and compute
 * With nothing to draw it records only the barrier that target.entry and target.exit ask for. */
FLK_API void flkCmdRender(VkCommandBuffer cmd, FlkPlan plan);

/* ---- What a plan holds, and what a frame took ----------------------------------------------------------------------- */

enum {
  FLK_STAGE_CLEAR = 0,
  FLK_STAGE_SHADOW = 1,
  FLK_STAGE_CAPTURE = 2,
  FLK_STAGE_RESOLVE = 3,
  FLK_STAGE_PREPARE = 4,
  FLK_STAGE_OUTPUT = 5,
  FLK_STAGE_COUNT = 6
};

typedef struct FlkPassInfo {
  const char* name;   /* for example "capture" */
  uint32_t stage;     /* FLK_STAGE_... */
  uint32_t groups[3]; /* of a pass of one dispatch; 0 for others */
  uint64_t indices;   /* drawn by a raster pass; 0 for compute passes */
  uint64_t segments;  /* that a shadow or capture pass by compute goes over; 0 for others */
  uint64_t hash;      /* of the SPIR-V that the pass runs and of the specialisation constants in it: equal hashes, equal code */
} FlkPassInfo;

typedef struct FlkResourceInfo {
  const char* name;   /* for example "nodes" */
  uint64_t bytes;
  uint32_t transient; /* 1: content lives within one frame and could be shared between views */
  const char* why;    /* which part of the frame needs it */
} FlkResourceInfo;

typedef struct FlkPlanInfo {
  uint32_t pass_count, resource_count, omission_count;
  uint64_t bytes_persistent; /* hairs of this frame */
  uint64_t bytes_transient;  /* lists, heads, shadow maps, constants of this view */
  uint32_t rect[4];          /* x, y, width, height of the hair on screen (pixel); 0 0 0 0: out of view */
  uint64_t segment_count;
  uint64_t node_capacity;    /* fragments the lists can hold */
  uint32_t full_shade_taps, low_shade_taps; /* shadow map reads of one shade */
} FlkPlanInfo;

FLK_API FlkResult flkPlanGetInfo(FlkPlan plan, FlkPlanInfo* info);
FLK_API FlkResult flkPlanGetPass(FlkPlan plan, uint32_t index, FlkPassInfo* info);
FLK_API FlkResult flkPlanGetResource(FlkPlan plan, uint32_t index, FlkResourceInfo* info);
/* A sentence on something the frame does without, and why; NULL past the end. Lives as long as the plan. */
FLK_API const char* flkPlanGetOmission(FlkPlan plan, uint32_t index);

typedef struct FlkStatistics {
  uint64_t frame_number;
  uint64_t fragments;         /* that passed the tests, stored or not: exact up to 4,026,531,840, where it stays */
  uint64_t overflow_fragments;/* found the lists full (see FlkFrame.overflow; the next plan grows within the budget): exact */
  double milliseconds_frame;  /* of all that flkCmdRender records; -1: not timed */
  double milliseconds[FLK_STAGE_COUNT]; /* by FLK_STAGE_...; -1: not timed or not run */
  /* With FlkFrame.count_work, else 0. */
  uint64_t pixels;            /* that the resolve found hair in */
  uint64_t full_shades, low_shades;
  uint64_t shadow_taps;       /* reads of hair shadow maps */
} FlkStatistics;

/* Of the latest frame known to have completed (FlkFrame.completed_frame of the latest plan, or `completed_frame` here if
 * larger). FLK_NOT_READY: none yet. A frame with nothing to draw counts 0 fragments. */
FLK_API FlkResult flkViewGetStatistics(FlkView view, uint64_t completed_frame, FlkStatistics* statistics);

/* Map `face` of light `index` as the latest plan left it, for the host to shade its scene with hair's shadow. All maps of a view
 * are rectangles of one image. After flkCmdRender: layout SHADER_READ_ONLY_OPTIMAL, written by the shadow pass, visible to
 * COMPUTE_SHADER and (on a queue with graphics) FRAGMENT_SHADER sampled reads. 1 where empty. Image and view live until a later
 * plan of other maps, or without, has completed. FLK_NOT_READY: the latest plan has no such map. */
typedef struct FlkShadowMap {
  VkImage image;
  VkImageView view;
  VkFormat format;              /* of the view: D32_SFLOAT where rasterised, R32_SFLOAT where computed */
  uint32_t offset[2];           /* texel of the image where the map begins */
  uint32_t size;                /* texels a side */
  uint32_t face, face_count;    /* 1, or 6 around a point light amid hair */
  uint32_t perspective;         /* 0: directional, 1: point or spot */
  double texels_from_world[16]; /* column-major: x, y in texels from `offset`, to be divided by w in perspective; z the metres
                                   from the map's front, or in perspective along its axis from the light */
  float depth_range;            /* metre: the map holds distance / depth_range; in perspective distance from the light */
  float texel;                  /* metre; in perspective at one metre from the light */
} FlkShadowMap;
FLK_API FlkResult flkViewGetShadowMap(FlkView view, uint32_t index, uint32_t face, FlkShadowMap* map);

#ifdef __cplusplus
}
#endif
#endif
