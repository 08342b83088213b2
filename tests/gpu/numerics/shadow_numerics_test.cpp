// Rows G1 to G3: attenuation of one tap, broken maps and receivers, one tap against 25.
#include "numerics_kit.h"
#include "numerics_spv/numerics_fibres.h"
#include "numerics_spv/numerics_shadow.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace forelock::test {
namespace {

// As frame_constants.cpp sends it. The API refuses opacities outside [0, 1]; here they are clamped, which is the
// nearest that could reach the shader.
float log2Transmittance(double a) {
  const double opacity = std::clamp(double(float(a)), 0.0, 1.0);
  return opacity < 1 ? float(std::log2(1 - opacity)) : -FLT_MAX;
}

// (1 - a)^n as methods.md section 4 has it.
double fibresTwin(double a, double n) {
  const double opacity = std::clamp(double(float(a)), 0.0, 1.0);
  if (!(n > 0)) return 1;
  return opacity >= 1 ? 0 : std::pow(1 - opacity, std::min(n, 1e6));
}

const double kOpacities[] = {-0.1, 0, 1e-7, 0.01, 0.35, 0.5, 0.9, 1 - 1e-7, 1, 1.5};  // ascending

TEST(Transmittance, EveryOpacityAndFibreCount) {
  std::vector<float> fibres = {-kInf, -1e6f, -1,    -0.0f, 0,    kDenormal, 1e-30f, 1e-3f, 0.5f,
                               1,     2,     14.4f, 126,   1e3f, 1e6f,      1e30f,  kInf};
  for (int i = 1; i < 2000; ++i) fibres.push_back(float(i) * 0.05f);
  std::sort(fibres.begin(), fibres.end());
  std::vector<float> in;
  for (const double a : kOpacities)
    for (const float n : fibres) in.insert(in.end(), {n, log2Transmittance(a)});
  const std::vector<float> out = runItems(numerics_fibres, in, 2, 1);
  ASSERT_EQ(out.size(), std::size(kOpacities) * fibres.size());
  Worst error, disorder;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t a = i / fibres.size(), n = i % fibres.size();
    outside += !(out[i] >= 0 && out[i] <= 1);
    // An opaque fibre times a denormal count: where denormals count, n log2(1 - a) is no longer large. Bounds only.
    if (fibres[n] != kDenormal) error.see(std::fabs(double(out[i]) - fibresTwin(kOpacities[a], double(fibres[n]))));
    if (n > 0 && fibres[n - 1] != kDenormal && fibres[n] != kDenormal)
      disorder.see(double(out[i]) - double(out[i - 1]));
    if (a > 0) disorder.see(double(out[i]) - double(out[i - fibres.size()]));
  }
  EXPECT_EQ(outside, 0u);
  EXPECT_LT(error.value(), 1e-4);
  // Two neighbours may each be off by the exp2 of the device: 3 + 2 |x| ulp of the result, below 1e-6 in all.
  EXPECT_LE(disorder.value(), 1e-6);
  record("G1", "transmittance, a -0.1 to 1.5, fibres -inf to inf: outside [0, 1] or NaN", "0", std::to_string(outside));
  record("G1", "the same: largest error", "< 1e-4", format(error.value()));
  record("G1", "the same: largest rise where a or the count rises", "<= 1e-6 (rounding)", format(disorder.value()));
}

TEST(Transmittance, NotANumber) {
  std::vector<float> in;
  for (const double a : kOpacities) in.insert(in.end(), {kNan, log2Transmittance(a)});
  const std::vector<float> out = runItems(numerics_fibres, in, 2, 1);
  ASSERT_FALSE(out.empty());
  std::size_t outside = 0;
  for (const float v : out) outside += !(v >= 0 && v <= 1);
  EXPECT_EQ(outside, 0u);
  record("G1", "transmittance of NaN fibres: outside [0, 1] or NaN", "0", std::to_string(outside));
}

struct Query {
  Vec3 position;
  double range = 0.3, fibres_per_metre = 1 / 1.5e-3, opacity = 0.35, texel = 1e-3;
  Vec3 tangent{1, 0, 0}, to_light{0, 0, 1};
  uint32_t corner[2] = {0, 0}, size = 0;  // of the map in the image; size 0: the whole of it
};
struct Answer {
  float bias, full, low;
};

std::vector<Answer> ask(const std::vector<Query>& queries, const DepthMap& map) {
  std::vector<float> in;
  for (const Query& q : queries) {
    add(in, q.position);
    add(in, q.tangent);
    add(in, q.to_light);
    add(in, {q.texel, double(q.size ? q.size : map.size), q.range, q.fibres_per_metre});
    in.push_back(log2Transmittance(q.opacity));
    add(in, {double(q.corner[0]), double(q.corner[1])});
  }
  const std::vector<float> out = runItems(numerics_shadow, in, 16, 3, &map);
  std::vector<Answer> answers(out.size() / 3);
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = {out[i * 3], out[i * 3 + 1], out[i * 3 + 2]};
  return answers;
}

