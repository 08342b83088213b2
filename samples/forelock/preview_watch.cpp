// `forelock preview --watch`: a picture that follows its file. SPDX-License-Identifier: MIT
#include "commands.h"
#include "preview.h"

#include <sys/stat.h>
#include <time.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

namespace forelock::samples {

namespace fs = std::filesystem;

namespace {

volatile std::sig_atomic_t interrupted = 0;

void onInterrupt(int) { interrupted = 1; }

constexpr std::chrono::milliseconds kPoll(250);

// Of one file; all zero where there is none.
struct Stamp {
  int64_t seconds = 0, nanoseconds = 0, bytes = 0;
  uint64_t number = 0;  // of the file: a new one may be renamed over the old
  bool operator==(const Stamp&) const = default;
};

std::vector<Stamp> stampsOf(const std::vector<std::string>& files) {
  std::vector<Stamp> stamps;
  for (const std::string& file : files) {
    struct stat info = {};
    Stamp& stamp = stamps.emplace_back();
    if (stat(file.c_str(), &info) == 0) {
      stamp = {info.st_mtim.tv_sec, info.st_mtim.tv_nsec, info.st_size, info.st_ino};
    }
  }
  return stamps;
}

void addSource(const std::string& source, std::vector<std::string>& files) {
  if (source.rfind("groom:", 0) != 0) {
    files.push_back(source);
    return;
  }
  for (const std::string& folder : groomFolders()) {
    std::error_code error;
    const fs::path path = fs::path(folder) / (source.substr(6) + ".json");
    if (fs::is_regular_file(path, error)) {
      files.push_back(path.string());
      return;
    }
  }
}

std::vector<std::string> filesOf(const PreviewArguments& arguments, const Scene& scene) {
  std::vector<std::string> files;
  if (!arguments.scene.empty() && !isInlineScene(arguments.scene)) {
    files.push_back(arguments.scene);
  }
  for (const SceneMesh& mesh : scene.meshes) {
    files.push_back(mesh.source);
  }
  for (const SceneAsset& asset : scene.assets) {
    addSource(asset.source, files);
    if (!asset.root_image.empty()) {
      files.push_back(asset.root_image);
    }
  }
  return files;
}

// Since the newest of the files that changed was written, as far as the clocks of the file system and of this machine agree.
double secondsSince(const std::vector<Stamp>& before, const std::vector<Stamp>& now, double since_seen) {
  timespec clock = {};
  clock_gettime(CLOCK_REALTIME, &clock);
  double least = 1e9;
  for (size_t i = 0; i < now.size(); ++i) {
    if (i >= before.size() || !(before[i] == now[i])) {
      least = std::min(least, static_cast<double>(clock.tv_sec - now[i].seconds) + 1e-9 * static_cast<double>(clock.tv_nsec - now[i].nanoseconds));
    }
  }
  const double slack = since_seen + 2.0 * std::chrono::duration<double>(kPoll).count();
  return least >= since_seen && least <= slack ? least : since_seen;  // a file may be moved here with an old time
}

}  // namespace

int runPreviewWatch(const CLI::App& command, const PreviewArguments& arguments, HeadlessHost& host) {
  interrupted = 0;
  struct sigaction action = {}, old_interrupt = {}, old_terminate = {};
  action.sa_handler = onInterrupt;
  sigaction(SIGINT, &action, &old_interrupt);
  sigaction(SIGTERM, &action, &old_terminate);
  std::vector<std::string> files;
  std::vector<Stamp> drawn;
  bool first = true;
  while (interrupted == 0) {
    // Taken before the files are read: what is written meanwhile is drawn next.
    std::vector<Stamp> now = stampsOf(files);
    if (first || now != drawn) {
      const auto seen = std::chrono::steady_clock::now();
      try {
        const Scene scene = previewScene(command, arguments);
        const std::vector<std::string> wanted = filesOf(arguments, scene);
        if (wanted != files) {
          files = wanted;
          now = stampsOf(files);
        }
        const Preview preview = drawPreview(host, scene, arguments, arguments.out);
        const double since_seen = std::chrono::duration<double>(std::chrono::steady_clock::now() - seen).count();
        if (first) {
          printPreview(arguments, host, preview);
          std::printf("watching; Ctrl-C ends\n");
        } else {
          std::printf("%s  drawn %.2f s after the change\n", arguments.out.c_str(), secondsSince(drawn, now, since_seen));
        }
      } catch (const UsageError&) {
        throw;
      } catch (const std::exception& error) {
        if (files.empty() && isInlineScene(arguments.scene)) {
          throw;  // it will not change
        }
        std::fprintf(stderr, "forelock: %s\n", error.what());
        std::printf(first ? "nothing drawn yet, watching; Ctrl-C ends\n" : "the picture stays as it was\n");
        if (files.empty()) {  // the scene itself cannot be read
          files.push_back(arguments.scene.empty() ? arguments.asset : arguments.scene);
          now = stampsOf(files);
        }
      }
      std::fflush(stdout);
      drawn = now;
      first = false;
    }
    if (interrupted == 0) {
      std::this_thread::sleep_for(kPoll);
    }
  }
  sigaction(SIGINT, &old_interrupt, nullptr);
  sigaction(SIGTERM, &old_terminate, nullptr);
  return kDone;
}

}  // namespace forelock::samples
