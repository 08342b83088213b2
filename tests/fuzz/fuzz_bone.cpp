#include "fuzz_rig.h"

// The upper bytes of the count of bones are cleared, so that names are reached.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  for (const size_t at : {1u, 2u, 3u})
    if (at < size) bytes[at] = 0;
  asset_test::fuzzRig(bytes.data(), bytes.size());
  return 0;
}
