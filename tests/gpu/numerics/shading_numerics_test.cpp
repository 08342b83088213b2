// Rows G4 to G6: specular exponents, grazing and parallel directions, tangents that are none.
#include "numerics_kit.h"
#include "numerics_spv/numerics_lobe.h"
#include "numerics_spv/numerics_shade.h"
#include "numerics_spv/numerics_tangent.h"

#include "forelock/asset.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace forelock::test {
namespace {

constexpr double kTilt = 0.174532925;  // of the default material

struct Shading {
  Vec3 tangent, to_light, to_eye;
  double exponent = 14.4, kd = 1, kr = 1, kt = 0;
};
struct Shaded {
  double diffuse, lobe_r, lobe_trt, full, low;
};

std::vector<Shaded> shade(const std::vector<Shading>& inputs) {
  std::vector<float> in;
  in.reserve(inputs.size() * 18);
  for (const Shading& s : inputs) {
    add(in, s.tangent);
    add(in, s.to_light);
    add(in, s.to_eye);
    add(in, {std::cos(2 * kTilt), std::sin(2 * kTilt), std::cos(3 * kTilt), std::sin(3 * kTilt), s.exponent, s.exponent,
             s.kd, s.kr, s.kt});
  }
  const std::vector<float> out = runItems(numerics_shade, in, 18, 5);
  std::vector<Shaded> shaded(out.size() / 5);
  for (std::size_t i = 0; i < shaded.size(); ++i) {
    const float* v = &out[i * 5];
    shaded[i] = {double(v[0]), double(v[1]), double(v[2]), double(v[3]), double(v[4])};
  }
  return shaded;
}

reference::LobeInput asSent(const Shading& s) { return {toFloat(s.tangent), toFloat(s.to_light), toFloat(s.to_eye)}; }

double fullTwin(const Shading& s, double kd, double kr, double kt) {
  reference::Material m;
  std::fill(m.color, m.color + 3, 1.0);
  m.kd = kd, m.kr = kr, m.kt = kt;
  m.exponent_r = m.exponent_trt = double(float(s.exponent));
  m.cuticle_tilt = kTilt;
  return reference::shadeLobes(m, asSent(s), true)[0];
}

// Angles of the two lobes from the eye.
std::pair<double, double> lobeAngles(const Shading& s) {
  const reference::LobeInput in = asSent(s);
  const double mirrored = std::numbers::pi - angleBetween(in.tangent, in.to_light),
               eye = angleBetween(in.tangent, in.to_eye);
  return {mirrored + 2 * kTilt - eye, mirrored - 3 * kTilt - eye};
}

TEST(Specular, Exponents) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const struct {
    double value, bound;
    const char* name;
  } exponents[] = {{0, 1e-3, "0"},     {1e-3, 1e-3, "0.001"},
                   {1, 1e-3, "1"},     {14.4, 1e-3, "14.4"},
                   {1e2, 1e-3, "1e2"}, {1e3, 1e-3, "1e3"},
                   {1e4, 1e-3, "1e4"}, {1e5, 1e-2, "1e5"},
                   {1e6, 1e-2, "1e6"}, {double(kInf), 1e-2, "inf (the API refuses it; clamped to 1e6)"}};
  for (const auto& e : exponents) {
    std::vector<Shading> inputs;
    for (int pair = 0; pair < 24; ++pair) {
      Shading s;
      s.tangent = pair == 0 ? Vec3{0, 0, 1} : randomDirection(random);
      s.to_light = pair == 1 ? s.tangent : randomDirection(random);
      s.exponent = e.value;
      for (std::size_t i = 0; i < 2000; ++i) {
        s.to_eye = fibonacci(i, 2000);
        inputs.push_back(s);
      }
      // A highlight of exponent n is 1 / sqrt(n) wide: the even sphere would miss it.
      const double mirrored = std::numbers::pi - angleBetween(s.tangent, s.to_light),
                   width = 4 / std::sqrt(std::clamp(e.value, 16.0, 1e6));
      const Vec3 u = someNormal(s.tangent), w = cross(s.tangent, u);
      for (int i = 0; i < 2000; ++i) {
        const double angle = mirrored + (i % 2 ? 2 : -3) * kTilt + width * uniform(random);
        s.to_eye = turned(s.tangent, turned(u, w, std::numbers::pi * uniform(random)), angle);
        inputs.push_back(s);
      }
    }
    const std::vector<Shaded> out = shade(inputs);
    ASSERT_EQ(out.size(), inputs.size());
    Worst error, above;
    std::size_t at_step = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      const auto [angle_r, angle_trt] = lobeAngles(inputs[i]);
      above.see(std::max(out[i].lobe_r, out[i].lobe_trt) - 1);
      // The lobe steps from 1 to 0 at 90 degrees where the exponent is near 0; on which side an angle lies that is 1e-6
      // off, fp32 vectors do not say.
      if (std::fabs(std::cos(angle_r)) < 1e-6 || std::fabs(std::cos(angle_trt)) < 1e-6) {
        ++at_step;
        continue;
      }
      error.see(std::fabs(out[i].lobe_r - fullTwin(inputs[i], 0, 1, 0)));
      error.see(std::fabs(out[i].lobe_trt - fullTwin(inputs[i], 0, 0, 1)));
    }
    EXPECT_LE(error.value(), e.bound) << e.name;
    EXPECT_LE(above.value(), 1e-4) << e.name;
    EXPECT_LT(at_step, out.size() / 1000);
    const std::string bound = e.value <= 1e4 ? "<= 1e-3" : "<= 1e-2";
    record("G4", std::string("exponent ") + e.name + ": largest error over directions", bound, format(error.value()));
    record("G4", std::string("exponent ") + e.name + ": above 1", "<= 1e-4", format(above.value()));
  }
}

