// SPDX-License-Identifier: MIT
#include "metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace forelock::study {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double shown(float value) { return 255 * std::clamp(double(value), 0.0, 1.0); }

}  // namespace

Errors compare(const Picture& a, const Picture& b) {
  std::vector<double> squares;
  double sum[3] = {0, 0, 0}, mean_a = 0, mean_b = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    if (!a.isHair(i) && !b.isHair(i)) continue;
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double d = shown(a.rgb[i * 3 + c]) - shown(b.rgb[i * 3 + c]);
      sum[c] += d * d;
      square += d * d;
      mean_a += double(a.rgb[i * 3 + c]);
      mean_b += double(b.rgb[i * 3 + c]);
    }
    squares.push_back(square);
  }
  if (squares.empty()) return {kUnknown, kUnknown, kUnknown, kUnknown};
  const double n = double(squares.size());
  Errors errors;
  errors.rmse = std::sqrt((sum[0] + sum[1] + sum[2]) / n);
  errors.rmse_channel = std::sqrt(std::max({sum[0], sum[1], sum[2]}) / n);
  errors.p999 = std::sqrt(percentile(std::move(squares), 0.999));
  errors.radiance_ratio = mean_b > 0 ? mean_a / mean_b : kUnknown;
  return errors;
}

double compareOpacity(const Picture& a, std::span<const float> opacity) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < a.pixels(); ++i) {
    if (!a.isHair(i) && !(opacity[i] > 0)) continue;
    const double d = 255 * (1 - double(a.transmittance[i]) - double(opacity[i]));
    sum += d * d, n += 1;
  }
  return n > 0 ? std::sqrt(sum / n) : kUnknown;
}

double drift(std::span<const Picture> a, std::span<const Picture> b) {
  double sum = 0, n = 0;
  for (std::size_t step = 1; step < a.size(); ++step)
    for (std::size_t i = 0; i < a[0].pixels(); ++i) {
      if (!a[step].isHair(i) && !b[step].isHair(i) && !a[step - 1].isHair(i) && !b[step - 1].isHair(i)) continue;
      for (std::size_t c = i * 3; c < i * 3 + 3; ++c)
        sum += std::fabs((shown(a[step].rgb[c]) - shown(a[step - 1].rgb[c])) - (shown(b[step].rgb[c]) - shown(b[step - 1].rgb[c])));
      n += 3;
    }
  return n > 0 ? sum / n : kUnknown;
}

double meanRadiance(const Picture& picture) {
  double sum = 0, n = 0;
  for (std::size_t i = 0; i < picture.pixels(); ++i) {
    if (!picture.isHair(i)) continue;
    for (std::size_t c = 0; c < 3; ++c) sum += double(picture.rgb[i * 3 + c]);
    n += 3;
  }
  return n > 0 ? sum / n : 0;
}

double median(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return kUnknown;
  const double rank = std::ceil(share * double(values.size())) - 1;
  const std::size_t index = std::min(values.size() - 1, std::size_t(std::max(rank, 0.0)));
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(index), values.end());
  return values[index];
}

PairRatio pairRatio(std::span<const double> baseline, std::span<const double> row, std::size_t batches) {
  const std::size_t pairs = std::min(baseline.size(), row.size());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < pairs; ++i) ratios.push_back(baseline[i] / row[i]);
  batches = std::min(batches, pairs);
  std::vector<double> medians;
  for (std::size_t b = 0; b < batches; ++b)
    medians.push_back(median({ratios.begin() + std::ptrdiff_t(b * pairs / batches), ratios.begin() + std::ptrdiff_t((b + 1) * pairs / batches)}));
  PairRatio result{median(ratios), kUnknown};
  if (medians.size() >= 2)
    result.spread = (*std::max_element(medians.begin(), medians.end()) - *std::min_element(medians.begin(), medians.end())) / median(medians);
  return result;
}

}  // namespace forelock::study
