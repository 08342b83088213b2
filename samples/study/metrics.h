// Differences of pictures: docs/methods.md section 8. SPDX-License-Identifier: MIT
#pragma once

#include "picture.h"

#include <span>

namespace forelock::study {

// Over pixels with hair in either picture; 0..255 after a clamp to [0, 1]. Not a number where no pixel has hair.
struct Errors {
  double rmse = 0;          // the channels' squared errors summed
  double rmse_channel = 0;  // the largest single channel's
  double p999 = 0;          // of the per-pixel root of that sum
  double radiance_ratio = 0;// mean of a over mean of b, not clamped
};
Errors compare(const Picture& a, const Picture& b);

// RMSE of opacity, 0..255.
double compareOpacity(const Picture& a, std::span<const float> opacity);

// Mean over channels, steps and hair pixels of |change of a - change of b|, 0..255, along pictures of a drifting camera.
double drift(std::span<const Picture> a, std::span<const Picture> b);

// Mean of all three channels over hair pixels.
double meanRadiance(const Picture& picture);

double median(std::vector<double> values);
// Nearest rank, share in [0, 1].
double percentile(std::vector<double> values, double share);

// Ratios of pairs of times: medians of `batches` runs of consecutive pairs.
struct PairRatio {
  double ratio = 0;   // median over pairs
  double spread = 0;  // (max - min) / median over batches; not a number below two batches
};
PairRatio pairRatio(std::span<const double> baseline, std::span<const double> row, std::size_t batches);

}  // namespace forelock::study