DepthMap filled(uint32_t size, float value) { return {size, std::vector<float>(std::size_t(size) * size, value)}; }

// Section 4 over a map of values in [0, 1], 1: empty.
double lightTwin(const DepthMap& map, const Query& q, double bias, bool core) {
  const Vec3 p = toFloat(q.position);
  const int column = int(std::floor(p.x)), row = int(std::floor(p.y)), reach = core ? 2 : 0, size = int(map.size);
  double light = 0;
  for (int j = -reach; j <= reach; ++j)
    for (int i = -reach; i <= reach; ++i) {
      const int x = column + i, y = row + j;
      double tap = 1;
      if (x >= 0 && y >= 0 && x < size && y < size) {
        const double front = double(map.texels[std::size_t(y) * map.size + std::size_t(x)]);
        if (front < 1)
          tap = reference::shadowTap(p.z, front * double(float(q.range)), bias, double(float(q.opacity)),
                                     1 / double(float(q.fibres_per_metre)));
      }
      light += core ? reference::gaussianWeight(i, j) * tap : tap;
    }
  return light;
}

TEST(ShadowRange, ClearedMaps) {
  std::vector<Query> queries;
  for (double z = -0.1; z < 0.5; z += 0.01)
    for (const double x : {-1e30, -100.0, -0.01, 0.0, 0.5, 17.3, 31.99, 32.0, 1000.0, 1e30})
      queries.push_back({{x, 13.2, z}});
  for (const double z : {double(kNan), double(kInf), -double(kInf), 1e30}) queries.push_back({{5, 5, z}});
  for (const double x : {double(kNan), double(kInf), -double(kInf)})
    queries.push_back({{x, 5, 0.1}}), queries.push_back({{5, x, 0.1}});
  Worst empty, outside, error;
  std::size_t broken = 0;
  for (const Answer& a : ask(queries, filled(32, 1)))
    empty.see(std::fabs(1 - double(a.full))), empty.see(std::fabs(1 - double(a.low)));
  const DepthMap near = filled(32, 0);
  const std::vector<Answer> answers = ask(queries, near);
  ASSERT_EQ(answers.size(), queries.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& a = answers[i];
    const Vec3 p = queries[i].position;
    broken += !(a.full >= 0 && double(a.full) <= 1 + 1e-6) || !(a.low >= 0 && a.low <= 1);
    if (std::isnan(p.x + p.y)) continue;
    if (p.x < -3 || p.x >= 34 || p.y < -3 || p.y >= 34) {
      outside.see(std::fabs(1 - double(a.full)));
      outside.see(std::fabs(1 - double(a.low)));
    } else if (std::isfinite(p.z)) {
      error.see(std::fabs(double(a.full) - lightTwin(near, queries[i], double(a.bias), true)));
      error.see(std::fabs(double(a.low) - lightTwin(near, queries[i], double(a.bias), false)));
    }
  }
  EXPECT_LE(empty.value(), 1e-6);
  EXPECT_LE(outside.value(), 1e-6);
  EXPECT_LT(error.value(), 1e-4);
  EXPECT_EQ(broken, 0u);
  record("G2", "map cleared to 1: light short of 1, receivers anywhere, also NaN and infinite", "<= 1e-6",
         format(empty.value()));
  record("G2", "map cleared to 0, receiver outside: light short of 1", "<= 1e-6", format(outside.value()));
  record("G2", "map cleared to 0, receiver before, in and behind: largest error", "< 1e-4", format(error.value()));
  record("G2", "map cleared to 0, broken receivers: outside [0, 1] or NaN", "0", std::to_string(broken));
}

TEST(ShadowRange, ExtremeRanges) {
  std::vector<Query> queries;
  const double extremes[] = {0, double(kDenormal), 1e-30, 1, 1e30, double(kInf), double(kNan)};
  for (const double range : extremes)
    for (const double z : {-1.0, 0.0, 1e-30, 0.15, 1.0, 1e30, double(kInf)})
      for (const double density : {1e-30, 1.0, 1e30, double(FLT_MAX)})
        for (const double a : {0.0, 0.35, 1.0}) queries.push_back({{5.5, 5.5, z}, range, density, a});
  for (const double texel : extremes)
    for (const Vec3 t : {Vec3{0, 0, 1}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{kNan, 0, 0}})
      queries.push_back({{5.5, 5.5, 0.1}, 0.3, 666, 0.35, texel, t});
  std::size_t broken = 0, count = 0;
  for (const float value : {0.0f, 0.5f, 0.99999994f, 1.0f}) {
    for (const Answer& a : ask(queries, filled(16, value))) {
      broken += !(a.full >= 0 && double(a.full) <= 1 + 1e-6) || !(a.low >= 0 && a.low <= 1);
      ++count;
    }
  }
  ASSERT_EQ(count, 4 * queries.size());
  EXPECT_EQ(broken, 0u);
  record("G2", "range, texel, receiver and fibre density from 0 to inf, and NaN: outside [0, 1] or NaN", "0",
         std::to_string(broken));
}

