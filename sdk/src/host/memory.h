// Host memory through the caller's callbacks, as a std::pmr resource, and messages through the caller's function.
// Every container that an API object owns takes its memory from here, so that the host sees every byte and a refused
// allocation becomes std::bad_alloc, which the C boundary turns into FLK_ERROR_OUT_OF_HOST_MEMORY.
#pragma once

#include "forelock/forelock.h"

#include <cstdarg>
#include <cstddef>
#include <memory_resource>
#include <new>
#include <utility>

namespace forelock {

class HostMemory final : public std::pmr::memory_resource {
public:
  // nullptr selects malloc and free. Throws nothing.
  explicit HostMemory(const FlkHostAllocator* callbacks) noexcept;

  // An allocator with one function of two is a caller's mistake.
  static bool valid(const FlkHostAllocator* callbacks) noexcept;

  // One object of this memory; destroy() undoes it. Throws std::bad_alloc.
  template <class T, class... Args> T* create(Args&&... args) {
    void* memory = allocate(sizeof(T), alignof(T));
    try {
      return ::new (memory) T(std::forward<Args>(args)...);
    } catch (...) {
      deallocate(memory, sizeof(T), alignof(T));
      throw;
    }
  }
  template <class T> void destroy(T* object) noexcept {
    if (!object) return;
    object->~T();
    deallocate(object, sizeof(T), alignof(T));
  }

private:
  void* do_allocate(std::size_t size, std::size_t alignment) override;
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override;
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

  FlkHostAllocator callbacks_;
};

// Where sentences for people go. Formats into a fixed buffer: saying that memory ran out must not need memory.
class Messages {
public:
  Messages() = default;
  Messages(FlkMessageFunction function, void* user) : function_(function), user_(user) {}
  void say(uint32_t severity, const char* id, const char* format, ...) const noexcept __attribute__((format(printf, 4, 5)));

private:
  FlkMessageFunction function_ = nullptr;
  void* user_ = nullptr;
};

}  // namespace forelock
