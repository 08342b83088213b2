// SPDX-License-Identifier: MIT
#include "view_loader.h"

#include "colored_stage.h"
#include "commands.h"
#include "strand_lod.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace forelock::samples {

namespace {

// What a slow device draws while the view moves: that many segments, and at least that many strands.
constexpr uint64_t kFewSegments = 12'000;
constexpr uint32_t kLeastStrands = 400;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

ViewLoader::ViewLoader(std::function<void()> wake) : wake_(std::move(wake)) {}

ViewLoader::~ViewLoader() {
  stopStudy();
  if (thread_.joinable()) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      next_.reset();
    }
    thread_.join();
  }
}

std::string ViewLoader::label() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return label_;
}

void ViewLoader::open(const Scene& scene) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    label_ = scene.assets.empty() ? "" : scene.assets.back().source;
    if (busy_) {
      next_ = std::make_unique<Scene>(scene);
      return;
    }
    busy_ = true;
    share_ = -1.0f;
  }
  if (thread_.joinable()) {
    thread_.join();
  }
  thread_ = std::thread([this, scene] { run(scene); });
}

void ViewLoader::run(Scene scene) {
  for (;;) {
    const auto start = std::chrono::steady_clock::now();
    auto result = std::make_unique<LoadedStage>();
    try {
      Scene plain = scene;
      plain.coloring = StrandColoring::none;
      std::atomic<int64_t> woken{0};  // (ms) since the start
      const ProgressFunction progress = [&](uint64_t done, uint64_t total) {
        share_ = total > 0 ? static_cast<float>(done) / static_cast<float>(total) : -1.0f;
        const auto now = static_cast<int64_t>(1e3 * secondsSince(start));
        if (now > woken + 30) {
          woken = now;
          wake_();
        }
      };
      result->plain = std::make_unique<Stage>(openStage(plain, progress));
      if (scene.coloring != StrandColoring::none) {
        result->plain->scene.coloring = scene.coloring;
        result->colored = std::make_unique<Stage>(coloredStage(*result->plain, scene.coloring));
      }
    } catch (const std::exception& error) {
      result->plain.reset();
      result->error = error.what();
    }
    result->seconds = secondsSince(start);
    std::unique_ptr<Scene> next;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      next = std::move(next_);
      if (!next) {
        loaded_ = std::move(result);
        busy_ = false;
      }
    }
    wake_();
    if (!next) {
      return;
    }
    scene = std::move(*next);
    share_ = -1.0f;
  }
}

std::unique_ptr<LoadedStage> ViewLoader::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(loaded_);
}

void ViewLoader::study(const Stage& plain) {
  stopStudy();
  studying_ = true;
  stop_study_ = false;
  std::vector<double> opacities;  // the window may change materials meanwhile
  for (const StagedAsset& asset : plain.assets) {
    opacities.push_back(static_cast<double>(asset.material.opacity_root));
  }
  study_thread_ = std::thread([this, &plain, opacities] { runStudy(plain, opacities); });
}

void ViewLoader::stopStudy() {
  stop_study_ = true;
  if (study_thread_.joinable()) {
    study_thread_.join();
  }
  extras_.reset();
  studying_ = false;
}

void ViewLoader::runStudy(const Stage& plain, const std::vector<double>& opacities) {
  auto extras = std::make_unique<LoadedExtras>();
  for (size_t i = 0; i < plain.assets.size(); ++i) {
    const StagedAsset& asset = plain.assets[i];
    std::unique_ptr<OpenedAsset> few;
    const uint64_t segments = asset.info.vertex_count - asset.info.strand_count;
    const uint32_t wanted = std::max(static_cast<uint32_t>(uint64_t{asset.info.strand_count} * kFewSegments / std::max<uint64_t>(segments, 1)), kLeastStrands);
    if (asset.info.strand_count > wanted && !stop_study_) {
      try {
        FlkStrands strands = {};
        flkAssetGetStrands(asset.opened.asset.get(), &strands);
        EditableStrands edited = editableStrands(strands, true);
        orderStrands(edited, evenOrder(edited));
        if (!stop_study_) {
          keepFirstStrands(edited, wanted, opacities[i]);
          few = std::make_unique<OpenedAsset>(assetOf(edited.view(), asset.opened.label));
        }
      } catch (const std::exception&) {
        few.reset();  // drawn whole then
      }
    }
    extras->few.push_back(std::move(few));
    FlkStrands strands = {};
    flkAssetGetStrands(asset.opened.asset.get(), &strands);
    extras->faults.push_back(stop_study_ ? StrandFaults{} : findStrandFaults(strands));
    extras->findings.push_back(stop_study_ ? std::vector<FindingStrands>() : findingStrands(asset.opened, extras->faults.back()));
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    extras_ = std::move(extras);
  }
  studying_ = false;
  wake_();
}

std::unique_ptr<LoadedExtras> ViewLoader::takeExtras() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::move(extras_);
}

}  // namespace forelock::samples
