// Command lines, and the rows that they lead to.
#include "measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace forelock::study {
namespace {

Options parsed(std::vector<std::string> words) {
  CLI::App program;
  Arguments arguments;
  addOptions(program, arguments);
  words.insert(words.begin(), {"--asset", "groom:paper-load", "--out", "x"});
  std::reverse(words.begin(), words.end());
  program.parse(words);
  return checkOptions(arguments);
}

Room roomOf(const Options& options) {
  Room room;
  room.views = options.views;
  return room;
}

std::size_t count(const std::vector<Measurement>& rows, const std::string& view, const std::string& method) {
  return std::size_t(std::count_if(rows.begin(), rows.end(), [&](const Measurement& m) { return m.view == view && m.method->name == method; }));
}

TEST(StudyOptions, DefaultsCoverThePaper) {
  const Options options = parsed({});
  const std::vector<Measurement> rows = listMeasurements(options, roomOf(options));
  std::set<std::string> keys;
  for (const Measurement& m : rows) {
    EXPECT_TRUE(keys.insert(m.key()).second) << m.key();
    EXPECT_EQ(m.capture, "raster");
    EXPECT_EQ(m.lights, 1u);
  }
  // Every method of the main view comes first.
  for (std::size_t i = 0; i < std::size(kMethods); ++i) {
    EXPECT_EQ(rows[i].view, "198k");
    EXPECT_TRUE(rows[i].main);
    EXPECT_EQ(rows[i].k, 8u);
  }
  for (const Method& method : kMethods) EXPECT_EQ(count(rows, "35k", method.name), method.in_every_view ? 1u : 0u);
  for (const uint32_t k : {0u, 1u, 2u, 4u, 8u, 16u})
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Measurement& m) { return m.method->name == std::string("core_only") && m.k == k; }));
  EXPECT_EQ(options.minutes, 18);
}

TEST(StudyOptions, QuickIsSmallAndFullIsLarge) {
  const Options quick = parsed({"--quick"}), standard = parsed({}), full = parsed({"--full"});
  EXPECT_EQ(quick.views, std::vector<std::string>{"quick"});
  const std::size_t few = listMeasurements(quick, roomOf(quick)).size(), some = listMeasurements(standard, roomOf(standard)).size(),
                    many = listMeasurements(full, roomOf(full)).size();
  EXPECT_LT(few, 20u);
  EXPECT_GT(some, 2 * few);
  EXPECT_GT(many, 4 * some);
}

TEST(StudyOptions, KSortFollowsK) {
  const Options options = parsed({"--k", "8,16", "--methods", "core_tail", "--views", "198k"});
  for (const Measurement& m : listMeasurements(options, roomOf(options))) EXPECT_EQ(m.k_sort, std::max(8u, m.k));
  const Options sorted = parsed({"--k-sort", "12", "--k", "0,8"});
  for (const Measurement& m : listMeasurements(sorted, roomOf(sorted))) EXPECT_EQ(m.k_sort, 12u);
  FlkFrame frame{};
  Measurement none;
  none.method = findMethod("core_tail"), none.k = 0;
  applyMeasurement(none, frame);
  EXPECT_EQ(frame.k, FLK_K_NONE);
  EXPECT_EQ(frame.overflow, uint32_t(FLK_OVERFLOW_DROP));
}

TEST(StudyOptions, ADeviceWithoutGraphicsCaptures) {
  Options options = parsed({});
  Room room = roomOf(options);
  room.raster = false;
  for (const Measurement& m : listMeasurements(options, room)) EXPECT_EQ(m.capture, "compute");
  options = parsed({"--capture", "raster"});
  EXPECT_THROW(listMeasurements(options, room), UsageError);
}

TEST(StudyOptions, WhatIsWrongIsSaid) {
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--views", "198k,tall"}, "--views tall"},     {{"--views", "9000k"}, "--views 9000k"},
      {{"--methods", "core"}, "there are forward"},   {{"--k", "33"}, "[0, 32]"},
      {{"--k", "1,,2"}, "empty"},                     {{"--core-taps", "5"}, "1, 4, 9, 25"},
      {{"--shadow-size", "513"}, "even"},             {{"--lights", "4"}, "[1, 3]"},
      {{"--hair-colour", "red"}, "dark, light"},      {{"--quick", "--views", "35k"}, "--quick"},
      {{"--scene", "a.json", "--lights", "1"}, "--scene"}};
  for (const auto& [words, said] : cases) {
    try {
      parsed(words);
      ADD_FAILURE() << words.front();
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace forelock::study
