// Draws a stage on a device: light chosen, hair drawn until none of it is lost, the bust under it.
// SPDX-License-Identifier: MIT
#pragma once

#include "headless_host.h"
#include "image.h"
#include "stage.h"

#include <string>
#include <vector>

namespace forelock::samples {

struct Picture {
  Image image;                 // over the bust and the background, if there are any
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
  // Uploads the stage's hair. Throws AssetError.
  Painter(HeadlessHost& host, const Stage& stage);

  // `exposure` 0: chosen here. Throws AssetError.
  Picture draw(const Camera& camera, double exposure);

 private:
  struct Sounding;
  Sounding sound(const Camera& camera);
  void check(FlkResult result, const char* what) const;
  void drawUntilWhole(FlkFrame& frame, Picture& picture);

  HeadlessHost& host_;
  const Stage& stage_;
  std::vector<Hair> hairs_;
  View view_;
};

}  // namespace forelock::samples
