/* Forelock: types shared by every header. SPDX-License-Identifier: MIT
 *
 * Units are SI (metre, radian, second), colours are linear, arrays are tightly packed. No function of the SDK prints,
 * exits, throws across this boundary or keeps writable globals. Descriptor structs begin with `type` (checked) and
 * `next` (reserved for extensions: must be NULL); zero in a field called optional selects the default named beside it.
 */
#ifndef FORELOCK_FORELOCK_H
#define FORELOCK_FORELOCK_H

#include <stddef.h>
#include <stdint.h>

#define FLK_VERSION_MAJOR 0u
#define FLK_VERSION_MINOR 1u
#define FLK_VERSION_PATCH 0u

#if defined(_WIN32) && defined(FORELOCK_SHARED)
#  if defined(FORELOCK_BUILDING)
#    define FLK_API __declspec(dllexport)
#  else
#    define FLK_API __declspec(dllimport)
#  endif
#elif defined(__GNUC__)
#  define FLK_API __attribute__((visibility("default")))
#else
#  define FLK_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What a call came to. Zero is success, a positive value is not an error, a negative one is; after an error nothing
 * the call was asked to change has changed. The reason in words goes to the message callback. */
typedef int32_t FlkResult;
enum {
  FLK_SUCCESS = 0,
  FLK_NOT_READY = 1,                   /* the answer does not exist yet: ask again after a later frame */
  FLK_ERROR_INVALID_ARGUMENT = -1,     /* an argument is outside the range its comment gives */
  FLK_ERROR_OUT_OF_HOST_MEMORY = -2,
  FLK_ERROR_OUT_OF_DEVICE_MEMORY = -3,
  FLK_ERROR_IO = -4,                   /* a file cannot be opened, read or written */
  FLK_ERROR_FORMAT_UNKNOWN = -5,       /* the bytes are of no strand format that is read here */
  FLK_ERROR_MALFORMED = -6,            /* the format is known, the bytes contradict it */
  FLK_ERROR_LIMIT = -7,                /* well formed, but beyond a stated limit */
  FLK_ERROR_EMPTY_ASSET = -8,          /* no strand is left that could be drawn */
  FLK_ERROR_UNSUPPORTED_DEVICE = -9,   /* the device lacks what flkGetRequirements lists */
  FLK_ERROR_UNSUPPORTED_IMAGE = -10,   /* wrong format, sample count or usage of a host image */
  FLK_ERROR_DEVICE_LOST = -11,
  FLK_ERROR_TOO_MANY_FRAMES = -12,     /* more frames in flight than the view was created for */
  FLK_ERROR_NOT_BUILT = -13            /* the library was built without what is asked for (CMake options FORELOCK_...) */
};

/* Struct tags. */
enum {
  FLK_TYPE_STRANDS = 1,
  FLK_TYPE_ASSET_OPTIONS = 2,
  FLK_TYPE_RIG_OPTIONS = 3,
  FLK_TYPE_CONTEXT = 16,
  FLK_TYPE_HAIR = 17,
  FLK_TYPE_VIEW = 18,
  FLK_TYPE_FRAME = 19
};

/* A message for a person, with a stable id for a program. Valid only during the callback. */
enum { FLK_SEVERITY_INFO = 0, FLK_SEVERITY_WARNING = 1, FLK_SEVERITY_ERROR = 2 };
typedef struct FlkMessage {
  uint32_t severity;  /* FLK_SEVERITY_... */
  const char* id;     /* stable, upper case, for example "TFX_BLOCK_PAST_END" */
  const char* text;   /* one sentence, UTF-8, that names what, where and what to do */
} FlkMessage;
/* Called on the thread of the call that causes it; must not call back into Forelock. */
typedef void (*FlkMessageFunction)(void* user, const FlkMessage* message);

/* Host memory. Both functions or neither; NULL functions select malloc and free. `allocate` returns memory aligned to
 * `alignment` (a power of two) or NULL, which makes the call fail with FLK_ERROR_OUT_OF_HOST_MEMORY. Called from any
 * thread that calls Forelock. `free` is given the size and alignment of the allocation. */
typedef struct FlkHostAllocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*free)(void* user, void* memory, size_t size, size_t alignment);
} FlkHostAllocator;

/* Version of the library that is linked: major << 22 | minor << 12 | patch. Any thread. */
FLK_API uint32_t flkGetVersion(void);

/* Name of a result, for example "FLK_ERROR_MALFORMED"; "unknown" for any other number. Never NULL. Any thread. */
FLK_API const char* flkResultName(FlkResult result);

#ifdef __cplusplus
}
#endif
#endif
