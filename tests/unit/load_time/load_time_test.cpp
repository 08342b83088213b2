// How long large strand files take to load and check, and how much memory: 1,000,000 strands of 16 vertices as .hair and cooked. Files are
// in the page cache, where they are written right before. Time is the best of several loads, because other programs can only add to it.
#include "../asset/temporary_folder.h"
#include "forelock/asset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

constexpr uint32_t strands = 1'000'000, vertices_per_strand = 16;
constexpr double hair_bound_s = 2, cooked_bound_s = 0.1, fur_bound_s = 0.05;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#ifdef NDEBUG
constexpr bool optimised = true;
#else
constexpr bool optimised = false;  // times are printed, but say nothing
#endif

struct Destroy {
  void operator()(FlkAsset asset) const { flkAssetDestroy(asset); }
};
using Owned = std::unique_ptr<FlkAsset_T, Destroy>;

Owned load(const std::string& path, const FlkHostAllocator* allocator = nullptr) {
  FlkAssetOptions options{};
  options.type = FLK_TYPE_ASSET_OPTIONS;
  options.allocator = allocator;
  FlkAsset asset = nullptr;
  const FlkResult result = flkAssetLoadFile(path.c_str(), &options, &asset);
  EXPECT_EQ(result, FLK_SUCCESS) << path << ": " << flkResultName(result);
  return Owned(asset);
}

struct Times {
  double best_s = 0, median_s = 0;
};

// Best and median of some loads, and of up to four times as many while the best is not yet below the bound: on a machine that others use
// a load may be interrupted many times over, which says nothing about it.
Times timeLoads(const std::string& path, int loads, double bound_s) {
  std::vector<double> seconds;
  for (int i = 0; i < loads || (i < 4 * loads && *std::min_element(seconds.begin(), seconds.end()) >= bound_s); ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const Owned asset = load(path);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds.front(), seconds[seconds.size() / 2]};
}

uint64_t bytesOf(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? static_cast<uint64_t>(status.st_size) : 0;
}

// A field of /proc/self/status, in bytes.
uint64_t processBytes(const char* field) {
  uint64_t kilobytes = 0;
  if (std::FILE* status = std::fopen("/proc/self/status", "r")) {
    for (char line[256]; std::fgets(line, sizeof line, status);)
      if (std::strncmp(line, field, std::strlen(field)) == 0) kilobytes = std::strtoull(line + std::strlen(field) + 1, nullptr, 10);
    std::fclose(status);
  }
  return kilobytes * 1024;
}

// The most memory that a process of its own has resident while it loads, above what it had before; 0: it failed.
uint64_t peakOfProcess(const std::string& path) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    const uint64_t before = processBytes("VmHWM");
    const Owned asset = load(path);
    const uint64_t peak = asset ? processBytes("VmHWM") - before : 0;
    const bool told = write(ends[1], &peak, sizeof peak) == sizeof peak;
    _exit(told ? 0 : 1);
  }
  uint64_t peak = 0;
  close(ends[1]);
  if (child < 0 || read(ends[0], &peak, sizeof peak) != sizeof peak) peak = 0;
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return peak;
}

// Counts to the byte what a load has taken from its allocator at once.
struct PeakAllocator {
  uint64_t live = 0, peak = 0;
  FlkHostAllocator callbacks() {
    return {this,
            [](void* user, size_t size, size_t) {
              auto& self = *static_cast<PeakAllocator*>(user);
              self.live += size;
              self.peak = std::max(self.peak, self.live);
              return std::malloc(size);
            },
            [](void* user, void* memory, size_t size, size_t) {
              static_cast<PeakAllocator*>(user)->live -= size;
              std::free(memory);
            }};
  }
};

uint64_t peakOfAllocator(const std::string& path) {
  PeakAllocator counter;
  const FlkHostAllocator allocator = counter.callbacks();
  load(path, &allocator);
  return counter.peak;
}

