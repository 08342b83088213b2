// Assets that are views of a mapped file: how long the mapping lives, what is copied, and what happens when the file does not stay.
#include "asset_kit.h"
#include "temporary_folder.h"

#include <atomic>
#include <cstdio>
#include <fcntl.h>
#include <sys/stat.h>
#include <thread>

using namespace asset_test;

namespace {

void writeRaw(const std::string& path, const std::vector<unsigned char>& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
  std::fclose(file);
}

std::unique_ptr<Loaded> loadPath(const std::string& path, uint32_t flags = 0, const FlkHostAllocator* allocator = nullptr) {
  auto loaded = std::make_unique<Loaded>();
  FlkAssetOptions options = optionsFor(loaded->caught, nullptr);
  options.flags = flags;
  options.allocator = allocator;
  FlkAsset asset = nullptr;
  loaded->result = flkAssetLoadFile(path.c_str(), &options, &asset);
  loaded->asset.reset(asset);
  return loaded;
}

// `strands` strands of eight vertices, all different.
Bytes longHair(uint32_t strands) {
  Bytes file;
  file.text("HAIR").u32(strands).u32(strands * 8).u32(2).u32(7).zeros(108);
  for (uint32_t point = 0; point < strands * 8; ++point)
    file.f32s({1e-4f * static_cast<float>(point), 1e-3f * static_cast<float>(point % 8), 0.25f});
  return file;
}

Bytes cookedOf(const Bytes& source) {
  FlkResult result;
  Bytes file;
  file.bytes = saved(load(source)->asset.get(), FLK_FORMAT_COOKED, result);
  return file;
}

std::string cookInto(const Folder& folder, const Bytes& source, const char* name = "hair.flk") {
  const std::string path = folder.path + "/" + name;
  EXPECT_EQ(flkAssetSaveFile(load(source)->asset.get(), FLK_FORMAT_COOKED, path.c_str()), FLK_SUCCESS);
  return path;
}

}  // namespace

TEST(MappedFile, ArraysAreViewsAndIndicesACopy) {
  const Folder folder;
  const Bytes source = longHair(4000);
  const std::string path = cookInto(folder, source);
  CountingAllocator counter;
  const FlkHostAllocator allocator = counter.callbacks();
  {
    const auto loaded = loadPath(path, 0, &allocator);
    ASSERT_EQ(loaded->result, FLK_SUCCESS) << loaded->caught.text();
    EXPECT_EQ(brokenPromise(loaded->asset.get()), nullptr);
    EXPECT_EQ(brokenRoundTrip(loaded->asset.get()), nullptr);
    EXPECT_GT(loaded->info().bytes_mapped, 4000u * 8 * 16);
    EXPECT_EQ(counter.largest, 4001u * 4) << "only first_vertex comes from the allocator";
    EXPECT_NEAR(static_cast<double>(loaded->info().bytes_host), static_cast<double>(counter.live_bytes), 64.0);
    const auto copy = loadPath(path, FLK_ASSET_COPY_FILE);
    ASSERT_EQ(copy->result, FLK_SUCCESS);
    EXPECT_EQ(copy->info().bytes_mapped, 0u);
    EXPECT_EQ(std::memcmp(copy->strands().positions, loaded->strands().positions, 4000 * 8 * 12), 0);
    EXPECT_EQ(std::memcmp(copy->strands().radii, loaded->strands().radii, 4000 * 8 * 4), 0);
  }
  EXPECT_EQ(counter.live, 0u);
  // A file of another format is mapped only while it is read.
  writeRaw(folder.path + "/hair.hair", source.bytes);
  CountingAllocator reading;
  const FlkHostAllocator reading_allocator = reading.callbacks();
  const auto loaded = loadPath(folder.path + "/hair.hair", 0, &reading_allocator);
  EXPECT_EQ(loaded->result, FLK_SUCCESS);
  EXPECT_EQ(loaded->info().bytes_mapped, 0u);
  EXPECT_EQ(reading.largest, 4000u * 8 * 12) << "the positions: the file is not copied";
  CountingAllocator copying;
  const FlkHostAllocator copying_allocator = copying.callbacks();
  EXPECT_EQ(loadPath(folder.path + "/hair.hair", FLK_ASSET_COPY_FILE, &copying_allocator)->result, FLK_SUCCESS);
  EXPECT_EQ(copying.largest, source.size());
}

TEST(MappedFile, OutlivesItsNameAndItsReplacement) {
  const Folder folder;
  const Bytes source = longHair(500);
  const std::string path = cookInto(folder, source);
  const auto loaded = loadPath(path), direct = load(source);
  ASSERT_EQ(loaded->result, FLK_SUCCESS);
  const auto unchanged = [&] { return std::memcmp(loaded->strands().positions, direct->strands().positions, 500 * 8 * 12) == 0; };
  // Another asset saved onto it, the asset itself saved onto it, and no file at all.
  ASSERT_EQ(flkAssetSaveFile(load(smallHair(63))->asset.get(), FLK_FORMAT_COOKED, path.c_str()), FLK_SUCCESS);
  EXPECT_TRUE(unchanged());
  EXPECT_EQ(loadPath(path)->info().strand_count, 3u);
  ASSERT_EQ(flkAssetSaveFile(loaded->asset.get(), FLK_FORMAT_COOKED, path.c_str()), FLK_SUCCESS);
  EXPECT_TRUE(unchanged());
  EXPECT_EQ(loadPath(path)->info().strand_count, 500u);
  ASSERT_EQ(std::remove(path.c_str()), 0);
  EXPECT_TRUE(unchanged());
}

