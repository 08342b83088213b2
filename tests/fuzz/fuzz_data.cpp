#include "fuzz_asset.h"

// The upper bytes of both counts are cleared, so that what follows is read as strands.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  for (const size_t at : {1u, 2u, 3u, 5u, 6u, 7u})
    if (at < size) bytes[at] = 0;
  asset_test::fuzzAsset(bytes.data(), bytes.size());
  return 0;
}
