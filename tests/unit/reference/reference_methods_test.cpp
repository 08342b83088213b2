// Section 6: the deterministic tail, core_only, all_low and hard.
#include "reference_support.h"

#include <algorithm>
#include <numeric>

namespace forelock::reference {
namespace {

// One pixel whose layers are lit by ambient alone, each of its own hair and colour.
struct Stack {
  Scene scene;
  Camera camera = pixelCamera(1, 1);
  FragmentLists lists;

  Stack() {
    lists.width = lists.height = 1;
    lists.first = {0, 0};
    scene.ambient[0] = scene.ambient[1] = scene.ambient[2] = 1;
  }
  void add(double depth, double alpha, double color) {
    Hair hair;
    hair.slot = uint32_t(scene.hairs.size());
    hair.material.color[0] = color;
    scene.hairs.push_back(hair);
    lists.fragments.push_back({depth, alpha, alpha, {1, 0, 0}, hair.slot, hair.slot});
    lists.first[1] = lists.fragments.size();
  }
  Pixel resolved(Method method, int k_sort, TailOrder tail) const {
    return resolve(scene, camera, {}, lists, {method, k_sort, k_sort, 1, tail}).at(0, 0);
  }
};

Stack randomStack(std::mt19937& random, int count, bool one_color) {
  std::uniform_real_distribution<double> uniform(0.01, 0.9);
  Stack stack;
  for (int i = 0; i < count; ++i) stack.add(uniform(random), uniform(random), one_color ? 0.7 : uniform(random));
  return stack;
}

TEST(ReferenceMethods, DeterministicTailHasNoOrder) {
  std::mt19937 random(30);
  double changed = 0;
  for (int round = 0; round < 200; ++round) {
    Stack stack = randomStack(random, 12, false);
    for (const Method method : {Method::core_tail, Method::core_only, Method::all_low}) {
      const Pixel before = stack.resolved(method, 3, TailOrder::deterministic);
      const Pixel list_before = stack.resolved(method, 3, TailOrder::list);
      std::shuffle(stack.lists.fragments.begin(), stack.lists.fragments.end(), random);
      const Pixel after = stack.resolved(method, 3, TailOrder::deterministic);
      EXPECT_NEAR(before.rgb[0], after.rgb[0], 1e-14);  // float64 sums of nine terms
      EXPECT_NEAR(before.transmittance, after.transmittance, 1e-15);
      EXPECT_NEAR(before.transmittance, list_before.transmittance, 1e-15);
      if (method == Method::core_tail) {
        changed = std::max(changed, std::fabs(list_before.rgb[0] - stack.resolved(method, 3, TailOrder::list).rgb[0]));
      }
    }
  }
  EXPECT_GT(changed, 0.01);  // as the tail in list order does
}

TEST(ReferenceMethods, DeterministicTailOfOneColorIsTheList) {
  std::mt19937 random(31);
  for (int round = 0; round < 200; ++round) {
    const Stack stack = randomStack(random, 10, true);
    const Pixel list = stack.resolved(Method::core_tail, 2, TailOrder::list);
    const Pixel sums = stack.resolved(Method::core_tail, 2, TailOrder::deterministic);
    EXPECT_NEAR(list.rgb[0], sums.rgb[0], 1e-14);
    EXPECT_NEAR(list.rgb[0], 0.7 * (1 - list.transmittance), 1e-14);
  }
  // So is a tail of one fragment, whatever its colour.
  Stack one;
  one.add(1, 0.4, 0.2);
  one.add(2, 0.6, 0.9);
  EXPECT_NEAR(one.resolved(Method::core_tail, 1, TailOrder::deterministic).rgb[0], 0.4 * 0.2 + 0.6 * 0.6 * 0.9, 1e-15);
}

// One colour for all of the tail: the nearest's, whatever lies behind and in which order it was stored.
TEST(ReferenceMethods, TailShadedOnce) {
  Stack stack;
  stack.add(3, 0.5, 0.1);
  stack.add(1, 0.25, 0.8);
  stack.add(2, 0.5, 0.6);
  const Pixel pixel = stack.resolved(Method::core_tail, 1, TailOrder::once);
  EXPECT_NEAR(pixel.rgb[0], 0.25 * 0.8 + 0.75 * (1 - 0.25) * 0.6, 1e-15);
  EXPECT_NEAR(pixel.transmittance, 0.75 * 0.25, 1e-15);
}

TEST(ReferenceMethods, MeanLobeIsTheIntegralOfThePower) {
  for (const double n : {0.0, 1.0, 2.0, 11.8, 14.4, 100.0, 1e4}) {
    const double closed = std::exp(std::lgamma((n + 1) / 2) - std::lgamma(n / 2 + 1)) / (2 * std::sqrt(std::numbers::pi));
    EXPECT_NEAR(meanLobe(n), closed, 1e-4 * closed) << n;  // the midpoint rule on a jump (n = 0) and a kink (n = 1)
  }
}

TEST(ReferenceMethods, DeterministicTailInClosedForm) {
  Stack stack;
  stack.add(1, 0.5, 0.3);          // tau 1
  stack.add(2, 0.75, 0.6);         // tau 2
  stack.add(3, 1 - 1.0 / 8, 0.1);  // tau 3
  const double mean = (0.3 + 2 * 0.6 + 3 * 0.1) / 6, t = 1.0 / 64;
  EXPECT_NEAR(stack.resolved(Method::all_low, 0, TailOrder::deterministic).rgb[0], (1 - t) * mean, 1e-15);
  // An opaque fragment weighs 12 and lets nothing through.
  stack.add(4, 1, 0.9);
  const Pixel opaque = stack.resolved(Method::all_low, 0, TailOrder::deterministic);
  EXPECT_NEAR(opaque.rgb[0], (6 * mean + 12 * 0.9) / 18, 1e-15);
  EXPECT_EQ(opaque.transmittance, 0);
  // Nearest two in the core, the rest by weight.
  EXPECT_NEAR(stack.resolved(Method::core_tail, 2, TailOrder::deterministic).rgb[0],
              0.5 * 0.3 + 0.5 * 0.75 * 0.6 + 0.125 * (3 * 0.1 + 12 * 0.9) / 15, 1e-15);
  EXPECT_NEAR(stack.resolved(Method::core_only, 2, TailOrder::deterministic).rgb[0], 0.5 * 0.3 + 0.5 * 0.75 * 0.6,
              1e-15);
}

Scene strandsAcross(const Camera& camera, int count) {
  std::mt19937 random(32);
  std::uniform_real_distribution<double> uniform(0, 1);
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.kr = m.kt = 0.4;
  m.opacity_root = m.opacity_tip = 0.5;
  m.exponent_r = 5;
  for (int i = 0; i < count; ++i) {
    addLine(
        scene.hairs[0], camera,
        std::vector<Point>{{uniform(random) * 32, uniform(random) * 32}, {uniform(random) * 32, uniform(random) * 32}},
        3, uniform(random) * 10);
  }
  scene.lights.push_back({{0.6, 0, 0.8}, {1, 1, 1}, false, 64});
  return scene;
}

TEST(ReferenceMethods, AllLowIsCoreTailWithoutFullShades) {
  const Camera camera = pixelCamera(32, 32);
  const Scene scene = strandsAcross(camera, 60);
  const FragmentLists lists = gatherFragments(scene, camera);
  const Image full = resolve(scene, camera, {}, lists, {Method::core_tail, 4, 4, 1});
  for (const TailOrder tail : {TailOrder::list, TailOrder::deterministic}) {
    const Image low = resolve(scene, camera, {}, lists, {Method::all_low, 4, 4, 1, tail});
    EXPECT_EQ(compare(low, resolve(scene, camera, {}, lists, {Method::core_tail, 0, 4, 1, tail})).rmse, 0);
    EXPECT_GT(compare(low, full).rmse, 5);  // without the lobes
  }
}

int countOf(const FragmentLists& lists) { return int(lists.fragments.size()); }

TEST(ReferenceMethods, HardIsAtLeastAPixelWide) {
  const Camera camera = pixelCamera(64, 64);
  for (const double width : {0.01, 0.3, 1.0, 4.0}) {
    for (const double degrees : {0.0, 17.0, 43.0, 71.0, 90.0}) {
      Scene scene;
      scene.hairs.resize(1);
      scene.hairs[0].material.opacity_root = scene.hairs[0].material.opacity_tip = 0.01;  // does not count
      const double a = radians(degrees), dx = 20 * std::cos(a), dy = 20 * std::sin(a);
      addLine(scene.hairs[0], camera, std::vector<Point>{{32.3 - dx, 32.4 - dy}, {32.3, 32.4}, {32.3 + dx, 32.4 + dy}},
              width);
      const FragmentLists lists = gatherHard(scene, camera);
      const double area = 40 * std::max(width, 1.0);
      // Pixel centres of a rectangle; along a diagonal they would all meet its sides at one phase.
      EXPECT_NEAR(countOf(lists), area, 2 + 0.06 * area) << width << " " << degrees;
      for (const Fragment& f : lists.fragments) EXPECT_EQ(f.alpha, 1);
    }
  }
}

TEST(ReferenceMethods, HardEndsFlush) {
  const Camera camera = pixelCamera(64, 8);
  Scene scene;
  scene.hairs.resize(1);
  addLine(scene.hairs[0], camera, std::vector<Point>{{10.2, 4.5}, {15, 4.5}, {20.7, 4.5}}, 0.1);
  const FragmentLists lists = gatherHard(scene, camera);
  EXPECT_EQ(countOf(lists), 11);
  EXPECT_EQ(lists.at(10, 4).size(), 1u);
  EXPECT_EQ(lists.at(20, 4).size(), 1u);
}

TEST(ReferenceMethods, HardKeepsTheNearest) {
  const Camera camera = pixelCamera(32, 32);
  const Scene scene = strandsAcross(camera, 60);
  const FragmentLists hard = gatherHard(scene, camera);
  EXPECT_GT(countOf(hard), 400);
  // Strands of 3 px belong to pixels that coverage knows too: the nearest of those that it covers by half is no nearer
  // than the hard one, and the hard one is among them.
  const FragmentLists soft = gatherFragments(scene, camera);
  const Image image = renderHard(scene, camera, {});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      double nearest = 1e30;
      bool among = false;
      for (const Fragment& f : soft.at(x, y)) {
        if (f.coverage > 0.51) nearest = std::min(nearest, f.depth);
        among = among || (!hard.at(x, y).empty() && f.depth == hard.at(x, y)[0].depth);
      }
      if (hard.at(x, y).empty()) {
        EXPECT_EQ(image.at(x, y).transmittance, 1);
        EXPECT_GT(nearest, 1e29);
        continue;
      }
      EXPECT_TRUE(among);
      EXPECT_LE(hard.at(x, y)[0].depth, nearest);
      EXPECT_EQ(image.at(x, y).transmittance, 0);
      EXPECT_EQ(image.at(x, y).rgb[0], shadeFragment(scene, camera, {}, x, y, hard.at(x, y)[0], true)[0]);
    }
  }
  // What the host hides is not drawn: a wall through the middle of the strands' depths.
  const std::vector<double> wall(32 * 32, 95);
  GatherOptions options;
  options.host_depth = wall;
  const FragmentLists before = gatherHard(scene, camera, options);
  EXPECT_LT(countOf(before), countOf(hard));
  for (const Fragment& f : before.fragments) EXPECT_LE(f.depth, 95);
}

