// Degenerate input to flkAssetCreate: dropped strand by strand, the rest unchanged.
#include "asset_arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace asset_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST(Sanitise, GoodStrandsStayBitForBit) {
  Arrays arrays;
  arrays.goodStrand().strand({1e-30f, -0.0f, 1e6f, -1e6f, 2, 3}).goodStrand(1);
  arrays.radii = {0, 1, 2, 3, 4, 5, 6, 7};
  arrays.root_uvs = {0, 0, 0.5f, 1, 1, 0};
  arrays.inverse_masses = {0, 1, 2, 0, 0.5f, 1, 1e30f, 1e-40f};
  arrays.colors.assign(arrays.positions.size(), 0.5f);
  arrays.colors[0] = 0;
  arrays.colors[1] = 1;
  arrays.colors[2] = -0.0f;
  arrays.colors[3] = 1e-40f;
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS) << made->caught.text();
  const FlkStrands strands = made->strands();
  EXPECT_TRUE(std::equal(arrays.first_vertex.begin(), arrays.first_vertex.end(), strands.first_vertex));
  EXPECT_EQ(std::memcmp(strands.positions, arrays.positions.data(), arrays.positions.size() * 4), 0);
  EXPECT_EQ(std::memcmp(strands.radii, arrays.radii.data(), arrays.radii.size() * 4), 0);
  EXPECT_EQ(std::memcmp(strands.root_uvs, arrays.root_uvs.data(), arrays.root_uvs.size() * 4), 0);
  EXPECT_EQ(std::memcmp(strands.inverse_masses, arrays.inverse_masses.data(), arrays.inverse_masses.size() * 4), 0);
  EXPECT_EQ(std::memcmp(strands.colors, arrays.colors.data(), arrays.colors.size() * 4), 0);
  EXPECT_EQ(made->info().has_colors, 1u);
  EXPECT_EQ(made->info().format, uint32_t{FLK_FORMAT_UNKNOWN});
}

TEST(Sanitise, DropsEachKindAndKeepsTheRest) {
  Arrays arrays;
  arrays.goodStrand(0.5f)
      .strand({0, 0, 0, 0, not_a_number, 0})
      .strand({0, 0, 0, -infinity, 0, 0})
      .strand({0, 0, 0, 0, 0, 1.0001e6f})
      .strand({1, 2, 3, 1, 2, 3, 1, 2, 3})
      .strand({1, 2, 3})
      .strand({})
      .goodStrand(0.75f)
      .strand({0, 0, 0, 3e38f, -3e38f, 3e38f})
      .strand({0, 0, 0, 1e-30f, 0, 0});
  arrays.radii.resize(arrays.positions.size() / 3);
  for (size_t i = 0; i < arrays.radii.size(); ++i) arrays.radii[i] = static_cast<float>(i);
  arrays.colors.assign(arrays.positions.size(), not_a_number);  // findings about dropped strands would mislead
  std::fill_n(arrays.colors.begin(), 9, 0.25f);
  std::fill_n(arrays.colors.begin() + 13 * 3, 9, 0.75f);
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS) << made->caught.text();
  EXPECT_EQ(made->codes(), "STRAND_TOO_SHORT POSITION_NOT_FINITE POSITION_OUT_OF_RANGE STRAND_ZERO_LENGTH");
  EXPECT_EQ(made->info().strand_count, 2u);
  EXPECT_EQ(made->info().strands_in_source, 10u);
  const auto expect = [&](const char* code, std::vector<uint32_t> numbers) {
    const FlkFinding finding = made->finding(code);
    EXPECT_EQ(finding.count, numbers.size()) << code;
    EXPECT_EQ(finding.repaired, 1u);
    EXPECT_EQ(finding.severity, uint32_t{FLK_SEVERITY_WARNING});
    EXPECT_EQ(finding.byte_offset, UINT64_MAX);
    EXPECT_EQ(std::vector<uint32_t>(finding.strands, finding.strands + finding.strands_listed), numbers) << code;
    EXPECT_NE(made->caught.find(code), nullptr);
  };
  expect("POSITION_NOT_FINITE", {1, 2});
  expect("POSITION_OUT_OF_RANGE", {3, 8});
  expect("STRAND_ZERO_LENGTH", {4, 9});
  expect("STRAND_TOO_SHORT", {5, 6});
  EXPECT_EQ(made->strands().positions[9], 0.75f);
  EXPECT_EQ(made->strands().radii[3], 13.0f);
  EXPECT_EQ(made->strands().colors[8], 0.25f);
  EXPECT_EQ(made->strands().colors[9], 0.75f);
}

TEST(Sanitise, ListsTheFirstEightStrands) {
  Arrays arrays;
  for (int i = 0; i < 20; ++i) arrays.strand({1, 1, 1, 1, 1, 1});
  arrays.goodStrand();
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS);
  const FlkFinding finding = made->finding("STRAND_ZERO_LENGTH");
  EXPECT_EQ(finding.count, 20u);
  EXPECT_EQ(finding.strands_listed, 8u);
  EXPECT_EQ(finding.strands[7], 7u);
}

