// SPDX-License-Identifier: MIT
#include "contact_sheet.h"

#include <algorithm>
#include <cmath>

namespace forelock::samples {

namespace {

// Linear.
const glm::vec3 kGround(0.020f, 0.022f, 0.026f), kTile(0.032f, 0.035f, 0.041f), kText(0.75f), kFailure(0.90f, 0.08f, 0.05f);

}  // namespace

SheetLayout layoutSheet(uint32_t count, uint32_t tile_width, uint32_t tile_height, uint32_t columns, bool title) {
  SheetLayout layout;
  count = std::max(count, 1u);
  layout.columns = std::min(columns > 0 ? columns : static_cast<uint32_t>(std::ceil(std::sqrt(static_cast<double>(count)))), count);
  layout.rows = (count + layout.columns - 1) / layout.columns;
  layout.tile_width = tile_width;
  layout.tile_height = tile_height;
  layout.text_scale = tile_width >= 384 ? 2 : 1;
  layout.gap = std::max(2u, tile_width / 64);
  layout.label_height = (kGlyphHeight + 3) * layout.text_scale;
  layout.title_height = title ? (kGlyphHeight + 5) * (layout.text_scale + 1) : 0;
  return layout;
}

Image shrink(const Image& image, uint32_t width, uint32_t height) {
  const uint32_t factor = std::max((image.width + width - 1) / std::max(width, 1u), (image.height + height - 1) / std::max(height, 1u));
  if (factor <= 1) {
    return image;
  }
  Image small((image.width + factor - 1) / factor, (image.height + factor - 1) / factor);
  for (uint32_t y = 0; y < small.height; ++y) {
    for (uint32_t x = 0; x < small.width; ++x) {
      const uint32_t right = std::min((x + 1) * factor, image.width), bottom = std::min((y + 1) * factor, image.height);
      const float share = 1.0f / static_cast<float>((right - x * factor) * (bottom - y * factor));
      float* to = small.pixel(x, y);
      for (uint32_t j = y * factor; j < bottom; ++j) {
        for (uint32_t i = x * factor; i < right; ++i) {
          const float* from = image.pixel(i, j);
          for (int channel = 0; channel < 4; ++channel) {
            to[channel] += share * from[channel];
          }
        }
      }
    }
  }
  return small;
}

ContactSheet::ContactSheet(const SheetLayout& wanted, const std::string& title) : layout(wanted), image(wanted.width(), wanted.height()) {
  fillBox(image, 0, 0, static_cast<int>(image.width), static_cast<int>(image.height), kGround);
  if (layout.title_height > 0) {
    const uint32_t scale = layout.text_scale + 1;
    drawText(image, static_cast<int>(layout.gap), static_cast<int>(layout.gap + 2 * scale),
             shortened(title, (layout.width() - 2 * layout.gap) / (kGlyphWidth * scale)), kText, scale);
  }
}

void ContactSheet::ground(uint32_t index) {
  fillBox(image, static_cast<int>(layout.left(index)), static_cast<int>(layout.top(index)), static_cast<int>(layout.tile_width),
          static_cast<int>(layout.tile_height), kTile);
}

void ContactSheet::label(uint32_t index, const std::string& text, bool failure) {
  drawText(image, static_cast<int>(layout.left(index)), static_cast<int>(layout.top(index) + layout.tile_height + 2 * layout.text_scale),
           shortened(text, layout.tile_width / (kGlyphWidth * layout.text_scale)), failure ? kFailure : kText, layout.text_scale);
}

void ContactSheet::place(uint32_t index, const Image& picture, const std::string& text) {
  ground(index);
  const Image small = shrink(picture, layout.tile_width, layout.tile_height);
  const uint32_t left = layout.left(index) + (layout.tile_width - small.width) / 2;
  const uint32_t top = layout.top(index) + (layout.tile_height - small.height) / 2;
  for (uint32_t y = 0; y < small.height; ++y) {
    for (uint32_t x = 0; x < small.width; ++x) {
      const float* from = small.pixel(x, y);
      float* to = image.pixel(left + x, top + y);
      for (int channel = 0; channel < 3; ++channel) {
        to[channel] = from[channel] + (1.0f - from[3]) * to[channel];
      }
    }
  }
  label(index, text, false);
}

void ContactSheet::placeText(uint32_t index, const std::string& text, const std::string& name, bool failure) {
  ground(index);
  const uint32_t scale = layout.text_scale, line = (kGlyphHeight + 2) * scale, edge = 4 * scale;
  const size_t columns = (layout.tile_width - std::min(layout.tile_width, 2 * edge)) / (kGlyphWidth * scale);
  const size_t lines = (layout.tile_height - std::min(layout.tile_height, 2 * edge)) / line;
  int y = static_cast<int>(layout.top(index) + edge);
  for (const std::string& part : wrapText(text, columns, lines)) {
    drawText(image, static_cast<int>(layout.left(index) + edge), y, part, failure ? kFailure : kText, scale);
    y += static_cast<int>(line);
  }
  label(index, name, failure);
}

}  // namespace forelock::samples
