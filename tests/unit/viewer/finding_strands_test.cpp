// The strands that findings speak of: all of them, by the numbers of the loaded asset.
#include "finding_strands.h"

#include "strand_edit.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <random>

using namespace forelock::samples;

namespace {

constexpr double kIdentity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Points = std::vector<std::array<float, 3>>;

struct Hair {
  EditableStrands held;
  Hair() { held.first_vertex = {0}; }
  uint32_t add(const Points& points, float radius = 0.001f) {
    for (const auto& p : points) held.positions.insert(held.positions.end(), p.begin(), p.end());
    held.radii.insert(held.radii.end(), points.size(), radius);
    held.first_vertex.push_back(held.first_vertex.back() + uint32_t(points.size()));
    return held.strands() - 1;
  }
  // Of length 1.02, alone of its kind.
  uint32_t sound() {
    const float x = 0.01f * float(held.strands());
    return add({{x, 0, 0}, {x, -0.5f, 0.1f}, {x, -1, 0}});
  }
  void uvs() {
    for (uint32_t i = 0; i < held.strands(); ++i) held.root_uvs.insert(held.root_uvs.end(), {0.5f + 0.001f * float(i % 100), 0.5f});
  }
};

struct Found {
  OpenedAsset opened;
  FlkStrands strands{};
  std::vector<FindingStrands> entries;
  explicit Found(const Hair& hair) : opened(assetOf(hair.held.view(), "hair")) {
    flkAssetGetStrands(opened.asset.get(), &strands);
    entries = findingStrands(opened, findStrandFaults(strands));
  }
  const FindingStrands& of(const std::string& code) const {
    for (const FindingStrands& entry : entries)
      if (entry.finding.code == code && !code.empty()) return entry;
    static const FindingStrands none;
    ADD_FAILURE() << "no " << code;
    return none;
  }
};

}  // namespace

TEST(FindingStrands, AllOfThemWhereTheFindingListsEight) {
  Hair hair;
  std::vector<uint32_t> micro, doubled, copies, uv;
  for (int i = 0; i < 40; ++i) {
    hair.sound();
    micro.push_back(hair.add({{0, float(i), 0}, {1e-6f * float(i + 1), float(i), 0}}));
    const float z = float(i + 1);
    doubled.push_back(hair.add({{0, 0, z}, {0, -1, z}, {0, -1, z}, {0, -1.1f, z}, {0, -1.1f, z}}));
    const uint32_t first = hair.sound();
    const float* p = &hair.held.positions[3 * hair.held.first_vertex[first]];
    copies.push_back(hair.add({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}}));
  }
  hair.uvs();
  for (uint32_t s = 3; s < 60; s += 3) uv.push_back(s), hair.held.root_uvs[2 * s] = 1.5f;
  const Found found(hair);
  EXPECT_EQ(found.of("STRAND_MICRO").strands, micro);
  EXPECT_EQ(found.of("STRAND_MICRO").finding.count, 40u);
  EXPECT_EQ(found.of("STRAND_MICRO").finding.strands.size(), 8u);
  EXPECT_EQ(found.of("STRAND_MICRO").label, "40 strands");
  EXPECT_TRUE(found.of("STRAND_MICRO").all);
  EXPECT_EQ(found.of("SEGMENT_ZERO_LENGTH").strands, doubled);
  EXPECT_EQ(found.of("SEGMENT_ZERO_LENGTH").finding.count, 80u) << "segments, not strands";
  EXPECT_EQ(found.of("STRAND_DUPLICATE").strands, copies);
  EXPECT_EQ(found.of("ROOT_UV_OUTSIDE_UNIT").strands, uv);
}

TEST(FindingStrands, LongStrandsAndMasses) {
  Hair hair;
  for (int i = 0; i < 80; ++i) hair.sound();
  const uint32_t tail = hair.add({{0, 0, 0}, {0, -12, 0}});
  hair.held.inverse_masses.assign(hair.held.vertices(), 1.0f);
  for (uint32_t s = 0; s < hair.held.strands(); ++s) hair.held.inverse_masses[hair.held.first_vertex[s]] = 0.0f;
  hair.held.inverse_masses[hair.held.first_vertex[7]] = 1.0f;
  hair.held.inverse_masses[hair.held.first_vertex[9] + 2] = 0.0f;
  const Found found(hair);
  EXPECT_EQ(found.of("STRAND_LONG").strands, std::vector<uint32_t>{tail});
  EXPECT_EQ(found.of("ROOT_NOT_PINNED").strands, std::vector<uint32_t>{7});
  EXPECT_EQ(found.of("BOTH_ENDS_FIXED").strands, std::vector<uint32_t>{9});
}

