// Row G7 and the other payload codings.
#include "numerics_kit.h"
#include "numerics_spv/numerics_color.h"
#include "numerics_spv/numerics_payload.h"
#include "numerics_spv/numerics_tangent.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace forelock::test {
namespace {

struct Coded {
  uint32_t code[3];  // 11 + 11 bits, 12 + 12 bits, 13 + 13 bits
  Vec3 decoded[3];
};

std::vector<Coded> code(const std::vector<Vec3>& directions) {
  std::vector<float> in;
  in.reserve(directions.size() * 3);
  for (const Vec3 d : directions) add(in, d);
  const std::vector<float> out = runItems(numerics_tangent, in, 3, 15);
  std::vector<Coded> coded(out.size() / 15);
  for (std::size_t i = 0; i < coded.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      coded[i].code[c] = word(out[i * 15 + 3 + 4 * c]), coded[i].decoded[c] = at(out, i * 15 + 4 + 4 * c);
  return coded;
}

// The direction at a corner between four codes, where the error is largest.
Vec3 cellCorner(double i, double j, double steps) {
  const double x = (i + 0.5) / steps * 2 - 1, y = (j + 0.5) / steps * 2 - 1, z = 1 - std::fabs(x) - std::fabs(y);
  if (z >= 0) return normalized({x, y, z});
  return normalized({(1 - std::fabs(y)) * (x >= 0 ? 1 : -1), (1 - std::fabs(x)) * (y >= 0 ? 1 : -1), z});
}

TEST(TangentCode, Angles) {
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < 1000000; ++i) directions.push_back(fibonacci(i, 1000000));
  std::mt19937 random(5);
  for (const int bits : {11, 12, 13}) {
    const int steps = (1 << bits) - 2;
    std::uniform_int_distribution<int> any(0, steps - 1);
    for (int i = 0; i < 300000; ++i) directions.push_back(cellCorner(any(random), any(random), steps));
    // The middle of a face, which the map stretches most, and its surroundings, in all octants.
    for (const double cx : {-1.0 / 3, 1.0 / 3, -2.0 / 3, 2.0 / 3})
      for (const double cy : {-1.0 / 3, 1.0 / 3, -2.0 / 3, 2.0 / 3})
        for (int i = -12; i < 12; ++i)
          for (int j = -12; j < 12; ++j)
            directions.push_back(
                cellCorner(std::floor((cx + 1) / 2 * steps) + i, std::floor((cy + 1) / 2 * steps) + j, steps));
  }
  const std::vector<Coded> coded = code(directions);
  ASSERT_EQ(coded.size(), directions.size());
  Worst angle[3], length_error;
  double square[3] = {};
  for (std::size_t i = 0; i < coded.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = angleBetween(directions[i], coded[i].decoded[c]) / kDegree;
      angle[c].see(a);
      if (i < 1000000) square[c] += a * a / 1000000;
      length_error.see(std::fabs(length(coded[i].decoded[c]) - 1));
    }
  EXPECT_LE(angle[1].value(), 0.06);
  // Half as many levels: twice the angle.
  EXPECT_LE(angle[0].value(), 0.12);
  // Twice as many: half of it.
  EXPECT_LE(angle[2].value(), 0.03);
  EXPECT_LE(length_error.value(), 1e-6);
  record("G7", "24-bit tangent (paper coding), all directions: largest angle", "<= 0.06 degrees",
         format(angle[1].value()) + " degrees");
  record("G7", "22-bit tangent (default coding), all directions: largest angle", "<= 0.12 degrees",
         format(angle[0].value()) + " degrees");
  record("G7", "26-bit tangent (hard), all directions: largest angle", "<= 0.03 degrees",
         format(angle[2].value()) + " degrees");
  record("G7", "rms angle of 26, of 24 and of 22 bits", "reported",
         format(std::sqrt(square[2])) + ", " + format(std::sqrt(square[1])) + ", " + format(std::sqrt(square[0])) +
             " degrees");
}

TEST(TangentCode, Highlight) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double exponent = 1e3, tilt = 0.174532925;
  reference::Material material;
  material.kd = 0, material.kr = 1, material.exponent_r = exponent, material.cuticle_tilt = tilt;
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < 300000; ++i) directions.push_back(fibonacci(i, 300000));
  const std::vector<Coded> coded = code(directions);
  ASSERT_EQ(coded.size(), directions.size());
  auto lobe = [&](Vec3 t, Vec3 l, Vec3 v) { return reference::shadeLobes(material, {t, l, v}, true)[0]; };
  double sphere[2] = {}, inside[2] = {};
  std::size_t inside_count = 0;
  for (std::size_t i = 0; i < coded.size(); ++i) {
    const Vec3 t = directions[i], l = randomDirection(random), anywhere = randomDirection(random);
    // An eye within the highlight, 3 of its widths to either side.
    const Vec3 u = someNormal(t);
    const double angle = std::numbers::pi - angleBetween(t, l) + 2 * tilt + 3 * uniform(random) / std::sqrt(exponent);
    const Vec3 eye = turned(t, turned(u, cross(t, u), std::numbers::pi * uniform(random)), angle);
    const double there = lobe(t, l, eye), elsewhere = lobe(t, l, anywhere);
    inside_count += there > 1.0 / 255;
    for (std::size_t c = 0; c < 2; ++c) {
      const double d = lobe(coded[i].decoded[c], l, anywhere) - elsewhere;
      sphere[c] += d * d / double(coded.size());
      if (there > 1.0 / 255) inside[c] += std::pow(lobe(coded[i].decoded[c], l, eye) - there, 2);
    }
  }
  for (double& s : inside) s = std::sqrt(s / double(inside_count));
  for (double& s : sphere) s = std::sqrt(s);
  EXPECT_LE(sphere[1], 0.005);
  EXPECT_LE(sphere[0], 0.005);
  record("G7", "highlight of exponent 1e3, all directions, 24 bits: rms", "<= 0.005", format(sphere[1]));
  record("G7", "highlight of exponent 1e3, all directions, 22 bits: rms", "<= 0.005", format(sphere[0]));
  record("G7", "highlight of exponent 1e3, within the highlight, 24 and 22 bits: rms", "reported",
         format(inside[1]) + ", " + format(inside[0]));
}