TEST(Sanitise, NothingLeft) {
  EXPECT_EQ(create(Arrays().strand({0, 0, 0, not_a_number, 0, 0}))->result, FLK_ERROR_EMPTY_ASSET);
  EXPECT_EQ(create(Arrays().strand({1, 1, 1, 1, 1, 1}))->result, FLK_ERROR_EMPTY_ASSET);
  EXPECT_EQ(create(Arrays().strand({1, 1, 1}).strand({2, 2, 2}))->result, FLK_ERROR_EMPTY_ASSET);
  const auto mixed = create(Arrays().strand({1, 1, 1}).strand({infinity, 0, 0, 0, 0, 0}).strand({2, 2, 2, 2, 2, 2}));
  EXPECT_EQ(mixed->result, FLK_ERROR_EMPTY_ASSET);
  EXPECT_EQ(mixed->caught.error(), "NO_STRAND_LEFT");
  EXPECT_EQ(mixed->caught.all.size(), 1u);
}

TEST(Sanitise, ReplacesWhatIsNoWidthUvOrMass) {
  Arrays arrays;
  arrays.goodStrand().goodStrand(1);
  arrays.radii = {-1, 0.005f, not_a_number, infinity, 2e6f, 0.0025f};
  arrays.root_uvs = {not_a_number, 0.5f, 0.25f, -infinity};
  arrays.inverse_masses = {not_a_number, -1, 1, infinity, 0, 1};
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS);
  EXPECT_EQ(made->codes(), "RADIUS_INVALID ROOT_UV_NOT_FINITE INVERSE_MASS_INVALID");
  EXPECT_EQ(made->finding("RADIUS_INVALID").count, 4u);
  EXPECT_EQ(made->finding("ROOT_UV_NOT_FINITE").count, 2u);
  EXPECT_EQ(made->finding("INVERSE_MASS_INVALID").count, 3u);
  const FlkStrands strands = made->strands();
  EXPECT_FLOAT_EQ(strands.radii[0], 0.5f * 1.0f / 1000) << "the longest side is 1";
  EXPECT_EQ(strands.radii[1], 0.005f);
  EXPECT_EQ(strands.root_uvs[0], 0.0f);
  EXPECT_EQ(strands.root_uvs[1], 0.5f);
  EXPECT_EQ(strands.root_uvs[3], 0.0f);
  EXPECT_EQ(strands.inverse_masses[0], 0.0f);
  EXPECT_EQ(strands.inverse_masses[2], 1.0f);
  EXPECT_EQ(made->info().has_radii, 1u);
}

TEST(Sanitise, ReplacesWhatIsNoColour) {
  Arrays arrays;
  arrays.goodStrand().goodStrand(1);
  arrays.colors = {0.5f, not_a_number, 0.25f, 2, -1, 0.25f, infinity, -3, 0, 0, 0, 1, 0.5f, 1.0001f, 0.5f, 1, 1, 1};
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS);
  EXPECT_EQ(made->codes(), "COLOR_NOT_FINITE COLOR_OUTSIDE_UNIT WIDTH_DEFAULTED");
  EXPECT_EQ(made->finding("COLOR_NOT_FINITE").count, 2u);
  EXPECT_EQ(made->finding("COLOR_NOT_FINITE").repaired, 1u);
  EXPECT_EQ(made->finding("COLOR_OUTSIDE_UNIT").count, 2u);
  EXPECT_EQ(made->finding("COLOR_OUTSIDE_UNIT").strands_listed, 2u);
  EXPECT_NE(made->caught.find("COLOR_OUTSIDE_UNIT"), nullptr);
  const std::vector<float> expected = {1, 1, 1, 1, 0, 0.25f, 1, 1, 1, 0, 0, 1, 0.5f, 1, 0.5f, 1, 1, 1};
  EXPECT_EQ(std::vector<float>(made->strands().colors, made->strands().colors + 18), expected);
}

TEST(Sanitise, NotesWithoutChanging) {
  Arrays arrays;
  arrays.goodStrand().strand({0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0}).strand({0, 0, 0, 1e-6f, 0, 0});
  arrays.root_uvs = {0, 0, 2, 0, 0, -1};
  const auto made = create(arrays);
  ASSERT_EQ(made->result, FLK_SUCCESS);
  EXPECT_EQ(made->codes(), "SEGMENT_ZERO_LENGTH STRAND_MICRO ROOT_UV_OUTSIDE_UNIT WIDTH_DEFAULTED");
  EXPECT_EQ(made->finding("SEGMENT_ZERO_LENGTH").count, 2u);
  EXPECT_EQ(made->finding("SEGMENT_ZERO_LENGTH").strands[0], 1u);
  EXPECT_EQ(made->finding("SEGMENT_ZERO_LENGTH").repaired, 0u);
  EXPECT_EQ(made->finding("STRAND_MICRO").strands[0], 2u);
  EXPECT_EQ(made->finding("ROOT_UV_OUTSIDE_UNIT").count, 2u);
  EXPECT_EQ(made->info().vertex_count, 9u);
  for (const Caught::Message& message : made->caught.all)
    EXPECT_EQ(message.id.rfind("WRITE_", 0), 0u) << "infos are listed, not told: " << message.id;
}

