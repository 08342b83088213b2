// The integer sums of the deterministic tail, and the opacity modifiers.
#include "numerics_kit.h"
#include "numerics_spv/numerics_modifier.h"
#include "numerics_spv/numerics_tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace forelock::test {
namespace {

constexpr uint32_t kFragments = 500, kIn = 2 + 4 * kFragments;
constexpr Constant kMean{7, 1}, kNone{7, 2};  // FLK_SPEC_TAIL: FLK_TAIL_KIND_MEAN, FLK_TAIL_KIND_NONE

struct TailFragment {
  std::array<float, 3> color;
  float alpha;
};
using TailList = std::vector<TailFragment>;
struct TailAnswer {
  float color[3], transmittance;
  bool operator==(const TailAnswer&) const = default;
};

std::vector<TailAnswer> tails(const std::vector<TailList>& lists, float range, Constant kind) {
  std::vector<float> in(lists.size() * kIn);
  for (std::size_t i = 0; i < lists.size(); ++i) {
    float* item = &in[i * kIn];
    item[0] = range, item[1] = float(lists[i].size());
    for (std::size_t k = 0; k < lists[i].size(); ++k) {
      std::copy_n(lists[i][k].color.begin(), 3, item + 2 + 4 * k);
      item[5 + 4 * k] = lists[i][k].alpha;
    }
  }
  const std::vector<float> out = runItems(numerics_tail, in, kIn, 4, nullptr, {&kind, 1});
  std::vector<TailAnswer> answers(out.size() / 4);
  for (std::size_t i = 0; i < answers.size(); ++i)
    answers[i] = {{out[i * 4], out[i * 4 + 1], out[i * 4 + 2]}, out[i * 4 + 3]};
  return answers;
}

struct Exact {
  long double color[3] = {0, 0, 0}, transmittance = 1;
};
Exact tailTwin(const TailList& list) {
  Exact e;
  long double sum = 0;
  for (const TailFragment& f : list) {
    const long double a = static_cast<long double>(f.alpha), tau = std::min(-log1pl(-a) / logl(2), 12.0L);
    e.transmittance *= 1 - a;
    sum += tau;
    for (std::size_t c = 0; c < 3; ++c) e.color[c] += tau * static_cast<long double>(f.color[c]);
  }
  for (long double& c : e.color) c = sum > 0 ? (1 - e.transmittance) * c / sum : 0;
  return e;
}

TEST(DeterministicTail, SumsAgainstLongDouble) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<TailList> lists;
  // Of one alpha all fragments round the same way; -ln T of 1 to 14, and alphas of all sizes mixed.
  for (int i = 0; i < 240; ++i) {
    const uint32_t count = i % 3 ? kFragments : 1 + random() % kFragments;
    const double depth = 1 + 13.0 * i / 240;
    TailList list;
    for (uint32_t k = 0; k < count; ++k) {
      const double even = -std::expm1(-depth / count);
      list.push_back({{uniform(random), uniform(random), uniform(random)},
                      float(i % 2 ? even : even * 2 * double(uniform(random)))});
    }
    lists.push_back(list);
  }
  const std::vector<TailAnswer> out = tails(lists, 1, kMean), none = tails(lists, 1, kNone);
  ASSERT_EQ(out.size(), lists.size());
  ASSERT_EQ(none.size(), lists.size());
  Worst transmittance, color;
  std::size_t spread = 0, unequal = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Exact e = tailTwin(lists[i]);
    transmittance.see(100 * std::fabs(double(static_cast<long double>(out[i].transmittance) / e.transmittance - 1)));
    for (std::size_t c = 0; c < 3; ++c)
      color.see(255 * std::fabs(double(static_cast<long double>(out[i].color[c]) - e.color[c])));
    unequal += none[i].transmittance != out[i].transmittance;
  }
  for (int turn = 0; turn < 6; ++turn) {
    std::vector<TailList> permuted = lists;
    for (TailList& list : permuted) {
      if (turn == 0)
        std::reverse(list.begin(), list.end());
      else
        std::shuffle(list.begin(), list.end(), random);
    }
    const std::vector<TailAnswer> again = tails(permuted, 1, kMean);
    ASSERT_EQ(again.size(), out.size());
    for (std::size_t i = 0; i < out.size(); ++i) spread += !(again[i] == out[i]);
  }
  EXPECT_LE(transmittance.value(), 0.3);
  // A step of tau of 2^-17 at least holds for 1 / 500 of the depth: the mean of colours moves by less than T does.
  EXPECT_LE(color.value(), 0.5);
  EXPECT_EQ(spread, 0u);
  EXPECT_EQ(unequal, 0u);
  record("G20",
         "sums of the deterministic tail, up to 500 fragments, T from 0.4 to 1e-6, against long double: |dT| / T",
         "<= 0.3 %", format(transmittance.value()) + " %");
  record("G20", "the same: colour", "<= 0.5 codes", format(color.value()) + " codes");
  record("G20", "the same in 6 other orders: not the same to the bit", "0", std::to_string(spread));
  record("G20", "opacity alone (core_only) from the same sums: not the same to the bit", "0", std::to_string(unequal));
}

