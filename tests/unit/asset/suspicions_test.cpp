// What is said of strands that are sound: each suspicion on hair that has it, and silence on hair that has not.
#include "asset_arrays.h"

#include <chrono>
#include <cmath>
#include <cstdio>

using namespace asset_test;

namespace {

float unit(uint32_t& state) {
  state = state * 1664525u + 1013904223u;
  return static_cast<float>(state >> 8) / 16777216.0f;
}

// Hair on the upper half of a sphere of 0.1, ten times longer to shorter: roots on a surface, tips not.
Arrays head(uint32_t strands, uint32_t vertices = 8) {
  Arrays arrays;
  uint32_t state = 1;
  for (uint32_t i = 0; i < strands; ++i) {
    const float y = unit(state), turn = 6.2831853f * unit(state), ring = std::sqrt(1 - y * y), length = 0.02f + 0.18f * unit(state);
    const float root[3] = {0.1f * ring * std::cos(turn), 0.1f * y, 0.1f * ring * std::sin(turn)};
    for (uint32_t v = 0; v < vertices; ++v) {
      const float t = static_cast<float>(v) / static_cast<float>(vertices - 1), out = 1 + 10 * t * length;
      arrays.positions.insert(arrays.positions.end(), {root[0] * out, root[1] * out - 0.3f * length * t * t, root[2] * out});
    }
    arrays.first_vertex.push_back(static_cast<uint32_t>(arrays.positions.size() / 3));
  }
  return arrays;
}

template <class T> void turnAround(std::vector<T>& values, size_t begin, size_t end, size_t size) {
  for (size_t a = begin, b = end; a + 1 < b; ++a)
    for (size_t c = (--b, 0); c < size; ++c) std::swap(values[a * size + c], values[b * size + c]);
}

Arrays reversed(Arrays arrays) {
  for (size_t i = 0; i + 1 < arrays.first_vertex.size(); ++i) {
    const size_t begin = arrays.first_vertex[i], end = arrays.first_vertex[i + 1];
    turnAround(arrays.positions, begin, end, 3);
    if (!arrays.radii.empty()) turnAround(arrays.radii, begin, end, 1);
    if (!arrays.inverse_masses.empty()) turnAround(arrays.inverse_masses, begin, end, 1);
  }
  return arrays;
}

}  // namespace

TEST(Suspicions, HairThatIsRightSaysNothing) {
  for (const uint32_t strands : {8u, 64u, 500u, 5000u}) EXPECT_EQ(create(head(strands))->codes(), "WIDTH_DEFAULTED") << strands;
}

TEST(Suspicions, RootAtTip) {
  for (const uint32_t strands : {200u, 500u, 5000u}) {  // with fewer the neighbours of a root go around the head
    const auto made = create(reversed(head(strands)));
    EXPECT_EQ(made->codes(), "ROOT_AT_TIP WIDTH_DEFAULTED") << strands;
    EXPECT_EQ(made->finding("ROOT_AT_TIP").count, strands);
    EXPECT_NE(std::string(made->finding("ROOT_AT_TIP").text).find("smooth surface as roots do"), std::string::npos);
  }
  EXPECT_EQ(create(reversed(head(63)))->codes(), "WIDTH_DEFAULTED") << "too few to tell";
}

// A flat brush of equal bristles: both ends are planes, so that only widths or pins can tell.
TEST(Suspicions, RootAtTipByWidthsAndPins) {
  Arrays brush;
  uint32_t state = 7;
  for (int i = 0; i < 100; ++i) {
    const float x = unit(state), z = unit(state);
    brush.strand({x, 0, z, x, 0.5f, z, x, 1, z});
    brush.radii.insert(brush.radii.end(), {0.002f, 0.002f, 0.001f});
    brush.inverse_masses.insert(brush.inverse_masses.end(), {0, 1, 1});
  }
  EXPECT_EQ(create(brush)->codes(), "");
  const std::string text = create(reversed(brush))->finding("ROOT_AT_TIP").text;
  EXPECT_NE(text.find("thicker at their last vertex, they are pinned at their last vertex alone"), std::string::npos) << text;
  Arrays bare = brush;
  bare.radii.clear();
  EXPECT_NE(std::string(create(reversed(bare))->finding("ROOT_AT_TIP").text).find("to root: they are pinned"), std::string::npos);
  bare.inverse_masses.clear();
  EXPECT_EQ(create(reversed(bare))->codes(), "WIDTH_DEFAULTED");
}

TEST(Suspicions, WidthsThatGrowOnStrandsThatAreRight) {
  Arrays arrays = head(200);
  for (size_t v = 0; v < arrays.first_vertex.back(); ++v) arrays.radii.push_back(1e-5f * static_cast<float>(1 + v % 8));
  EXPECT_EQ(create(arrays)->codes(), "WIDTH_GROWS");
}

