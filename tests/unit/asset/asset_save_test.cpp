#include "asset_kit.h"
#include "temporary_folder.h"

#include <cstdio>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace asset_test;

namespace {

std::vector<unsigned char> contents(const std::string& path) {
  std::vector<unsigned char> bytes;
  if (std::FILE* file = std::fopen(path.c_str(), "rb")) {
    unsigned char buffer[4096];
    for (size_t got; (got = std::fread(buffer, 1, sizeof buffer, file)) > 0;)
      bytes.insert(bytes.end(), buffer, buffer + got);
    std::fclose(file);
  }
  return bytes;
}

void writeRaw(const std::string& path, const std::vector<unsigned char>& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  if (!bytes.empty()) std::fwrite(bytes.data(), 1, bytes.size(), file);
  std::fclose(file);
}

FlkResult loadFile(const std::string& path, Loaded& loaded, const FlkHostAllocator* allocator = nullptr) {
  FlkAssetOptions options = optionsFor(loaded.caught, nullptr);
  options.allocator = allocator;
  FlkAsset asset = nullptr;
  loaded.result = flkAssetLoadFile(path.c_str(), &options, &asset);
  loaded.asset.reset(asset);
  return loaded.result;
}

}  // namespace

TEST(AssetSave, WhatIsReadIsWrittenAgain) {
  for (const bool uvs : {false, true}) {
    const Bytes tfx = smallTfx(uvs);
    const auto loaded = load(tfx);
    FlkResult result;
    EXPECT_EQ(saved(loaded->asset.get(), FLK_FORMAT_TFX, result), tfx.bytes) << "byte for byte";
  }
  for (const unsigned flags : {2u, 3u, 6u, 7u, 18u, 19u, 22u, 23u}) {
    const auto loaded = load(smallHair(flags));
    EXPECT_EQ(brokenRoundTrip(loaded->asset.get()), nullptr) << flags;
  }
}

TEST(AssetSave, BetweenFormats) {
  const auto tfx = load(smallTfx());
  FlkResult result;
  Bytes hair;
  hair.bytes = saved(tfx->asset.get(), FLK_FORMAT_HAIR, result);
  ASSERT_EQ(result, FLK_SUCCESS);
  EXPECT_NE(tfx->caught.find("WRITE_DROPS_ROOT_UVS"), nullptr);
  EXPECT_NE(tfx->caught.find("WRITE_DROPS_INVERSE_MASSES"), nullptr);
  EXPECT_EQ(tfx->caught.find("WRITE_DROPS_RADII"), nullptr) << "a default width is nothing to lose";
  const auto as_hair = load(hair);
  ASSERT_EQ(as_hair->result, FLK_SUCCESS) << as_hair->caught.text();
  EXPECT_EQ(std::memcmp(as_hair->strands().positions, tfx->strands().positions, 12 * 12), 0);
  EXPECT_EQ(as_hair->info().has_radii, 0u);
  EXPECT_EQ(as_hair->strands().radii[0], tfx->strands().radii[0]);

  Bytes again;
  again.bytes = saved(as_hair->asset.get(), FLK_FORMAT_TFX, result);
  EXPECT_NE(as_hair->caught.find("WRITE_FILLS_INVERSE_MASSES"), nullptr);
  const auto as_tfx = load(again);
  ASSERT_EQ(as_tfx->result, FLK_SUCCESS);
  EXPECT_EQ(std::memcmp(as_tfx->strands().positions, tfx->strands().positions, 12 * 12), 0);
  EXPECT_EQ(as_tfx->strands().inverse_masses[5], 0.0f);
  EXPECT_EQ(as_tfx->strands().inverse_masses[6], 1.0f);
  EXPECT_EQ(as_tfx->strands().root_uvs, nullptr);
}

