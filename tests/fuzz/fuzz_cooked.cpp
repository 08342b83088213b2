#include "cooked_seal.h"
#include "fuzz_asset.h"

// The magic, the version, the size and all checksums are set: whoever makes a file can do so too, and a fuzzer cannot.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  if (size >= 24) {
    std::memcpy(bytes.data(), "\x8a" "FLK\r\n\x1a\n\x01\0\0", 12);
    asset_test::putLittleEndian(bytes, 16, size, 8);
    asset_test::sealCooked(bytes);
  }
  asset_test::fuzzAsset(bytes.data(), bytes.size());
  return 0;
}
