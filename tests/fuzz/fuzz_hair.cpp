#include "fuzz_asset.h"

// Takes the bytes as they are: what begins with none of the magics goes through the recognition of other formats.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  asset_test::fuzzAsset(data, size);
  return 0;
}
