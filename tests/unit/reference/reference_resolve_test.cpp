// Section 6: the order of layers in each method.
#include "reference_support.h"

#include <algorithm>
#include <numeric>

namespace forelock::reference {
namespace {

// A pixel's list made by hand; each layer has its own slot and so its own colour, lit by ambient alone.
struct Layers {
  Scene scene;
  Camera camera = pixelCamera(1, 1);
  FragmentLists lists;

  explicit Layers(const std::vector<double>& depths, double alpha) {
    lists.width = lists.height = 1;
    for (size_t i = 0; i < depths.size(); ++i) {
      Hair hair;
      hair.slot = uint32_t(i);
      hair.material.color[0] = color(i);
      scene.hairs.push_back(hair);
      lists.fragments.push_back({depths[i], alpha, alpha, {1, 0, 0}, uint32_t(i), uint32_t(i)});
    }
    lists.first = {0, depths.size()};
    scene.ambient[0] = 1;
  }
  static double color(size_t i) { return 0.05 + 0.1 * double(i); }
  double red(Method method, int k_sort) const {
    return resolve(scene, camera, {}, lists, {method, k_sort, k_sort, 1}).at(0, 0).rgb[0];
  }
};

double blend(const std::vector<size_t>& order, double alpha) {
  double out = 0, t = 1;
  for (const size_t i : order) {
    out += t * alpha * Layers::color(i);
    t *= 1 - alpha;
  }
  return out;
}

TEST(ReferenceResolve, ExactSortsAndListsDoNot) {
  const Layers layers({5, 3, 4, 1, 2}, 0.5);
  EXPECT_NEAR(layers.red(Method::exact, 8), blend({3, 4, 1, 2, 0}, 0.5), 1e-15);
  // All in the core: the same.
  EXPECT_NEAR(layers.red(Method::forward, 5), blend({3, 4, 1, 2, 0}, 0.5), 1e-15);
  // No core: met last stored first, each further one laid over the tail, so the first stored is in front.
  EXPECT_NEAR(layers.red(Method::forward, 0), blend({0, 1, 2, 3, 4}, 0.5), 1e-15);
  EXPECT_NEAR(layers.red(Method::core_tail, 0), blend({0, 1, 2, 3, 4}, 0.5), 1e-15);
  // Two sorted: met 4 (depth 2), 3 (1): core. Then 2, 1 and 0 are rejected in turn.
  EXPECT_NEAR(layers.red(Method::core_tail, 2), blend({3, 4, 0, 1, 2}, 0.5), 1e-15);
}

TEST(ReferenceResolve, DisplacedFragmentsEnterTheTailWhenTheyFall) {
  const Layers layers({1, 2, 3, 4, 5}, 0.4);  // met 5, 4 | 3 displaces 5, 2 displaces 4, 1 displaces 3
  EXPECT_NEAR(layers.red(Method::forward, 2), blend({0, 1, 2, 3, 4}, 0.4), 1e-15);
  const Layers mixed({4, 1, 5, 3, 2}, 0.4);  // met 2, 3 | 5 rejected, 1 displaces 3, 4 rejected
  EXPECT_NEAR(mixed.red(Method::forward, 2), blend({1, 4, 0, 3, 2}, 0.4), 1e-15);
  EXPECT_NEAR(mixed.red(Method::core_only, 2), blend({1, 4}, 0.4), 1e-15);
}

TEST(ReferenceResolve, TiesGoBySlotThenSequence) {
  Layers layers({2, 2, 2}, 0.5);
  EXPECT_NEAR(layers.red(Method::exact, 8), blend({0, 1, 2}, 0.5), 1e-15);
  std::reverse(layers.lists.fragments.begin(), layers.lists.fragments.end());
  EXPECT_NEAR(layers.red(Method::exact, 8), blend({0, 1, 2}, 0.5), 1e-15);
}

Scene bush(const std::vector<int>& order) {
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.kr = m.kt = 0.3;
  m.exponent_r = 30;
  m.opacity_root = 0.7;
  m.fibre_spacing = 0.01;
  std::vector<std::vector<Vec3>> strands;
  std::mt19937 random(14);
  std::normal_distribution<double> normal;
  for (size_t s = 0; s < order.size(); ++s) {
    std::vector<Vec3> points{{normal(random) * 0.2, normal(random) * 0.2, normal(random) * 0.2}};
    for (int v = 0; v < 6; ++v) {
      const Vec3 p = points.back();
      points.push_back({p.x + 0.1 * normal(random), p.y + 0.1 * normal(random), p.z + 0.1 * normal(random)});
    }
    strands.push_back(points);
  }
  for (const int i : order) addStrand(scene.hairs[0].strands, strands[size_t(i)], 0.003);
  scene.lights.push_back({{0.48, 0.6, 0.64}, {1, 0.9, 0.8}, true, 256});
  return scene;
}

TEST(ReferenceResolve, OrderAndThreadsChangeNothing) {
  std::vector<int> order(400);
  std::iota(order.begin(), order.end(), 0);
  const Scene scene = bush(order);
  std::shuffle(order.begin(), order.end(), std::mt19937(15));
  const Scene shuffled = bush(order);
  const Camera camera = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, {}, 200, 150);
  const FragmentLists lists = gatherFragments(scene, camera), other = gatherFragments(shuffled, camera);
  EXPECT_EQ(lists.fragments.size(), other.fragments.size());
  const auto maps = renderShadowMaps(scene), other_maps = renderShadowMaps(shuffled);
  EXPECT_EQ(maps[0].depth, other_maps[0].depth);
  const Image exact = resolve(scene, camera, maps, lists);
  EXPECT_EQ(compare(exact, resolve(shuffled, camera, other_maps, other)).rmse, 0);  // depths are all different
  EXPECT_GT(compare(exact, exact).mean_a, 1);

