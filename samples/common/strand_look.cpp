// SPDX-License-Identifier: MIT
#include "strand_look.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace forelock::samples {

double WidthProfile::at(double along) const {
  if (along <= knots.front().along) return knots.front().factor;
  for (size_t i = 1; i < knots.size(); ++i)
    if (along < knots[i].along) {
      const double t = (along - knots[i - 1].along) / (knots[i].along - knots[i - 1].along);
      return knots[i - 1].factor + (knots[i].factor - knots[i - 1].factor) * t;
    }
  return knots.back().factor;
}

WidthProfile parseWidthProfile(const std::string& text) {
  WidthProfile profile;
  const char *at = text.data(), *const end = at + text.size();
  const auto number = [&](double& value) {
    const std::from_chars_result read = std::from_chars(at, end, value);  // the same in every locale
    if (read.ec != std::errc() || !std::isfinite(value)) throw std::invalid_argument("is " + text + ", must be PLACE:FACTOR,... like 0:1,0.7:0.9,1:0.1");
    at = read.ptr;
  };
  for (;;) {
    WidthProfile::Knot knot{};
    number(knot.along);
    if (at == end || *at++ != ':') throw std::invalid_argument("is " + text + ", must be PLACE:FACTOR,... like 0:1,0.7:0.9,1:0.1");
    number(knot.factor);
    if (knot.along < 0 || knot.along > 1) throw std::invalid_argument("is " + text + ": a place along a strand is between 0 (root) and 1 (tip)");
    if (knot.factor < 0 || knot.factor > 1e6) throw std::invalid_argument("is " + text + ": a factor is between 0 and 1e6");
    if (!profile.knots.empty() && knot.along <= profile.knots.back().along) throw std::invalid_argument("is " + text + ": places must rise");
    profile.knots.push_back(knot);
    if (at == end) return profile;
    if (*at++ != ',') throw std::invalid_argument("is " + text + ", must be PLACE:FACTOR,... like 0:1,0.7:0.9,1:0.1");
  }
}

void applyWidthProfile(EditableStrands& strands, const WidthProfile& profile, double diameter) {
  if (strands.radii.empty() && diameter <= 0) throw std::invalid_argument("strands without widths need a diameter");
  if (diameter > 0) strands.radii.assign(strands.vertices(), float(0.5 * diameter));
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    const size_t begin = strands.first_vertex[strand], end = strands.first_vertex[strand + 1];
    const std::vector<double> along = lengthsAlong(strands, strand);
    for (size_t v = begin; v < end; ++v) strands.radii[v] = float(double(strands.radii[v]) * profile.at(along.back() > 0 ? along[v - begin] / along.back() : 0));
  }
}

RootColorReport colorFromImage(EditableStrands& strands, const Image& image) {
  if (strands.root_uvs.empty()) throw std::invalid_argument("there are no root UVs to look up");
  RootColorReport report;
  if (strands.colors.empty()) strands.colors.assign(3 * size_t{strands.vertices()}, 1.0f);
  // Bilinear between pixel centres, held at the border: as FlkRootImage is read.
  const auto place = [](double t, uint32_t size, uint32_t& low, uint32_t& high) {
    const double at = std::clamp(t * size - 0.5, 0.0, double(size) - 1);
    low = uint32_t(at), high = std::min(low + 1, size - 1);
    return at - low;
  };
  for (uint32_t strand = 0; strand < strands.strands(); ++strand) {
    const float u = strands.root_uvs[2 * size_t{strand}], v = strands.root_uvs[2 * size_t{strand} + 1];
    report.outside += u < 0 || u > 1 || v < 0 || v > 1;
    uint32_t x0, x1, y0, y1;
    const double fx = place(u, image.width, x0, x1), fy = place(v, image.height, y0, y1);
    for (size_t c = 0; c < 3; ++c) {
      const auto pixel = [&](uint32_t x, uint32_t y) { return double(image.pixel(x, y)[c]); };
      const double color = (pixel(x0, y0) * (1 - fx) + pixel(x1, y0) * fx) * (1 - fy) + (pixel(x0, y1) * (1 - fx) + pixel(x1, y1) * fx) * fy;
      for (size_t vertex = strands.first_vertex[strand]; vertex < strands.first_vertex[strand + 1]; ++vertex)
        strands.colors[3 * vertex + c] = float(std::clamp(double(strands.colors[3 * vertex + c]) * color, 0.0, 1.0));
    }
  }
  return report;
}

}  // namespace forelock::samples