TEST(Specular, LobeOfExtremes) {
  struct Case {
    double q, n, cosine, sine, lobe;  // lobe: what is expected, negative: in [0, 1]
  };
  const double inf = double(kInf), nan = double(kNan);
  const std::vector<Case> cases = {
      {0, 0, 1, 0, 1},   {0, inf, 1, 0, 1},          {1, 0, 1e-30, 1, 1},     {0.5, 0, 1e-3, 1, 1},
      {1, 1, 0, 1, 0},   {1, inf, 0.5, 0.866, 0},    {0, 1e6, 1, 1e-30, 1},   {0, 14.4, -0.5, 0.866, 0},
      {0, 0, -1, 0, 0},  {0.3, 1, nan, 0, 0},        {0.3, 1, 0.5, nan, -1},  {0.3, -5, 0.5, 0.866, 1},
      {nan, 1, 1, 0, 1}, {0.5, nan, 0.5, 0.866, -1}, {2, 3, 1.0000001, 0, 1}, {0, 1e30, 0.999, 0.0447, 0}};
  std::vector<float> in;
  for (const Case& c : cases) add(in, {c.q, c.n, c.cosine, c.sine});
  const std::vector<float> out = runItems(numerics_lobe, in, 4, 2);
  ASSERT_EQ(out.size(), cases.size() * 2);
  std::size_t broken = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double lobe = double(out[i * 2 + 1]);
    const bool good = cases[i].lobe < 0 ? lobe >= 0 && lobe <= 1 : std::fabs(lobe - cases[i].lobe) <= 1e-6;
    EXPECT_TRUE(good) << "cosine " << cases[i].cosine << ", sine " << cases[i].sine << ", exponent " << cases[i].n
                      << ": " << lobe;
    broken += !good;
  }
  record("G4", "cosine, sine and exponent 0, 1, infinite, negative, NaN: not as documented", "0",
         std::to_string(broken));
}