// The map covers a sphere around all hair, so that no receiver and no caster reaches its border but by rounding: what
// must not be seen is a line where the map ends.
TEST(ShadowRange, MapEdge) {
  DepthMap inner = filled(64, 1), full = filled(64, 0.2f);
  for (uint32_t y = 3; y < 61; ++y)
    for (uint32_t x = 3; x < 61; ++x) inner.texels[y * 64 + x] = 0.2f;
  std::vector<Query> queries;
  auto sweep = [&](double z) {
    queries.clear();
    for (int i = -400; i < 6800; ++i) queries.push_back({{0.01 * i + 0.005, 30.5, z}});
  };
  // Steps between two receivers on either side of the map's end.
  auto largestStep = [&](const DepthMap& map) {
    Worst full_step, low_step;
    const std::vector<Answer> answers = ask(queries, map);
    for (std::size_t i = 1; i < answers.size(); ++i) {
      const double x0 = queries[i - 1].position.x, x1 = queries[i].position.x;
      if (!((x0 < 0 && x1 >= 0) || (x0 < 64 && x1 >= 64))) continue;
      full_step.see(255 * std::fabs(double(answers[i].full) - double(answers[i - 1].full)));
      low_step.see(255 * std::fabs(double(answers[i].low) - double(answers[i - 1].low)));
    }
    return std::pair(full_step.value(), low_step.value());
  };
  sweep(0.2);
  const auto behind_empty = largestStep(inner);
  sweep(0.06);  // as near as the caster: no fibre in between
  const auto at_caster = largestStep(full);
  sweep(0.2);
  const auto behind_border = largestStep(full);
  const double held = std::max({behind_empty.first, behind_empty.second, at_caster.first, at_caster.second});
  EXPECT_LT(held, 2);
  record("G2", "map edge, no caster in the outer texels: step", "< 2 codes",
         format(std::max(behind_empty.first, behind_empty.second)));
  record("G2", "map edge, caster up to it, receiver at its depth: step", "< 2 codes",
         format(std::max(at_caster.first, at_caster.second)));
  EXPECT_GT(behind_border.second, 250);  // else the sweep misses the edge
  record("G2",
         "map edge, caster up to it, receiver 93 fibres behind (none crosses it: the map holds all hair): step of 25"
         " taps, of one",
         "reported", format(behind_border.first) + ", " + format(behind_border.second) + " codes");
}

// Maps of several lights are rectangles of one image: what lies beside one never shows in it.
TEST(ShadowRange, MapInAnAtlas) {
  const uint32_t size = 32, left = 17, top = 40;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0, 0.5f);
  DepthMap alone = filled(size, 1), atlas = filled(96, 0);  // all else casts a shadow
  for (uint32_t y = 0; y < size; ++y)
    for (uint32_t x = 0; x < size; ++x)
      alone.texels[y * size + x] = atlas.texels[(y + top) * 96 + x + left] = uniform(random);
  std::vector<Query> queries;
  for (double x = -6.3; x < 40; x += 0.9)
    for (double y = -6.1; y < 40; y += 0.9) queries.push_back({{x, y, 0.11}});
  for (const double far : {-1e30, 1e30, double(kInf)})
    queries.push_back({{far, 5, 0.11}}), queries.push_back({{5, far, 0.11}});
  const std::vector<Answer> expected = ask(queries, alone);
  for (Query& q : queries) q.corner[0] = left, q.corner[1] = top, q.size = size;
  const std::vector<Answer> actual = ask(queries, atlas);
  ASSERT_EQ(actual.size(), expected.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < actual.size(); ++i)
    different += actual[i].full != expected[i].full || actual[i].low != expected[i].low;
  EXPECT_EQ(different, 0u);
  record("G2", "map amid an atlas of other shadows, receivers in it and around: not as of the map alone", "0",
         std::to_string(different));
}

