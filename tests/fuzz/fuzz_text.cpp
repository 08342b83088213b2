#include "fuzz_asset.h"

// The first word is set, so that no time goes into finding it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  if (size >= 8) std::memcpy(bytes.data(), "version ", 8);
  asset_test::fuzzAsset(bytes.data(), bytes.size());
  return 0;
}
