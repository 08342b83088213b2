// Arguments of the rig functions, files, and damage in every place.
#include "rig_kit.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

using namespace asset_test;

namespace {

Bytes skin() {
  Bytes file;
  file.bytes = smallTfxbone();
  return file;
}

Bytes mesh() { return Bytes().text(smallTfxmesh()); }

FlkRigOptions rigOptions(Caught& caught) {
  FlkRigOptions options{};
  options.type = FLK_TYPE_RIG_OPTIONS;
  options.message = Caught::receive;
  options.message_user = &caught;
  options.name = "args";
  return options;
}

}  // namespace

TEST(RigArguments, OptionsAndNulls) {
  const Bytes file = skin();
  Caught caught;
  FlkRig rig = reinterpret_cast<FlkRig>(&caught);
  FlkRigOptions options = rigOptions(caught);
  options.type = FLK_TYPE_ASSET_OPTIONS;
  EXPECT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, &rig), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(rig, nullptr);
  EXPECT_TRUE(caught.all.empty()) << "nothing of a wrong struct is used";
  options = rigOptions(caught);
  options.next = &options;
  EXPECT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, &rig), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(caught.text().find("FlkRigOptions.next"), std::string::npos);
  CountingAllocator counter;
  FlkHostAllocator half = counter.callbacks();
  half.free = nullptr;
  options = rigOptions(caught);
  options.allocator = &half;
  EXPECT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, &rig), FLK_ERROR_INVALID_ARGUMENT);
  options = rigOptions(caught);
  EXPECT_EQ(flkRigLoadMemory(nullptr, 1, &options, &rig), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigLoadFile(nullptr, &options, &rig), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(caught.all.size(), 5u) << caught.text();
  EXPECT_EQ(flkRigLoadMemory(nullptr, 0, nullptr, &rig), FLK_ERROR_FORMAT_UNKNOWN);

  FlkRigInfo info;
  FlkRigArrays arrays;
  FlkFinding finding;
  EXPECT_EQ(flkRigGetInfo(nullptr, &info), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigGetArrays(nullptr, &arrays), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigGetFinding(nullptr, 0, &finding), FLK_ERROR_INVALID_ARGUMENT);
  flkRigDestroy(nullptr);
  ASSERT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), nullptr, &rig), FLK_SUCCESS);
  const OwnedRig owned(rig);
  EXPECT_EQ(flkRigGetInfo(rig, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigGetArrays(rig, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigGetFinding(rig, 0, nullptr), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(flkRigGetFinding(rig, UINT32_MAX, &finding), FLK_ERROR_INVALID_ARGUMENT);
}

TEST(RigArguments, Files) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("forelock_rig_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()));
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const Bytes& bytes) {
    std::ofstream(folder / name, std::ios::binary).write(reinterpret_cast<const char*>(bytes.bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return (folder / name).string();
  };
  const auto loadFile = [](const std::string& path, std::string& said) {
    Caught caught;
    FlkRigOptions options = rigOptions(caught);
    options.name = nullptr;
    FlkRig rig = nullptr;
    const FlkResult result = flkRigLoadFile(path.c_str(), &options, &rig);
    flkRigDestroy(rig);
    said = caught.text();
    return result;
  };
  std::string said;
  EXPECT_EQ(loadFile(write("a.tfxbone", skin()), said), FLK_SUCCESS) << said;
  EXPECT_EQ(loadFile(write("a.tfxmesh", mesh()), said), FLK_SUCCESS) << said;
  EXPECT_EQ(loadFile((folder / "none.tfxbone").string(), said), FLK_ERROR_IO);
  EXPECT_NE(said.find("none.tfxbone: cannot be opened"), std::string::npos) << said;
  EXPECT_EQ(loadFile(folder.string(), said), FLK_ERROR_IO);
  EXPECT_EQ(loadFile(write("hair.tfxbone", smallHair()), said), FLK_ERROR_FORMAT_UNKNOWN);
  EXPECT_NE(said.find("STRANDS_NOT_RIG"), std::string::npos) << said;
  std::filesystem::remove_all(folder);
}

TEST(RigArguments, ReportsTheMemoryItHolds) {
  for (const Bytes& file : {skin(), mesh()}) {
    CountingAllocator counter;
    const FlkHostAllocator allocator = counter.callbacks();
    Caught caught;
    FlkRigOptions options = rigOptions(caught);
    options.allocator = &allocator;
    options.name = "a name that is too long to be kept inside a string object";
    FlkRig rig = nullptr;
    ASSERT_EQ(flkRigLoadMemory(file.bytes.data(), file.size(), &options, &rig), FLK_SUCCESS);
    FlkRigInfo info;
    flkRigGetInfo(rig, &info);
    EXPECT_NEAR(static_cast<double>(info.bytes_host), static_cast<double>(counter.live_bytes), 64.0);
    flkRigDestroy(rig);
    EXPECT_EQ(counter.live, 0u);
  }
}

TEST(RigMutation, TruncatedAtEveryLength) {
  for (size_t length = 0; length < skin().size(); ++length) EXPECT_NE(loadRig(skin().cut(length))->result, FLK_SUCCESS) << length;
  // The last line feed may be missing.
  for (size_t length = 0; length + 1 < mesh().size(); ++length) EXPECT_NE(loadRig(mesh().cut(length))->result, FLK_SUCCESS) << length;
}

TEST(RigMutation, EveryByteAndWordReplaced) {
  const auto hair = load(smallTfx());
  for (const Bytes& seed : {skin(), mesh()})
    for (size_t at = 0; at < seed.size(); ++at) {
      const unsigned char old = seed.bytes[at];
      for (const int value : {0x00, 0x01, 0x7f, 0x80, 0xff, old ^ 0x01, old ^ 0x80, old + 1, old - 1, int{' '}, int{'#'}, int{'\n'}, int{'-'}, int{'9'}}) {
        Bytes damaged = seed;
        damaged.bytes[at] = static_cast<unsigned char>(value);
        loadRig(damaged, at % 2 ? hair->asset.get() : nullptr);
        if (HasFailure()) return;
      }
      for (const uint32_t value : {0u, 1u, 4u, 0x7fffffffu, 0x80000000u, 0xffffffffu, 0x7f800000u, 0x7fc00000u, 0x3f800000u, 0xbf800000u, 0x7f7fffffu}) {
        if (at + 4 > seed.size()) break;
        Bytes damaged = seed;
        loadRig(damaged.setU32(at, value));
        if (HasFailure()) return;
      }
    }
}

TEST(RigMutation, EveryAllocationRefused) {
  Bytes odd = skin();
  odd.setU32(25, 0x746f6f72u).setU32(53, 9).setF32(57, 0.5f).zeros(3);  // "root" twice, and more findings that need sentences
  const auto hair = load(smallTfx());
  for (const Bytes& seed : {skin(), mesh(), odd}) {
    bool completed = false;
    for (size_t refuse = 0; !completed; ++refuse) {
      ASSERT_LT(refuse, 1000u);
      CountingAllocator counter(refuse);
      const FlkHostAllocator allocator = counter.callbacks();
      Caught caught;
      FlkRigOptions options = rigOptions(caught);
      options.allocator = &allocator;
      options.asset = hair->asset.get();
      options.name = "a file whose name is too long for the small string optimisation.tfxbone";
      FlkRig rig = nullptr;
      const FlkResult result = flkRigLoadMemory(seed.bytes.data(), seed.size(), &options, &rig);
      completed = !counter.refused;
      EXPECT_EQ(result, completed ? FLK_SUCCESS : FLK_ERROR_OUT_OF_HOST_MEMORY) << refuse;
      if (!completed) {
        EXPECT_EQ(rig, nullptr);
        EXPECT_EQ(caught.error(), "OUT_OF_HOST_MEMORY");
      } else {
        EXPECT_GT(refuse, 5u);
      }
      flkRigDestroy(rig);
      EXPECT_EQ(counter.live, 0u) << refuse;
      EXPECT_EQ(counter.live_bytes, 0u);
    }
  }
}