TEST(Suspicions, Duplicates) {
  Arrays arrays = head(100, 4);
  for (const uint32_t copied : {3u, 3u, 99u}) {
    const std::vector<float> again(arrays.positions.begin() + copied * 12, arrays.positions.begin() + copied * 12 + 12);
    arrays.positions.insert(arrays.positions.end(), again.begin(), again.end());
    arrays.first_vertex.push_back(static_cast<uint32_t>(arrays.positions.size() / 3));
  }
  const auto made = create(arrays);
  EXPECT_EQ(made->codes(), "STRAND_DUPLICATE WIDTH_DEFAULTED");
  const FlkFinding finding = made->finding("STRAND_DUPLICATE");
  EXPECT_EQ(finding.count, 3u);
  EXPECT_EQ(finding.strands[0], 100u);
  EXPECT_EQ(finding.strands[2], 102u);
  // Numbers are those of the source where strands before were dropped, and equal vertices at the start alone are no copy.
  Arrays dropped;
  dropped.strand({1, 1, 1, 1, 1, 1}).goodStrand().strand({2, 2, 2, 2, 2, 2}).goodStrand(1).goodStrand();
  dropped.strand({5, 0, 0, 5, 1, 0, 5, 2, 0, 5, 3, 0, 5, 4, 0}).strand({5, 0, 0, 5, 1, 0, 5, 2, 0, 5, 3, 0, 5, 4, 0.5f});
  const FlkFinding shifted = create(dropped)->finding("STRAND_DUPLICATE");
  EXPECT_EQ(shifted.count, 1u);
  EXPECT_EQ(shifted.strands[0], 4u);
}

TEST(Suspicions, WidthsOfAnotherUnit) {
  for (const auto& [radius, expected] : {std::pair{4e-5f, ""}, {2e-3f, ""}, {4e-3f, "WIDTH_SUSPECT"}, {0.04f, "WIDTH_SUSPECT"}, {2e-7f, "WIDTH_SUSPECT"}}) {
    Arrays arrays = head(100);
    arrays.radii.assign(arrays.positions.size() / 3, radius);
    EXPECT_EQ(create(arrays)->codes(), expected) << radius;
  }
}

TEST(Suspicions, RootUvs) {
  const auto codes = [](float u, float v, float first_u) {
    Arrays arrays = head(10);
    for (int i = 0; i < 10; ++i) arrays.root_uvs.insert(arrays.root_uvs.end(), {i ? u : first_u, v});
    return create(arrays)->codes();
  };
  EXPECT_EQ(codes(0, 0, 0), "ROOT_UV_ALL_ZERO WIDTH_DEFAULTED");
  EXPECT_EQ(codes(0.5f, 0.25f, 0.5f), "ROOT_UV_CONSTANT WIDTH_DEFAULTED");
  EXPECT_EQ(codes(0.5f, 0.25f, 0.125f), "WIDTH_DEFAULTED");
  EXPECT_EQ(codes(0.5f, 0.25f, 1.5f), "ROOT_UV_OUTSIDE_UNIT WIDTH_DEFAULTED");
}

TEST(Suspicions, Masses) {
  const auto codes = [](float root, float middle, float tip) {
    Arrays arrays;
    for (int i = 0; i < 3; ++i) {
      arrays.goodStrand(static_cast<float>(i));
      arrays.inverse_masses.insert(arrays.inverse_masses.end(), {root, middle, tip});
    }
    return create(arrays)->codes();
  };
  EXPECT_EQ(codes(0, 1, 1), "WIDTH_DEFAULTED");
  EXPECT_EQ(codes(0, 1, 0), "BOTH_ENDS_FIXED WIDTH_DEFAULTED");
  EXPECT_EQ(codes(0, 0, 0), "INVERSE_MASS_ALL_ZERO WIDTH_DEFAULTED");
  EXPECT_EQ(codes(1, 0, 1), "ROOT_NOT_PINNED WIDTH_DEFAULTED");
}

TEST(Suspicions, LongStrandsAndFarHair) {
  Arrays spike = head(100);
  spike.positions[3 * 8 * 40 + 3 * 7] = 3;
  const auto made = create(spike);
  EXPECT_EQ(made->codes(), "STRAND_LONG WIDTH_DEFAULTED");
  EXPECT_EQ(made->finding("STRAND_LONG").strands[0], 40u);
  Arrays far = head(100);
  for (size_t i = 0; i < far.positions.size(); i += 3) far.positions[i] += 9000;
  const auto away = create(far);
  EXPECT_EQ(away->finding("FAR_FROM_ORIGIN").count, 1u);
  EXPECT_NE(std::string(away->finding("FAR_FROM_ORIGIN").text).find("floats are 0.00098 apart"), std::string::npos) << away->finding("FAR_FROM_ORIGIN").text;
}

// Strands made to meet in the table, all with the same first three vertices: the work stays linear. With whole chains walked
// these would be 2e9 comparisons.
TEST(Suspicions, DuplicatesInLinearTime) {
  Arrays arrays;
  for (int i = 0; i < 60'000; ++i) arrays.strand({0, 0, 0, 0, 1, 0, 0, 2, 0, static_cast<float>(i), 3, 0});
  const auto begin = std::chrono::steady_clock::now();
  const auto made = create(arrays);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  EXPECT_EQ(made->finding("STRAND_DUPLICATE").count, 0u);
  std::printf("60,000 strands of one hash: %.1f ms with three round trips\n", seconds * 1e3);
  EXPECT_LT(seconds, 5);
}