TEST(ShadowTaps, Weights) {
  const DepthMap empty = filled(16, 1);
  const float unity = ask({{{8.5, 8.5, 0.1}}}, empty).at(0).full;
  EXPECT_NEAR(double(unity), 1, 1e-6);
  // One opaque texel takes away its own weight. A sum of 25 fp32 terms near 1 is good to 25 x 6e-8.
  Worst error;
  DepthMap one = filled(16, 1);
  one.texels[8 * 16 + 8] = 0;
  std::vector<Query> queries;
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i) queries.push_back({{8.5 - i, 8.5 - j, 0.1}, 0.3, 666, 1});
  const std::vector<Answer> answers = ask(queries, one);
  ASSERT_EQ(answers.size(), queries.size());
  for (std::size_t k = 0; k < answers.size(); ++k) {
    const int i = int(k % 7) - 3, j = int(k / 7) - 3;
    const double weight = std::abs(i) <= 2 && std::abs(j) <= 2 ? reference::gaussianWeight(i, j) : 0;
    error.see(std::fabs(1 - double(answers[k].full) - weight));
  }
  EXPECT_LE(error.value(), 1.5e-6);
  record("G3", "weights of the 25 taps: sum less 1", "<= 1e-6", format(std::fabs(double(unity) - 1)));
  record("G3", "each weight: largest error", "<= 1.5e-6", format(error.value()));
}

TEST(ShadowTaps, Bias) {
  std::vector<Query> queries;
  const Vec3 light{0.36, -0.48, 0.8}, across = someNormal(light);
  std::vector<double> angles = {1e-30, 1e-9, 1e-7};
  for (int i = 0; i <= 1800; ++i) angles.push_back(i * 0.1 * kDegree);
  for (const double angle : angles) {
    Query q{{5, 5, 0}};
    q.to_light = light, q.tangent = turned(light, across, angle), q.texel = 1;
    queries.push_back(q);
  }
  const std::vector<Answer> answers = ask(queries, filled(16, 1));
  ASSERT_EQ(answers.size(), queries.size());
  Worst error;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Vec3 t = toFloat(queries[i].tangent), l = toFloat(light);
    error.see(std::fabs(double(answers[i].bias) - std::fabs(dot(t, l)) / std::max(length(cross(t, l)), 0.1)));
  }
  // At most 10 texels, and the sine beside 0.1 is good to 1e-7: 1e-5.
  EXPECT_LT(error.value(), 2e-5);
  record("other", "shadow bias, light at 0 to 180 degrees to the strand: largest error", "< 2e-5 texel",
         format(error.value()) + " texel");
}

TEST(ShadowTaps, FlatEdgeNoise) {
  const uint32_t size = 64;
  DepthMap flat = filled(size, 0.3f), edge = filled(size, 1), noise = filled(size, 1);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> uniform(0, 0.5f);
  for (uint32_t y = 0; y < size; ++y)
    for (uint32_t x = 0; x < size; ++x) {
      if (x < size / 2) edge.texels[y * size + x] = 0.3f;
      noise.texels[y * size + x] = uniform(random);
    }
  const struct {
    const char* name;
    const DepthMap& map;
  } maps[] = {{"constant depth", flat}, {"edge", edge}, {"noise", noise}};
  for (const auto& m : maps) {
    // 8 texels off the border, where the map ends for 25 taps and not for one.
    std::vector<Query> queries;
    for (uint32_t y = 8; y < size - 8; ++y)
      for (uint32_t x = 8; x < size - 8; ++x)
        for (const double z : {0.089, 0.0901, 0.0905, 0.092, 0.1, 0.14})
          queries.push_back({{x + 0.37, y + 0.61, z}, 0.3, 1 / 1.5e-3, 0.35, 1e-4, {0.6, 0, 0.8}});
    double sum_full = 0, sum_low = 0;
    Worst error;
    const std::vector<Answer> answers = ask(queries, m.map);
    ASSERT_EQ(answers.size(), queries.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const Answer& a = answers[i];
      sum_full += double(a.full), sum_low += double(a.low);
      error.see(std::fabs(double(a.full) - lightTwin(m.map, queries[i], double(a.bias), true)));
      error.see(std::fabs(double(a.low) - lightTwin(m.map, queries[i], double(a.bias), false)));
    }
    // A depth of 0.1 m in fp32 is good to 1e-8 m, 1e-5 fibres; each tap to 1e-5.
    EXPECT_LT(error.value(), 5e-5) << m.name;
    const double percent = 100 * std::fabs(sum_full / sum_low - 1);
    const bool held = &m.map == &flat;
    EXPECT_TRUE(!held || percent < 0.5) << percent;
    record("G3", std::string(m.name) + ": mean of 25 taps against one", held ? "< 0.5 %" : "reported",
           format(percent) + " %");
    record("G3", std::string(m.name) + ": largest error of a receiver", "< 5e-5", format(error.value()));
  }
}

}  // namespace
}  // namespace forelock::test
