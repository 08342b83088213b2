// Clipping, depth conventions and projections.
#include "reference_support.h"

namespace forelock::reference {
namespace {

Scene tangle(uint32_t seed, int strands, int vertices, double radius) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Scene scene;
  scene.hairs.resize(1);
  for (int s = 0; s < strands; ++s) {
    Vec3 p{normal(random) * 0.3, normal(random) * 0.3, normal(random) * 0.3};
    Vec3 d{normal(random), normal(random), normal(random)};
    std::vector<Vec3> points;
    for (int v = 0; v < vertices; ++v) {
      points.push_back(p);
      p = {p.x + 0.05 * d.x, p.y + 0.05 * d.y, p.z + 0.05 * d.z};
      d = {d.x + 0.3 * normal(random), d.y + 0.3 * normal(random), d.z + 0.3 * normal(random)};
    }
    addStrand(scene.hairs[0].strands, points, radius);
  }
  return scene;
}

// The same fragments, moved by `shift` columns; the number compared.
size_t expectSame(const FragmentLists& a, const FragmentLists& b, double tolerance, int shift = 0) {
  size_t compared = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = std::max(0, -shift); x < a.width - std::max(0, shift); ++x) {
      const auto p = a.at(x, y), q = b.at(x + shift, y);
      EXPECT_EQ(p.size(), q.size()) << x << " " << y;
      for (size_t i = 0; i < std::min(p.size(), q.size()); ++i) {
        EXPECT_EQ(p[i].sequence, q[i].sequence);
        EXPECT_NEAR(p[i].depth, q[i].depth, tolerance);
        EXPECT_NEAR(p[i].alpha, q[i].alpha, tolerance);
        EXPECT_NEAR(p[i].tangent.x, q[i].tangent.x, tolerance);
        ++compared;
      }
    }
  }
  return compared;
}

bool finite(const FragmentLists& lists) {
  for (const Fragment& f : lists.fragments) {
    if (!std::isfinite(f.depth) || !(f.alpha > 0 && f.alpha <= 1)) return false;
    if (!std::isfinite(f.tangent.x + f.tangent.y + f.tangent.z)) return false;
  }
  return true;
}

TEST(ReferenceProjection, NearPlaneAndRoundTrip) {
  for (const bool orthographic : {false, true}) {
    for (const bool reversed : {false, true}) {
      Projection p;
      p.orthographic = orthographic;
      p.reversed = reversed;
      p.near_plane = 0.25;
      p.offset_x = 0.3;
      p.offset_y = -0.1;
      const Camera camera = makeCamera({1, 2, 3}, {0.2, 0.1, -0.5}, {0.1, 1, 0}, p, 320, 200);
      EXPECT_NEAR(nearPlane(camera), 0.25, 1e-13);
      const Vec3 at{0.1, -0.3, 0.2};
      const Projected q = project(camera, at);
      const Vec3 back = unproject(camera, q.x, q.y, q.depth);
      EXPECT_NEAR(std::hypot(back.x - at.x, back.y - at.y, back.z - at.z), 0, 1e-13);
      EXPECT_LT(project(camera, {0.1, 0.3, 0.2}).y, q.y);  // up in the world is up in the image: a smaller row
    }
  }
}

TEST(ReferenceProjection, DepthConventionChangesNothing) {
  const Scene scene = tangle(8, 40, 8, 0.004);
  for (const bool orthographic : {false, true}) {
    Projection p;
    p.orthographic = orthographic;
    p.tan_half_y = orthographic ? 1 : 0.5;
    const Camera standard = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
    p.reversed = true;
    const Camera reversed = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
    // The near plane is the only use of the depth rows, and nothing reaches it.
    EXPECT_GT(expectSame(gatherFragments(scene, standard), gatherFragments(scene, reversed), 1e-12), 1000u);
  }
}

TEST(ReferenceProjection, OffCentreShiftsWholePixels) {
  const Scene scene = tangle(9, 40, 8, 0.004);
  for (const bool orthographic : {false, true}) {
    Projection p;
    p.orthographic = orthographic;
    const Camera centred = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
    p.offset_x = 2.0 * 12 / 160;
    const Camera moved = makeCamera({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
    // Positions differ by rounding of 1e-14 px, which the slope of a 1e-4 px segment could raise; 1e-8 is far above.
    EXPECT_GT(expectSame(gatherFragments(scene, centred), gatherFragments(scene, moved), 1e-8, 12), 1000u);
  }
}

TEST(ReferenceProjection, FarPerspectiveIsOrthographic) {
  const Scene scene = tangle(10, 40, 8, 0.004);
  const double distance = 1e5;
  Projection p;
  p.tan_half_y = 1 / distance;
  p.near_plane = 1;
  p.far_plane = 1e6;
  const Camera perspective = makeCamera({0, 0, distance}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
  p.orthographic = true;
  p.tan_half_y = 1;
  const Camera orthographic = makeCamera({0, 0, distance}, {0, 0, 0}, {0, 1, 0}, p, 160, 120);
  const std::vector<double> a = opacityOf(gatherFragments(scene, perspective));
  const std::vector<double> b = opacityOf(gatherFragments(scene, orthographic));
  double sum_a = 0, sum_b = 0;
  int differ = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum_a += a[i];
    sum_b += b[i];
    differ += std::fabs(a[i] - b[i]) > 0.01;
  }
  // Scales differ by 1 m of 1e5 m and positions by up to 1e-3 px; a pixel centre may change sides at a joint.
  EXPECT_NEAR(sum_a / sum_b, 1, 1e-3);
  EXPECT_LE(differ, 4);
}

TEST(ReferenceProjection, PerspectiveDepthIsThatOfTheLine) {
  Projection p;
  const Camera camera = makeCamera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, p, 200, 200);
  Scene scene;
  scene.hairs.resize(1);
  const Vec3 ends[2] = {{-0.2, -0.02, -0.5}, {1.6, 0.02, -4}};
  addStrand(scene.hairs[0].strands, ends, 1e-4);
  const FragmentLists lists = gatherFragments(scene, camera);
  ASSERT_GT(lists.fragments.size(), 100u);
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x) {
      for (const Fragment& f : lists.at(x, y)) {
        // The fragment unprojects to within a pixel of the line, at the line's own parameter for that depth.
        const double u = (f.depth - 0.5) / 3.5;
        const Projected q = project(camera, {-0.2 + 1.8 * u, -0.02 + 0.04 * u, -f.depth});
        EXPECT_LT(std::hypot(q.x - x - 0.5, q.y - y - 0.5), 1.5);
      }
    }
  }
}