TEST(Specular, PowerOfOneMinus) {
  std::vector<double> qs = {0, double(kDenormal), 1e-30, 1e-12, 1e-8, 0.4999999, 0.5, 0.5000001, 0.9, 1 - 0x1p-24, 1};
  for (int i = 0; i < 400; ++i) qs.push_back(std::exp2(-24.0 * i / 400));
  for (int i = 1; i < 100; ++i) qs.push_back(i / 100.0);
  std::vector<float> in;
  for (const double q : qs)
    for (const double n : {0.0, 1e-3, 0.1, 1.0, 2.0, 14.4, 1e2, 1e3, 1e4, 1e5, 1e6}) add(in, {q, n, 1, 0});
  const std::vector<float> out = runItems(numerics_lobe, in, 4, 2);
  ASSERT_EQ(out.size() * 2, in.size());
  Worst error;
  for (std::size_t i = 0; i < in.size() / 4; ++i) {
    const long double q = static_cast<long double>(in[i * 4]), n = static_cast<long double>(in[i * 4 + 1]);
    const long double exact = n == 0 ? 1 : q >= 1 ? 0 : expl(n * log1pl(-q));
    error.see(std::fabs(double(static_cast<long double>(out[i * 2]) - exact)));
  }
  // x exp(-x) <= 0.37 times the log's few ulp (2^-21 beside q = 0.5), and exp's 3 + 2 |x| ulp.
  EXPECT_LT(error.value(), 2e-6);
  record("other", "(1 - q)^n, q 0 to 1, n 0 to 1e6, against long double: largest error", "< 2e-6",
         format(error.value()));
}

const Vec3 kTangents[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.6, 0.8, 0}, {-0.48, 0.64, 0.6}, {0.36, -0.48, -0.8}};

// Angles of 0 to 1e-7, where sqrt(1 - cos^2) has no digit left, then steps of 0.01 degree up to 180.
std::vector<double> parallelAngles(int& tiny) {
  std::vector<double> angles = {0, 1e-30, 1e-12, 1e-9, 1e-8, 3e-8, 1e-7};
  tiny = int(angles.size());
  for (int i = 0; i <= 18000; ++i) angles.push_back(i * 0.01 * kDegree);
  return angles;
}

TEST(Parallel, FiniteAndSmooth) {
  enum Kind { light_parallel, eye_is_light, back_light };
  const struct {
    Kind kind;
    const char* name;
  } kinds[] = {
      {light_parallel, "light parallel to the strand"}, {eye_is_light, "eye = light"}, {back_light, "back light"}};
  int tiny = 0;
  const std::vector<double> angles = parallelAngles(tiny);
  for (const auto& k : kinds) {
    Worst error, step, tiny_spread;
    std::size_t broken = 0;
    for (const Vec3 t : kTangents) {
      const Vec3 u = someNormal(t), w = cross(t, u);
      std::vector<Shading> inputs;
      for (const double angle : angles) {
        Shading s;
        s.tangent = t;
        s.to_light = turned(t, u, angle);
        s.to_eye = k.kind == eye_is_light ? s.to_light
                   : k.kind == back_light ? scaled(s.to_light, -1)
                                          : turned(t, turned(u, w, 1), std::numbers::pi - 0.3);
        // Its steepest slope is 2 sqrt(n) exp(-1/2) per radian, 0.54 code per 0.01 degree: with the diffuse 0.59.
        s.exponent = 100;
        inputs.push_back(s);
      }
      const std::vector<Shaded> out = shade(inputs);
      ASSERT_EQ(out.size(), inputs.size());
      for (std::size_t i = 0; i < out.size(); ++i) {
        const Shaded& o = out[i];
        broken += !std::isfinite(o.diffuse + o.lobe_r + o.lobe_trt + o.full + o.low) || o.diffuse < 0 || o.diffuse > 1;
        error.see(std::fabs(o.full - fullTwin(inputs[i], 1, 1, 0)));
        if (i > 0)
          (i < std::size_t(tiny) ? tiny_spread : step)
              .see(255 * std::fabs(o.full - out[i < std::size_t(tiny) ? 0 : i - 1].full));
      }
    }
    EXPECT_EQ(broken, 0u) << k.name;
    EXPECT_LT(step.value(), 1) << k.name;
    EXPECT_LT(tiny_spread.value(), 1) << k.name;
    // The slope above times the 1e-7 that fp32 vectors are good to, doubled for the arithmetic.
    EXPECT_LT(error.value(), 1e-5) << k.name;
    record("G5", std::string(k.name) + ", 0 to 180 degrees: NaN, infinite, or diffuse outside [0, 1]", "0",
           std::to_string(broken));
    record("G5", std::string(k.name) + ", exponent 100: step per 0.01 degree", "< 1 code",
           format(step.value()) + " codes");
    record("G5", std::string(k.name) + ", angles 0 to 1e-7 radian: spread", "< 1 code",
           format(tiny_spread.value()) + " codes");
    record("G5", std::string(k.name) + ": largest error", "< 1e-5", format(error.value()));
  }
}

