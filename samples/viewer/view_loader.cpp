// SPDX-License-Identifier: MIT
#include "view_loader.h"

#include "colored_stage.h"
#include "commands.h"
#include "gltf_reader.h"
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

void ViewLoader::open(const Scene& scene, const OpenFiles& files) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    label_ = scene.meshes.empty() ? "" : scene.meshes.back().source;
    for (const SceneAsset& asset : scene.assets) {
      if (!findOpen(files, asset)) {
        label_ = asset.source;
      }
    }
    if (busy_) {
      next_ = std::make_unique<Wanted>(Wanted{scene, files});
      return;
    }
    busy_ = true;
    share_ = -1.0f;
  }
  if (thread_.joinable()) {
    thread_.join();
  }
  thread_ = std::thread([this, wanted = Wanted{scene, files}] { run(wanted); });
}

void ViewLoader::readAssets(Wanted& wanted, const ProgressFunction& progress) {
  std::vector<SceneAsset> hair;
  for (const SceneAsset& asset : wanted.scene.assets) {
    try {
      if (!findOpen(wanted.files, asset)) {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          label_ = asset.source;
        }
        share_ = -1.0f;
        auto opened = std::make_shared<OpenedAsset>(openAsset(asset.source, progress, {asset.points_per_strand, true}));
        printMessages(*opened->messages, false);
        wanted.files.assets.emplace_back(asset, std::move(opened));
      }
      hair.push_back(asset);
    } catch (const GltfError& error) {
      if (error.id != "GLTF_MESH_ONLY") {
        throw;
      }
      wanted.scene.meshes.emplace_back().source = asset.source;
    }
  }
  wanted.scene.assets = std::move(hair);
}

void ViewLoader::run(Wanted wanted) {
  for (;;) {
    const auto start = std::chrono::steady_clock::now();
    auto result = std::make_unique<LoadedStage>();
    try {
      std::atomic<int64_t> woken{0};  // (ms) since the start
      const ProgressFunction progress = [&](uint64_t done, uint64_t total) {
        share_ = total > 0 ? static_cast<float>(done) / static_cast<float>(total) : -1.0f;
        const auto now = static_cast<int64_t>(1e3 * secondsSince(start));
        if (now > woken + 30) {
          woken = now;
          wake_();
        }
      };
      const size_t open_before = wanted.files.assets.size();
      readAssets(wanted, progress);
      result->read = wanted.files.assets.size() > open_before;
      if (wanted.scene.assets.empty()) {
        result->meshes = wanted.scene.meshes;
        result->error = wanted.scene.meshes.back().source + ": is a mesh without hair. Open hair first, then this beside it.";
      } else {
        Scene plain = wanted.scene;
        plain.coloring = StrandColoring::none;
        result->plain = std::make_unique<Stage>(openStage(plain, progress, wanted.files));
        if (wanted.scene.coloring != StrandColoring::none) {
          result->plain->scene.coloring = wanted.scene.coloring;
          result->colored = std::make_unique<Stage>(coloredStage(*result->plain, wanted.scene.coloring));
        }
      }
    } catch (const std::exception& error) {
      result->plain.reset();
      result->error = error.what();
    }
    result->seconds = secondsSince(start);
    std::unique_ptr<Wanted> next;
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
    wanted = std::move(*next);
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
        flkAssetGetStrands(asset.opened->asset.get(), &strands);
        EditableStrands edited = editableStrands(strands, true);
        orderStrands(edited, evenOrder(edited));
        if (!stop_study_) {
          keepFirstStrands(edited, wanted, opacities[i]);
          few = std::make_unique<OpenedAsset>(assetOf(edited.view(), asset.opened->label));
        }
      } catch (const std::exception&) {
        few.reset();  // drawn whole then
      }
    }
    extras->few.push_back(std::move(few));
    FlkStrands strands = {};
    flkAssetGetStrands(asset.opened->asset.get(), &strands);
    extras->faults.push_back(stop_study_ ? StrandFaults{} : findStrandFaults(strands));
    extras->findings.push_back(stop_study_ ? std::vector<FindingStrands>() : findingStrands(*asset.opened, extras->faults.back()));
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
