#include "fuzz_asset.h"

// The version is set, so that no time goes into finding it; sniffing is reached by the unit tests and by fuzz_hair. The
// third byte is what tells 3.0 from 4.0.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  const unsigned char version[4] = {0x00, 0x00, static_cast<unsigned char>(size >= 4 && data[2] == 0x40 ? 0x40 : 0x80), 0x40};
  if (size >= 4) std::memcpy(bytes.data(), version, 4);
  asset_test::fuzzAsset(bytes.data(), bytes.size());
  return 0;
}