struct Degenerate {
  Vec3 v;
  bool is_direction;  // unitOrZero gives a unit vector
};
const double kN = double(kNan), kI = double(kInf), kD = double(kDenormal);
const std::vector<Degenerate> kDegenerate = {
    {{0, 0, 0}, false},          {{-0.0, 0, -0.0}, false},    {{kD, 0, 0}, false},       {{kD, -kD, kD}, false},
    {{kN, kN, kN}, false},       {{kN, 0, 0}, false},         {{0, 1, kN}, false},       {{kI, 0, 0}, false},
    {{1, -kI, 0}, false},        {{kI, kN, 1}, false},        {{kI, kI, -kI}, false},    {{1e20, 0, 0}, true},
    {{1e20, -1e20, 1e20}, true}, {{3e38, 3e38, -3e38}, true}, {{1e-30, 2e-30, 0}, true}, {{1e20, 1, 1e-20}, true}};

// Lights and eyes all around, so that any tangent would somewhere show a highlight.
std::size_t notDiffuseOnly(const std::vector<Vec3>& tangents) {
  std::vector<Shading> inputs;
  for (const Vec3 t : tangents)
    for (std::size_t i = 0; i < 40; ++i)
      for (std::size_t j = 0; j < 40; ++j)
        inputs.push_back({t, fibonacci(i, 40), fibonacci(j, 40), 14.4, 0.7, 0.5, 0.5});
  std::size_t wrong = 0;
  const std::vector<Shaded> out = shade(inputs);
  EXPECT_EQ(out.size(), inputs.size());
  for (const Shaded& o : out)
    wrong += !(o.diffuse == 1 && o.lobe_r == 0 && o.lobe_trt == 0 && std::fabs(o.full - 0.7) < 1e-6 &&
               std::fabs(o.low - 0.7) < 1e-6);
  return wrong;
}

