/* Forelock: strands on the CPU. No device, no Vulkan. SPDX-License-Identifier: MIT
 *
 * An asset is a list of strands, each a polyline of two or more vertices from root to tip; strands may differ in their
 * number of vertices. An asset never changes after it is made: any number of threads may read it at once.
 *
 * What every asset holds, whatever the file said: positions finite and within 1e6 of the origin; radii finite and >= 0;
 * colours within 0..1; two or more vertices a strand; no strand of zero length. Strands that break this are dropped one
 * by one, other values replaced, each kind with a finding, and the rest is loaded unchanged.
 */
#ifndef FORELOCK_ASSET_H
#define FORELOCK_ASSET_H

#include "forelock.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct FlkAsset_T* FlkAsset;

/* Strands as arrays: what flkAssetCreate takes and flkAssetGetStrands gives. Vertices of a strand are consecutive, root
 * first; vertices of strand i are first_vertex[i] .. first_vertex[i + 1] - 1. */
typedef struct FlkStrands {
  uint32_t type;                /* FLK_TYPE_STRANDS */
  const void* next;             /* NULL */
  uint32_t strand_count;        /* [1, 4,194,304] */
  uint32_t vertex_count;        /* of all strands together [2, 268,435,456] */
  const uint32_t* first_vertex; /* strand_count + 1 entries, never falling, from 0 to vertex_count */
  const float* positions;       /* 3 x vertex_count (metre by convention) */
  const float* radii;           /* vertex_count (unit of the positions), half the diameter; NULL: default width */
  const float* root_uvs;        /* 2 x strand_count, on the scalp; NULL: none */
  const float* inverse_masses;  /* vertex_count, 0 pins the vertex; NULL: none */
  const float* colors;          /* 3 x vertex_count, linear [0, 1]; NULL: none */
} FlkStrands;

typedef struct FlkAssetOptions {
  uint32_t type;    /* FLK_TYPE_ASSET_OPTIONS */
  const void* next; /* NULL */
  const FlkHostAllocator* allocator; /* optional, copied */
  FlkMessageFunction message;        /* optional; told why a call failed, and each finding of severity warning or error */
  void* message_user;
  const char* name;                  /* optional: what messages call the asset; flkAssetLoadFile: the path */
  uint32_t max_strands;              /* optional: 0 is the limit of FlkStrands */
  uint32_t max_vertices;             /* optional: 0 is the limit of FlkStrands */
  uint32_t flags;                    /* optional: FLK_ASSET_... */
  uint32_t points_per_strand;        /* optional, [2, ...]: of a PLY file that has vertices and nothing that says which make
                                        a strand, so many after each other do; 0: such a file is refused. Other files: no effect */
} FlkAssetOptions;

enum {
  FLK_ASSET_COPY_FILE = 1  /* flkAssetLoadFile: read the file into memory of the allocator instead of mapping it, for files that
                              another process may cut short or write into; an asset of a cooked file then keeps a copy */
};

/* Something worth knowing about an asset. */
typedef struct FlkFinding {
  const char* code;       /* stable, for example "STRAND_ZERO_LENGTH"; the list is in docs/findings.md */
  uint32_t severity;      /* FLK_SEVERITY_... */
  uint32_t repaired;      /* 1: the asset was changed (strand dropped, value replaced); 0: only noted */
  uint64_t count;         /* how often */
  uint32_t strands[8];    /* the first strands concerned, numbered as in the file */
  uint32_t strands_listed;/* entries of `strands` that are set */
  uint64_t byte_offset;   /* of the first occurrence in the file; UINT64_MAX: none */
  const char* text;       /* a sentence: what it is and what to do */
} FlkFinding;

/* Formats. */
enum {
  FLK_FORMAT_UNKNOWN = 0,
  FLK_FORMAT_TFX = 1,   /* TressFX, binary: versions 3 and 4 are read, 4 is written. Equal vertex counts, root UV,
                           inverse mass; widths a strand are read, not written; no colours */
  FLK_FORMAT_HAIR = 2,  /* Cem Yuksel's .hair: thickness (read and written as the diameter), colour; UVs are read, not written; no mass */
  FLK_FORMAT_TFX_TEXT = 3,    /* TressFX 1 and 2, text, only read: root UV, inverse mass as TressFX implies it */
  FLK_FORMAT_STRAND_DATA = 4, /* USC-HairSalon (.data) and CT2Hair (.bin), only read: positions */
  FLK_FORMAT_PLY = 5,   /* PLY with an element strand, read and written: everything that an asset holds; bare points
                           are read with FlkAssetOptions.points_per_strand */
  FLK_FORMAT_COOKED = 6 /* Forelock's own cache (.flk): everything that an asset holds and knows, findings included, as it lies in
                           memory. Read by the version that wrote it; cook it again from the source after an update */
};

