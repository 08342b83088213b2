// A file of its own, so that the compiler does not look into operators that it knows. SPDX-License-Identifier: MIT
#include "counted_memory.h"

#include <algorithm>
#include <cstdlib>
#include <malloc.h>
#include <new>

CountedMemory counted;

namespace {

void* allocate(size_t size) {
  if (size >= kLarge && counted.large++ == counted.refuse) return nullptr;
  void* memory = std::malloc(size);
  counted.live += memory ? malloc_usable_size(memory) : 0;
  counted.peak = std::max(counted.peak, counted.live);
  return memory;
}

void release(void* memory) {
  if (memory) counted.live -= std::min(counted.live, malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace

void* operator new(size_t size) {
  if (void* memory = allocate(size)) return memory;
  throw std::bad_alloc();
}
void* operator new[](size_t size) { return operator new(size); }
void* operator new(size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void* operator new[](size_t size, const std::nothrow_t&) noexcept { return allocate(size); }
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, size_t) noexcept { release(memory); }
void operator delete[](void* memory, size_t) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