  // The tail does depend on it: this is what the paper's reference image lives with.
  const Image forward = resolve(scene, camera, maps, lists, {Method::forward, 2, 2, 2});
  const Image forward_other = resolve(shuffled, camera, other_maps, other, {Method::forward, 2, 2, 2});
  EXPECT_GT(compare(forward, forward_other).rmse, 0);

  GatherOptions one, three;
  one.threads = 1;
  three.threads = 3;
  const FragmentLists a = gatherFragments(scene, camera, one), b = gatherFragments(scene, camera, three);
  EXPECT_EQ(a.first, b.first);
  for (const Method method : {Method::exact, Method::forward, Method::core_tail}) {
    EXPECT_EQ(compare(resolve(scene, camera, maps, a, {method, 8, 8, 1}),
                      resolve(scene, camera, maps, b, {method, 8, 8, 3})).rmse, 0);
  }
  // A core that holds everything, shaded fully, is exact.
  EXPECT_EQ(compare(exact, resolve(scene, camera, maps, lists, {Method::core_tail, 1000, 1000, 2})).rmse, 0);
  EXPECT_EQ(renderCover(scene, camera, 4, 1), renderCover(scene, camera, 4, 3));
}

TEST(ReferenceResolve, MetricsOfKnownImages) {
  Image a, b;
  a.width = b.width = 10;
  a.height = b.height = 1;
  a.pixels.resize(10);
  b.pixels.resize(10);
  for (size_t i = 0; i < 5; ++i) a.pixels[i].fragments = 1;  // five pixels of hair
  for (size_t c = 0; c < 3; ++c) b.pixels[0].rgb[c] = 1;
  const Difference d = compare(a, b);
  EXPECT_EQ(d.pixels, 5u);
  EXPECT_NEAR(d.rmse, 255 * std::sqrt(3.0 / 5), 1e-12);
  EXPECT_NEAR(d.rmse_channel[1], 255 * std::sqrt(1.0 / 5), 1e-12);
  EXPECT_NEAR(d.p999, 255 * std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(d.mean_b, 255 / 5.0, 1e-12);
  EXPECT_NEAR(compare(a, b, 0.5).rmse, 127.5 * std::sqrt(3.0 / 5), 1e-12);
}

}  // namespace
}  // namespace forelock::reference
