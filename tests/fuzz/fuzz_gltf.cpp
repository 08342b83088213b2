// glTF is read by the tools, not by the library: read it, then make an asset of it as they do.
#include "asset_invariants.h"
#include "fuzz_asset.h"
#include "gltf_reader.h"

#include <algorithm>

namespace {

using asset_test::require;

void put(unsigned char* to, size_t value) {
  for (int i = 0; i < 4; ++i) to[i] = static_cast<unsigned char>(value >> (8 * i));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace forelock::samples;
  std::vector<unsigned char> bytes(data, data + size);
  // Lengths that agree, so that no time goes into finding them: of the file, and of the last chunk.
  if (size >= 28 && std::memcmp(data, "glTF", 4) == 0) {
    put(&bytes[8], size);
    const size_t json = bytes[12] | size_t{bytes[13]} << 8;
    if (20 + json + 8 <= size) put(&bytes[20 + json], size - 28 - json);
  }
  GltfStrands read;
  try {
    read = readGltf(std::move(bytes), "fuzzed", "");
  } catch (const GltfError& error) {
    require(std::strncmp(error.what(), "fuzzed: ", 8) == 0 && error.what()[8], "a refusal names the file");
    require(error.id.rfind("GLTF_", 0) == 0 && error.result != FLK_SUCCESS, "a refusal has an id");
    return 0;
  }
  const uint32_t strands = read.strands.strands();
  require(strands > 0 && read.groups.size() == strands, "a group for each strand");
  require(std::all_of(read.groups.begin(), read.groups.end(), [&](uint32_t group) { return group < read.group_names.size(); }), "groups have names");
  for (const AssetFinding& finding : read.findings)
    require(finding.count > 0 && std::all_of(finding.strands.begin(), finding.strands.end(), [&](uint32_t strand) { return strand < strands; }),
            "findings are about strands that there are");
  const FlkStrands view = read.strands.view();
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetCreate(&view, nullptr, &asset);
  require(result == FLK_SUCCESS || result == FLK_ERROR_EMPTY_ASSET, "its arrays are those of an asset");
  if (!asset) return 0;
  const char* broken = asset_test::brokenPromise(asset);
  require(!broken, broken ? broken : "");
  flkAssetDestroy(asset);
  return 0;
}
