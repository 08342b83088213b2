// Host memory that is counted: what is given back must have been given out, with the same size and alignment.
#pragma once

#include <forelock/forelock.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

class HostMemory {
public:
  HostMemory();
  ~HostMemory();
  HostMemory(const HostMemory&) = delete;
  HostMemory& operator=(const HostMemory&) = delete;

  FlkHostAllocator callbacks;
  uint64_t allocations = 0;  // so far, refused ones counted in
  uint64_t fail_at = 0;      // the allocation that is refused, counted from 1; 0: none
  bool failed = false;
  std::vector<std::string> breaches;
  size_t live() const { return blocks_.size(); }
  size_t live_bytes = 0;

private:
  struct Block {
    size_t size, alignment;
  };
  void* allocate(size_t size, size_t alignment);
  void free(void* memory, size_t size, size_t alignment);
  std::map<void*, Block> blocks_;
};
