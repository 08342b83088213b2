// SPDX-License-Identifier: MIT
#include "legend.h"

#include "bitmap_text.h"

#include <forelock/render.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::samples {

namespace {

const glm::vec3 kGround(0.020f, 0.022f, 0.026f), kText(0.75f);

// How much differs from the picture's upper left pixel: hair, or the bust.
double hairIn(const Image& image, int left, int top, int width, int height) {
  double sum = 0.0;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      const float* pixel = image.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
      for (int channel = 0; channel < 4; ++channel) {
        sum += std::fabs(static_cast<double>(pixel[channel] - image.rgba[static_cast<size_t>(channel)]));
      }
    }
  }
  return sum;
}

const char* colorWord(double share) {
  constexpr const char* words[] = {"blue", "cyan", "green", "yellow", "red"};
  return words[static_cast<size_t>(std::lround(std::clamp(share, 0.0, 1.0) * 4.0))];
}

}  // namespace

glm::vec3 barColor(const Legend& legend, double share) {
  for (size_t i = 1; i < legend.stops.size(); ++i) {
    const auto& [low, low_color] = legend.stops[i - 1];
    const auto& [high, high_color] = legend.stops[i];
    if (share <= high) {
      return glm::mix(low_color, high_color, static_cast<float>((share - low) / std::max(high - low, 1e-9)));
    }
  }
  return legend.stops.back().second;
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

Legend scaleLegend(const std::string& title, const ColorScale& scale) {
  Legend legend;
  legend.title = title;
  for (int i = 0; i <= 4; ++i) {
    legend.stops.emplace_back(i / 4.0, scaleColor(i / 4.0));
  }
  const double middle = scale.logarithmic ? std::sqrt(scale.blue * scale.red) : 0.5 * (scale.blue + scale.red);
  legend.marks = {{0.0, shortNumber(scale.blue)}, {0.5, shortNumber(middle)}, {1.0, shortNumber(scale.red)}};
  return legend;
}

Legend displayLegend(uint32_t display) {
  // The colours of shaders/lib/display.glsl.
  const glm::vec3 grey(0.5f), blue(0.05f, 0.1f, 0.9f), green(0.05f, 0.7f, 0.1f), red(0.9f, 0.05f, 0.02f);
  Legend legend;
  switch (display) {
    case FLK_DISPLAY_ROOT_TIP:
      legend.title = "from root to tip";
      legend.stops = {{0.0, {0.02f, 0.05f, 0.35f}}, {1.0, {1.0f, 0.75f, 0.1f}}};
      legend.marks = {{0.0, "root"}, {1.0, "tip"}};
      break;
    case FLK_DISPLAY_WIDTH:
      legend.title = "width (px)";
      legend.stops = {{0.0, blue}, {0.5, green}, {1.0, red}};
      legend.marks = {{0.0, "1/8"}, {0.5, "1"}, {1.0, "8"}};
      break;
    case FLK_DISPLAY_DEPTH:
      legend.title = "depth";
      for (int i = 0; i <= 8; ++i) {
        const float share = static_cast<float>(i) / 8.0f;
        legend.stops.emplace_back(share, glm::vec3(0.01f + 0.89f * share * share * share));
      }
      legend.marks = {{0.0, "far"}, {1.0, "near"}};
      break;
    case FLK_DISPLAY_LAYERS:
      legend.title = "layers (fragments of the pixel)";
      legend.stops = {{0.0, grey}, {1.0 / 3.0, blue}, {2.0 / 3.0, green}, {1.0, red}};
      legend.marks = {{0.0, "1"}, {1.0 / 3.0, "8"}, {2.0 / 3.0, "50"}, {1.0, "100"}};
      break;
    default: break;
  }
  return legend;
}

void drawLegend(Image& image, const Legend& legend, int& corner) {
  if (legend.title.empty()) {
    return;
  }
  const uint32_t scale = image.width >= 900 && image.height >= 600 ? 2 : 1;
  const size_t swatches = std::min(legend.swatches.size(), kMostSwatches);
  const int s = static_cast<int>(scale), line = static_cast<int>(kGlyphHeight + 2) * s, edge = 5 * s, bar = 150 * s, thick = 8 * s;
  int width = std::max(static_cast<int>(textWidth(legend.title, scale)), legend.stops.empty() ? 0 : bar);
  int height = line + (legend.stops.empty() ? 0 : thick + 2 * s + line) + static_cast<int>(swatches) * line;
  for (size_t i = 0; i < swatches; ++i) {
    width = std::max(width, line + static_cast<int>(textWidth(legend.swatches[i].second, scale)));
  }
  width += 2 * edge, height += 2 * edge;
  if (2 * width > 3 * static_cast<int>(image.width) / 2 || 3 * height > static_cast<int>(image.height)) {
    return;  // more than three quarters of the width, or a third of the height
  }
  const int right = static_cast<int>(image.width) - width - edge, bottom = static_cast<int>(image.height) - height - edge;
  const int corners[4][2] = {{edge, bottom}, {right, bottom}, {edge, edge}, {right, edge}};
  double least = 1e30;
  int best = 0;
  for (int i = 0; corner < 0 && i < 4; ++i) {
    const double covered = hairIn(image, corners[i][0], corners[i][1], width, height);
    if (covered < least) {
      least = covered;
      best = i;
    }
  }
  corner = corner < 0 ? best : corner;
  const int left = corners[corner][0], top = corners[corner][1];
  fillBox(image, left, top, width, height, kGround);
  int y = top + edge;
  drawText(image, left + edge, y, legend.title, kText, scale);
  y += line;
  if (!legend.stops.empty()) {
    for (int x = 0; x < bar; ++x) {
      fillBox(image, left + edge + x, y, 1, thick, barColor(legend, x / static_cast<double>(bar - 1)));
    }
    y += thick + 2 * s;
    for (const auto& [share, text] : legend.marks) {
      const int size = static_cast<int>(textWidth(text, scale));
      const int x = static_cast<int>(share * bar) - static_cast<int>(share * size);  // inside at both ends
      drawText(image, left + edge + x, y, text, kText, scale);
    }
    y += line;
  }
  for (size_t i = 0; i < swatches; ++i) {
    fillBox(image, left + edge, y, 7 * s, 7 * s, legend.swatches[i].first);
    const bool more = i + 1 == swatches && legend.swatches.size() > swatches;
    drawText(image, left + edge + line, y, more ? "and more" : legend.swatches[i].second, kText, scale);
    y += line;
  }
}

std::string shortLegend(const Legend& legend, const std::string& name) {
  if (legend.marks.size() >= 2) {
    return name + " " + legend.marks.front().second + " to " + legend.marks.back().second;
  }
  return name + (legend.swatches.empty() ? "" : ": " + legend.swatches.front().second);
}

std::string legendText(const Legend& legend) {
  std::string text = legend.title;
  const char* before = ": ";
  for (const auto& [share, mark] : legend.marks) {
    text += before;
    if (legend.stops.size() == 5) {  // of scaleLegend
      text += std::string(colorWord(share)) + " ";
    }
    text += mark;
    before = ", ";
  }
  for (const auto& [color, word] : legend.swatches) {
    text += before + word;
    before = ", ";
  }
  return text;
}

}  // namespace forelock::samples
