// Pictures side by side with a line of text under each. SPDX-License-Identifier: MIT
#pragma once

#include "bitmap_text.h"

#include <string>
#include <vector>

namespace forelock::samples {

// Where everything goes; a tile is a picture, below it its label.
struct SheetLayout {
  uint32_t columns = 1, rows = 1;
  uint32_t tile_width = 1, tile_height = 1;  // (px) of the pictures
  uint32_t title_height = 0, label_height = 0, gap = 0;
  uint32_t text_scale = 1;  // the letters' (px)

  uint32_t width() const { return columns * tile_width + (columns + 1) * gap; }
  uint32_t height() const { return title_height + rows * (tile_height + label_height) + (rows + 1) * gap; }
  uint32_t left(uint32_t index) const { return gap + index % columns * (tile_width + gap); }
  uint32_t top(uint32_t index) const { return title_height + gap + index / columns * (tile_height + label_height + gap); }
};

// `count` tiles of this size in `columns`; columns 0: about as wide as high.
SheetLayout layoutSheet(uint32_t count, uint32_t tile_width, uint32_t tile_height, uint32_t columns, bool title);

// On a dark ground.
class ContactSheet {
 public:
  ContactSheet(const SheetLayout& layout, const std::string& title);

  // A picture of the tile's size or larger, which is averaged down and put in the tile's middle, over the ground.
  void place(uint32_t index, const Image& picture, const std::string& label);
  // Text in place of a picture, red where it is a failure.
  void placeText(uint32_t index, const std::string& text, const std::string& label, bool failure);

  SheetLayout layout;
  Image image;

 private:
  void ground(uint32_t index);
  void label(uint32_t index, const std::string& text, bool failure);
};

// Averages blocks of pixels until the picture fits into width x height; as it is where it does.
Image shrink(const Image& image, uint32_t width, uint32_t height);

}  // namespace forelock::samples