TEST(DeterministicTail, Extremes) {
  const float huge = 3e38f;
  const TailList opaque(kFragments, {{0.5f, 0.25f, 1}, 1}), faint(kFragments, {{0.5f, 0.25f, 1}, 0x1p-20f}), none,
      wild = {{{kNan, kInf, -kInf}, 0.5f}, {{huge, -1, kDenormal}, 0.5f}},
      behind = {{{0, 0, 0}, 0.01f}, {{1, 1, 1}, 1}};
  const std::vector<TailAnswer> out = tails({opaque, faint, none, wild, behind}, 1, kMean);
  ASSERT_EQ(out.size(), 5u);
  std::size_t broken = 0;
  for (const TailAnswer& a : out) {
    for (const float c : a.color) broken += !(c >= 0 && double(c) <= 1 + 1e-6);
    broken += !(a.transmittance >= 0 && a.transmittance <= 1);
  }
  EXPECT_EQ(broken, 0u);
  record("G20", "500 opaque fragments, 500 of 1e-6, none, colours NaN and infinite: outside [0, 1] or NaN", "0",
         std::to_string(broken));
  // Opaque is opaque: a sun of 1e4 behind it must not show.
  const double leak = std::max(double(out[0].transmittance), double(out[4].transmittance));
  EXPECT_EQ(leak, 0);
  record("G20", "a fragment of opacity 1 in the tail: transmittance", "0", format(leak));
}

TEST(Modifiers, AgainstTheReferenceAndHostile) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<float> in;
  std::vector<double> expected;
  for (int i = 0; i < 20000; ++i) {
    reference::OpacityModifiers twin;
    const double x = 1920 * uniform(random), y = 1080 * uniform(random),
                 d = double(float(std::exp2(10 * uniform(random) - 6)));
    if (i % 2) {
      const float start = float(2 * uniform(random)), end = start + float(0.01 + uniform(random));
      twin.near_fade = reference::NearFade{double(start), double(end)};
      add(in, {1, double(start), double(1 / (end - start)), 0, 0, 0, x, y, d});
    } else {
      const float radius = float(300 * uniform(random)), feather = float(1 + 100 * uniform(random)),
                  inside = float(uniform(random));
      twin.lens = reference::Lens{double(float(960 + x / 10)), double(float(540 - y / 10)), double(radius),
                                  double(feather), double(inside)};
      add(in, {2, double(radius), double(1 / feather), double(inside), 960 + x / 10, 540 - y / 10, x, y, d});
    }
    expected.push_back(reference::opacityModifier(twin, double(float(x)), double(float(y)), d));
  }
  const std::vector<float> out = runItems(numerics_modifier, in, 9, 1);
  ASSERT_EQ(out.size(), expected.size());
  Worst error;
  for (std::size_t i = 0; i < out.size(); ++i) error.see(std::fabs(double(out[i]) - expected[i]));
  // A depth of 16 m less a start of 2 m, or pixels of 2000, in steps of 2^-14 of a ramp of 0.01 m or 1 pixel.
  EXPECT_LE(error.value(), 1e-3);
  record("G15", "opacity modifiers against the reference: largest error", "<= 1e-3", format(error.value()));

  const double inf = double(kInf), most = double(FLT_MAX);
  in.clear();
  for (const double kind : {0.0, 1.0, 2.0})
    for (const double v : {0.0, 1e-30, 1.0, 1e30, most, inf})
      for (const double start : {0.0, 1.0, 1e30})
        for (const double ramp : {1e-30, 1.0, 1e30})
          for (const double inside : {0.0, 0.3, 1.0}) add(in, {kind, start, ramp, inside, 5, 5, v, 5, v});
  std::size_t broken = 0;
  for (const float v : runItems(numerics_modifier, in, 9, 1)) broken += !(v >= 0 && v <= 1);
  EXPECT_EQ(broken, 0u);
  record("G15", "opacity modifiers, depth and distance 0 to inf, ramps of 1e-30 to 1e30: outside [0, 1] or NaN", "0",
         std::to_string(broken));
}

}  // namespace
}  // namespace forelock::test