TEST(TangentCode, AxesAreExact) {
  std::vector<Vec3> axes;
  for (const double s : {-1.0, 1.0}) axes.push_back({s, 0, 0}), axes.push_back({0, s, 0}), axes.push_back({0, 0, s});
  std::size_t wrong = 0;
  const std::vector<Coded> coded = code(axes);
  ASSERT_EQ(coded.size(), axes.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (const Vec3 d : coded[i].decoded) wrong += !(d.x == axes[i].x && d.y == axes[i].y && d.z == axes[i].z);
  EXPECT_EQ(wrong, 0u);
  record("other", "axes through each tangent code: not equal", "0", std::to_string(wrong));
}

TEST(TangentCode, Stable) {
  // What is decoded codes to itself, so that nothing drifts when stored again.
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < 200000; ++i) directions.push_back(fibonacci(i, 200000));
  const std::vector<Coded> once = code(directions);
  ASSERT_EQ(once.size(), directions.size());
  Worst drift;
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<Vec3> decoded;
    for (const Coded& o : once) decoded.push_back(o.decoded[c]);
    const std::vector<Coded> twice = code(decoded);
    for (std::size_t i = 0; i < twice.size(); ++i) drift.see(angleBetween(decoded[i], twice[i].decoded[c]));
  }
  EXPECT_LT(drift.value(), 1e-6);
  record("other", "a decoded tangent coded again: largest turn", "< 1e-6 radian", format(drift.value()));
}

struct Stored {
  uint32_t alpha_code;
  double tangent_alpha, color_alpha;
  Vec3 color;
};

std::vector<Stored> store(const std::vector<float>& in) {
  const std::vector<float> out = runItems(numerics_payload, in, 6, 7);
  std::vector<Stored> stored(out.size() / 7);
  for (std::size_t i = 0; i < stored.size(); ++i)
    stored[i] = {word(out[i * 7]), double(out[i * 7 + 1]), double(out[i * 7 + 6]), at(out, i * 7 + 3)};
  return stored;
}

