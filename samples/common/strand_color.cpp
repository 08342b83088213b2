// SPDX-License-Identifier: MIT
#include "strand_color.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace forelock::samples {

namespace {

glm::dvec3 pointAt(const FlkStrands& strands, uint32_t vertex) {
  const float* p = strands.positions + size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

double segmentLength(const FlkStrands& strands, uint32_t vertex) {
  return glm::length(pointAt(strands, vertex + 1) - pointAt(strands, vertex));
}

double lengthOf(const FlkStrands& strands, uint32_t strand) {
  double length = 0.0;
  for (uint32_t v = strands.first_vertex[strand]; v + 1 < strands.first_vertex[strand + 1]; ++v) {
    length += segmentLength(strands, v);
  }
  return length;
}

// Two digits, away from or towards zero.
double rounded(double value, bool up) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    return 0.0;
  }
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return (up ? std::ceil(value / step - 1e-6) : std::floor(value / step + 1e-6)) * step;
}

}  // namespace

const std::vector<std::string>& coloringNames() {
  static const std::vector<std::string> names{"shaded",    "curvature", "length", "segments",
                                              "thickness", "groups",    "guides", "bad"};
  return names;
}

std::vector<float> strandLengths(const FlkStrands& strands) {
  std::vector<float> values(strands.vertex_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    const float length = static_cast<float>(lengthOf(strands, s));
    std::fill(values.begin() + strands.first_vertex[s], values.begin() + strands.first_vertex[s + 1], length);
  }
  return values;
}

std::vector<float> strandCurvature(const FlkStrands& strands) {
  std::vector<float> values(strands.vertex_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    const uint32_t begin = strands.first_vertex[s], end = strands.first_vertex[s + 1];
    glm::dvec3 before(0.0);  // the last segment that has a length
    uint32_t corner = begin;
    float last = 0.0f;
    bool any = false;
    for (uint32_t v = begin; v + 1 < end; ++v) {
      const glm::dvec3 segment = pointAt(strands, v + 1) - pointAt(strands, v);
      const double length = glm::length(segment);
      if (length > 0.0) {
        const double length_before = glm::length(before);
        if (length_before > 0.0) {
          // atan2 keeps its digits for small angles, which acos does not.
          const double angle = std::atan2(glm::length(glm::cross(before, segment)), glm::dot(before, segment));
          last = static_cast<float>(angle / (0.5 * (length + length_before)));
          std::fill(values.begin() + (any ? corner : begin), values.begin() + v + 1, last);
          any = true;
        }
        before = segment;
        corner = v + 1;
      }
    }
    if (any) {
      std::fill(values.begin() + corner, values.begin() + end, last);
    }
  }
  return values;
}

std::vector<float> segmentRatios(const FlkStrands& strands) {
  std::vector<float> values(strands.vertex_count);
  for (uint32_t s = 0; s < strands.strand_count; ++s) {
    const uint32_t begin = strands.first_vertex[s], end = strands.first_vertex[s + 1];
    const double mean = lengthOf(strands, s) / std::max(end - begin - 1, 1u);
    float before = 1.0f;
    for (uint32_t v = begin; v < end; ++v) {
      const float after = v + 1 < end ? static_cast<float>(segmentLength(strands, v) / std::max(mean, 1e-30)) : before;
      before = v == begin ? after : before;
      const auto unusual = [](float ratio) { return std::fabs(std::log2(std::max(ratio, 1e-6f))); };
      values[v] = unusual(before) > unusual(after) ? before : after;
      before = after;
    }
  }
  return values;
}

std::vector<float> strandDiameters(const FlkStrands& strands) {
  std::vector<float> values(strands.vertex_count);
  for (uint32_t v = 0; v < strands.vertex_count; ++v) {
    values[v] = 2.0f * strands.radii[v];
  }
  return values;
}

double ColorScale::share(double value) const {
  const double x = logarithmic ? std::log(std::max(value, 1e-30) / blue) / std::log(red / blue)
                               : (value - blue) / std::max(red - blue, 1e-30);
  return x > 0.0 ? std::min(x, 1.0) : 0.0;
}

ColorScale usualScale(const std::vector<float>& values, bool from_zero) {
  ColorScale scale;
  if (values.empty()) {
    return scale;
  }
  std::vector<float> sorted(values);
  const auto at = [&](size_t percent) {
    const auto place = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * percent / 100);
    std::nth_element(sorted.begin(), place, sorted.end());
    return static_cast<double>(*place);
  };
  const double low = from_zero ? 0.0 : at(5), high = at(95);
  if (high <= low * 1.001) {
    scale.red = high > 0.0 ? 2.0 * high : 1.0;
    return scale;
  }
  scale.red = rounded(high, true);
  scale.blue = rounded(low, false);
  return scale;
}

glm::vec3 scaleColor(double share) {
  static const std::array<glm::vec3, 5> stops{glm::vec3(0.03f, 0.07f, 0.80f), glm::vec3(0.02f, 0.45f, 0.60f), glm::vec3(0.05f, 0.55f, 0.08f),
                                              glm::vec3(0.85f, 0.60f, 0.02f), glm::vec3(0.80f, 0.03f, 0.02f)};
  const double x = (share > 0.0 ? std::min(share, 1.0) : 0.0) * 4.0;
  const size_t low = std::min(static_cast<size_t>(x), size_t{3});
  return glm::mix(stops[low], stops[low + 1], static_cast<float>(x - static_cast<double>(low)));
}

glm::vec3 distinctColor(uint32_t index) {
  static const std::array<glm::vec3, 12> colors{
      glm::vec3(0.80f, 0.05f, 0.04f), glm::vec3(0.04f, 0.20f, 0.80f), glm::vec3(0.06f, 0.50f, 0.08f), glm::vec3(0.90f, 0.55f, 0.02f),
      glm::vec3(0.40f, 0.08f, 0.60f), glm::vec3(0.02f, 0.55f, 0.60f), glm::vec3(0.85f, 0.20f, 0.45f), glm::vec3(0.35f, 0.16f, 0.04f),
      glm::vec3(0.45f, 0.70f, 0.10f), glm::vec3(0.90f, 0.28f, 0.02f), glm::vec3(0.25f, 0.40f, 0.90f), glm::vec3(0.60f, 0.60f, 0.60f)};
  return colors[index % colors.size()];
}

std::vector<float> scaleColors(const std::vector<float>& values, const ColorScale& scale) {
  std::vector<float> colors(values.size() * 3);
  for (size_t v = 0; v < values.size(); ++v) {
    const glm::vec3 color = scaleColor(scale.share(static_cast<double>(values[v])));
    std::copy(&color.x, &color.x + 3, &colors[3 * v]);
  }
  return colors;
}

}  // namespace forelock::samples
