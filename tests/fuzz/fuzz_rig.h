// One run of a fuzz target of rigs: load, check what rig.h promises, alone and with hair.
#pragma once

#include "fuzz_asset.h"
#include "rig_invariants.h"

namespace asset_test {

// Three strands, of which the second is dropped.
inline FlkAsset gappyHair() {
  static const FlkAsset asset = [] {
    const uint32_t first[] = {0, 2, 4, 6};
    float positions[18] = {};
    for (int i = 0; i < 18; ++i) positions[i] = 0.125f * static_cast<float>(i);
    positions[6] = NAN;
    const FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 3, 6, first, positions, nullptr, nullptr, nullptr, nullptr};
    FlkAsset made = nullptr;
    flkAssetCreate(&strands, nullptr, &made);
    return made;
  }();
  return asset;
}

inline void fuzzRig(const unsigned char* bytes, size_t size) {
  for (const FlkAsset hair : {FlkAsset{}, gappyHair()}) {
    FuzzMessages messages;
    FlkRigOptions options{};
    options.type = FLK_TYPE_RIG_OPTIONS;
    options.message = FuzzMessages::receive;
    options.message_user = &messages;
    options.name = "fuzzed";
    options.asset = hair;
    FlkRig rig = nullptr;
    const FlkResult result = flkRigLoadMemory(bytes, size, &options, &rig);
    require((result == FLK_SUCCESS) == (rig != nullptr), "a rig on success only");
    require((result == FLK_SUCCESS) == (messages.errors == 0), "one sentence for a refusal, none for a success");
    if (!rig) return;
    const char* broken = brokenRigPromise(rig);
    require(!broken, broken ? broken : "");
    FlkRigInfo info;
    flkRigGetInfo(rig, &info);
    require(!hair || info.kind != FLK_RIG_SKIN || info.record_count == 2, "a skin has the strands of its hair");
    flkRigDestroy(rig);
  }
}

}  // namespace asset_test
