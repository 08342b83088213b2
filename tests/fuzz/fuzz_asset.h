// One run of a fuzz target: load, check what asset.h promises, save in every format and load that again.
#pragma once

#include "asset_invariants.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace asset_test {

inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

struct FuzzMessages {
  unsigned errors = 0;
  static void receive(void* user, const FlkMessage* message) {
    static_cast<FuzzMessages*>(user)->errors += message->severity == FLK_SEVERITY_ERROR;
    require(std::strncmp(message->text, "fuzzed: ", 8) == 0 && message->text[8], "a message names the file");
    require(message->id && *message->id, "a message has an id");
    require(isSentence(message->text), "a message is UTF-8");
  }
};

inline void fuzzAsset(const unsigned char* bytes, size_t size, uint32_t points_per_strand = 0) {
  FuzzMessages messages;
  FlkAssetOptions options{};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.message = FuzzMessages::receive;
  options.message_user = &messages;
  options.name = "fuzzed";
  options.points_per_strand = points_per_strand;
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetLoadMemory(bytes, size, &options, &asset);
  require((result == FLK_SUCCESS) == (asset != nullptr), "an asset on success only");
  require((result == FLK_SUCCESS) == (messages.errors == 0), "one sentence for a refusal, none for a success");
  if (!asset) return;
  const char* broken = brokenPromise(asset);
  if (!broken) broken = brokenRoundTrip(asset);
  require(!broken, broken ? broken : "");
  flkAssetDestroy(asset);
}

}  // namespace asset_test
