// Which strands of a loaded asset somebody should look at: all of them, where a finding lists the first. SPDX-License-Identifier: MIT
#pragma once

#include <forelock/asset.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace forelock::samples {

enum StrandFault : uint32_t {
  kFaultMicro = 0,        // shorter than 1/10,000 of the median length, as STRAND_MICRO
  kFaultSegment = 1,      // equal consecutive vertices, as SEGMENT_ZERO_LENGTH
  kFaultTurn = 2,         // turns by more than 120 degrees in a vertex
  kFaultDuplicate = 3,    // the same positions as an earlier strand
  kFaultWidth = 4,        // width 0 from root to tip
  kFaultRootUv = 5,       // root UV outside 0..1 where most are inside: with UDIM tiles or wrapping most are not
  kStrandFaultCount = 6
};

struct StrandFaults {
  std::vector<uint8_t> of;  // of each strand the bits 1 << kFault...
  std::array<uint64_t, kStrandFaultCount> counts{};  // strands of each kind
  uint64_t strands = 0;     // with any
};

StrandFaults findStrandFaults(const FlkStrands& strands);

// "shorter than 1/10,000 of the median": goes on after "a strand".
const char* faultWord(StrandFault kind);

// "3 strands: 2 shorter than 1/10,000 of the median, 1 with equal consecutive vertices"; "none" where there are none.
std::string describeFaults(const StrandFaults& faults);

}  // namespace forelock::samples
