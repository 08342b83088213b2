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
  VkQueueFlags queue_flags;                   /* of the queue family that flkCmdRender's command buffers go to */
  VkPhysicalDeviceFeatures features;          /* to enable: fragmentStoresAndAtomics */
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
 * Without it Forelock allocates with vkAllocateMemory, one allocation a resource: about six a view and four a hair. */
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
  float color[3];          /* reflectance of the fibre (linear) [0, 1] */
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
} FlkMaterial;

/* Brown hair: color 0.22 0.13 0.07, opacity 0.63, width_scale 1, diffuse 0.22, R 0.012 exp 14.4, TRT 0.136 exp 11.8,
 * tilt 10 degrees, shadow_opacity 0.35, fibre_spacing 1.5 mm. Weights and exponents as in AMD's TressFX 4.1 sample. */
FLK_API void flkMaterialDefault(FlkMaterial* material);

enum {
  FLK_HAIR_KEEP_ORDER = 1u /* draw strands in the asset's order, not shuffled */
};
typedef struct FlkHairDesc {
  uint32_t type;    /* FLK_TYPE_HAIR */
  const void* next; /* NULL */
  FlkAsset asset;   /* copied; may be destroyed afterwards */
  const FlkMaterial* material; /* optional: flkMaterialDefault */
  uint32_t flags;              /* FLK_HAIR_... */
  uint32_t shuffle_seed;       /* of the order of strands, so that what is left out on overflow is spread evenly */
} FlkHairDesc;

/* Device memory: 16 bytes a vertex and 4 a segment (see FlkHairInfo); staging of the same size until the upload is
 * released. Cost: one pass over the strands. Transform: identity. FLK_ERROR_LIMIT: one of the buffers exceeds
 * maxStorageBufferRange (at 128 MiB: 11 million vertices); FLK_ERROR_OUT_OF_HOST_MEMORY, FLK_ERROR_OUT_OF_DEVICE_MEMORY. */
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

/* Rigid transform, with a uniform scale if need be, as a column-major 4x4 (last row 0 0 0 1), from asset to world. Widths
 * scale by the cube root of its determinant. Holds for plans made afterwards. */
FLK_API FlkResult flkHairSetTransform(FlkHair hair, const double world_from_hair[16]);
FLK_API FlkResult flkHairSetMaterial(FlkHair hair, const FlkMaterial* material);

