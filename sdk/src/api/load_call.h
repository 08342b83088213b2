// What loading calls have in common: options are checked, memory runs out, and a handle is given or none.
#pragma once

#include "api/boundary.h"
#include "asset/report.h"
#include "host/memory.h"

#include <algorithm>
#include <string_view>

namespace forelock {

inline FlkResult invalid(const Report& report, const char* what) {
  return report.fail(FLK_ERROR_INVALID_ARGUMENT, "INVALID_ARGUMENT", "%s", what);
}

inline uint32_t limitOr(uint32_t asked, uint32_t largest) { return asked == 0 ? largest : std::min(asked, largest); }

struct LoadCall {
  uint32_t type;            // of the options
  const char* struct_name;
  const char* noun;         // what is loaded, and what messages call it without a name
};

// What options come to that all of them have.
struct LoadBase {
  HostMemory memory;
  Messages messages;
  std::string_view name;
};

// Checks `options` (FlkAssetOptions, FlkRigOptions), says what is wrong with them, and runs `body(options, base, report, made)`.
template <class Pointer, class Options, class Handle, class Body>
FlkResult loadWith(const LoadCall& call, const Options* options, const char* default_name, Handle* handle, Body&& body) noexcept {
  if (handle) *handle = nullptr;
  Options none{};
  none.type = call.type;
  if (!options) options = &none;
  // Of a struct that is not what it should be nothing is used, its callback least of all.
  if (options->type != call.type) return FLK_ERROR_INVALID_ARGUMENT;

  const char* name = options->name ? options->name : default_name ? default_name : call.noun;
  LoadBase base{HostMemory(nullptr), Messages(options->message, options->message_user), name};
  const Report report(base.messages, base.name);
  if (options->next)
    return report.fail(FLK_ERROR_INVALID_ARGUMENT, "INVALID_ARGUMENT", "%s.next is reserved and has to be NULL", call.struct_name);
  if (!HostMemory::valid(options->allocator))
    return invalid(report, "FlkHostAllocator has one function of two: give allocate and free, or neither");
  if (!handle) return report.fail(FLK_ERROR_INVALID_ARGUMENT, "INVALID_ARGUMENT", "the place for the new %s is NULL", call.noun);
  base.memory = HostMemory(options->allocator);

  Pointer made;
  const FlkResult result = guarded([&] { return body(*options, base, report, made); });
  if (result == FLK_ERROR_OUT_OF_HOST_MEMORY)
    return report.fail(result, "OUT_OF_HOST_MEMORY", "the host's allocator refused memory: nothing was loaded");
  if (result == FLK_SUCCESS) *handle = made.release();
  return result;
}

}  // namespace forelock
