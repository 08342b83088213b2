// Draws a stage on a device: light chosen, hair drawn until none of it is lost, the bust and meshes under it.
// SPDX-License-Identifier: MIT
#pragma once

#include "gpu_resources.h"
#include "headless_host.h"
#include "image.h"
#include "opaque_scene.h"
#include "stage.h"

#include <memory>
#include <string>
#include <vector>

namespace forelock::samples {

struct Picture {
  Image image;                 // over the meshes and the background, if there are any
  double exposure = 0.0;       // what all light is multiplied by
  uint64_t hair_pixels = 0;    // where hair is not wholly transparent
  FlkStatistics statistics{};  // of the frame that is shown
  FlkPlanInfo plan{};
  std::vector<std::string> omissions;
  uint32_t attempts = 0;       // frames drawn until none of the hair was lost

  double meanLayers() const {
    return hair_pixels > 0 ? static_cast<double>(statistics.fragments) / static_cast<double>(hair_pixels) : 0.0;
  }
};

// The exposure for a picture of the stage whose pixels, drawn with exposure 1, are these (RGBA, premultiplied).
double exposureOf(const std::vector<float>& rgba, const Stage& stage);

class Painter {
 public:
  // Uploads the stage's hair and meshes. Throws AssetError.
  Painter(HeadlessHost& host, const Stage& stage);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  // `exposure` 0: chosen here. Throws AssetError.
  Picture draw(const Camera& camera, double exposure);

 private:
  // From a small first picture, without meshes.
  double soundExposure(const Camera& camera);
  void check(FlkResult result, const char* what) const;
  void readyMeshes(const Camera& camera);
  void drawUntilWhole(StagedFrame& staged, bool with_meshes, Picture& picture);

  HeadlessHost& host_;
  const Stage& stage_;
  std::unique_ptr<OpaqueScene> opaque_;
  GpuImage opaque_color_;
  std::vector<Hair> hairs_;
  View view_;
};

}  // namespace forelock::samples