typedef struct FlkAssetInfo {
  uint32_t format;                   /* FLK_FORMAT_... the asset was read from; FLK_FORMAT_UNKNOWN: made from arrays */
  uint32_t strand_count;
  uint32_t vertex_count;
  uint32_t min_vertices_per_strand;
  uint32_t max_vertices_per_strand;
  uint32_t has_radii;                /* 1: from the source; 0: default width */
  uint32_t has_root_uvs;
  uint32_t has_inverse_masses;
  uint32_t has_colors;
  uint32_t finding_count;
  uint32_t strands_in_source;        /* before degenerate strands were dropped */
  float min_bounds[3], max_bounds[3];/* of the vertices (unit of the positions) */
  float min_length, mean_length, max_length; /* of strands (unit of the positions) */
  float min_radius, max_radius;
  uint64_t bytes_host;               /* held by this asset, from the allocator */
  uint64_t bytes_mapped;             /* of a cooked file whose mapping this asset holds beside them; 0: none */
  uint32_t source_format;            /* of a cooked file: the format that was cooked; otherwise `format` */
} FlkAssetInfo;

/* Makes an asset from arrays, which are copied. Strands that no asset may hold are dropped with a finding.
 * Cost: linear in the data. FLK_ERROR_INVALID_ARGUMENT: counts or first_vertex do not fit together;
 * FLK_ERROR_EMPTY_ASSET: no strand is left. `options` may be NULL. On failure *asset is NULL. Any thread. */
FLK_API FlkResult flkAssetCreate(const FlkStrands* strands, const FlkAssetOptions* options, FlkAsset* asset);

/* Reads a strand file from memory; the format is told from the bytes, not from a name. The bytes are not kept.
 * Never reads outside them, never allocates for a count before it is proven against them. Cost: linear in `size`.
 * FLK_ERROR_FORMAT_UNKNOWN, FLK_ERROR_MALFORMED, FLK_ERROR_LIMIT, FLK_ERROR_EMPTY_ASSET: see the message, which names
 * the file, the field and the byte. `options` may be NULL. On failure *asset is NULL. Any thread. */
FLK_API FlkResult flkAssetLoadMemory(const void* bytes, size_t size, const FlkAssetOptions* options, FlkAsset* asset);

/* Like flkAssetLoadMemory, for a file (path in UTF-8). The file is mapped while it is read, which is the one thing that does not
 * come from the allocator; the mapping of a cooked file stays, because the asset's arrays are views of it. A mapped file may be
 * replaced (flkAssetSaveFile does it safely), but must not be written into or cut short, which ends the program with SIGBUS:
 * FLK_ASSET_COPY_FILE is for files that may be. Cost of a cooked file: one pass over it at the speed of memory, no copy.
 * FLK_ERROR_IO: cannot be read, or is not a regular file. */
FLK_API FlkResult flkAssetLoadFile(const char* path, const FlkAssetOptions* options, FlkAsset* asset);

/* Size in bytes and content of the asset written as `format`. With bytes == NULL only *size is set; otherwise *size is
 * the capacity on entry and the length on return. Equal assets give equal bytes. FLK_ERROR_INVALID_ARGUMENT: the format
 * cannot be written or the capacity is too small; FLK_ERROR_LIMIT: the format cannot hold this asset (.tfx needs equal
 * vertex counts, .hair and PLY at most 65,536 vertices a strand); what else a format cannot hold is left out and reported to the
 * asset's message callback with id "WRITE_DROPS_...". */
FLK_API FlkResult flkAssetSaveMemory(FlkAsset asset, uint32_t format, void* bytes, size_t* size);

/* Writes the asset to a file through a temporary file beside it, so that a failure leaves an existing file whole.
 * Results of flkAssetSaveMemory, and FLK_ERROR_IO. */
FLK_API FlkResult flkAssetSaveFile(FlkAsset asset, uint32_t format, const char* path);

/* Facts about an asset. Cost: none. Any thread. */
FLK_API FlkResult flkAssetGetInfo(FlkAsset asset, FlkAssetInfo* info);

/* The strands of an asset; the arrays live as long as the asset. radii is never NULL (the default width is filled in:
 * a diameter of 1/5,000 of the longest side of the bounds x max(1, 100,000 / strands), which is 80 um for the hair of a
 * head, 0.4 m; at most 1/1,000 of that side and 1/100 of the median strand length). Any thread. */
FLK_API FlkResult flkAssetGetStrands(FlkAsset asset, FlkStrands* strands);

/* Finding `index` in [0, finding_count); its strings live as long as the asset. Any thread. */
FLK_API FlkResult flkAssetGetFinding(FlkAsset asset, uint32_t index, FlkFinding* finding);

/* Frees the asset; NULL is allowed. No other thread may be using it. Hairs made from it stay valid. */
FLK_API void flkAssetDestroy(FlkAsset asset);

#ifdef __cplusplus
}
#endif
#endif
