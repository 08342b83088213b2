// Colours along and between strands, their code, and the opacity modifiers.
#include "reference_support.h"

#include <algorithm>

namespace forelock::reference {
namespace {

// The line y = 16.5 from x = -8 to x = 40, lit so that a pixel is alpha times the fibre's colour.
struct Line {
  Camera camera = pixelCamera(32, 32);
  Scene scene;

  Line() {
    scene.hairs.resize(1);
    addLine(scene.hairs[0], camera, std::vector<Point>{{-8, 16.5}, {40, 16.5}}, 4);
    scene.ambient[0] = scene.ambient[1] = scene.ambient[2] = 1;
    Material& m = scene.hairs[0].material;
    m.opacity_root = m.opacity_tip = 0.5;
    m.color[0] = 0.8;
    m.color[1] = 0.4;
    m.color[2] = 0.2;
    m.tip_color[0] = 0.1;
    m.tip_color[1] = 0.9;
  }
  Hair& hair() { return scene.hairs[0]; }
  Image image(const GatherOptions& options = {}) const {
    return resolve(scene, camera, {}, gatherFragments(scene, camera, options));
  }
};

TEST(ReferenceColor, TipBlendIsLinearInTheFraction) {
  Line line;
  EXPECT_FALSE(hasColors(line.scene));
  EXPECT_FALSE(gatherFragments(line.scene, line.camera).at(10, 16)[0].has_color);
  EXPECT_NEAR(line.image().at(10, 16).rgb[0], 0.5 * 0.8, 1e-14);
  line.hair().material.tip_blend = 0.6;
  const Image image = line.image();
  for (const int x : {0, 10, 31}) {
    const double f = (x + 0.5 + 8) / 48;
    EXPECT_NEAR(image.at(x, 16).rgb[0], 0.5 * (0.8 + 0.6 * f * (0.1 - 0.8)), 1e-14);
    EXPECT_NEAR(image.at(x, 16).rgb[1], 0.5 * (0.4 + 0.6 * f * (0.9 - 0.4)), 1e-14);
  }
  // hard has it too.
  EXPECT_NEAR(renderHard(line.scene, line.camera, {}).at(10, 16).rgb[0], 0.8 + 0.6 * 18.5 / 48 * (0.1 - 0.8), 1e-14);
}

TEST(ReferenceColor, VertexColorsAreAFactor) {
  Line line;
  line.hair().strands.colors = {{1, 0.5, 0}, {0, 0.5, 2}};
  const Image image = line.image();
  const double f = 18.5 / 48;
  EXPECT_NEAR(image.at(10, 16).rgb[0], 0.5 * 0.8 * (1 - f), 1e-14);
  EXPECT_NEAR(image.at(10, 16).rgb[1], 0.5 * 0.4 * 0.5, 1e-14);
  EXPECT_NEAR(image.at(10, 16).rgb[2], 0.5 * 0.2 * 2 * f, 1e-14);
  // Strands added later have 1.
  const Vec3 more[2] = {{0, 0, 0}, {1, 0, 0}};
  addStrand(line.hair().strands, more, 1);
  ASSERT_EQ(line.hair().strands.colors.size(), 4u);
  EXPECT_EQ(line.hair().strands.colors[3].y, 1);
}

// Linear in space, not on the screen: a strand that runs away from the camera.
TEST(ReferenceColor, LinearInSpace) {
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 ends[2] = {{-0.5, 0, 0}, {0.5, 0, -2}};
  addStrand(scene.hairs[0].strands, ends, 0.2);
  scene.hairs[0].strands.colors = {{0, 0, 0}, {1, 1, 1}};
  const Camera camera = makeCamera({0, 0, 1.5}, {0, 0, 0}, {0, 1, 0}, {}, 64, 64);
  const FragmentLists lists = gatherFragments(scene, camera);
  EXPECT_GT(lists.fragments.size(), 100u);
  for (const Fragment& f : lists.fragments) {
    EXPECT_NEAR(f.color[0], 0.5 * (f.depth - 1.5) / 2, 1e-12);
  }
}

TEST(ReferenceColor, RootImage) {
  ColorImage image{2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
  EXPECT_EQ(sampleColor(image, 0.25, 0.25).x, 1);
  EXPECT_EQ(sampleColor(image, 0.25, 0.25).y, 0);
  EXPECT_EQ(sampleColor(image, 0.75, 0.25).y, 1);  // row 0 at v = 0
  EXPECT_EQ(sampleColor(image, -3, 9).z, 1);       // clamped
  EXPECT_NEAR(sampleColor(image, 0.5, 0.5).x, 0.5, 1e-15);
  EXPECT_NEAR(sampleColor(image, 0.375, 0.25).x, 0.75, 1e-15);
  Strands strands;
  const Vec3 ends[2] = {{0, 0, 0}, {1, 0, 0}};
  addStrand(strands, ends, 1);
  addStrand(strands, ends, 1);
  strands.colors.assign(4, {0.5, 0.5, 0.5});
  const std::array<double, 2> uv[2] = {{0.25, 0.25}, {0.75, 0.75}};
  applyRootColors(strands, image, uv);
  EXPECT_EQ(strands.colors[1].x, 0.5);
  EXPECT_EQ(strands.colors[1].y, 0);
  EXPECT_EQ(strands.colors[2].y, 0.5);
}

TEST(ReferenceColor, SharedExponentBound) {
  std::mt19937 random(40);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const double scale = std::exp2(uniform(random) * 24 - 12);
    const std::array<double, 3> c{uniform(random) * scale, uniform(random) * scale, uniform(random) * scale};
    const auto coded = codedColor(c, Payload::standard), again = codedColor(coded, Payload::paper);
    const double largest = std::max({c[0], c[1], c[2]});
    for (size_t k = 0; k < 3; ++k) {
      // The largest mantissa is 256 at least, so half a step is 1/512 of the largest channel.
      ASSERT_LE(std::fabs(coded[k] - c[k]), largest / 512);
      ASSERT_EQ(coded[k], again[k]);
      worst = std::max(worst, std::fabs(coded[k] - c[k]) / largest);
    }
  }
  EXPECT_GT(worst, 1.0 / 600);  // the bound is met
  const auto coded = codedColor({1, 0.5, 0.001}, Payload::standard);
  EXPECT_EQ(coded[0], 1);
  EXPECT_EQ(coded[1], 0.5);
  EXPECT_EQ(coded[2], 0);                                          // under half of 1/256
  EXPECT_EQ(codedColor({0.9999, 0, 0}, Payload::standard)[0], 1);  // rounds to the next exponent
  EXPECT_EQ(codedColor({1e9, -1, 0}, Payload::standard)[0], 65408);
  EXPECT_EQ(codedColor({1e9, -1, 0}, Payload::standard)[1], 0);
  EXPECT_EQ(codedColor({0, 0, 0}, Payload::standard)[0], 0);
  EXPECT_EQ(codedColor({1e-9, 0, 0}, Payload::standard)[0], 0);  // the least step is 2^-24
  EXPECT_EQ(codedColor({std::exp2(-24), 0, 0}, Payload::standard)[0], std::exp2(-24));
  EXPECT_EQ(codedColor({0.001, 0, 0}, Payload::unquantised)[0], 0.001);
}

// In a frame with colours every node has one, rounded.
TEST(ReferenceColor, NodesOfColoredFrames) {
  Line line;
  line.scene.hairs.push_back(line.scene.hairs[0]);
  line.scene.hairs[1].slot = 1;
  line.scene.hairs[1].material.tip_blend = 1;
  GatherOptions options;
  options.payload = Payload::standard;
  const FragmentLists lists = gatherFragments(line.scene, line.camera, options);
  const auto list = lists.at(10, 16);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_TRUE(list[0].has_color);
  EXPECT_EQ(list[0].color, codedColor({0.8, 0.4, 0.2}, Payload::standard));
  EXPECT_NE(list[0].color[0], 0.8);
}

TEST(ReferenceModifiers, NearFadeInClosedForm) {
  OpacityModifiers fade;
  fade.near_fade = NearFade{2, 6};
  EXPECT_EQ(opacityModifier({}, 3, 4, 1), 1);
  EXPECT_EQ(opacityModifier(fade, 0, 0, 1), 0);
  EXPECT_EQ(opacityModifier(fade, 0, 0, 3), 0.25);
  EXPECT_EQ(opacityModifier(fade, 0, 0, 9), 1);
  // The line lies at depth 100.
  const Line line;
  GatherOptions options;
  options.modifiers.near_fade = NearFade{90, 130};
  EXPECT_NEAR(line.image(options).at(10, 16).transmittance, 1 - 0.5 * 0.25, 1e-14);
  options.modifiers.near_fade = NearFade{100, 130};
  EXPECT_EQ(gatherFragments(line.scene, line.camera, options).fragments.size(), 0u);
}

TEST(ReferenceModifiers, LensInClosedForm) {
  const Line line;
  GatherOptions options;
  options.modifiers.lens = Lens{10.5, 16.5, 4, 8, 0.2};
  const Image image = line.image(options);
  auto expected = [](double distance) {
    const double q = std::clamp((distance - 4) / 8, 0.0, 1.0);
    return 0.5 * (0.2 + 0.8 * q * q * (3 - 2 * q));
  };
  for (int x = 0; x < 32; ++x) EXPECT_NEAR(1 - image.at(x, 16).transmittance, expected(std::fabs(x - 10.0)), 1e-14);
  EXPECT_NEAR(expected(8), 0.5 * 0.6, 1e-15);
  // Both are factors.
  options.modifiers.near_fade = NearFade{90, 110};
  EXPECT_NEAR(1 - line.image(options).at(10, 16).transmittance, 0.5 * 0.5 * 0.2, 1e-14);
  // A lens of no feather is a step.
  options.modifiers = {};
  options.modifiers.lens = Lens{10.5, 16.5, 4, 0, 0};
  EXPECT_EQ(line.image(options).at(14, 16).transmittance, 1);
  EXPECT_EQ(line.image(options).at(15, 16).transmittance, 0.5);
}

TEST(ReferenceModifiers, HardLeavesOutBelowHalf) {
  const Line line;
  GatherOptions options;
  options.modifiers.lens = Lens{10.5, 16.5, 4, 8, 0};  // one half at 8 px
  const FragmentLists lists = gatherHard(line.scene, line.camera, options);
  EXPECT_EQ(lists.at(17, 16).size(), 0u);
  EXPECT_EQ(lists.at(18, 16).size(), 1u);
  options.modifiers.near_fade = NearFade{90, 105};  // two thirds
  EXPECT_EQ(gatherHard(line.scene, line.camera, options).at(18, 16).size(), 0u);
  EXPECT_EQ(gatherHard(line.scene, line.camera, options).at(22, 16).size(), 1u);
}

}  // namespace
}  // namespace forelock::reference
