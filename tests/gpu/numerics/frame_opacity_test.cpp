// Rows G14 to G17, G21 and G22: what many layers, extreme opacities, full lists and bright backgrounds do to a picture.
#include "frame_kit.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace forelock::test {
namespace {

// One row of the picture has every opacity between root and tip.
double opacityAt(const ViewSpec& view, int x, double root, double tip) {
  return root + (tip - root) * (x + 2.5) / (view.width + 4);
}

TEST(AlphaCull, OpacityLost) {
  const ViewSpec view = flatView(128, 8);
  for (const bool paper : {false, true})
    for (const uint32_t count : {8u, 50u, 100u, 500u}) {
      double lost = 0, mean = 0, pixels = 0;
      for (const float tip : {2e-5f, 1e-3f, 1.0f / 255, 0.03f}) {
        Scene scene(layers(view, count, true), plainMaterial(0, tip), view);
        FlkFrame frame{};
        frame.payload = paper ? FLK_PAYLOAD_PAPER : FLK_PAYLOAD_DEFAULT;
        const std::vector<float> image = scene.render(frame);
        for (int x = 0; x < view.width; ++x) {
          const double truth = 1 - std::pow(1 - opacityAt(view, x, 0, double(tip)), count);
          const double here = truth - double(image[std::size_t(3 * view.width + x) * 4 + 3]);
          lost = std::max(lost, here), mean += here, pixels += 1;
        }
      }
      const bool held = !paper && count <= 100;
      EXPECT_TRUE(!held || lost < 0.01) << lost;
      record("G14",
             std::string(paper ? "paper" : "default") + " coding, " + std::to_string(count) +
                 " layers of opacity 0 to 0.03: most opacity lost, mean",
             held ? "< 1 %" : "reported", format(100 * lost) + " %, " + format(100 * mean / pixels) + " %");
    }
}

TEST(OpacityRange, TheApiRefusesAndModifiersClamp) {
  const ViewSpec view = flatView(64, 64);
  StrandArrays strands = layers(view, 12, false);
  Scene scene(strands, plainMaterial(0.63f, 0.4f), view);
  scene.setLight(samples::kConditionLight, 1, 0);
  const std::vector<float> before = scene.render();
  std::size_t accepted = 0, changed = 0;
  for (const float v :
       {1.5f, -0.1f, kNan, kInf, -kInf, std::nextafter(1.0f, 2.0f), -std::numeric_limits<float>::denorm_min()})
    for (const bool root : {false, true}) {
      FlkMaterial m = scene.material;
      (root ? m.opacity_root : m.opacity_tip) = v;
      accepted += flkHairSetMaterial(scene.hair, &m) != FLK_ERROR_INVALID_ARGUMENT;
      changed += scene.render() != before;
    }
  EXPECT_EQ(accepted, 0u);
  EXPECT_EQ(changed, 0u);
  record("G15", "material opacity > 1, < 0, NaN, infinite: accepted by the API", "0", std::to_string(accepted));
  record("G15", "the same: pictures that a refused call changes by a bit", "0", std::to_string(changed));

  const auto with = [&](FlkOpacityModifier modifier) {
    FlkFrame frame{};
    frame.opacity_modifier_count = 1, frame.opacity_modifiers = &modifier;
    return scene.render(frame);
  };
  FlkOpacityModifier fade{}, lens{};
  fade.kind = FLK_OPACITY_NEAR_FADE, lens.kind = FLK_OPACITY_LENS;
  lens.center[0] = lens.center[1] = 32, lens.radius = 100, lens.feather = 10, lens.inside = 1;
  fade.start = 0, fade.end = 1e-3f;  // all hair is beyond: a factor of thousands, clamped
  std::size_t off = with(fade) != before;
  off += with(lens) != before;
  lens.radius = 0, lens.feather = 1e-3f, lens.inside = 0.0f, lens.center[0] = 1e6f;  // a lens far off
  off += with(lens) != before;
  fade.start = 1e3f, fade.end = 1e4f;  // all hair is before: a negative factor, clamped to none
  const std::vector<float> none = with(fade);
  off += std::any_of(none.begin(), none.end(), [](float v) { return v != 0; });
  EXPECT_EQ(off, 0u);
  record("G15", "modifiers that would be thousands, 1, negative: pictures not bit-equal to those of 1, 1, 0", "0",
         std::to_string(off));
  std::size_t taken = 0;
  for (const float v : {-0.1f, 1.1f, kNan, kInf}) {
    FlkOpacityModifier m = lens;
    m.inside = v;
    FlkFrame frame = scene.frame({});
    frame.opacity_modifier_count = 1, frame.opacity_modifiers = &m;
    taken += host().render(scene.view, frame) != FLK_ERROR_INVALID_ARGUMENT;
    m = fade;
    m.start = std::isnan(v) ? v : -1, m.end = 2;
    taken += host().render(scene.view, frame) != FLK_ERROR_INVALID_ARGUMENT;
  }
  host().messages().clear();
  EXPECT_EQ(taken, 0u);
  record("G15", "modifiers with inside or start out of range, NaN: accepted by the API", "0", std::to_string(taken));
}

TEST(OpacityRange, OneAndNone) {
  const ViewSpec view = flatView(32, 32);
  const std::size_t values = 32 * 32 * 4;
  std::vector<float> sun(values, 1e4f);
  for (std::size_t i = 3; i < values; i += 4) sun[i] = 1;
  std::size_t open = 0, drawn = 0;
  Worst through;
  for (const MethodWay& way : kMethodWays)
    for (const CaptureWay& capture : kCaptures) {
      FlkFrame frame = frameOf(way, capture.capture);
      {
        Scene opaque(layers(view, 20, false), plainMaterial(1, 1), view);
        host().setOutputs(1u << FLK_OUTPUT_TRANSMITTANCE);
        const std::vector<float> image = opaque.render(frame);
        for (const float t : host().readOutput(FLK_OUTPUT_TRANSMITTANCE)) open += t != 0.0f;
        host().setOutputs(0);
        for (std::size_t i = 3; i < values; i += 4) open += image[i] != 1.0f;
      }
      {
        Scene none(layers(view, 20, false), plainMaterial(0, 0), view);
        const std::vector<float> image = none.render(frame);
        drawn += std::any_of(image.begin(), image.end(), [](float v) { return v != 0; });
      }
      // Forty faint layers before an opaque one, which is in the tail of all that have one; unlit, before a sun.
      StrandArrays strands = layers(view, 40, true);
      strands.add({flatPoint(view, -2, 16, -0.9), flatPoint(view, 1e4, 16, -0.9)},
                  2);  // of which the picture sees the root
      FlkMaterial m = plainMaterial(1, 0);
      for (std::size_t s = 0; s < 40; ++s)
        strands.positions[s * 6] = flatPoint(view, -1e5, 0, 0)[0];  // and of these nearly the tip
      Scene scene(strands, m, view);
      host().resize(32, 32);
      host().setBackground(sun);
      const std::vector<float> image = scene.render(frame);
      host().setBackground({});
      // 1 at the left border, where the opaque strand's first pixel is its root.
      for (int y = 0; y < 32; ++y) through.see(255 * std::min(1.0, double(image[std::size_t(y * 32) * 4])));
    }
  EXPECT_EQ(open, 0u);
  EXPECT_EQ(drawn, 0u);
  EXPECT_LE(through.value(), 1);
  record("G15", "opacity 1, every method: pixels not opaque, or with a transmittance output other than 0", "0",
         std::to_string(open));
  record("G15", "opacity 0, every method: pictures with anything in them", "0", std::to_string(drawn));
  record("G15", "opacity 1 behind 40 faint layers, every method: what a background of 1e4 adds", "<= 1 code",
         format(through.value()) + " codes");
}

// As many layers as leave a quarter of the light, all of one opacity.
float evenAlpha(uint32_t count) { return float(-std::expm1(std::log(0.25) / count)); }

TEST(Layers, NoneIgnored) {
  const ViewSpec view = flatView(16, 16);
  const uint32_t counts[] = {1, 8, 9, 100, 500, 513, 1200, 5000};
  for (const MethodWay& way : kMethodWays) {
    Worst few, many;
    std::string each, rmse;
    std::size_t lost = 0;
    for (const uint32_t count : counts) {
      const float alpha = evenAlpha(count);
      Scene scene(layers(view, count, false), plainMaterial(alpha, alpha), view);
      scene.setLight(samples::kConditionLight, 1, 0);
      const std::vector<float> image = scene.render(frameOf(way));
      lost += scene.statistics.fragments != uint64_t(count) * 256;
      const double truth = std::pow(1 - rootCoded(double(alpha), way.method == FLK_METHOD_FORWARD ? 511 : 1023), count);
      Worst codes;
      for (std::size_t i = 3; i < image.size(); i += 4) codes.see(255 * std::fabs(1 - double(image[i]) - truth));
      (count <= 1200 ? few : many).see(codes.value());
      enlist(each, format(codes.value()));
      reference::GatherOptions coded;
      coded.payload = reference::Payload::standard;
      const reference::FragmentLists lists = reference::gatherFragments(scene.reference_scene, scene.camera, coded);
      const reference::Image exact = reference::resolve(scene.reference_scene, scene.camera, {}, lists, {});
      enlist(rmse, format(reference::compare(scene.toImage(image), exact).rmse));
    }
    EXPECT_EQ(lost, 0u) << way.name;
    EXPECT_LE(few.value(), 1) << way.name;
    const bool limited = way.method == FLK_METHOD_EXACT && loopsAreLimited();
    EXPECT_TRUE(limited || many.value() <= 1) << way.name << " " << many.value();
    record("G16", std::string(way.name) + ", 1, 8, 9, 100, 500, 513, 1200 layers: opacity against float64, most",
           "<= 1 code", format(few.value()) + " codes");
    record("G16", std::string(way.name) + ", 5000 layers: the same",
           limited ? "<= 1 code: **not held**, this driver ends loops after 65,535 rounds" : "<= 1 code",
           format(many.value()) + " codes");
    record("G16", std::string(way.name) + ", all of these: codes of opacity; rmse of colour against exact in float64",
           "reported", each + "; " + rmse);
  }
}

TEST(Layers, TimeOfCoreTail) {
  const ViewSpec view = flatView(32, 32);
  double least[3] = {};
  const uint32_t counts[] = {500, 1000, 5000};
  for (std::size_t c = 0; c < 3; ++c) {
    const float alpha = evenAlpha(counts[c]);
    Scene scene(layers(view, counts[c], false), plainMaterial(alpha, alpha), view);
    scene.setLight(samples::kConditionLight, 1, 0);
    FlkFrame frame{};
    frame.timestamps = 1;
    for (int run = 0; run < 4; ++run) {  // the first sizes the lists
      scene.render(frame);
      const double ms = scene.statistics.milliseconds[FLK_STAGE_RESOLVE];
      if (run == 1 || ms < least[c]) least[c] = ms;
    }
    EXPECT_GT(least[c], 0);
  }
  record("G16", "core_tail, resolve of 1000 and of 5000 layers over that of 500 (2 and 10 were linear)", "reported",
         format(least[1] / least[0]) + ", " + format(least[2] / least[0]));
}

struct SmallView {
  FlkView view = nullptr;
  explicit SmallView(uint64_t nodes) {
    FlkViewDesc desc{};
    desc.type = FLK_TYPE_VIEW;
    desc.pool_budget = 12 * nodes;
    EXPECT_EQ(flkViewCreate(host().context(), &desc, &view), FLK_SUCCESS);
  }
  ~SmallView() { flkViewDestroy(view); }
};

TEST(Overflow, SilhouetteAndStoredNodes) {
  const ViewSpec view = flatView(64, 64);
  // Nine layers of one opacity over the whole, so that a pixel's transmittance says how many it holds; a fringe of thin ones.
  Scene uniform(layers(view, 9, false), plainMaterial(0.1f, 0.1f), view);
  uniform.render();
  const uint64_t all = uniform.statistics.fragments;
  EXPECT_EQ(all, 9u * 64 * 64);
  std::size_t stored_wrong = 0, flag_wrong = 0;
  for (const CaptureWay& capture : kCaptures)
    for (const uint64_t nodes : {uint64_t(1), all / 10, all * 99 / 100}) {
      SmallView small(nodes);
      FlkFrame frame = uniform.frame({});
      frame.capture = capture.capture;
      frame.overflow = FLK_OVERFLOW_DROP;
      EXPECT_EQ(host().render(small.view, frame), FLK_SUCCESS);
      FlkStatistics statistics{};
      EXPECT_EQ(host().statistics(small.view, statistics), FLK_SUCCESS);
      flag_wrong += statistics.fragments != all || statistics.overflow_fragments != all - nodes;
      const std::vector<float> image = host().readColor();
      uint64_t stored = 0;
      const double through = std::log(1 - rootCoded(double(0.1f), 1023));
      for (std::size_t i = 3; i < image.size(); i += 4)
        stored += uint64_t(std::lround(std::log(1 - double(image[i])) / through));
      stored_wrong += stored != nodes;
    }
  EXPECT_EQ(stored_wrong, 0u);
  EXPECT_EQ(flag_wrong, 0u);
  record("G17", "lists of 1 fragment, 10 %, 99 %, the rest dropped: pictures that do not hold just as many fragments",
         "0", std::to_string(stored_wrong));
  record("G17", "the same: overflow_fragments not exact", "0", std::to_string(flag_wrong));

  StrandArrays strands;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(8, 56);
  for (int i = 0; i < 150; ++i)
    strands.add({flatPoint(view, place(random), place(random), place(random) / 200),
                 flatPoint(view, place(random), place(random), place(random) / 200)},
                i % 2 ? 0.02f : 0.003f);
  Scene scene(strands, plainMaterial(0.6f, 0.1f), view);
  scene.setLight(samples::kConditionLight, 1, 0);
  for (const MethodWay& way : kMethodWays) {
    std::size_t outline = 0, broken = 0;
    Worst opacity;
    for (const CaptureWay& capture : kCaptures) {
      const std::vector<float> whole = scene.render(frameOf(way, capture.capture));
      const uint64_t need = scene.statistics.fragments;
      for (const uint64_t nodes : {uint64_t(1), need / 10, need * 99 / 100}) {
        SmallView small(nodes);
        FlkFrame frame = scene.frame(frameOf(way, capture.capture));
        EXPECT_EQ(host().render(small.view, frame), FLK_SUCCESS);
        FlkStatistics statistics{};
        EXPECT_EQ(host().statistics(small.view, statistics), FLK_SUCCESS);
        EXPECT_EQ(statistics.overflow_fragments, need - nodes);
        const std::vector<float> image = host().readColor();
        broken += notFinite(image);
        for (std::size_t i = 3; i < image.size(); i += 4) {
          outline += (image[i] > 0) != (whole[i] > 0);
          opacity.see(255 * std::fabs(double(image[i]) - double(whole[i])));
        }
      }
    }
    EXPECT_EQ(outline + broken, 0u) << way.name;
    // An aggregate keeps the opacity before it is coded, of 10 or 9 bits a fragment, and about 20 a pixel.
    record("G17",
           std::string(way.name) +
               ", lists of 1 fragment, 10 %, 99 %, the rest summed up: pixels of the silhouette lost or gained, NaN",
           "0, 0", std::to_string(outline) + ", " + std::to_string(broken));
    record("G17", std::string(way.name) + ", the same: opacity against that of lists that suffice", "reported",
           format(opacity.value()) + " codes");
  }
}

TEST(Blend, RoundOff) {
  const ViewSpec view = flatView(32, 32);
  for (const auto& [low, high] : {std::pair{0.004f, 0.02f}, std::pair{0.02f, 0.6f}}) {
    Scene scene(layers(view, 500, false), plainMaterial(low, high), view);
    scene.setLight(samples::kConditionLight, 1, 0);
    reference::GatherOptions coded;
    coded.payload = reference::Payload::standard;
    const reference::FragmentLists lists = reference::gatherFragments(scene.reference_scene, scene.camera, coded);
    for (const MethodWay& way : kMethodWays) {
      if (way.method == FLK_METHOD_FORWARD) continue;  // its colours have 8 bits: methods_test
      const reference::Image actual = scene.toImage(scene.render(frameOf(way, FLK_CAPTURE_RASTER)));
      reference::ResolveOptions options;
      options.method = way.twin, options.tail = way.order;
      const reference::Image expected = reference::resolve(scene.reference_scene, scene.camera, {}, lists, options);
      Worst worst;
      double squares = 0;
      for (std::size_t i = 0; i < actual.pixels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c) {
          const double codes = 255 * std::fabs(actual.pixels[i].rgb[c] - expected.pixels[i].rgb[c]);
          worst.see(codes), squares += codes * codes;
        }
      EXPECT_LE(worst.value(), 0.5) << way.name;
      record("G21",
             std::string(way.name) + ", 500 layers of opacity " + format(double(low)) + " to " + format(double(high)) +
                 ", RGBA16F: most, rms",
             "<= 0.5 codes",
             format(worst.value()) + ", " + format(std::sqrt(squares / double(actual.pixels.size() * 3))) + " codes");
    }
  }
}

// What shows of a sun behind hair: from all of it to none, in one picture; on a display, which stops at 1.
TEST(Background, NoFringe) {
  const ViewSpec view = flatView(256, 4);
  const double sun = 1e4;
  for (const uint32_t count : {4u, 64u, 500u}) {
    // T from 1 to 1e-7 across the picture.
    const double most = -std::expm1(std::log(1e-7) / count);
    for (const float below : {1.0f, 0.25f}) {  // the background's own alpha
      Scene scene(layers(view, count, true), plainMaterial(0, float(most)), view);
      scene.setLight(samples::kConditionLight, 1, 0);
      std::vector<float> background(std::size_t(256 * 4 * 4), float(sun));
      for (std::size_t i = 3; i < background.size(); i += 4) background[i] = below;
      reference::GatherOptions coded;
      coded.payload = reference::Payload::standard;
      const reference::FragmentLists lists = reference::gatherFragments(scene.reference_scene, scene.camera, coded);
      for (const MethodWay& way : kMethodWays) {
        if (way.method == FLK_METHOD_FORWARD) continue;
        host().resize(256, 4);
        host().setBackground(background);
        const std::vector<float> image = scene.render(frameOf(way, FLK_CAPTURE_RASTER));
        host().setBackground({});
        reference::ResolveOptions options;
        options.method = way.twin, options.tail = way.order;
        const reference::Image expected = reference::resolve(scene.reference_scene, scene.camera, {}, lists, options);
        Worst worst;
        int compared = 0;
        for (int x = 0; x < 256; ++x) {
          // Where the device may choose the code beside, all layers would.
          if (nearTie(opacityAt(view, x, 0, double(float(most))), 1023)) continue;
          ++compared;
          const std::size_t i = std::size_t(2 * 256 + x);
          const reference::Pixel& e = expected.pixels[i];
          for (std::size_t c = 0; c < 3; ++c)
            worst.see(255 * std::fabs(std::min(double(image[i * 4 + c]), 1.0) -
                                      std::min(e.rgb[c] + e.transmittance * sun, 1.0)));
          worst.see(255 *
                    std::fabs(double(image[i * 4 + 3]) - (1 - e.transmittance + e.transmittance * double(below))));
        }
        EXPECT_GT(compared, 240);
        EXPECT_LE(worst.value(), 1) << way.name << " " << count;
        if (below == 1)
          record("G22",
                 std::string(way.name) + ", " + std::to_string(count) + " layers, T from 1 to 1e-7 before 1e4: most",
                 "<= 1 code", format(worst.value()) + " codes");
      }
    }
  }
}

}  // namespace
}  // namespace forelock::test