// The rule of docs/findings.md: a share of the longest side by the count of strands, and two bounds.
TEST(Sanitise, DefaultWidthSaysHowToChangeIt) {
  const auto one = create(Arrays().goodStrand());
  EXPECT_FLOAT_EQ(one->strands().radii[0], 0.5f * 0.2f / 1000) << "at most 1/1,000 of the side";
  const FlkFinding finding = one->finding("WIDTH_DEFAULTED");
  EXPECT_EQ(finding.severity, uint32_t{FLK_SEVERITY_INFO});
  EXPECT_NE(std::string(finding.text).find("a diameter of 0.0002 "), std::string::npos) << finding.text;
  EXPECT_NE(std::string(finding.text).find("change it"), std::string::npos) << finding.text;
  const auto comb = [](float unit, int strands, float length) {
    Arrays arrays;
    for (int i = 0; i < strands; ++i) {
      const float x = unit * 0.4f * static_cast<float>(i) / static_cast<float>(strands - 1);
      arrays.strand({x, 0, 0, x, unit * length, 0});
    }
    return create(arrays);
  };
  EXPECT_FLOAT_EQ(comb(1, 200'000, 0.1f)->strands().radii[0], 40e-6f) << "80 um for the hair of a head";
  EXPECT_FLOAT_EQ(comb(1, 50'000, 0.1f)->strands().radii[0], 80e-6f) << "twice as wide for half as many";
  EXPECT_FLOAT_EQ(comb(100, 50'000, 0.1f)->strands().radii[0], 80e-4f) << "the same in centimetres";
  EXPECT_FLOAT_EQ(comb(1, 1'000, 0.1f)->strands().radii[0], 200e-6f) << "1/1,000 of the side";
  EXPECT_FLOAT_EQ(comb(1, 1'000, 0.01f)->strands().radii[0], 50e-6f) << "1/100 of a strand";
}

TEST(Sanitise, WidthsOfZeroAreNoted) {
  Arrays arrays;
  arrays.goodStrand();
  arrays.radii = {0, 0, 0};
  const auto made = create(arrays);
  EXPECT_EQ(made->codes(), "RADIUS_ALL_ZERO");
  EXPECT_EQ(made->strands().radii[1], 0.0f);
}

TEST(Sanitise, GuessesTheUnitWithoutApplyingIt) {
  const auto centimetres = create(Arrays().strand({0, 150, 0, 0, 170, 5}));
  EXPECT_NE(std::string(centimetres->finding("UNIT_SUSPECT").text).find("centimetres"), std::string::npos);
  EXPECT_EQ(centimetres->finding("UNIT_SUSPECT").repaired, 0u);
  EXPECT_EQ(centimetres->strands().positions[4], 170.0f);
  const auto millimetres = create(Arrays().strand({0, 1500, 0, 0, 1700, 5}));
  EXPECT_NE(std::string(millimetres->finding("UNIT_SUSPECT").text).find("millimetres"), std::string::npos);
  const auto tiny = create(Arrays().strand({0, 0, 0, 0, 0.0002f, 0}));
  EXPECT_EQ(tiny->finding("UNIT_SUSPECT").count, 1u);
  EXPECT_EQ(create(Arrays().goodStrand())->finding("UNIT_SUSPECT").count, 0u);
}

TEST(Sanitise, MeasuresWhatIsLeft) {
  Arrays arrays;
  arrays.strand({0, 0, 0, 3, 4, 0}).strand({-1, 0, 0, -1, 0, 2, -1, 1, 2}).strand({9, 9, 9, 9, 9, 9});
  arrays.radii = {1, 2, 3, 4, 0.5f, 99, 99};
  const auto made = create(arrays);
  const FlkAssetInfo info = made->info();
  EXPECT_EQ(info.min_vertices_per_strand, 2u);
  EXPECT_EQ(info.max_vertices_per_strand, 3u);
  EXPECT_EQ(info.min_bounds[0], -1.0f);
  EXPECT_EQ(info.max_bounds[0], 3.0f);
  EXPECT_EQ(info.max_bounds[1], 4.0f);
  EXPECT_EQ(info.max_bounds[2], 2.0f);
  EXPECT_EQ(info.min_length, 3.0f);
  EXPECT_EQ(info.mean_length, 4.0f);
  EXPECT_EQ(info.max_length, 5.0f);
  EXPECT_EQ(info.min_radius, 0.5f);
  EXPECT_EQ(info.max_radius, 4.0f);
}
