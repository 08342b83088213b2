#include "host_memory.h"

#include <cstdlib>
#include <cstring>

HostMemory::HostMemory()
    : callbacks{this,
                [](void* user, size_t size, size_t alignment) {
                  return static_cast<HostMemory*>(user)->allocate(size, alignment);
                },
                [](void* user, void* memory, size_t size, size_t alignment) {
                  static_cast<HostMemory*>(user)->free(memory, size, alignment);
                }} {}

HostMemory::~HostMemory() {
  for (const auto& [memory, block] : blocks_) std::free(memory);
}

void* HostMemory::allocate(size_t size, size_t alignment) {
  if (++allocations == fail_at) {
    failed = true;
    return nullptr;
  }
  if (size == 0) breaches.push_back("allocate: no size");
  if (alignment == 0 || (alignment & (alignment - 1)) != 0)
    breaches.push_back("allocate: the alignment is no power of two");
  const size_t unit = alignment < sizeof(void*) ? sizeof(void*) : alignment;
  void* memory = std::aligned_alloc(unit, (size + unit) / unit * unit);
  std::memset(memory, 0xCD, size);  // whoever reads it before writing to it should notice
  blocks_[memory] = {size, alignment};
  live_bytes += size;
  return memory;
}

void HostMemory::free(void* memory, size_t size, size_t alignment) {
  const auto block = blocks_.find(memory);
  if (block == blocks_.end()) {
    breaches.push_back("free: of memory that is not given out");
    return;
  }
  if (block->second.size != size || block->second.alignment != alignment)
    breaches.push_back("free: size or alignment differs from the allocation's");
  std::memset(memory, 0xDD, block->second.size);
  live_bytes -= block->second.size;
  std::free(memory);
  blocks_.erase(block);
}
