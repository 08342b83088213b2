// Opens scenes beside the window, which goes on. SPDX-License-Identifier: MIT
#pragma once

#include "finding_strands.h"
#include "stage.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace forelock::samples {

struct LoadedStage {
  std::unique_ptr<Stage> plain;    // without a colouring
  std::unique_ptr<Stage> colored;  // with the scene's, if it has one
  std::string error;               // why there is no stage: a sentence
  std::vector<SceneMesh> meshes;   // without a stage: what was asked for as hair, and is meshes alone
  double seconds = 0.0;
  bool read = false;               // an asset of it from a file
};

// What may come after the picture.
struct LoadedExtras {
  std::vector<std::vector<FindingStrands>> findings;  // of each asset
  std::vector<StrandFaults> faults;                   // likewise
  std::vector<std::unique_ptr<OpenedAsset>> few;      // levels of detail of each asset; null where it has few strands anyway
};

class ViewLoader {
public:
  // `wake` is called from the thread whenever there is news.
  explicit ViewLoader(std::function<void()> wake);
  ~ViewLoader();  // waits for what is under way
  ViewLoader(const ViewLoader&) = delete;
  ViewLoader& operator=(const ViewLoader&) = delete;

  // One at a time: what is under way is finished and forgotten. What is in `files` is not read again.
  // A glTF file of triangles alone among the assets becomes a mesh beside the others.
  void open(const Scene& scene, const OpenFiles& files = {});
  bool busy() const { return busy_; }
  std::string label() const;
  float share() const { return share_; }  // below 0: not known
  // Null: nothing new.
  std::unique_ptr<LoadedStage> take();

  // Findings and levels of detail of a stage, which must live until they are taken or another is asked for.
  void study(const Stage& plain);
  bool studying() const { return studying_; }
  std::unique_ptr<LoadedExtras> takeExtras();
  void stopStudy();

private:
  struct Wanted {
    Scene scene;
    OpenFiles files;
  };
  void run(Wanted wanted);
  void readAssets(Wanted& wanted, const ProgressFunction& progress);
  void runStudy(const Stage& plain, const std::vector<double>& opacities);

  std::function<void()> wake_;
  std::thread thread_, study_thread_;
  std::atomic<bool> busy_{false}, studying_{false}, stop_study_{false};
  std::atomic<float> share_{-1.0f};
  mutable std::mutex mutex_;
  std::string label_;
  std::unique_ptr<LoadedStage> loaded_;
  std::unique_ptr<LoadedExtras> extras_;
  std::unique_ptr<Wanted> next_;
};

}  // namespace forelock::samples
