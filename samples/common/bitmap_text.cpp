// SPDX-License-Identifier: MIT
#include "bitmap_text.h"

#include <algorithm>

namespace forelock::samples {

namespace {

// Eight rows a letter from the top, the last below the line; a row is five bits as one digit of base 32: 0-9, A-V.
constexpr const char* kGlyphs[128 - 32] = {
    "00000000", "44440040", "AA000000", "AAVAVAA0", "4FKE5U40", "OP248J30", "CIK8LID0", "44000000",  //  !"#$%&'
    "24888420", "84222480", "0LEVEL00", "044V4400", "00000C48", "000E0000", "00000CC0", "01248G00",  // ()*+,-./
    "EHJLPHE0", "4C4444E0", "EH1248V0", "V2421HE0", "26AIV220", "VGU11HE0", "68GUHHE0", "V1248880",  // 01234567
    "EHHEHHE0", "EHHF12C0", "0CC0CC00", "0CC0C480", "248G8420", "00V0V000", "84212480", "EH124040",  // 89:;<=>?
    "EHNLNGE0", "EHHVHHH0", "UHHUHHU0", "EHGGGHE0", "UHHHHHU0", "VGGUGGV0", "VGGUGGG0", "EHGNHHF0",  // @ABCDEFG
    "HHHVHHH0", "E44444E0", "72222IC0", "HIKOKIH0", "GGGGGGV0", "HRLLHHH0", "HPPLJJH0", "EHHHHHE0",  // HIJKLMNO
    "UHHUGGG0", "EHHHLID0", "UHHUKIH0", "FGGE11U0", "V4444440", "HHHHHHE0", "HHHHHA40", "HHHLLLA0",  // PQRSTUVW
    "HHA4AHH0", "HHA44440", "V1248GV0", "E88888E0", "0G842100", "E22222E0", "4AH00000", "000000V0",  // XYZ[\]^_
    "84000000", "00E1FHF0", "GGMPHHU0", "00EGGHE0", "11DJHHF0", "00EHVGE0", "698S8880", "00FHHF1E",  // `abcdefg
    "GGMPHHH0", "40C444E0", "206222IC", "GGIKOKI0", "C44444E0", "00QLLHH0", "00MPHHH0", "00EHHHE0",  // hijklmno
    "00UHHUGG", "00FHHF11", "00MPGGG0", "00FGE1U0", "88S88960", "00HHHJD0", "00HHHA40", "00HHLLA0",  // pqrstuvw
    "00HA4AH0", "00HHHF1E", "00V248V0", "24484420", "44444440", "84424480", "008L2000", "VHHHHHV0",  // xyz{|}~
};

uint32_t rowBits(char digit) { return static_cast<uint32_t>(digit <= '9' ? digit - '0' : digit - 'A' + 10); }

// Bytes that continue a letter of UTF-8 take no place of their own.
bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

const char* glyphOf(char c) {
  const unsigned char code = static_cast<unsigned char>(c);
  return kGlyphs[code >= 32 && code < 127 ? code - 32 : 127 - 32];
}

size_t letters(const std::string& text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) { return !continues(c); }));
}

// The first byte of letter `index`.
size_t byteOf(const std::string& text, size_t index) {
  size_t at = 0;
  for (size_t seen = 0; at < text.size(); ++at) {
    if (!continues(text[at]) && seen++ == index) {
      break;
    }
  }
  return at;
}

void setPixel(Image& image, int64_t x, int64_t y, const glm::vec3& color) {
  if (x < 0 || y < 0 || x >= int64_t{image.width} || y >= int64_t{image.height}) {
    return;
  }
  float* pixel = image.pixel(static_cast<uint32_t>(x), static_cast<uint32_t>(y));
  std::copy(&color.x, &color.x + 3, pixel);
  pixel[3] = 1.0f;
}

}  // namespace

uint32_t textWidth(const std::string& text, uint32_t scale) { return static_cast<uint32_t>(letters(text)) * kGlyphWidth * scale; }

void fillBox(Image& image, int x, int y, int width, int height, const glm::vec3& color) {
  for (int64_t j = y; j < int64_t{y} + height; ++j) {
    for (int64_t i = x; i < int64_t{x} + width; ++i) {
      setPixel(image, i, j, color);
    }
  }
}

void drawText(Image& image, int x, int y, const std::string& text, const glm::vec3& color, uint32_t scale) {
  const int size = static_cast<int>(scale);
  for (const char c : text) {
    if (continues(c)) {
      continue;
    }
    const char* glyph = glyphOf(c);
    for (int row = 0; row < 8; ++row) {
      const uint32_t bits = rowBits(glyph[row]);
      for (int column = 0; column < 5; ++column) {
        if (bits >> (4 - column) & 1u) {
          fillBox(image, x + column * size, y + row * size, size, size, color);
        }
      }
    }
    x += static_cast<int>(kGlyphWidth) * size;
  }
}

std::string shortened(const std::string& text, size_t columns) {
  const size_t count = letters(text);
  if (count <= columns) {
    return text;
  }
  if (columns < 5) {
    return text.substr(0, byteOf(text, columns));
  }
  const size_t tail = (columns - 2) / 2, head = columns - 2 - tail;
  return text.substr(0, byteOf(text, head)) + ".." + text.substr(byteOf(text, count - tail));
}

std::vector<std::string> wrapText(const std::string& text, size_t columns, size_t lines) {
  std::vector<std::string> wrapped;
  columns = std::max<size_t>(columns, 4);
  std::string rest = text;
  while (!rest.empty() && wrapped.size() < lines) {
    size_t end = rest.size(), next = rest.size();
    if (const size_t newline = rest.find('\n'); newline != std::string::npos && letters(rest.substr(0, newline)) <= columns) {
      end = newline, next = newline + 1;
    } else if (letters(rest) > columns) {
      end = next = byteOf(rest, columns);
      const size_t space = rest.rfind(' ', end);
      if (space != std::string::npos && space > 0) {
        end = space, next = space + 1;
      }
    }
    wrapped.push_back(rest.substr(0, end));
    rest.erase(0, next);
  }
  if (!rest.empty() && !wrapped.empty()) {
    std::string& last = wrapped.back();
    last = last.substr(0, byteOf(last, std::min(letters(last), columns - 3))) + "...";
  }
  return wrapped;
}

}  // namespace forelock::samples
