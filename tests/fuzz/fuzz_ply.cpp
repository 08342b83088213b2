#include "fuzz_asset.h"

// The first line is set, so that no time goes into finding it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  if (size >= 4) std::memcpy(bytes.data(), "ply\n", 4);
  asset_test::fuzzAsset(bytes.data(), bytes.size());
  asset_test::fuzzAsset(bytes.data(), bytes.size(), 2);
  return 0;
}