TEST(ReferenceProjection, NearPlaneClipping) {
  for (const bool reversed : {false, true}) {
    Projection p;
    p.reversed = reversed;
    p.near_plane = 0.2;
    const Camera camera = makeCamera({0, 0, 0.4}, {0, 0, 0}, {0, 1, 0}, p, 128, 128);
    const Scene scene = tangle(11, 200, 10, 0.002);
    const FragmentLists lists = gatherFragments(scene, camera);
    EXPECT_TRUE(finite(lists));
    EXPECT_GT(lists.fragments.size(), 1000u);
    for (const Fragment& f : lists.fragments) EXPECT_GE(f.depth, 0.2 * (1 - 1e-12));
  }
  // A strand through the camera plane shows the same before the near plane as one that starts farther behind.
  Projection p;
  p.near_plane = 0.2;
  const Camera camera = makeCamera({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, p, 128, 128);
  Scene a, b;
  a.hairs.resize(1);
  b.hairs.resize(1);
  const Vec3 behind[2] = {{0.02, 0.01, 1}, {0.02, 0.05, -1}}, farther[2] = {{0.02, -0.03, 3}, {0.02, 0.05, -1}};
  addStrand(a.hairs[0].strands, behind, 1e-3);
  addStrand(b.hairs[0].strands, farther, 1e-3);
  EXPECT_GT(expectSame(gatherFragments(a, camera), gatherFragments(b, camera), 1e-10), 10u);
}

TEST(ReferenceProjection, HostDepthHides) {
  const Camera camera = pixelCamera(32, 32);
  Scene scene;
  scene.hairs.resize(1);
  addLine(scene.hairs[0], camera, std::vector<Point>{{-40, 16}, {70, 16}}, 6);  // depth 100
  std::vector<double> host(32 * 32, 100.0);
  for (int y = 0; y < 32; ++y) host[size_t(y) * 32 + 5] = 99.999;
  GatherOptions options;
  options.host_depth = host;
  const FragmentLists lists = gatherFragments(scene, camera, options);
  EXPECT_EQ(lists.at(4, 16).size(), 1u);  // equal depth is kept
  EXPECT_EQ(lists.at(5, 16).size(), 0u);
}

TEST(ReferenceProjection, DegenerateStrandsAreFinite) {
  const Camera camera = pixelCamera(32, 32);
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e300;
  const std::vector<std::vector<Vec3>> strands = {
      {{0, 0, 0}, {0, 0, 0}},
      {{0, 0, 0}, {0, 0, 0}, {3, 1, 0}, {3, 1, 0}, {6, 0, 0}},
      {{0, 0, 0}, {5, 0, 0}, {0, 0, 0}, {5, 0, 0}},
      {{0, 0, 0}, {0, 0, 5}},  // along the view
      {{0, 0, 0}, {0, 0, 5}, {4, 4, 5}},
      {{0, 0, 0}, {nan, 0, 0}, {5, 5, 0}, {6, 6, 0}},
      {{0, 0, 0}, {huge, huge, 0}},
      {{1, 1, 0}},
      {},
  };
  Scene scene;
  scene.hairs.resize(1);
  for (const auto& strand : strands) {
    for (const double radius : {0.0, 1e-9, 2.0}) addStrand(scene.hairs[0].strands, strand, radius);
  }
  scene.lights.push_back({{0, 0.6, 0.8}, {1, 1, 1}, false, 64});
  const FragmentLists lists = gatherFragments(scene, camera);
  EXPECT_TRUE(finite(lists));
  EXPECT_GT(lists.fragments.size(), 0u);
  for (const Method method : {Method::exact, Method::forward, Method::core_tail, Method::core_only}) {
    for (const Pixel& pixel : resolve(scene, camera, {}, lists, {method}).pixels) {
      EXPECT_TRUE(std::isfinite(pixel.rgb[0] + pixel.rgb[1] + pixel.rgb[2] + pixel.transmittance));
    }
  }
  for (const double opacity : renderCover(scene, camera)) EXPECT_TRUE(opacity >= 0 && opacity <= 1 + 1e-12);
}

}  // namespace
}  // namespace forelock::reference
