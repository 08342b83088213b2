#include "fuzz_rig.h"

// The first word is set, so that no time goes into finding it.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<unsigned char> bytes(data, data + size);
  if (size >= 11) std::memcpy(bytes.data(), "numOfBones ", 11);
  asset_test::fuzzRig(bytes.data(), bytes.size());
  return 0;
}
