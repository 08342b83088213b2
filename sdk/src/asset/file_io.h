// Whole files, without iostreams: what went wrong has to reach the message, and memory has to come from the host.
#pragma once

#include "asset/report.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>
#include <vector>

namespace forelock {

// Bytes of a file in the address space, only to be read. What another process writes into the file may show in them, and
// reading what it has cut off ends the program (SIGBUS): see docs/limits.md.
class Mapping {
public:
  Mapping() noexcept = default;
  Mapping(Mapping&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  Mapping& operator=(Mapping&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Mapping();

  // The first `size` bytes of an open file. False: the system refused, most likely because the file system maps no files.
  bool map(int fd, uint64_t size) noexcept;
  std::span<const std::byte> bytes() const noexcept { return bytes_; }

private:
  std::span<const std::byte> bytes_;
};

// A file's bytes: mapped, or copied into memory of the host.
struct FileBytes {
  explicit FileBytes(std::pmr::memory_resource* memory) noexcept : copy(memory) {}
  std::span<const std::byte> bytes() const noexcept { return mapping.bytes().empty() ? std::span<const std::byte>(copy) : mapping.bytes(); }

  Mapping mapping;
  std::pmr::vector<std::byte> copy;
};

// Opens a regular file of at most `largest` bytes; maps it unless `must_copy`. `accept` sees the first bytes before anything is
// asked for the rest: a film of 40 GB that was picked by mistake is refused at once. Failures are told to `report`. Throws
// std::bad_alloc.
using AcceptHead = FlkResult (*)(std::span<const std::byte> head, const Report& report);
FlkResult readFile(const char* path, uint64_t largest, bool must_copy, const Report& report, AcceptHead accept, FileBytes& file);

// Writes a temporary file beside `path` and renames it: a failure leaves what was there. Throws std::bad_alloc.
FlkResult writeFile(const char* path, std::span<const std::byte> bytes, const Report& report,
                    std::pmr::memory_resource* memory);

}  // namespace forelock