TEST(AlphaCode, RoundTrip) {
  std::vector<double> alphas = {
      0, double(kDenormal), 1e-30, 2.3e-7, 2.5e-7, 1 / 255.0 - 1e-8, 1 / 255.0 + 1e-8, 1 - 0x1p-24, 1};
  for (int i = 0; i <= 20000; ++i) alphas.push_back(i / 20000.0);
  std::sort(alphas.begin(), alphas.end());
  Worst root_error, linear_error;
  std::size_t wrong = 0;
  for (const int coding : {0, 1}) {
    std::vector<float> in;
    for (const double a : alphas) add(in, {0, 0, 0, a, 1, double(coding)});
    const std::vector<Stored> out = store(in);
    ASSERT_EQ(out.size(), alphas.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = double(float(alphas[i]));
      if (coding == 0) {
        root_error.see(1023 * std::fabs(std::sqrt(out[i].tangent_alpha) - std::sqrt(a)));
      } else if (a >= double(1.0f / 255.0f)) {
        linear_error.see(255 * std::fabs(out[i].tangent_alpha - a));
      } else {
        wrong += out[i].alpha_code != 0;
      }
      if (i > 0) wrong += out[i].alpha_code < out[i - 1].alpha_code;
      wrong += out[i].tangent_alpha < 0 || out[i].tangent_alpha > 1;
    }
    wrong += out.front().alpha_code != 0 || out.back().tangent_alpha != 1;
  }
  // Half a step, and the rounding of sqrt and product: 1e-3 of a step.
  EXPECT_LE(root_error.value(), 0.501);
  EXPECT_LE(linear_error.value(), 0.501);
  EXPECT_EQ(wrong, 0u);
  record("other", "alpha, default coding, in steps of its root: largest error", "<= 0.501", format(root_error.value()));
  record("other", "alpha, paper coding, in steps: largest error", "<= 0.501", format(linear_error.value()));
  record("other", "alpha, either coding: 0 kept, 1 not exact, code falls where alpha rises, outside [0, 1]", "0",
         std::to_string(wrong));
}

TEST(ColorCode, RoundTripAndHostile) {
  Worst error;
  std::size_t wrong = 0;
  const double nan = double(kNan), inf = double(kInf);
  for (const int coding : {0, 1})
    for (const double range : {1e-30, 0.01, 1.0, 300.0, 1e30}) {
      const double white = double(float(range));
      std::vector<float> in;
      std::vector<double> share;
      for (int i = 0; i <= 1000; ++i) share.push_back(i / 1000.0);
      for (const double s : share) add(in, {s * white, white, s * white, 0.5, range, double(coding)});
      for (const double v : {nan, inf, -inf, -1.0, 3e38, double(kDenormal), 1e30})
        for (int where = 0; where < 3; ++where)
          add(in, {where == 0 ? v : 0.0, where == 1 ? v : 0.0, where == 2 ? v : 0.0, 0.5, range, double(coding)});
      const std::vector<Stored> out = store(in);
      ASSERT_EQ(out.size(), share.size() + 21);
      auto steps = [&](double c, double s, double levels) {
        return levels * (coding == 0 ? std::fabs(std::sqrt(c / white) - std::sqrt(s)) : std::fabs(c / white - s));
      };
      for (std::size_t i = 0; i < out.size(); ++i) {
        const Vec3 c = out[i].color;
        // Whatever the colour, the alpha keeps its bits.
        wrong += std::fabs(out[i].color_alpha - 0.5) > 0.002 || !isFinite(c);
        for (const double v : {c.x, c.y, c.z}) wrong += !(v >= 0 && v <= white * (1 + 1e-6));
        if (i < share.size()) {
          error.see(steps(c.x, share[i], 255));
          error.see(steps(c.z, share[i], coding == 0 ? 127 : 255));
          wrong += std::fabs(c.y / white - 1) > 1e-6;
        } else {
          // Nor does it spill into the other channels.
          const std::size_t where = (i - share.size()) % 3;
          wrong += (where != 0 && c.x != 0) || (where != 1 && c.y != 0) || (where != 2 && c.z != 0);
        }
      }
    }
  EXPECT_LE(error.value(), 0.501);
  EXPECT_EQ(wrong, 0u);
  record("other", "forward colour, both codings, range 1e-30 to 1e30, in steps: largest error", "<= 0.501",
         format(error.value()));
  record(
      "other",
      "forward colour of NaN, infinite, negative, huge radiance: spills into other bits, or decodes outside [0, range]",
      "0", std::to_string(wrong));
}

