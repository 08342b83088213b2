// Grooms are the same bytes everywhere, stay out of the body and keep to their recipe. SPDX-License-Identifier: MIT
#include "bust_shape.h"
#include "fragment_walk.h"
#include "groom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace forelock::samples {
namespace {

Recipe stored(const char* name) { return loadRecipe(std::string(FORELOCK_SOURCE_DIR "/hairassets/") + name + ".json"); }

glm::dvec3 positionOf(const Groom& groom, size_t vertex) {
  const float* p = &groom.positions[3 * vertex];
  return {p[0], p[1], p[2]};
}

double deepestPenetration(const Groom& groom) {
  double deepest = 0.0;
  for (uint32_t strand = 0; strand < groom.strandCount(); ++strand) {
    for (uint32_t v = groom.first_vertex[strand]; v + 1 < groom.first_vertex[strand + 1]; ++v) {
      for (int quarter = 0; quarter < 4; ++quarter) {
        const double t = 0.25 * quarter;
        const glm::dvec3 p = positionOf(groom, v) * (1.0 - t) + positionOf(groom, v + 1) * t;
        deepest = std::max(deepest, -shape::bust<double>(p));
      }
    }
  }
  return deepest;
}

double strandLength(const Groom& groom, uint32_t strand) {
  double length = 0.0;
  for (uint32_t v = groom.first_vertex[strand]; v + 1 < groom.first_vertex[strand + 1]; ++v) {
    const glm::dvec3 d = positionOf(groom, v + 1) - positionOf(groom, v);
    length += std::sqrt(glm::dot(d, d));
  }
  return length;
}

std::vector<double> sortedLengths(const Groom& groom) {
  std::vector<double> lengths;
  for (uint32_t strand = 0; strand < groom.strandCount(); ++strand) {
    lengths.push_back(strandLength(groom, strand));
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

// Share of the roots that face a viewer, of those on `direction`'s side of the scalp, over which hair leaves more than
// half of the light: where a picture would show skin.
double baldShare(const Groom& groom, const Recipe& recipe, const glm::dvec3& direction) {
  constexpr uint32_t size = 256;
  Camera camera;
  camera.target = recipe.scalp.centre;
  camera.eye = recipe.scalp.centre + direction;
  camera.up = std::fabs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  camera.orthographic = true;
  camera.view_height = 0.4;
  const CameraBasis basis = cameraBasis(camera);
  struct Seen {
    double depth, transmittance;
  };
  std::map<uint32_t, std::vector<Seen>> pixels;
  size_t seen = 0;
  for (uint32_t strand = 0; strand < groom.strandCount(); ++strand) {
    const glm::dvec3 root = positionOf(groom, groom.first_vertex[strand]);
    const glm::dvec3 slope = (root - recipe.scalp.centre) / (recipe.scalp.radii * recipe.scalp.radii);
    if (glm::dot(slope, direction) < 0.7 * std::sqrt(glm::dot(slope, slope))) {
      continue;
    }
    const glm::dvec3 d = root - camera.eye;
    const double scale = size / camera.view_height;
    const uint32_t x = static_cast<uint32_t>(0.5 * size + glm::dot(d, basis.right) * scale);
    const uint32_t y = static_cast<uint32_t>(0.5 * size - glm::dot(d, basis.up) * scale);
    pixels[y * size + x].push_back({-glm::dot(d, basis.back), 1.0});
    ++seen;
  }
  walkFragments(describeGroom(groom), camera, size, size, 0.0, [&](const WalkedFragment& fragment) {
    const auto found = pixels.find(fragment.y * size + fragment.x);
    if (found == pixels.end()) {
      return;
    }
    for (Seen& root : found->second) {
      root.transmittance *= fragment.depth < root.depth ? 1.0 - fragment.coverage : 1.0;
    }
  });
  size_t bald = 0;
  for (const auto& [pixel, roots] : pixels) {
    bald += static_cast<size_t>(
        std::count_if(roots.begin(), roots.end(), [](const Seen& root) { return root.transmittance > 0.5; }));
  }
  return seen > 0 ? static_cast<double>(bald) / static_cast<double>(seen) : 0.0;
}

// A change of these hashes is a change of what every picture and measurement of these grooms shows: change a hash only
// together with the recipe or the generator, and measure the four views of paper-load again.
TEST(GroomShape, StoredGroomsAreTheSameBytesEverywhere) {
  EXPECT_EQ(hashGroom(makeGroom(stored("long-wavy"))), 0x28eaa5674d08c5d5ull);
  EXPECT_EQ(hashGroom(makeGroom(stored("paper-load"))), 0x626a6164f942adddull);
  EXPECT_EQ(hashGroom(makeGroom(stored("short-straight"))), 0x502993f3beb84b31ull);
  EXPECT_EQ(hashGroom(makeGroom(stored("curly"))), 0x876de4a4e97af7bdull);
  EXPECT_EQ(hashGroom(makeGroom(stored("fur-ball"))), 0x954860b09eb9f18full);
}

TEST(GroomShape, SeedChangesTheGroom) {
  Recipe recipe = stored("paper-load");
  recipe.strands = 100;
  const uint64_t before = hashGroom(makeGroom(recipe));
  EXPECT_EQ(hashGroom(makeGroom(recipe)), before);
  recipe.seed += 1;
  EXPECT_NE(hashGroom(makeGroom(recipe)), before);
}

TEST(GroomShape, HairLiesOnTheBustAndNotInIt) {
  // Chords of 16 mm over curved skin that is kept 1.2 mm away at the vertices; finer hair than that is not resolved.
  EXPECT_LT(deepestPenetration(makeGroom(stored("long-wavy"))), 0.0005);
  EXPECT_LT(deepestPenetration(makeGroom(stored("paper-load"))), 0.0005);
  EXPECT_LT(deepestPenetration(makeGroom(stored("short-straight"))), 0.0005);
  EXPECT_LT(deepestPenetration(makeGroom(stored("curly"))), 0.0005);
}

TEST(GroomShape, NoSkinShowsThroughTheHair) {
  for (const char* name : {"short-straight", "curly", "fur-ball"}) {
    const Recipe recipe = stored(name);
    const Groom groom = makeGroom(recipe);
    EXPECT_LE(groom.strandCount(), 30000u);
    EXPECT_LE(groom.vertexCount(), 500000u);
    const double s = 0.5773502691896258;
    for (const glm::dvec3& direction : {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, -1),
                                        glm::dvec3(s, s, s), glm::dvec3(-s, s, -s)}) {
      const double share = baldShare(groom, recipe, direction);
      std::printf("%s from (%.1f %.1f %.1f): %.2f %%\n", name, direction.x, direction.y, direction.z, 100.0 * share);
      EXPECT_LT(share, 0.05) << name;
    }
  }
}

TEST(GroomShape, ShortStraightIsShortAndStraight) {
  const Groom groom = makeGroom(stored("short-straight"));
  const std::vector<double> lengths = sortedLengths(groom);
  EXPECT_GT(lengths[lengths.size() / 50], 0.020);
  EXPECT_LT(lengths[lengths.size() - lengths.size() / 50 - 1], 0.050);
  // Straight: hair bends around the head, but from its root to its tip it goes next to no detour.
  size_t bent = 0;
  for (uint32_t strand = 0; strand < groom.strandCount(); ++strand) {
    const glm::dvec3 across = positionOf(groom, groom.first_vertex[strand + 1] - 1) - positionOf(groom, groom.first_vertex[strand]);
    bent += std::sqrt(glm::dot(across, across)) < 0.85 * strandLength(groom, strand);
  }
  EXPECT_LT(bent, groom.strandCount() / 50);
}

TEST(GroomShape, CurlyTurnsTightly) {
  const Recipe recipe = stored("curly");
  const Groom groom = makeGroom(recipe);
  // A helix of radius a and pitch p is sqrt(1 + (2 pi a / p)^2) = 2.2 times as long as its axis; ringlets grow into theirs
  // from the root, and the undercoat is shorter.
  const std::vector<double> lengths = sortedLengths(groom);
  EXPECT_GT(lengths[lengths.size() / 2], 1.6 * recipe.length.mean);
  // Every turn is drawn with six vertices or more.
  EXPECT_GE(recipe.vertices * recipe.curl.wavelength / recipe.length.mean, 6.0);
}

TEST(GroomShape, FurBallIsARoundBallWithoutHead) {
  const Recipe recipe = stored("fur-ball");
  const Groom groom = makeGroom(recipe);
  const double radius = recipe.scalp.radii.x;
  glm::dvec3 sum(0.0);
  double deepest = radius;
  for (uint32_t strand = 0; strand < groom.strandCount(); ++strand) {
    const glm::dvec3 root = positionOf(groom, groom.first_vertex[strand]);
    EXPECT_NEAR(std::sqrt(glm::dot(root, root)), radius, 1e-5);
    sum += root / radius;
    for (uint32_t v = groom.first_vertex[strand]; v < groom.first_vertex[strand + 1]; ++v) {
      const glm::dvec3 p = positionOf(groom, v);
      deepest = std::min(deepest, std::sqrt(glm::dot(p, p)));
      ASSERT_LT(glm::dot(p, p), (radius + 0.05) * (radius + 0.05));
    }
  }
  EXPECT_GT(deepest, radius - 0.0005);
  // Roots in all directions alike: a low-discrepancy sequence sums to far less than the square root of random ones.
  EXPECT_LT(std::sqrt(glm::dot(sum, sum)), std::sqrt(static_cast<double>(groom.strandCount())));
}

TEST(GroomShape, UndercoatIsShorterAndCrimped) {
  const auto grow = [](const char* undercoat) {
    return makeGroom(parseRecipe(std::string(R"({"strands": 400, "vertices": 40, "drape_on": "scalp", "flow": {"lift": 1.0},
      "length": {"mean": 0.05, "variation": 0.0, "clump_variation": 0.0})") + undercoat + "}", "test"));
  };
  const Groom without = grow(""), none = grow(R"(, "undercoat": {"fraction": 0.0, "crimp": 0.01})");
  EXPECT_EQ(hashGroom(without), hashGroom(none)) << "what no strand has changes none";
  const std::vector<double> plain = sortedLengths(grow(R"(, "undercoat": {"fraction": 0.5, "length": 0.4, "crimp": 0.0})"));
  EXPECT_NEAR(plain.front(), 0.4 * plain.back(), 0.1 * plain.back());
  const size_t shorter = static_cast<size_t>(std::count_if(plain.begin(), plain.end(), [&](double length) {
    return length < 0.6 * plain.back();
  }));
  EXPECT_NEAR(static_cast<double>(shorter), 200.0, 40.0);  // four standard deviations of 400 coin tosses
  const std::vector<double> crimped =
      sortedLengths(grow(R"(, "undercoat": {"fraction": 1.0, "length": 0.4, "crimp": 0.006, "wavelength": 0.005})"));
  EXPECT_GT(crimped[crimped.size() / 2], 1.5 * plain.front());
}

// What lengths below zero, weightless hair and a calm whorl are for.
TEST(GroomShape, HairFromTheCrownMayBeLonger) {
  const auto tallest = [](const char* more) {
    const Groom groom = makeGroom(parseRecipe(std::string(R"({"strands": 300, "drape_on": "scalp", "parting": {"strength": 0},
      "length": {"mean": 0.03, "variation": 0, "clump_variation": 0, "layers": -1},
      "flow": {"lift": 1.0, "bend": 0.05, "back": 0)") + more + "}}", "test"));
    float top = 0.0f;
    for (size_t i = 1; i < groom.positions.size(); i += 3) {
      top = std::max(top, groom.positions[i]);
    }
    EXPECT_NEAR(sortedLengths(groom).back(), 0.06, 0.006);
    return static_cast<double>(top);
  };
  const double crown = 0.022 + 0.088;
  EXPECT_GT(tallest(R"(, "gravity": 0, "whorl": 0)"), tallest("") + 0.002);
  EXPECT_LT(tallest(R"(, "gravity": 0, "whorl": 0)"), crown + 0.066);
}

TEST(GroomShape, NumbersAreOnTheirGridAndFinite) {
  const Groom groom = makeGroom(stored("paper-load"));
  for (float value : groom.positions) {
    ASSERT_TRUE(std::isfinite(value));
    ASSERT_EQ(value * 0x1p20f, std::floor(value * 0x1p20f));
  }
  for (float radius : groom.radii) {
    ASSERT_GT(radius, 0.0f);
    ASSERT_EQ(radius * 0x1p30f, std::floor(radius * 0x1p30f));
  }
  for (float uv : groom.root_uvs) {
    ASSERT_GE(uv, 0.0f);
    ASSERT_LE(uv, 1.0f);
  }
}

TEST(GroomShape, LengthsAndWidthsFollowTheRecipe) {
  Recipe recipe = parseRecipe(R"({
    "strands": 500, "vertices": 40, "drape_on": "scalp",
    "length": {"mean": 0.2, "variation": 0.1, "clump_variation": 0.0},
    "width": {"root": 1e-4, "tip": 5e-5, "taper": 0.5}})", "test");
  const Groom groom = makeGroom(recipe);
  ASSERT_EQ(groom.strandCount(), 500u);
  ASSERT_EQ(groom.vertexCount(), 500u * 40u);
  for (uint32_t strand = 0; strand < 500; ++strand) {
    double length = 0.0;
    for (uint32_t v = groom.first_vertex[strand]; v + 1 < groom.first_vertex[strand + 1]; ++v) {
      const glm::dvec3 d = positionOf(groom, v + 1) - positionOf(groom, v);
      length += std::sqrt(glm::dot(d, d));
    }
    // 10 % either way, and 8 % for what draping and chords add or take.
    EXPECT_GT(length, 0.2 * 0.9 * 0.92) << strand;
    EXPECT_LT(length, 0.2 * 1.1 * 1.08) << strand;
    // 15 % from strand to strand.
    const float root = 2.0f * groom.radii[groom.first_vertex[strand]];
    EXPECT_NEAR(root, 1e-4f, 0.151e-4f);
    EXPECT_NEAR(2.0f * groom.radii[groom.first_vertex[strand + 1] - 1], 0.5f * root, 1e-8f);
  }
}

// Every recipe of extremes makes finite hair: these are the corners of the ranges, not styles.
TEST(GroomShape, ExtremeRecipesStayFinite) {
  const char* recipes[] = {
      R"({"strands": 1, "vertices": 2})",
      R"({"strands": 20, "length": {"mean": 0.001, "variation": 0.9, "layers": 0.9, "front": 0.9}})",
      R"({"strands": 20, "length": {"mean": 3.0}})",
      R"({"strands": 20, "length": {"hem": 10.0}})",
      R"({"strands": 20, "flow": {"lift": 1.0, "bend": 0.002, "comb": 0.001, "gather": 4.0, "face_gap": 0.2}})",
      R"({"strands": 20, "flow": {"lift": 0.0, "bend": 10.0, "comb": 10.0, "clearance_high": 0.1}})",
      R"({"strands": 20, "clumps": [{"count": 100000, "tightness": 1.0, "start": 1.0, "full": 0.0}]})",
      R"({"strands": 20, "wave": {"amplitude": 0.1, "wavelength": 0.002}, "curl": {"amplitude": 0.1, "start": 0.0}})",
      R"({"strands": 20, "flyaways": {"fraction": 1.0, "amplitude": 0.2}, "frizz": {"amplitude": 0.1}})",
      R"({"strands": 20, "width": {"tip": 0.0, "taper": 0.0}})",
      R"({"strands": 20, "length": {"mean": 0.5, "variation": 0.9, "layers": -2.0, "front": -2.0}})",
      R"({"strands": 20, "flow": {"gravity": 0.0, "ruffle": 4.0, "ruffle_size": 0.001, "whorl": 0.0, "lift": 0.0}})",
      R"({"strands": 20, "undercoat": {"fraction": 1.0, "length": 0.05, "crimp": 0.1, "wavelength": 0.002}})",
  };
  for (const char* text : recipes) {
    const Groom groom = makeGroom(parseRecipe(text, "extreme"));
    for (float value : groom.positions) {
      ASSERT_TRUE(std::isfinite(value) && std::fabs(value) < 10.0f) << text;
    }
  }
}

TEST(GroomShape, NoScalpLeftIsAnError) {
  const Recipe recipe = parseRecipe(R"({"strands": 10, "scalp": {"feather": 0,
    "hairline": [{"azimuth": 0, "elevation": 90}]}})", "bald");
  EXPECT_THROW(makeGroom(recipe), RecipeError);
}

TEST(GroomShape, BustIsSymmetricSmoothAndRightSideOut) {
  EXPECT_LT(shape::bust<double>({0, 0, 0}), -0.05);
  EXPECT_GT(shape::bust<double>({0, 0.3, 0}), 0.15);
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 p(0.002 * (i % 20), 0.1 - 0.0025 * i, 0.12 - 0.001 * i);
    const double d = shape::bust<double>(p);
    EXPECT_EQ(d, shape::bust<double>({-p.x, p.y, p.z}));
    EXPECT_NEAR(d, shape::bust<float>(glm::vec3(p)), 2e-6);  // rounding of sums of about 0.1
  }
}

}  // namespace
}  // namespace forelock::samples
