// The object behind FlkRig: what rig.h promises, what is known about it, and where it lives.
#pragma once

#include "asset/rig_arrays.h"
#include "host/memory.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>

struct FlkRig_T {
  FlkRig_T(const forelock::HostMemory& host, std::string_view called)
      : memory(host), name(called, &memory), arrays(&memory), findings(&memory) {}
  FlkRig_T(const FlkRig_T&) = delete;
  FlkRig_T& operator=(const FlkRig_T&) = delete;

  forelock::HostMemory memory;  // first: everything below lives in it
  std::pmr::string name;
  forelock::RigArrays arrays;
  forelock::Findings findings;
  FlkRigInfo info{};
};

namespace forelock {

struct RigDeleter {
  void operator()(FlkRig_T* rig) const noexcept;
};
using RigPointer = std::unique_ptr<FlkRig_T, RigDeleter>;

// What the options of a call come to once they are checked.
struct RigSettings {
  HostMemory memory;
  Messages messages;
  std::string_view name;
  RigLimits limits;
  const FlkAsset_T* asset;  // nullptr: none
};

// Leaves `rig` empty on failure, having said why. Throws std::bad_alloc.
FlkResult readRig(std::span<const std::byte> bytes, const RigSettings& settings, RigPointer& rig);

}  // namespace forelock
