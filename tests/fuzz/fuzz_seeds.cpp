// fuzz_seeds tfx|hair|text|data|ply|cooked|bone|mesh|gltf FOLDER: a few small files to start from, written by the SDK itself, with extra arrays added by
// hand; what the SDK does not write, by hand altogether.
#include "asset_invariants.h"
#include "gltf_files.h"
#include "rig_files.h"
#include "text_files.h"

#include <cstdio>
#include <filesystem>
#include <string>

namespace {

bool put(const std::filesystem::path& path, const std::vector<unsigned char>& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && whole;
}

void setU32(std::vector<unsigned char>& bytes, size_t at, size_t value) {
  for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<unsigned char>(value >> (8 * i));
}

FlkAsset makeAsset(bool equal_counts) {
  const uint32_t equal[] = {0, 4, 8}, unequal[] = {0, 3, 8};
  float positions[24], values[8];
  for (int i = 0; i < 24; ++i) positions[i] = 0.125f * static_cast<float>((i * 7) % 24);
  for (int i = 0; i < 8; ++i) values[i] = 0.25f * static_cast<float>(i % 4);
  float colors[24];
  for (int i = 0; i < 24; ++i) colors[i] = 0.125f * static_cast<float>(i % 9);
  const FlkStrands strands{FLK_TYPE_STRANDS, nullptr, 2,      8,      equal_counts ? equal : unequal,
                           positions,        values,  values, values, colors};
  FlkAsset asset = nullptr;
  flkAssetCreate(&strands, nullptr, &asset);
  return asset;
}

std::vector<unsigned char> tfx3(bool all_arrays) {
  constexpr size_t strands = 2, vertices = 4, header = 296;
  std::vector<unsigned char> bytes(header + strands * vertices * 12);
  bytes[2] = bytes[3] = 0x40;
  setU32(bytes, 4, strands);
  setU32(bytes, 8, vertices);
  setU32(bytes, 16, 1);
  setU32(bytes, 144, header);
  for (size_t i = 0; i < strands * vertices; ++i) setU32(bytes, header + i * 12, 0x3f000000 + i * 0x100000);
  constexpr struct {
    size_t field, bytes;
  } blocks[] = {{148, strands * 4}, {152, strands * 8}, {156, strands * vertices * 16}, {160, strands * 4},
                {164, strands * vertices * 8}};
  for (const auto& block : blocks) {
    if (!all_arrays) break;
    setU32(bytes, block.field, bytes.size());
    bytes.resize(bytes.size() + block.bytes);
  }
  return bytes;
}

std::vector<unsigned char> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

std::vector<unsigned char> strandData(size_t floats) {
  std::vector<unsigned char> bytes(4);
  setU32(bytes, 0, 3);
  for (const size_t points : {2u, 1u, 3u}) {
    const size_t at = bytes.size();
    bytes.resize(at + 4 + points * floats * 4);
    setU32(bytes, at, points);
    for (size_t i = 0; i < points * floats; ++i) setU32(bytes, at + 4 + i * 4, 0x3f000000 + i * 0x100000);
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string kind = argv[1];
  const bool tfx = kind == "tfx";
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder);
  if (kind == "text") return put(folder / "text", bytesOf(asset_test::smallTfxText())) ? 0 : 1;
  if (kind == "data") return put(folder / "narrow", strandData(3)) && put(folder / "wide", strandData(7)) ? 0 : 1;
  if (kind == "gltf") {
    const std::vector<unsigned char> bytes = asset_test::gltfBytes();
    const auto glb = [&](const char* primitives, const char* more = "") { return asset_test::glbOf(asset_test::gltfJson(primitives, more), bytes); };
    std::string text = asset_test::gltfJson(R"([{"attributes":{"POSITION":0},"mode":3}])");
    text.insert(text.find(R"("byteLength":96)"), R"("uri":"data:application/octet-stream;base64,)" + std::string(128, 'A') + "\",");
    const bool written = put(folder / "lines", glb(R"([{"attributes":{"POSITION":0,"_WIDTH":3},"indices":1,"mode":1}])")) &&
                         put(folder / "strips", glb(R"([{"attributes":{"POSITION":0},"indices":4,"mode":3},{"attributes":{"POSITION":5},"mode":2}])",
                                                    R"(,"extensionsRequired":["KHR_mesh_primitive_restart"])")) &&
                         put(folder / "quantised", glb(R"([{"attributes":{"POSITION":2,"COLOR_0":2},"mode":1}])")) && put(folder / "text", bytesOf(text));
    return written ? 0 : 1;
  }
  if (kind == "mesh") {
    // As the target sets its first bytes.
    const std::string text = asset_test::smallTfxmesh();
    return put(folder / "mesh", bytesOf(text.substr(text.find("numOfBones")))) ? 0 : 1;
  }
  if (kind == "bone") {
    std::vector<unsigned char> odd = asset_test::smallTfxbone();
    setU32(odd, 53, 0xffffffff);                    // a bone of -1
    setU32(odd, 49 + 36 + 8, 0x3e4ccccd);           // weights that make 0.7
    odd.resize(odd.size() + 3);
    return put(folder / "skin", asset_test::smallTfxbone()) && put(folder / "odd", odd) ? 0 : 1;
  }
  if (kind == "ply") {
    FlkAsset asset = makeAsset(false);
    FlkResult result = FLK_SUCCESS;
    const std::vector<unsigned char> bytes = asset_test::saved(asset, FLK_FORMAT_PLY, result);
    flkAssetDestroy(asset);
    const std::string points = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                               "0 0 0\n0 1 0\n1 0 0\n1 1 0\n";
    return result == FLK_SUCCESS && put(folder / "points", bytesOf(points)) && put(folder / "ascii", bytesOf(asset_test::smallPlyText())) && put(folder / "written", bytes) ? 0 : 1;
  }
  if (kind == "cooked") {
    // One with every array, one with findings.
    std::vector<unsigned char> defective = bytesOf(asset_test::smallPlyText() + "0 0 0");
    FlkAsset assets[2] = {makeAsset(false), nullptr};
    flkAssetLoadMemory(defective.data(), defective.size(), nullptr, &assets[1]);
    bool all = true;
    for (FlkAsset asset : assets) {
      FlkResult result = FLK_ERROR_IO;
      const std::vector<unsigned char> bytes = asset ? asset_test::saved(asset, FLK_FORMAT_COOKED, result) : std::vector<unsigned char>();
      all = all && result == FLK_SUCCESS && put(folder / (asset == assets[0] ? "all-arrays" : "findings"), bytes);
      flkAssetDestroy(asset);
    }
    return all ? 0 : 1;
  }
  bool written = !tfx || (put(folder / "version-3", tfx3(false)) && put(folder / "version-3-all-arrays", tfx3(true)));
  for (const bool equal : {true, false}) {
    FlkAsset asset = makeAsset(equal);
    FlkResult result = FLK_SUCCESS;
    std::vector<unsigned char> bytes = asset_test::saved(asset, tfx ? FLK_FORMAT_TFX : FLK_FORMAT_HAIR, result);
    flkAssetDestroy(asset);
    if (result == FLK_ERROR_LIMIT) continue;  // a .tfx file holds no unequal counts
    const std::string name = equal ? "equal" : "unequal";
    written = written && result == FLK_SUCCESS && put(folder / name, bytes);
    if (tfx) {
      for (const size_t field : {24u, 20u, 28u}) {
        setU32(bytes, field, bytes.size());
        bytes.resize(bytes.size() + (field == 24 ? 8 : field == 20 ? 64 : 128));
      }
    } else {
      bytes[12] |= 0x28;  // the SDK wrote the colours
      bytes.resize(bytes.size() + 8 * (4 + 8));
    }
    written = written && put(folder / (name + "-all-arrays"), bytes);
  }
  return written ? 0 : 1;
}
