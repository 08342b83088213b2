// What the colours of a picture mean: a bar with numbers, or boxes with words. SPDX-License-Identifier: MIT
#pragma once

#include "image.h"
#include "strand_color.h"

#include <string>
#include <utility>
#include <vector>

namespace forelock::samples {

struct Legend {
  std::string title;                                       // empty: colours need no words
  std::vector<std::pair<double, glm::vec3>> stops;         // of the bar: share of it, linear colour; empty: no bar
  std::vector<std::pair<double, std::string>> marks;       // numbers under the bar
  std::vector<std::pair<glm::vec3, std::string>> swatches;
  std::vector<std::string> notes;                          // for the printed legend only
};

Legend scaleLegend(const std::string& title, const ColorScale& scale);

// Of FLK_DISPLAY_...; empty where colours are no data.
Legend displayLegend(uint32_t display);

// Of the bar, where it has one: linear, at a share of it in [0, 1].
glm::vec3 barColor(const Legend& legend, double share);

inline constexpr size_t kMostSwatches = 10;  // that are shown; the last of more says so

// Nothing where the picture is too small for it. `corner`: negative becomes the one where it covers least, the lower left one if equal;
// the next pictures of a row keep it.
void drawLegend(Image& image, const Legend& legend, int& corner);

// "curvature (1/unit): blue 0, green 55, red 110".
std::string legendText(const Legend& legend);

// For a label: "curvature 0 to 110", "groups".
std::string shortLegend(const Legend& legend, const std::string& name);

std::string shortNumber(double value);

}  // namespace forelock::samples