TEST(ReferenceMethods, HardTies) {
  const Camera camera = pixelCamera(16, 16);
  Scene scene;
  scene.hairs.resize(2);
  scene.hairs[0].slot = 9;
  scene.hairs[1].slot = 4;
  for (Hair& hair : scene.hairs) addLine(hair, camera, std::vector<Point>{{-4, 8.5}, {20, 8.5}}, 2);
  EXPECT_EQ(gatherHard(scene, camera).at(8, 8)[0].slot, 4u);
  // Of one hair the tangent's code decides: +y has a greater second component than -y.
  scene.hairs.resize(1);
  addLine(scene.hairs[0], camera, std::vector<Point>{{8.5, 20}, {8.5, -4}}, 2);
  addLine(scene.hairs[0], camera, std::vector<Point>{{8.5, -4}, {8.5, 20}}, 2);
  scene.hairs[0].strands.first_vertex.erase(scene.hairs[0].strands.first_vertex.begin() + 1);
  scene.hairs[0].strands.first_vertex[0] = 2;
  EXPECT_NEAR(gatherHard(scene, camera).at(8, 8)[0].tangent.y, -1, 1e-12);
}

TEST(ReferenceMethods, TangentCodes) {
  std::mt19937 random(33);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 v{normal(random), normal(random), normal(random)};
    const double l = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    const Vec3 w = tangentOf(tangentCode(v, 13), 13);
    // Half a step, 1 / 8190, on both axes moves a point of a face by sqrt(6) of that, seen from up to 1 / sqrt(3).
    EXPECT_GT((v.x * w.x + v.y * w.y + v.z * w.z) / l, std::cos(std::sqrt(18.0) / 8190));
    ASSERT_EQ(tangentCode(w, 13), tangentCode(v, 13));
  }
  EXPECT_EQ(tangentCode({}, 13), (1u << 26) - 1);
  EXPECT_EQ(tangentOf((1u << 26) - 1, 13).z, 0);
  EXPECT_EQ(tangentOf(tangentCode({0, 0, 1}, 13), 13).z, 1);
}

}  // namespace
}  // namespace forelock::reference
