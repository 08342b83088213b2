// The C boundary: nothing that is thrown inside crosses it.
#pragma once

#include "forelock/forelock.h"

#include <utility>

namespace forelock {

// Runs `body`, which returns an FlkResult. The one thing that the SDK's own code throws is std::bad_alloc (or
// std::length_error from a container asked for more than it could ever hold, which comes to the same); a host's allocator
// written in C++ might throw something else.
template <class Body> FlkResult guarded(Body&& body) noexcept {
  try {
    return std::forward<Body>(body)();
  } catch (...) {
    return FLK_ERROR_OUT_OF_HOST_MEMORY;
  }
}

}  // namespace forelock
