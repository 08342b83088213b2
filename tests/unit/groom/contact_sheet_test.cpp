// Sheets and their letters.
#include "contact_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace forelock::samples {
namespace {

float sum(const Image& image) {
  float total = 0;
  for (const float v : image.rgba) total += v;
  return total;
}

Image filled(uint32_t width, uint32_t height, const glm::vec3& color, float alpha) {
  Image image(width, height);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    for (size_t c = 0; c < 3; ++c) image.rgba[i + c] = alpha * color[int(c)];
    image.rgba[i + 3] = alpha;
  }
  return image;
}

}  // namespace

TEST(ContactSheet, TilesNeverMeetAndStayInside) {
  for (const uint32_t count : {1u, 2u, 3u, 5u, 12u, 17u, 100u})
    for (const uint32_t columns : {0u, 1u, 4u})
      for (const bool title : {false, true}) {
        const SheetLayout l = layoutSheet(count, 96, 64, columns, title);
        EXPECT_GE(l.columns * l.rows, count);
        EXPECT_LT(l.columns * (l.rows - 1), count) << "no row is empty";
        std::set<std::pair<uint32_t, uint32_t>> places;
        for (uint32_t i = 0; i < count; ++i) {
          EXPECT_LE(l.left(i) + l.tile_width + l.gap, l.width());
          EXPECT_LE(l.top(i) + l.tile_height + l.label_height + l.gap, l.height());
          EXPECT_GE(l.top(i), l.title_height);
          EXPECT_TRUE(places.insert({l.left(i) / (l.tile_width + l.gap), l.top(i) / (l.tile_height + l.label_height + l.gap)}).second);
        }
      }
}

TEST(ContactSheet, PictureLiesInItsTile) {
  ContactSheet sheet(layoutSheet(4, 40, 40, 2, true), "a title");
  sheet.place(3, filled(80, 40, {1, 0, 0}, 1), "red");  // averaged down to 40 x 20, in the middle
  const uint32_t x = sheet.layout.left(3), y = sheet.layout.top(3);
  EXPECT_NEAR(sheet.image.pixel(x, y + 10)[0], 1, 1e-5f);  // four quarters of 1
  EXPECT_NEAR(sheet.image.pixel(x + 39, y + 29)[0], 1, 1e-5f);
  EXPECT_LT(sheet.image.pixel(x, y + 9)[0], 0.1f);
  EXPECT_LT(sheet.image.pixel(x, y + 30)[0], 0.1f);
  for (size_t i = 3; i < sheet.image.rgba.size(); i += 4) ASSERT_EQ(sheet.image.rgba[i], 1.0f) << "no holes";
}

TEST(ContactSheet, TransparentPicturesLieOverTheGround) {
  ContactSheet sheet(layoutSheet(1, 16, 16, 0, false), "");
  sheet.placeText(0, "", "", false);
  const float ground = sheet.image.pixel(sheet.layout.left(0), sheet.layout.top(0))[0];
  sheet.place(0, filled(16, 16, {1, 1, 1}, 0.5f), "");
  EXPECT_NEAR(sheet.image.pixel(sheet.layout.left(0), sheet.layout.top(0))[0], 0.5f + 0.5f * ground, 1e-6f);
}

TEST(ContactSheet, FailuresAreRedAndStayInTheirTile) {
  ContactSheet sheet(layoutSheet(2, 64, 32, 2, false), ""), empty(sheet.layout, "");
  empty.placeText(1, "", "", false);
  sheet.placeText(1, std::string(4000, 'x') + " a long message\nwith lines", "name", true);
  float red = 0, blue = 0;
  for (uint32_t y = 0; y < sheet.image.height; ++y)
    for (uint32_t x = 0; x < sheet.image.width; ++x) {
      if (x < sheet.layout.left(1)) {
        ASSERT_EQ(sheet.image.pixel(x, y)[0], empty.image.pixel(x, y)[0]) << x << " " << y;
      }
      red += sheet.image.pixel(x, y)[0] - empty.image.pixel(x, y)[0], blue += sheet.image.pixel(x, y)[2] - empty.image.pixel(x, y)[2];
    }
  EXPECT_GT(red, 5 * blue);
}

TEST(ContactSheet, ShrinkKeepsTheMean) {
  Image image(7, 5);
  for (size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = float(i % 13);
  const Image small = shrink(image, 3, 3);
  EXPECT_EQ(small.width, 3u);
  EXPECT_EQ(small.height, 2u);
  // Blocks of 3 x 3, at the edges less: the first is a plain mean.
  float mean = 0;
  for (uint32_t y = 0; y < 3; ++y)
    for (uint32_t x = 0; x < 3; ++x) mean += image.pixel(x, y)[1] / 9;
  EXPECT_NEAR(small.pixel(0, 0)[1], mean, 1e-5f);  // nine roundings of numbers below 13
  EXPECT_EQ(sum(shrink(image, 7, 5)), sum(image));
}

TEST(BitmapText, EveryLetterIsItsOwn) {
  std::set<std::vector<float>> shapes;
  for (char c = 33; c < 127; ++c) {
    Image image(kGlyphWidth, kGlyphHeight);
    drawText(image, 0, 0, std::string(1, c), glm::vec3(1));
    EXPECT_GT(sum(image), 0) << c;
    for (uint32_t y = 0; y < kGlyphHeight; ++y) EXPECT_EQ(image.pixel(kGlyphWidth - 1, y)[3], 0) << c << ": a column between letters";
    EXPECT_TRUE(shapes.insert(image.rgba).second) << c;
  }
}

TEST(BitmapText, IsCutAtTheEdges) {
  for (const int at : {-1000, -3, 7, 1000}) {
    Image image(8, 8);
    drawText(image, at, at, "W8", glm::vec3(1), 3);
    SUCCEED();
  }
  Image none(0, 0);
  drawText(none, 0, 0, "x", glm::vec3(1));
}

TEST(BitmapText, LettersOfUtf8TakeOnePlace) {
  EXPECT_EQ(textWidth("\xc3\xa4", 1), kGlyphWidth);
  EXPECT_EQ(textWidth("ab", 2), 4 * kGlyphWidth);
  EXPECT_EQ(shortened("\xc3\xa4\xc3\xb6\xc3\xbc", 3), "\xc3\xa4\xc3\xb6\xc3\xbc");
  EXPECT_EQ(shortened("\xc3\xa4" "bcdefg\xc3\xbc", 6), "\xc3\xa4" "b..g\xc3\xbc");
}

TEST(BitmapText, WrapsAtSpaces) {
  EXPECT_EQ(wrapText("one two three", 8, 9), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapText("one\ntwo", 8, 9), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(wrapText("abcdefghij", 4, 9), (std::vector<std::string>{"abcd", "efgh", "ij"}));
  EXPECT_EQ(wrapText("one two three four", 8, 2), (std::vector<std::string>{"one two", "three..."}));
  EXPECT_TRUE(wrapText("", 8, 2).empty());
  EXPECT_TRUE(wrapText("text", 8, 0).empty());
}

}  // namespace forelock::samples