// Strands that wander, without widths: then the asset is larger than its file, which is the harder case for memory.
bool writeHair(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return false;
  unsigned char header[128] = {'H', 'A', 'I', 'R'};
  const uint32_t fields[4] = {strands, strands * vertices_per_strand, 2, vertices_per_strand - 1};
  std::memcpy(header + 4, fields, sizeof fields);
  bool written = std::fwrite(header, 1, sizeof header, file) == sizeof header;
  uint32_t state = 1;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 16777216.0f; };
  std::vector<float> positions(std::size_t{vertices_per_strand} * 3 * 1000);
  for (uint32_t strand = 0; strand < strands; strand += 1000) {
    float at[3] = {};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (i % (vertices_per_strand * 3) < 3) at[i % 3] = 0.2f * random();
      positions[i] = at[i % 3] += 0.02f * (random() - 0.3f);
    }
    written = written && std::fwrite(positions.data(), sizeof(float), positions.size(), file) == positions.size();
  }
  return std::fclose(file) == 0 && written;
}

}  // namespace

TEST(LoadTime, AMillionStrands) {
  if (sanitized) GTEST_SKIP() << "sanitizers have time and memory of their own";
  const asset_test::Folder folder;
  const std::string hair = folder.path + "/million.hair", cooked = folder.path + "/million.flk";
  ASSERT_TRUE(writeHair(hair)) << hair << " needs 200 MB, and 260 MB for its cooked file";

  // Before anything large was in memory here.
  const uint64_t hair_process = peakOfProcess(hair);
  {
    const Owned asset = load(hair);
    ASSERT_EQ(flkAssetSaveFile(asset.get(), FLK_FORMAT_COOKED, cooked.c_str()), FLK_SUCCESS);
  }
  const uint64_t cooked_process = peakOfProcess(cooked), hair_host = peakOfAllocator(hair), cooked_host = peakOfAllocator(cooked);
  const uint64_t hair_bytes = bytesOf(hair), cooked_bytes = bytesOf(cooked);
  const Times hair_times = timeLoads(hair, 9, hair_bound_s), cooked_times = timeLoads(cooked, 25, cooked_bound_s);

  const auto megabytes = [](uint64_t bytes) { return static_cast<double>(bytes) / 1e6; };
  // The file's own pages are resident too while it is mapped, and are not counted.
  const double hair_ratio = static_cast<double>(hair_process - std::min(hair_process, hair_bytes)) / static_cast<double>(hair_bytes);
  std::printf("ROW 1,000,000 x 16 .hair (%.1f MB): load and check %.1f ms best, %.1f ms median; above the mapped file %.1f MB by the allocator, "
              "%.1f MB by the process: %.2f of its bytes\n",
              megabytes(hair_bytes), hair_times.best_s * 1e3, hair_times.median_s * 1e3, megabytes(hair_host), megabytes(hair_process - hair_bytes),
              hair_ratio);
  std::printf("ROW its cooked file (%.1f MB): %.1f ms best, %.1f ms median; %.1f MB by the allocator, %.1f MB by the process with the file\n",
              megabytes(cooked_bytes), cooked_times.best_s * 1e3, cooked_times.median_s * 1e3, megabytes(cooked_host), megabytes(cooked_process));

  ASSERT_GT(hair_process, hair_bytes) << "the file is mapped, so its pages count";
  EXPECT_LE(hair_ratio, 1.6);
  EXPECT_LE(static_cast<double>(hair_host), 1.6 * static_cast<double>(hair_bytes));
  // first_vertex and what the asset itself is.
  EXPECT_LE(cooked_host, (uint64_t{strands} + 1) * 4 + 65'536);
  if (!optimised) GTEST_SKIP() << "times: NOT TESTED in a build without NDEBUG";
  EXPECT_LT(hair_times.best_s, hair_bound_s);
  EXPECT_LT(cooked_times.best_s, cooked_bound_s);
}

TEST(LoadTime, Fur) {
  if (sanitized) GTEST_SKIP() << "sanitizers have time of their own";
  const std::string path = std::string(FORELOCK_HAIRDATA) + "/fur.hair";
  if (bytesOf(path) == 0) GTEST_SKIP() << path << " is not here: strand files of others are optional";
  const Times times = timeLoads(path, 25, fur_bound_s);
  std::printf("ROW fur.hair (50,000 strands): load and check %.2f ms best, %.2f ms median\n", times.best_s * 1e3, times.median_s * 1e3);
  if (optimised) {
    EXPECT_LT(times.best_s, fur_bound_s);
  }
}