TEST(AssetSave, WhatAFormatCannotHold) {
  const auto uneven = load(smallHair(7));
  size_t size = 77;
  EXPECT_EQ(flkAssetSaveMemory(uneven->asset.get(), FLK_FORMAT_TFX, nullptr, &size), FLK_ERROR_LIMIT);
  EXPECT_EQ(size, 77u);
  EXPECT_NE(uneven->caught.find("WRITE_TFX_UNEQUAL_COUNTS"), nullptr);

  const auto even = load(smallHair(6));
  FlkResult result;
  saved(even->asset.get(), FLK_FORMAT_TFX, result);
  EXPECT_EQ(result, FLK_SUCCESS);
  EXPECT_NE(even->caught.find("WRITE_DROPS_RADII"), nullptr);
  EXPECT_EQ(even->caught.find("WRITE_DROPS_COLORS"), nullptr);
  EXPECT_NE(even->caught.find("WRITE_TFX_UNUSUAL_COUNT"), nullptr) << "three vertices a strand";

  const auto colored = load(smallHair(18));
  Bytes tfx;
  tfx.bytes = saved(colored->asset.get(), FLK_FORMAT_TFX, result);
  EXPECT_EQ(result, FLK_SUCCESS);
  ASSERT_NE(colored->caught.find("WRITE_DROPS_COLORS"), nullptr);
  EXPECT_EQ(colored->caught.find("WRITE_DROPS_COLORS")->severity, uint32_t{FLK_SEVERITY_WARNING});
  EXPECT_EQ(load(tfx)->strands().colors, nullptr);

  // 65,536 points fit a 16-bit segment count, 65,537 do not.
  for (const uint32_t points : {65'536u, 65'537u}) {
    Bytes file;
    file.text("HAIR").u32(1).u32(points).u32(2).u32(points - 1).zeros(108);
    for (uint32_t point = 0; point < points; ++point) file.f32s({1e-5f * static_cast<float>(point), 0, 0});
    const auto loaded = load(file);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    saved(loaded->asset.get(), FLK_FORMAT_HAIR, result);
    EXPECT_EQ(result, points == 65'536 ? FLK_SUCCESS : FLK_ERROR_LIMIT);
    EXPECT_EQ(loaded->caught.find("WRITE_HAIR_STRAND_TOO_LONG") != nullptr, points == 65'537);
  }
}

TEST(AssetSave, SizesAndFormats) {
  const auto loaded = load(smallTfx());
  size_t size = 0;
  EXPECT_EQ(flkAssetSaveMemory(loaded->asset.get(), FLK_FORMAT_TFX, nullptr, &size), FLK_SUCCESS);
  EXPECT_EQ(size, smallTfx().size());
  std::vector<unsigned char> bytes(size + 8, 0xee);
  size_t capacity = size - 1;
  EXPECT_EQ(flkAssetSaveMemory(loaded->asset.get(), FLK_FORMAT_TFX, bytes.data(), &capacity), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(capacity, size - 1);
  EXPECT_EQ(bytes[0], 0xee);
  capacity = size + 8;
  EXPECT_EQ(flkAssetSaveMemory(loaded->asset.get(), FLK_FORMAT_TFX, bytes.data(), &capacity), FLK_SUCCESS);
  EXPECT_EQ(capacity, size);
  EXPECT_EQ(bytes[size], 0xee);
  for (const uint32_t format : {uint32_t{FLK_FORMAT_UNKNOWN}, 3u, UINT32_MAX})
    EXPECT_EQ(flkAssetSaveMemory(loaded->asset.get(), format, nullptr, &size), FLK_ERROR_INVALID_ARGUMENT);
}

TEST(AssetSave, Files) {
  const Folder folder;
  const std::string path = folder.path + "/out.tfx";
  const auto loaded = load(smallTfx());
  ASSERT_EQ(flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_TFX, path.c_str()), FLK_SUCCESS);
  EXPECT_EQ(contents(path), smallTfx().bytes);
  Loaded again;
  EXPECT_EQ(loadFile(path, again), FLK_SUCCESS);
  // Over an existing file, which keeps its permissions; and in another format.
  ASSERT_EQ(chmod(path.c_str(), 0640), 0);
  EXPECT_EQ(flkAssetSaveFile(again.asset.get(), FLK_FORMAT_HAIR, path.c_str()), FLK_SUCCESS);
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
  EXPECT_EQ(contents(path)[0], 'H');
  EXPECT_EQ(folder.entries().size(), 1u) << "no temporary file stays";
}

TEST(AssetSave, FailuresLeaveTheFileWhole) {
  const Folder folder;
  const std::string path = folder.path + "/kept.tfx";
  writeRaw(path, {1, 2, 3});
  const auto uneven = load(smallHair(7));
  EXPECT_EQ(flkAssetSaveFile(uneven->asset.get(), FLK_FORMAT_TFX, path.c_str()), FLK_ERROR_LIMIT);
  EXPECT_EQ(contents(path).size(), 3u);

  const auto loaded = load(smallTfx());
  const auto save = [&](const std::string& where) {
    return flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_TFX, where.c_str());
  };
  EXPECT_EQ(save(folder.path + "/absent/out.tfx"), FLK_ERROR_IO);
  EXPECT_EQ(loaded->caught.all.back().id, "FILE_NOT_WRITTEN");
  EXPECT_EQ(save(folder.path), FLK_ERROR_IO) << "a directory";
  EXPECT_EQ(save("/dev/null"), FLK_ERROR_IO) << "a device must not be replaced by a file";
  EXPECT_EQ(save(""), FLK_ERROR_IO);
  struct stat status {};
  ASSERT_EQ(stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
  EXPECT_EQ(folder.entries().size(), 1u);
}

TEST(AssetSave, LinksKeepLeadingToTheFile) {
  const Folder folder;
  const std::string file = folder.path + "/file.tfx", link = folder.path + "/link.tfx", lost = folder.path + "/lost.tfx";
  writeRaw(file, {1, 2, 3});
  ASSERT_EQ(symlink(file.c_str(), link.c_str()), 0);
  ASSERT_EQ(symlink((folder.path + "/absent.tfx").c_str(), lost.c_str()), 0);
  const auto loaded = load(smallTfx());
  EXPECT_EQ(flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_TFX, link.c_str()), FLK_SUCCESS);
  struct stat status {};
  ASSERT_EQ(lstat(link.c_str(), &status), 0);
  EXPECT_TRUE(S_ISLNK(status.st_mode));
  EXPECT_GT(contents(file).size(), 3u);
  EXPECT_EQ(flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_TFX, lost.c_str()), FLK_ERROR_IO);
  EXPECT_NE(loaded->caught.all.back().text.find("leads nowhere"), std::string::npos);
  EXPECT_EQ(folder.entries().size(), 3u);
}

