#include "asset/cursor.h"
#include "asset/report.h"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <limits>
#include <string>

using forelock::ByteSink;
using forelock::Cursor;

namespace {

constexpr std::array<std::byte, 10> bytes{std::byte{0x01}, std::byte{0x02}, std::byte{0x03}, std::byte{0x04}, std::byte{0xff},
                                          std::byte{0xfe}, std::byte{0x00}, std::byte{0x00}, std::byte{0x80}, std::byte{0x40}};

}  // namespace

TEST(Cursor, ReadsLittleEndianAtAnyAlignment) {
  Cursor cursor(bytes);
  EXPECT_EQ(cursor.u32(), 0x04030201u);
  EXPECT_EQ(cursor.u16(), 0xfeffu);
  EXPECT_EQ(cursor.f32(), 4.0f);
  EXPECT_EQ(cursor.left(), 0u);
  EXPECT_FALSE(cursor.failed());
  Cursor odd(bytes, 3);
  EXPECT_EQ(odd.u16(), 0xff04u);
}

TEST(Cursor, NeverLeavesTheSpan) {
  Cursor cursor(bytes, 8);
  EXPECT_EQ(cursor.u32(), 0u);
  EXPECT_TRUE(cursor.failed());
  EXPECT_EQ(cursor.u16(), 0u) << "stays at the end";
  EXPECT_EQ(cursor.at(), bytes.size());

  std::array<float, 3> out{1, 2, 3};
  Cursor floats(bytes, 0);
  floats.floats(out);
  EXPECT_TRUE(floats.failed());
  EXPECT_EQ(out, (std::array<float, 3>{0, 0, 0}));
  Cursor enough(bytes, 6);
  enough.floats(std::span(out).first(1));
  EXPECT_FALSE(enough.failed());
  EXPECT_EQ(out[0], 4.0f);
  enough.floats({});
  EXPECT_FALSE(enough.failed());

  for (const uint64_t offset : {uint64_t{11}, std::numeric_limits<uint64_t>::max()}) {
    Cursor past(bytes, offset);
    EXPECT_TRUE(past.failed());
    EXPECT_EQ(past.left(), 0u);
    EXPECT_EQ(past.u32(), 0u);
  }
  EXPECT_FALSE(Cursor(bytes, 10).failed());
}

TEST(Cursor, ProvesCountsWithoutOverflow) {
  const Cursor cursor(bytes, 2);
  EXPECT_TRUE(cursor.holds(2, 4));
  EXPECT_FALSE(cursor.holds(3, 4));
  EXPECT_TRUE(cursor.holds(0, 16));
  EXPECT_FALSE(cursor.holds(uint64_t{1} << 60, 16));
  EXPECT_FALSE(cursor.holds(std::numeric_limits<uint64_t>::max(), 2));
  EXPECT_EQ(forelock::saturatingProduct(uint64_t{1} << 60, 16), std::numeric_limits<uint64_t>::max());
  EXPECT_EQ(forelock::saturatingProduct(uint64_t{1} << 59, 16), uint64_t{1} << 63);
  EXPECT_EQ(forelock::saturatingProduct(7, 0), 0u);
  EXPECT_EQ(forelock::saturatingSum(std::numeric_limits<uint64_t>::max(), 1), std::numeric_limits<uint64_t>::max());
}

TEST(ByteSink, WritesWhatTheCursorReads) {
  std::array<std::byte, 10> out{};
  ByteSink sink(out);
  sink.u32(0x04030201u);
  sink.u16(0xfeffu);
  EXPECT_FALSE(sink.complete());
  sink.f32(4.0f);
  EXPECT_TRUE(sink.complete());
  EXPECT_EQ(out, bytes);
  sink.u16(7);
  EXPECT_FALSE(sink.complete()) << "one value too many";
  EXPECT_EQ(out, bytes);
}

TEST(Quoted, ShowsWholeCharactersOnly) {
  const auto shown = [](const std::string& word) { return std::string(forelock::Quoted(word).text); };
  EXPECT_EQ(shown("numVerts"), "numVerts");
  EXPECT_EQ(shown(""), "");
  for (const char* whole : {"kopf\xc3\xbc", "\xe9\xa0\xad", "\xf0\x9f\x92\x87"}) EXPECT_EQ(shown(whole), whole);
  EXPECT_EQ(shown(std::string("a\nb\x7f\0c", 6)), "a?b??c");
  EXPECT_EQ(shown("\xff\xc3"), "??") << "no lead, and a lead that nothing follows";
  EXPECT_EQ(shown("\xc0\xaf"), "??") << "longer than needed";
  EXPECT_EQ(shown("\xe0\x80\xaf"), "???") << "longer than needed";
  EXPECT_EQ(shown("\xf0\x80\x80\xaf"), "????") << "longer than needed";
  EXPECT_EQ(shown("\xed\xa0\x80"), "???") << "a surrogate";
  EXPECT_EQ(shown("\xf4\x90\x80\x80"), "????") << "beyond the last character";
  EXPECT_EQ(shown("\xc2\x85"), "??") << "a control character";
  EXPECT_EQ(shown(std::string(100, 'x')), std::string(60, 'x'));
  EXPECT_EQ(shown(std::string(59, 'x') + "\xc3\xbc"), std::string(59, 'x')) << "a character that does not fit is left out whole";
}

// Sentences go into caches, whose bytes must not follow the host's locale.
TEST(Number, AsTheLocaleCHasIt) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"C", "de_DE.UTF-8"}) {
    if (!std::setlocale(LC_ALL, name)) continue;
    EXPECT_STREQ(forelock::Number(0.25).text, "0.25");
    EXPECT_STREQ(forelock::Number(1234567, 6).text, "1.23457e+06");
    EXPECT_STREQ(forelock::Number(-3e-7).text, "-3e-07");
  }
  std::setlocale(LC_ALL, before.c_str());
}