TEST(FindingStrands, NumbersOfTheSourceBecomeThoseLoaded) {
  Hair hair;
  for (int i = 0; i < 30; ++i) {
    if (i == 4 || i == 11) {
      hair.add({{kNan, 0, 0}, {0, 1, 0}});
    } else if (i == 20) {
      hair.add({{1, 1, 1}, {1, 1, 1}});
    } else {
      hair.sound();
    }
  }
  hair.held.colors.assign(3 * size_t{hair.held.vertices()}, 0.5f);
  for (const uint32_t s : {2u, 6u, 12u, 25u}) hair.held.colors[3 * size_t{hair.held.first_vertex[s]}] = 2.0f;
  const Found found(hair);
  ASSERT_EQ(found.strands.strand_count, 27u);
  EXPECT_EQ(found.of("POSITION_NOT_FINITE").reach, FindingReach::dropped);
  EXPECT_TRUE(found.of("POSITION_NOT_FINITE").strands.empty());
  EXPECT_EQ(found.of("POSITION_NOT_FINITE").label, "2 strands left out, of the source 4, 11");
  const FindingStrands& colors = found.of("COLOR_OUTSIDE_UNIT");
  EXPECT_EQ(colors.finding.strands, (std::vector<uint32_t>{2, 6, 12, 25}));
  EXPECT_EQ(colors.strands, (std::vector<uint32_t>{2, 5, 10, 22}));
  EXPECT_TRUE(colors.all);
  EXPECT_EQ(colors.label, "4 strands");
  for (const uint32_t s : colors.strands)
    EXPECT_EQ(found.strands.colors[3 * size_t{found.strands.first_vertex[s]}], 1.0f) << s;
}

TEST(FindingStrands, WhatIsNotKnownIsSaid) {
  Hair hair;
  for (int i = 0; i < 60; ++i) {
    if (i % 5 == 2) {
      hair.add({{kNan, 0, 0}, {0, 1, 0}});  // 2, 7 ... 57: twelve, of which eight are listed, up to 37
    } else {
      hair.sound();
    }
  }
  hair.held.colors.assign(3 * size_t{hair.held.vertices()}, 0.5f);
  for (const uint32_t s : {3u, 36u, 38u, 50u}) hair.held.colors[3 * size_t{hair.held.first_vertex[s]}] = 2.0f;
  const Found found(hair);
  const FindingStrands& colors = found.of("COLOR_OUTSIDE_UNIT");
  EXPECT_EQ(colors.strands, (std::vector<uint32_t>{2, 29}));
  EXPECT_FALSE(colors.all);
  EXPECT_EQ(colors.label, "4 strands; which of those loaded is not known of 38, 50 of the source");
  EXPECT_EQ(found.of("POSITION_NOT_FINITE").label, "12 strands left out, of the source 2, 7, 12, 17, 22, 27, 32, 37 and on");
  EXPECT_FALSE(found.of("POSITION_NOT_FINITE").all);
}

// With strands dropped at random, every number that is given is right, by the positions of the strands.
TEST(FindingStrands, SourceNumbersAreRightOrNone) {
  std::mt19937 dice(1);
  for (int round = 0; round < 200; ++round) {
    Hair hair;
    std::vector<uint32_t> loaded_of;
    uint32_t loaded = 0, known = 0;
    for (int i = 0; i < 40; ++i) {
      const bool drop = dice() % (round % 2 ? 12 : 3) == 0 && i != 0;
      if (drop) {
        if (dice() % 2) hair.add({{kNan, 0, 0}, {0, 1, 0}});
        else hair.add({{1, 1, 1}, {1, 1, 1}});
      } else {
        hair.sound();
      }
      loaded_of.push_back(drop ? UINT32_MAX : loaded++);
    }
    const Found found(hair);
    FlkAssetInfo info{};
    flkAssetGetInfo(found.opened.asset.get(), &info);
    const SourceNumbers numbers(info, findingsOf(found.opened));
    for (uint32_t i = 0; i < 40; ++i) {
      const auto got = numbers.loaded(i);
      if (got) {
        EXPECT_EQ(*got, loaded_of[i]);
        EXPECT_EQ(numbers.source(*got), std::optional<uint32_t>(i));
        ++known;
      }
    }
    for (uint32_t i = 0; i < loaded; ++i) {
      if (const auto source = numbers.source(i)) {
        EXPECT_EQ(loaded_of[*source], i);
      }
    }
    if (40 - loaded <= 8) {
      EXPECT_EQ(known, loaded) << "all dropped ones are listed";
    }
    EXPECT_FALSE(numbers.loaded(40));
    EXPECT_FALSE(numbers.source(loaded));
  }
}

