/* Forelock: what hair hangs on. No device, no Vulkan. SPDX-License-Identifier: MIT
 *
 * A rig is read from a file of TressFX: a skin (.tfxbone) says by which bones each strand moves, a mesh (.tfxmesh) is the
 * body that strands collide with. Either has records of four bones and four weights, one a strand or one a vertex. A rig
 * never changes after it is made: any number of threads may read it at once.
 *
 * What every rig holds, whatever the file said: bone indices below bone_count; weights of 0 or more, whose four make
 * 1 within 1e-5, or are all 0 (the record hangs on nothing); positions finite and within 1e6; normals finite; triangles of
 * three different vertices that exist. Values that break this are replaced and triangles dropped, one by one and each
 * kind with a finding; the rest is loaded unchanged.
 */
#ifndef FORELOCK_RIG_H
#define FORELOCK_RIG_H

#include "asset.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct FlkRig_T* FlkRig;

typedef struct FlkRigOptions {
  uint32_t type;    /* FLK_TYPE_RIG_OPTIONS */
  const void* next; /* NULL */
  const FlkHostAllocator* allocator; /* optional, copied */
  FlkMessageFunction message;        /* optional; told why a call failed, and each finding of severity warning or error */
  void* message_user;
  const char* name;                  /* optional: what messages call the rig; flkRigLoadFile: the path */
  uint32_t max_bones;                /* optional: 0 is 4,096 */
  uint32_t max_records;              /* of strands, of vertices and of triangles; optional: 0 is 4,194,304 */
  FlkAsset asset;                    /* optional, for a skin: the hair that it is for, needed during the call only. Records
                                        then are those of the asset's strands, in its order: a record more than the source
                                        of the asset had strands, or of a strand that the asset dropped, is left out, and a
                                        strand without one hangs on nothing; each with a finding */
} FlkRigOptions;

/* Kinds. */
enum {
  FLK_RIG_SKIN = 1, /* .tfxbone: a record a strand */
  FLK_RIG_MESH = 2  /* .tfxmesh: a record a vertex, and triangles */
};

typedef struct FlkRigInfo {
  uint32_t kind;                /* FLK_RIG_... */
  uint32_t bone_count;
  uint32_t record_count;        /* strands or vertices */
  uint32_t records_in_source;
  uint32_t unattached_count;    /* records whose weights are all 0 */
  uint32_t triangle_count;      /* 0 for a skin */
  uint32_t triangles_in_source; /* before some were dropped */
  uint32_t finding_count;
  uint64_t bytes_host;          /* held by this rig */
} FlkRigInfo;

/* The arrays of a rig; they live as long as it. */
typedef struct FlkRigArrays {
  const char* const* bone_names; /* bone_count, UTF-8 where the file has it; to be looked up in the skeleton of the host */
  const uint32_t* bones;         /* 4 x record_count, into bone_names; 0 where the weight is 0 for want of a bone */
  const float* weights;          /* 4 x record_count */
  const float* positions;        /* 3 x record_count (unit of the file); NULL for a skin */
  const float* normals;          /* 3 x record_count, length as in the file, 0 where it had none; NULL for a skin */
  const uint32_t* triangles;     /* 3 x triangle_count, into the records; NULL for a skin */
} FlkRigArrays;

/* Reads a .tfxbone or .tfxmesh file from memory; which of them is told from the bytes, not from a name. The bytes are not
 * kept. Never reads outside them, never allocates for a count before it is proven against them. Cost: linear in `size`.
 * FLK_ERROR_FORMAT_UNKNOWN, FLK_ERROR_MALFORMED, FLK_ERROR_LIMIT, FLK_ERROR_EMPTY_ASSET (no bone, record or triangle is
 * left): see the message, which names the file, the field and the byte. `options` may be NULL. On failure *rig is NULL.
 * Any thread. */
FLK_API FlkResult flkRigLoadMemory(const void* bytes, size_t size, const FlkRigOptions* options, FlkRig* rig);

/* Like flkRigLoadMemory, for a file (path in UTF-8). FLK_ERROR_IO: cannot be read, or is not a regular file. */
FLK_API FlkResult flkRigLoadFile(const char* path, const FlkRigOptions* options, FlkRig* rig);

/* Facts about a rig. Cost: none. Any thread. */
FLK_API FlkResult flkRigGetInfo(FlkRig rig, FlkRigInfo* info);

/* The arrays of a rig. Cost: none. Any thread. */
FLK_API FlkResult flkRigGetArrays(FlkRig rig, FlkRigArrays* arrays);

/* Finding `index` in [0, finding_count); its strings live as long as the rig. `strands` numbers what `text` speaks of:
 * bones, strands, vertices or triangles, as in the file. Any thread. */
FLK_API FlkResult flkRigGetFinding(FlkRig rig, uint32_t index, FlkFinding* finding);

/* Frees the rig; NULL is allowed. No other thread may be using it. */
FLK_API void flkRigDestroy(FlkRig rig);

#ifdef __cplusplus
}
#endif
#endif
