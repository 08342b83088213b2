// Every allocation of the test program that links counted_memory.cpp, so that what reading takes is known, and that a large one may be
// refused: small ones are those of trees of JSON, whose destructors allocate and cannot fail. SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

constexpr size_t kLarge = 16'384;  // bytes

struct CountedMemory {
  size_t live = 0, peak = 0;  // bytes
  size_t large = 0;           // large allocations made
  size_t refuse = SIZE_MAX;   // the large allocation that fails
};
extern CountedMemory counted;