TEST(FindingStrands, OfTheAssetAndOfTheViewer) {
  Hair hair;
  for (int i = 0; i < 30; ++i) hair.sound();
  hair.add({{0, 0, 0}, {0, -1, 0}, {0.01f, 0, 0}});             // 30 turns back
  hair.add({{0.5f, 0, 0}, {0.5f, -1, 0}, {0.51f, -0.1f, 0}});   // 31 too
  hair.add({{0.7f, 0, 0}, {0.7f, -1, 0}}, 0.0f);                // 32
  for (float& p : hair.held.positions) p *= 50;  // centimetres
  const Found found(hair);
  EXPECT_EQ(found.of("UNIT_SUSPECT").reach, FindingReach::asset);
  EXPECT_EQ(found.of("UNIT_SUSPECT").label, "the whole asset");
  EXPECT_EQ(pointsOf(found.strands, found.of("UNIT_SUSPECT"), kIdentity).size(), found.strands.vertex_count);
  std::vector<const FindingStrands*> own;
  for (const FindingStrands& entry : found.entries)
    if (entry.finding.code.empty()) own.push_back(&entry);
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[0]->strands, (std::vector<uint32_t>{30, 31}));
  EXPECT_EQ(own[0]->label, "2 strands");
  EXPECT_EQ(own[1]->strands, std::vector<uint32_t>{32});
}

TEST(FindingStrands, PointsAreInTheWorld) {
  Hair hair;
  hair.add({{1, 2, 3}, {4, 5, 6}});
  hair.add({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}});
  const double matrix[16] = {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1};  // a quarter turn about z, twice as large
  const std::vector<glm::vec3> points = pointsOf(hair.held.view(), std::vector<uint32_t>{0}, matrix);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0], glm::vec3(6, 22, 36));
  EXPECT_EQ(points[1], glm::vec3(0, 28, 42));
}

TEST(FindingStrands, NoneOfSoundHair) {
  Hair hair;
  for (int i = 0; i < 30; ++i) hair.sound();
  const Found found(hair);
  for (const FindingStrands& entry : found.entries) EXPECT_TRUE(entry.strands.empty()) << entry.finding.code;
}

// Files of others and our grooms: where a finding counts strands, as many are found.
TEST(FindingStrands, AsManyAsTheLibraryCounts) {
  const char* named = std::getenv("FORELOCK_HAIRDATA");
  std::vector<std::string> sources;
  for (const std::string& groom : groomNames()) {
    if (groom != "paper-load") sources.push_back("groom:" + groom);  // which is large and like long-straight
  }
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(named ? named : FORELOCK_HAIRDATA, error)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".tfx" || extension == ".hair") sources.push_back(entry.path().string());
  }
  if (error) std::printf("NOT TESTED: files of others, %s\n", error.message().c_str());
  for (const std::string& source : sources) {
    const OpenedAsset opened = openAsset(source);
    FlkStrands strands{};
    flkAssetGetStrands(opened.asset.get(), &strands);
    const StrandFaults faults = findStrandFaults(strands);
    const auto start = std::chrono::steady_clock::now();
    const std::vector<FindingStrands> entries = findingStrands(opened, faults);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s: %u strands, %.1f ms\n", source.c_str(), strands.strand_count, ms);
    for (const FindingStrands& entry : entries) {
      std::printf("  %s: %s\n", entry.finding.code.c_str(), entry.label.c_str());
      for (const char* code : {"STRAND_MICRO", "STRAND_DUPLICATE", "ROOT_UV_OUTSIDE_UNIT", "STRAND_LONG", "ROOT_NOT_PINNED"}) {
        if (entry.finding.code == code) {
          EXPECT_EQ(entry.strands.size(), entry.finding.count) << source << " " << code;
        }
      }
      for (const uint32_t strand : entry.strands) ASSERT_LT(strand, strands.strand_count);
    }
  }
}