TEST(DegenerateTangent, ShadesDiffuseOnly) {
  std::vector<Vec3> raw;
  for (const Degenerate& d : kDegenerate)
    if (!(d.is_direction && d.v.x < 1)) raw.push_back(d.v);  // 1e-30 too is shorter than any unit vector, but so is 0
  const std::size_t wrong_raw = notDiffuseOnly(raw);
  EXPECT_EQ(wrong_raw, 0u);
  record("G6", "tangent 0, denormal, 1e20, NaN, infinite sent to the shading itself: not diffuse only", "0",
         std::to_string(wrong_raw));

  std::vector<float> in;
  for (const Degenerate& d : kDegenerate) add(in, d.v);
  const std::vector<float> out = runItems(numerics_tangent, in, 3, 15);
  ASSERT_EQ(out.size(), kDegenerate.size() * 15);
  std::vector<Vec3> unit, decoded[3];
  Worst direction_error;
  for (std::size_t i = 0; i < kDegenerate.size(); ++i) {
    const Degenerate& d = kDegenerate[i];
    const Vec3 u = at(out, i * 15);
    if (d.is_direction) {
      const double largest = std::max({std::fabs(d.v.x), std::fabs(d.v.y), std::fabs(d.v.z)});
      direction_error.see(angleBetween(u, scaled(toFloat(d.v), 1 / largest)) + std::fabs(length(u) - 1));
      for (int c = 0; c < 3; ++c)
        direction_error.see(isFinite(at(out, i * 15 + 4 + 4 * std::size_t(c))) ? 0 : HUGE_VAL);
      continue;
    }
    unit.push_back(u);
    for (int c = 0; c < 3; ++c) decoded[c].push_back(at(out, i * 15 + 4 + 4 * std::size_t(c)));
  }
  const std::size_t wrong_unit = notDiffuseOnly(unit), wrong_default = notDiffuseOnly(decoded[0]),
                    wrong_paper = notDiffuseOnly(decoded[1]), wrong_hard = notDiffuseOnly(decoded[2]);
  EXPECT_EQ(wrong_unit, 0u);
  EXPECT_EQ(wrong_default, 0u);
  EXPECT_EQ(wrong_paper, 0u);
  EXPECT_EQ(wrong_hard, 0u);
  EXPECT_LT(direction_error.value(), 1e-6);
  record("G6", "the same (but 1e20, which is a direction) normalised: not diffuse only", "0",
         std::to_string(wrong_unit));
  record("G6", "the same, stored and read, default coding: not diffuse only", "0", std::to_string(wrong_default));
  record("G6", "the same, stored and read, paper coding: not diffuse only", "0", std::to_string(wrong_paper));
  record("G6", "the same, stored and read, method hard: not diffuse only", "0", std::to_string(wrong_hard));
  record("G6", "lengths of 1e-30 to 3e38 normalised: largest error, radian and length", "< 1e-6",
         format(direction_error.value()));
}

// The counter of G6: what has no direction is counted where it enters.
TEST(DegenerateTangent, FindingsCountThem) {
  const float tiny = kDenormal;
  const std::vector<float> positions = {
      0, 0,    0, 0,    0,    0,                          // two strands of no length
      1, 1,    1, 1,    1,    1,                          //
      0, 0,    0, 0,    0,    0, 0.1f, 0, 0, 0.1f, 0, 0,  // a segment of none at either end
      0, 0,    0, tiny, 0,    0, 0.1f, 0, 0, 0.2f, 0, 0,  // a denormal one
      0, 0.1f, 0, 0.1f, 0.1f, 0};
  const std::vector<uint32_t> first = {0, 2, 4, 8, 12, 14};
  const std::vector<float> radii(14, 1e-4f);
  FlkStrands strands{};
  strands.type = FLK_TYPE_STRANDS;
  strands.strand_count = 5, strands.vertex_count = 14;
  strands.first_vertex = first.data(), strands.positions = positions.data(), strands.radii = radii.data();
  FlkAsset asset = nullptr;
  ASSERT_EQ(flkAssetCreate(&strands, nullptr, &asset), FLK_SUCCESS);
  uint64_t dropped = 0, kept = 0;
  FlkFinding finding{};
  for (uint32_t i = 0; flkAssetGetFinding(asset, i, &finding) == FLK_SUCCESS; ++i) {
    if (std::string(finding.code) == "STRAND_ZERO_LENGTH") dropped = finding.count;
    if (std::string(finding.code) == "SEGMENT_ZERO_LENGTH") kept = finding.count;
  }
  flkAssetDestroy(asset);
  EXPECT_EQ(dropped, 2u);
  EXPECT_EQ(kept, 3u);
  record("G6", "2 strands and 3 segments of no length, or a denormal one: findings count", "2, 3",
         std::to_string(dropped) + ", " + std::to_string(kept));
}

}  // namespace
}  // namespace forelock::test