TEST(MappedFile, ACopySurvivesWhatWouldEndAMapping) {
  const Folder folder;
  const Bytes source = longHair(500);
  const std::string path = cookInto(folder, source);
  const auto copy = loadPath(path, FLK_ASSET_COPY_FILE), direct = load(source);
  ASSERT_EQ(copy->result, FLK_SUCCESS);
  ASSERT_EQ(truncate(path.c_str(), 0), 0);
  EXPECT_EQ(std::memcmp(copy->strands().positions, direct->strands().positions, 500 * 8 * 12), 0);
  const auto empty = loadPath(path);
  EXPECT_EQ(empty->caught.error(), "FILE_EMPTY");
}

TEST(MappedFile, DamageIsNamedAndNothingIsKept) {
  const Folder folder;
  const std::string path = cookInto(folder, longHair(500));
  struct stat status {};
  ASSERT_EQ(stat(path.c_str(), &status), 0);
  CountingAllocator counter;
  const FlkHostAllocator allocator = counter.callbacks();
  std::FILE* file = std::fopen(path.c_str(), "r+b");
  std::fseek(file, 9000, SEEK_SET);
  std::fputc(0x5a, file);
  std::fclose(file);
  const auto damaged = loadPath(path, 0, &allocator);
  EXPECT_EQ(damaged->result, FLK_ERROR_MALFORMED);
  EXPECT_EQ(damaged->caught.error(), "COOKED_CHECKSUM");
  EXPECT_NE(damaged->caught.text().find("hair.flk: the checksum of its positions (bytes "), std::string::npos) << damaged->caught.text();
  ASSERT_EQ(truncate(path.c_str(), status.st_size / 2), 0);
  EXPECT_EQ(loadPath(path, 0, &allocator)->caught.error(), "COOKED_SIZE");
  EXPECT_EQ(counter.live, 0u);
}

TEST(MappedFile, EveryAllocationRefused) {
  const Folder folder;
  Bytes defective = smallHair(63);
  const std::string path = cookInto(folder, defective.setU32(128 + 6, 0x7fc00000u).zeros(1), "a cooked file with a name of some length.flk");
  for (const uint32_t flags : {0u, uint32_t{FLK_ASSET_COPY_FILE}}) {
    bool completed = false;
    for (size_t refuse = 0; !completed; ++refuse) {
      CountingAllocator counter(refuse);
      const FlkHostAllocator allocator = counter.callbacks();
      {
        const auto loaded = loadPath(path, flags, &allocator);
        completed = !counter.refused;
        EXPECT_EQ(loaded->result, completed ? FLK_SUCCESS : FLK_ERROR_OUT_OF_HOST_MEMORY) << refuse;
      }
      EXPECT_EQ(counter.live, 0u) << refuse;
    }
  }
}

// Counts that change between two looks at them must not lead outside the arrays. The other writer goes through the file, as another
// process would.
TEST(MappedFile, WrittenIntoWhileItIsRead) {
  const Folder folder;
  constexpr uint32_t strands = 20'000;
  Bytes hair, data;
  hair.text("HAIR").u32(strands).u32(strands * 2).u32(3).zeros(112);
  data.u32(strands);
  for (uint32_t strand = 0; strand < strands; ++strand) hair.u16(1);
  for (uint32_t strand = 0; strand < strands; ++strand) {
    for (Bytes* file : {&hair, &data}) {
      if (file == &data) file->u32(2);
      file->f32s({0.5f, 0, 0, 0.5f, 1, 0});
    }
  }
  const struct {
    const char* name;
    const Bytes& bytes;
    off_t count_at;  // of the last strand
  } files[] = {{"/hair", hair, 128 + 2 * (strands - 1)}, {"/data", data, static_cast<off_t>(data.size()) - 28},
               {"/flk", cookedOf(hair), 320 + 4 * (strands - 1)}};
  for (const auto& file : files) {
    const std::string path = folder.path + file.name;
    writeRaw(path, file.bytes.bytes);
    std::atomic<bool> done = false;
    std::thread writer([&] {
      const int fd = open(path.c_str(), O_WRONLY);
      for (unsigned char value = 0; !done; value = static_cast<unsigned char>(value + 1)) EXPECT_EQ(pwrite(fd, &value, 1, file.count_at), 1);
      close(fd);
    });
    for (int i = 0; i < 200; ++i) {
      const auto loaded = loadPath(path);
      if (loaded->result == FLK_SUCCESS) continue;
      EXPECT_TRUE(loaded->result == FLK_ERROR_MALFORMED || loaded->result == FLK_ERROR_IO) << loaded->caught.text();
    }
    done = true;
    writer.join();
  }
}

TEST(MappedFile, FlagsThatAreNone) {
  Caught caught;
  FlkAssetOptions options = optionsFor(caught, "args");
  options.flags = 2;
  FlkAsset asset = nullptr;
  EXPECT_EQ(flkAssetLoadFile("x", &options, &asset), FLK_ERROR_INVALID_ARGUMENT);
  EXPECT_NE(caught.text().find("FlkAssetOptions.flags"), std::string::npos);
}