typedef struct FlkHairInfo {
  uint32_t strand_count, vertex_count, segment_count;
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

typedef struct FlkLight {
  float direction[3];      /* from the scene to the light, world space; normalised here; not zero */
  float radiance[3];       /* irradiance on a surface facing it / pi, host's unit, >= 0 */
  uint32_t casts_shadow;   /* 1: hair attenuates it, through a shadow map of this view */
  uint32_t shadow_size;    /* texels a side, even [64, 8192]; optional: 0 is 1024 */
} FlkLight;

enum { /* methods: docs/methods.md section 6 */
  FLK_METHOD_CORE_TAIL = 0, /* the nearest k in full quality, the rest cheaply */
  FLK_METHOD_EXACT = 1,     /* every fragment in full quality and in order; bit-identical from run to run */
  FLK_METHOD_FORWARD = 2    /* every fragment shaded at capture; nearest k_sort in order (the paper's reference) */
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

typedef struct FlkFrame {
  uint32_t type;    /* FLK_TYPE_FRAME */
  const void* next; /* NULL */
  uint64_t frame_number;     /* of this view; rises with every plan, from 1 */
  uint64_t completed_frame;  /* the last frame of this view whose commands the host knows to have completed; 0: none */
  double view_from_world[16];/* rigid */
  float clip_from_view[16];  /* perspective or orthographic, Vulkan clip space */
  uint32_t reversed_depth;   /* 1: near is depth 1 */
  uint32_t hair_count;       /* [0, 63] */
  const FlkHair* hairs;      /* in drawing order; each at most once */
  uint32_t light_count;      /* [0, 1] */
  const FlkLight* lights;
  float ambient[3];          /* radiance from everywhere, >= 0 */
  float exposure;            /* FLK_METHOD_FORWARD with FLK_PAYLOAD_PAPER cuts colours at 1 / exposure; optional: 0 is 1 */
  uint32_t method;           /* FLK_METHOD_... */
  uint32_t k;                /* fragments shaded fully [1, 32]; optional: 0 is 8 (use FLK_K_NONE for none) */
  uint32_t k_sort;           /* fragments sorted [k, 32]; optional: 0 is max(8, k) */
  uint32_t payload;          /* FLK_PAYLOAD_... */
  uint32_t display;          /* FLK_DISPLAY_... */
  uint32_t timestamps;       /* 1: time each pass (see FlkStatistics) */
  FlkColorTarget target;
  FlkDepthSource depth;
} FlkFrame;
#define FLK_K_NONE 0xFFFFFFFFu

/* Decides what the frame needs and readies it: memory, pipelines (compiled here, in this call, when first needed; some
 * 10 ms each), descriptors. Uses the fragment count of the last completed frame to size the lists; before there is one,
 * an upper estimate within the budget. The plan lives until its frame has completed and frames_in_flight later ones are
 * planned, or the view's end. A plan whose commands will never be submitted (a minimised window) counts as completed.
 * Memory that a smaller or larger one replaces is freed when `completed_frame` allows it.
 * FLK_ERROR_UNSUPPORTED_IMAGE: target or depth (the message says which field); FLK_ERROR_TOO_MANY_FRAMES:
 * frames_in_flight plans of this view have not completed; FLK_ERROR_LIMIT: target or shadow map exceed what the device
 * draws to, or the hair covers more pixels than list heads of 4 bytes can be bound for (maxStorageBufferRange; 33 million at
 * 128 MiB); FLK_ERROR_INVALID_ARGUMENT: the message says which field; FLK_ERROR_OUT_OF_HOST_MEMORY, ..._DEVICE_MEMORY. */
FLK_API FlkResult flkPlanFrame(FlkView view, const FlkFrame* frame, FlkPlan* plan);

/* Records the plan: no allocation, no compilation, no file. Once a plan. Outside rendering, on a queue with graphics and
 * compute; the same VkCommandBuffer may hold other work before and after.
 *   reads: hairs, depth source   writes: colour target, the view's own memory
 *   stages: CLEAR and COPY, VERTEX_SHADER and FRAGMENT_SHADER and fragment tests (capture, shadow), COMPUTE_SHADER (resolve)
 *   clobbers: pipelines, descriptor sets 0 and 1, push constants, index buffer and all dynamic state, of graphics and compute
 * With nothing to draw it records only the barrier that target.entry and target.exit ask for. */
FLK_API void flkCmdRender(VkCommandBuffer cmd, FlkPlan plan);

/* ---- What a plan holds, and what a frame took ----------------------------------------------------------------------- */

enum { FLK_STAGE_CLEAR = 0, FLK_STAGE_SHADOW = 1, FLK_STAGE_CAPTURE = 2, FLK_STAGE_RESOLVE = 3, FLK_STAGE_COUNT = 4 };

typedef struct FlkPassInfo {
  const char* name;   /* for example "capture" */
  uint32_t stage;     /* FLK_STAGE_... */
  uint32_t groups[3]; /* of a compute pass; 0 for raster passes */
  uint64_t indices;   /* drawn by a raster pass; 0 for compute passes */
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
  uint64_t fragments_lost;    /* did not fit into the lists (then the picture lacks them; the next plan grows) */
  double milliseconds[FLK_STAGE_COUNT]; /* by FLK_STAGE_...; -1: not timed or not run */
} FlkStatistics;

/* Of the latest frame known to have completed (FlkFrame.completed_frame of the latest plan, or `completed_frame` here if
 * larger). FLK_NOT_READY: none yet. A frame with nothing to draw counts 0 fragments. */
FLK_API FlkResult flkViewGetStatistics(FlkView view, uint64_t completed_frame, FlkStatistics* statistics);

/* The view's shadow map of light `index` as the latest plan left it, for the host to shade its scene with hair's shadow.
 * After flkCmdRender: layout SHADER_READ_ONLY_OPTIMAL, written by the shadow pass, visible to COMPUTE_SHADER and
 * FRAGMENT_SHADER sampled reads. D32_SFLOAT, 1 where empty; depth in metre = value x depth_range. Image and view live until a
 * later plan of another shadow_size, or without a map, has completed. FLK_NOT_READY: the latest plan has no such map. */
typedef struct FlkShadowMap {
  VkImage image;
  VkImageView view;
  uint32_t size;                /* texels a side */
  double texels_from_world[16]; /* column-major: x, y in texels, z in metre from the map's front */
  float depth_range;            /* metre */
  float texel;                  /* metre */
} FlkShadowMap;
FLK_API FlkResult flkViewGetShadowMap(FlkView view, uint32_t index, FlkShadowMap* map);

#ifdef __cplusplus
}
#endif
#endif
