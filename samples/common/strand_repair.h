// Mends what findings name, each by its code, and says what it changed. SPDX-License-Identifier: MIT
#pragma once

#include "asset_source.h"
#include "strand_edit.h"

#include <string>
#include <vector>

namespace forelock::samples {

// What can be done about a finding after loading.
struct RepairKind {
  const char* code;
  bool unasked;  // takes away only what draws nothing or twice, and is done unless others are named
  const char* what;
};
const std::vector<RepairKind>& repairKinds();

struct Repair {
  std::string code, what;
  uint64_t count = 0;  // strands or vertices
};

// Does what `codes` name, as far as `findings` say that it is needed, in the order of repairKinds(). A code that is none of them
// throws std::invalid_argument, which names those there are.
std::vector<Repair> repairStrands(EditableStrands& strands, const FlkAssetInfo& info, const std::vector<AssetFinding>& findings,
                                  const std::vector<std::string>& codes);

// What loading has changed already.
std::vector<Repair> repairsOnLoading(const std::vector<AssetFinding>& findings);

}  // namespace forelock::samples