TEST(AssetSave, EveryAllocationRefused) {
  const Folder folder;
  const std::string source = folder.path + "/a source file with a name of some length.hair", target = folder.path + "/out.hair";
  writeRaw(source, smallHair(63).bytes);
  bool completed = false;
  for (size_t refuse = 0; !completed; ++refuse) {
    CountingAllocator counter(refuse);
    const FlkHostAllocator allocator = counter.callbacks();
    {
      Loaded loaded;
      FlkResult result = loadFile(source, loaded, &allocator);
      if (result == FLK_SUCCESS) result = flkAssetSaveFile(loaded.asset.get(), FLK_FORMAT_HAIR, target.c_str());
      completed = !counter.refused;
      EXPECT_EQ(result, completed ? FLK_SUCCESS : FLK_ERROR_OUT_OF_HOST_MEMORY) << refuse;
      EXPECT_EQ(folder.entries().size(), completed ? 2u : 1u);
    }
    EXPECT_EQ(counter.live, 0u) << refuse;
  }
}

TEST(AssetSave, FilesThatCannotBeRead) {
  const Folder folder;
  Loaded absent;
  EXPECT_EQ(loadFile(folder.path + "/absent.tfx", absent), FLK_ERROR_IO);
  EXPECT_EQ(absent.caught.error(), "FILE_NOT_OPENED");
  EXPECT_NE(absent.caught.text().find("absent.tfx: cannot be opened: "), std::string::npos);
  Loaded directory;
  EXPECT_EQ(loadFile(folder.path, directory), FLK_ERROR_IO);
  EXPECT_EQ(directory.caught.error(), "FILE_IS_DIRECTORY");
  Loaded device;
  EXPECT_EQ(loadFile("/dev/zero", device), FLK_ERROR_IO);
  EXPECT_EQ(device.caught.error(), "FILE_NOT_REGULAR");
  ASSERT_EQ(mkfifo((folder.path + "/pipe").c_str(), 0600), 0);
  Loaded pipe;
  EXPECT_EQ(loadFile(folder.path + "/pipe", pipe), FLK_ERROR_IO) << "and does not wait for a writer";
  writeRaw(folder.path + "/empty.tfx", {});
  Loaded empty;
  EXPECT_EQ(loadFile(folder.path + "/empty.tfx", empty), FLK_ERROR_FORMAT_UNKNOWN);
  EXPECT_EQ(empty.caught.error(), "FILE_EMPTY");
  // 1 TiB of zeros, which are stored nowhere: refused by its first bytes, without asking for memory.
  const std::string sparse = folder.path + "/sparse.tfx";
  writeRaw(sparse, {'n', 'o', 'n', 'e'});
  if (truncate(sparse.c_str(), off_t{1} << 40) == 0) {
    Loaded large;
    EXPECT_EQ(loadFile(sparse, large), FLK_ERROR_FORMAT_UNKNOWN);
  }
  writeRaw(sparse, smallHair().bytes);
  if (truncate(sparse.c_str(), off_t{1} << 40) == 0) {
    CountingAllocator counter;
    const FlkHostAllocator allocator = counter.callbacks();
    Loaded large;
    EXPECT_EQ(loadFile(sparse, large, &allocator), FLK_ERROR_LIMIT);
    EXPECT_EQ(large.caught.error(), "FILE_TOO_LARGE");
    EXPECT_EQ(counter.asked, 0u);
  }
}

TEST(AssetSave, ThreadsShareAnAsset) {
  const auto loaded = load(smallTfx());
  FlkResult result;
  const std::vector<unsigned char> expected = saved(loaded->asset.get(), FLK_FORMAT_TFX, result);
  const Folder folder;
  const std::string path = folder.path + "/shared.tfx";
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int j = 0; j < 20; ++j) {
        EXPECT_EQ(flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_TFX, path.c_str()), FLK_SUCCESS);
        EXPECT_EQ(contents(path), expected) << "never half written";
      }
    });
  for (std::thread& thread : threads) thread.join();
}
