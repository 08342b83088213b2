// Prints the time of an exact 1920x1200 reference with about 4 M fragments: a head of synthetic strands.
#include "reference.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

using namespace forelock::reference;

int main(int argc, char** argv) {
  const int threads = argc > 1 ? std::atoi(argv[1]) : 2;
  const double distance = argc > 2 ? std::atof(argv[2]) : 1.1;  // metre
  Scene scene;
  scene.hairs.resize(1);
  Material& m = scene.hairs[0].material;
  m.opacity_root = m.opacity_tip = 0.5;
  m.kr = 0.1;
  m.exponent_r = 40;
  m.kt = 0.3;
  m.exponent_trt = 12;
  m.cuticle_tilt = 0.1;
  m.fibre_spacing = 1.5e-3;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int s = 0; s < 6100; ++s) {
    Vec3 d{normal(random), std::fabs(normal(random)), normal(random)};
    const double l = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    d = {d.x / l, d.y / l, d.z / l};
    Vec3 p{0.1 * d.x, 0.1 * d.y, 0.1 * d.z};
    std::vector<Vec3> points;
    for (int v = 0; v < 16; ++v) {  // out of the head, then down
      points.push_back(p);
      const double step = 0.02, sink = v / 6.0;
      p = {p.x + step * (d.x * (1 - sink / 3)), p.y + step * (d.y - sink), p.z + step * (d.z * (1 - sink / 3))};
      d = {d.x + 0.05 * normal(random), d.y, d.z + 0.05 * normal(random)};
    }
    addStrand(scene.hairs[0].strands, points, 0.6e-3);
  }
  scene.lights.push_back({{0.36, 0.48, 0.8}, {1, 1, 1}, true, 1024});
  const Camera camera = makeCamera({0, 0, distance}, {0, -0.02, 0}, {0, 1, 0}, {}, 1920, 1200);

  auto seconds = [last = std::chrono::steady_clock::now()]() mutable {
    const auto now = std::chrono::steady_clock::now();
    const double s = std::chrono::duration<double>(now - last).count();
    last = now;
    return s;
  };
  const auto maps = renderShadowMaps(scene);
  std::printf("shadow map %.2f s\n", seconds());
  GatherOptions gather;
  gather.threads = threads;
  const FragmentLists lists = gatherFragments(scene, camera, gather);
  std::printf("gather %.2f s, %zu fragments\n", seconds(), lists.fragments.size());
  const Image exact = resolve(scene, camera, maps, lists, {Method::exact, 8, 8, threads});
  std::printf("exact %.2f s\n", seconds());
  const Image core_tail = resolve(scene, camera, maps, lists, {Method::core_tail, 8, 8, threads});
  std::printf("core_tail %.2f s\n", seconds());
  const Image forward = resolve(scene, camera, maps, lists, {Method::forward, 8, 8, threads});
  std::printf("forward %.2f s\n", seconds());
  const Difference d = compare(exact, core_tail);
  std::printf("hair pixels %zu, mean radiance %.1f, core_tail against exact: RMSE %.2f, p99.9 %.1f\n", d.pixels,
              d.mean_a, d.rmse, d.p999);
}
