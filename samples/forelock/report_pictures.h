// Pictures of a report: how many fragments pixels have, methods beside their reference and what they differ by.
// SPDX-License-Identifier: MIT
#pragma once

#include "report_plots.h"

namespace forelock::samples {

// Of sRGB colours in 0..255.
struct PictureColor {
  int r = 0, g = 0, b = 0;
  std::string css() const;
};

// The paper's Figure 2: grey 1, blue 8, green 50, red 100 and above, as --color layers of the preview.
PictureColor layersColor(double fragments);

// Black over violet and orange to white for t in [0, 1]: lighter is more, also without colour.
PictureColor differenceColor(double t);

struct LayersPicture {
  std::string view, path;  // of the .png, from the report's folder
  uint32_t width = 0, height = 0;
  uint64_t hair_pixels = 0, fragments = 0;
  uint32_t most = 0;
};

struct MethodPicture {
  std::string method;
  std::string image, difference, detail;  // .png; no detail where nothing differs
  uint32_t detail_x = 0, detail_y = 0, detail_size = 0;  // the worst region, pixels from the upper left of the crop
  double rmse = 0.0, p999 = 0.0;  // of these very pictures, 0..442
  double off_scale = 0.0;         // share of the hair pixels that are brighter than the scale
  const StudyRow* row = nullptr;  // null: the table does not have it
};

// Methods of a view and colour against its R_exact.
struct PictureGroup {
  Setting setting;
  std::string exact, forward;  // .png; `forward` may be missing
  uint32_t width = 0, height = 0;
  double scale = 1.0;  // differences times this fill the colours: white is a difference of 255 / scale
  std::vector<MethodPicture> methods;
};

struct Pictures {
  std::vector<LayersPicture> layers;
  std::vector<Histogram> histograms;
  std::vector<PictureGroup> groups;  // the main one first
  std::vector<std::string> missing;   // file names
  std::vector<std::string> problems;  // a sentence each
};

// Reads STUDY/images and writes .png to FOLDER/report.
Pictures makePictures(const StudyFacts& facts, const std::string& study, const std::string& folder,
                      const std::function<void(uint64_t, uint64_t)>& progress);

}  // namespace forelock::samples
