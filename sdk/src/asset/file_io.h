// Whole files, without iostreams: what went wrong has to reach the message, and memory has to come from the host.
#pragma once

#include "asset/report.h"

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace forelock {

// Reads a regular file of at most `largest` bytes. `accept` sees the first bytes before memory for the rest is asked for: a
// film of 40 GB that was picked by mistake is refused at once. Failures are told to `report`. Throws std::bad_alloc.
using AcceptHead = FlkResult (*)(std::span<const std::byte> head, const Report& report);
FlkResult readFile(const char* path, uint64_t largest, const Report& report, AcceptHead accept,
                   std::pmr::vector<std::byte>& bytes);

// Writes a temporary file beside `path` and renames it: a failure leaves what was there. Throws std::bad_alloc.
FlkResult writeFile(const char* path, std::span<const std::byte> bytes, const Report& report,
                    std::pmr::memory_resource* memory);

}  // namespace forelock