struct SharedColor {
  uint32_t word;
  Vec3 color;
};

std::vector<SharedColor> shareExponent(const std::vector<Vec3>& colors) {
  std::vector<float> in;
  for (const Vec3 c : colors) add(in, c);
  const std::vector<float> out = runItems(numerics_color, in, 3, 4);
  std::vector<SharedColor> shared(out.size() / 4);
  for (std::size_t i = 0; i < shared.size(); ++i) shared[i] = {word(out[i * 4]), at(out, i * 4 + 1)};
  return shared;
}

TEST(SharedExponent, RoundTripAndHostile) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Vec3> colors = {{1, 1, 1}, {0, 0, 0}, {65408, 0, 1}, {0x1p-24, 0, 0}, {0.999999, 0.5, 0.25}};
  for (int e = -22; e <= 15; ++e)
    for (int i = 0; i < 400; ++i) {
      const double largest = std::exp2(e + uniform(random));
      Vec3 c{largest, largest * uniform(random), largest * std::exp2(-10 * uniform(random))};
      if (i % 3 == 1) std::swap(c.x, c.y);
      if (i % 3 == 2) std::swap(c.x, c.z);
      colors.push_back(c);
    }
  // The last value below each carry: 511.5 steps round up into the next exponent.
  for (int e = -14; e <= 15; ++e)
    for (const double steps : {511.4999, 511.5, 511.9999}) colors.push_back({std::ldexp(steps, e - 9), 0, 0});
  const std::vector<SharedColor> out = shareExponent(colors);
  ASSERT_EQ(out.size(), colors.size());
  Worst error, against_twin;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 c = toFloat(colors[i]), d = out[i].color;
    const double largest = std::max({c.x, c.y, c.z});
    const std::array<double, 3> twin = reference::codedColor({c.x, c.y, c.z}, reference::Payload::standard);
    // What exceeds the largest code is cut to it, and below 2^-15 steps no longer shrink.
    const double scale = std::max(std::min(largest, 65408.0), 0x1p-15);
    const double cut[3] = {std::min(c.x, 65408.0), std::min(c.y, 65408.0), std::min(c.z, 65408.0)},
                 decoded[3] = {d.x, d.y, d.z};
    for (std::size_t k = 0; k < 3; ++k) {
      error.see(std::fabs(decoded[k] - cut[k]) / scale);
      against_twin.see(std::fabs(decoded[k] - twin[k]) / scale);
    }
  }
  // Half a step of 1/256 or less of the largest channel.
  EXPECT_LE(error.value(), 1.0 / 512);
  record("other", "colour of nine bits and a shared exponent: largest error, share of the largest channel", "<= 1/512",
         "1/" + format(1 / error.value()));
  EXPECT_EQ(against_twin.value(), 0);
  record("other", "the same against its twin", "0", format(against_twin.value()));

  std::vector<Vec3> hostile;
  const double nan = double(kNan), inf = double(kInf);
  for (const double v : {nan, inf, -inf, -1.0, 65408.5, 65536.0, 3e38, double(kDenormal), 1e-30, 2.9e-8})
    for (int where = 0; where < 3; ++where)
      hostile.push_back({where == 0 ? v : 0.25, where == 1 ? v : 0.25, where == 2 ? v : 0.25});
  std::size_t broken = 0;
  const std::vector<SharedColor> answers = shareExponent(hostile);
  ASSERT_EQ(answers.size(), hostile.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Vec3 d = answers[i].color;
    for (const double v : {d.x, d.y, d.z}) broken += !(v >= 0 && v <= 65408);
    // A small or negative neighbour leaves the others as they are.
    const double values[3] = {hostile[i].x, hostile[i].y, hostile[i].z}, decoded[3] = {d.x, d.y, d.z};
    const bool small = values[i % 3] < 0.25;
    if (small)
      for (std::size_t k = 0; k < 3; ++k) broken += decoded[k] != (k == i % 3 ? 0 : 0.25);
  }
  EXPECT_EQ(broken, 0u);
  record("other",
         "the same of NaN, infinite, negative, denormal, huge: decodes outside [0, 65408], or a small channel moves "
         "the others",
         "0", std::to_string(broken));
}

}  // namespace
}  // namespace forelock::test
