// Letters of 5 x 7 pixels, for labels in pictures: no fonts are looked for on the machine. SPDX-License-Identifier: MIT
#pragma once

#include "image.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace forelock::samples {

constexpr uint32_t kGlyphWidth = 6, kGlyphHeight = 9;  // (px) with the space to the next, at a scale of 1

// Pixels that a line takes; text is UTF-8, of which what is not in the font is drawn as a box.
uint32_t textWidth(const std::string& text, uint32_t scale = 1);

// Its upper left at (x, y); opaque; cut at the picture's edges.
void drawText(Image& image, int x, int y, const std::string& text, const glm::vec3& color, uint32_t scale = 1);

void fillBox(Image& image, int x, int y, int width, int height, const glm::vec3& color);

// `text` broken at spaces into lines of at most `columns` letters, and within words that are longer; at most `lines`, of which the last
// then ends in "...".
std::vector<std::string> wrapText(const std::string& text, size_t columns, size_t lines);

// The whole of `text`, or its beginning and end with ".." between.
std::string shortened(const std::string& text, size_t columns);

}  // namespace forelock::samples
