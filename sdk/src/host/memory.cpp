#include "host/memory.h"

#include <cstdio>
#include <cstdlib>

namespace forelock {
namespace {

void* defaultAllocate(void*, std::size_t size, std::size_t alignment) {
  if (alignment <= alignof(std::max_align_t)) return std::malloc(size ? size : 1);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void defaultFree(void*, void* memory, std::size_t, std::size_t) { std::free(memory); }

}  // namespace

HostMemory::HostMemory(const FlkHostAllocator* callbacks) noexcept
    : callbacks_(callbacks && callbacks->allocate ? *callbacks
                                                  : FlkHostAllocator{nullptr, defaultAllocate, defaultFree}) {}

bool HostMemory::valid(const FlkHostAllocator* callbacks) noexcept {
  return !callbacks || (callbacks->allocate == nullptr) == (callbacks->free == nullptr);
}

void* HostMemory::do_allocate(std::size_t size, std::size_t alignment) {
  void* memory = callbacks_.allocate(callbacks_.user, size, alignment);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void HostMemory::do_deallocate(void* memory, std::size_t size, std::size_t alignment) {
  if (memory) callbacks_.free(callbacks_.user, memory, size, alignment);
}

void Messages::say(uint32_t severity, const char* id, const char* format, ...) const noexcept {
  if (!function_) return;
  char text[1024];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  const FlkMessage message{severity, id, text};
  function_(user_, &message);
}

}  // namespace forelock
