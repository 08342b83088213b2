// What a frame is spared, the host's depth, projections, and strands that try to break the picture.
#include "scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace forelock::test {
namespace {

StrandArrays someStrands() {
  StrandArrays strands;
  for (int i = 0; i < 60; ++i) {
    const float x = -0.3f + 0.01f * float(i);
    strands.add({{x, 0.3f, 0.1f * std::sin(float(i))},
                 {x + 0.02f, 0.1f, 0.05f},
                 {x - 0.02f, -0.1f, 0.0f},
                 {x + 0.05f, -0.3f, 0.1f}},
                0.004f);
  }
  return strands;
}

ViewSpec someView() {
  ViewSpec view;
  view.width = 200, view.height = 120;
  view.eye = {0.2, 0.1, 1.5};
  view.projection.tan_half_y = 0.3;
  return view;
}

double finite(const std::vector<float>& image) {
  double sum = 0;
  for (const float v : image) {
    EXPECT_TRUE(std::isfinite(v));
    sum += double(v);
  }
  return sum;
}

TEST(Plan, NoShadowingLightMeansNoShadowPassAndNoBytes) {
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), someView());
  const auto shadowBytes = [&] {
    FlkPlanInfo info{};
    flkPlanGetInfo(scene.plan, &info);
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < info.resource_count; ++i) {
      FlkResourceInfo resource{};
      flkPlanGetResource(scene.plan, i, &resource);
      if (std::string(resource.name) == "shadow map") bytes += resource.bytes;
    }
    for (uint32_t i = 0; i < info.pass_count; ++i) {
      FlkPassInfo pass{};
      flkPlanGetPass(scene.plan, i, &pass);
      if (pass.stage == FLK_STAGE_SHADOW) bytes += 1;
    }
    return bytes;
  };
  for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_EXACT, FLK_METHOD_FORWARD}) {
    FlkFrame frame{};
    frame.method = method;
    frame.timestamps = 1;
    scene.setLight(samples::kConditionLight, 3, 512);
    const double shadowed = finite(scene.render(frame));
    EXPECT_EQ(shadowBytes(), 512u * 512u * 4u + 1u);
    scene.setLight(samples::kConditionLight, 3, 0);
    const double lit = finite(scene.render(frame));
    EXPECT_EQ(shadowBytes(), 0u);
    EXPECT_LT(scene.statistics.milliseconds[FLK_STAGE_SHADOW], 0);
    EXPECT_GT(lit, shadowed);
    scene.noLight();
    frame.ambient[0] = 1;
    finite(scene.render(frame));
    EXPECT_EQ(shadowBytes(), 0u);
  }
}

TEST(Plan, NoHairInViewMeansNoPassAndNoBytes) {
  ViewSpec away = someView();
  away.target = {0.2, 0.1, 3};  // the hair is behind
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), away);
  scene.setLight(samples::kConditionLight, 3, 512);
  const std::vector<float> image = scene.render();
  EXPECT_EQ(finite(image), 0.0);
  FlkPlanInfo info{};
  flkPlanGetInfo(scene.plan, &info);
  EXPECT_EQ(info.pass_count, 0u);
  EXPECT_EQ(info.resource_count, 0u);
  EXPECT_EQ(info.bytes_transient, 0u);
  EXPECT_EQ(scene.statistics.fragments, 0u);
}

// Split lines that cross, clamped mitres and the factor that keeps the area: tight curls and zig-zags of every width.
TEST(Joints, TightBendsMatchTheReference) {
  constexpr double kPi = 3.14159265358979323846, kPixel = 2 * 0.3 * 1.5 / 120;  // metre, at the target
  for (const double width : {0.1, 1.0, 6.0}) {
    StrandArrays strands;
    int number = 0;
    for (const double length : {0.1, 0.5, 2.0, 6.0})
      for (const double bend : {10.0, 40.0, 90.0, 120.0, 150.0})
        for (const bool to_and_fro : {false, true}) {
          std::vector<std::array<float, 3>> points;
          double x = 0.2 + (number % 10 - 4.5) * 0.12, y = 0.1 + (number / 10 - 1.5) * 0.18, heading = 0.7 * number;
          for (int i = 0; i < 8; ++i) {
            points.push_back({float(x), float(y), 0.0f});
            x += length * kPixel * std::cos(heading), y += length * kPixel * std::sin(heading);
            heading += (to_and_fro && i % 2 ? -bend : bend) * kPi / 180;
          }
          strands.add(points, float(width * kPixel / 2));
          ++number;
        }
    Scene scene(strands, samples::conditionMaterial(samples::HairColor::dark), someView());
    scene.setLight(samples::kConditionLight, 4, 0);
    FlkFrame frame{};
    frame.method = FLK_METHOD_EXACT;
    const reference::Image actual = scene.toImage(scene.render(frame));
    const reference::Image expected = reference::resolve(scene.reference_scene, scene.camera, {}, scene.gather(), {});
    double most = 0, sum[2] = {0, 0};
    for (std::size_t i = 0; i < actual.pixels.size(); ++i) {
      const double a = 1 - actual.pixels[i].transmittance, e = 1 - expected.pixels[i].transmittance;
      most = std::max(most, std::abs(a - e)), sum[0] += a, sum[1] += e;
    }
    std::printf("ROW joints %.1f px: opacity off by %.4f at most, sum %.3f of %.3f\n", width, most, sum[0], sum[1]);
    EXPECT_LE(most, 0.02);
    EXPECT_NEAR(sum[0] / sum[1], 1, 0.01);
  }
}

// Standard and reversed depth, perspective and orthographic: the same picture as the reference, in front of and behind a wall.
TEST(HostDepth, HidesWhatIsBehindInEveryProjection) {
  const StrandArrays strands = someStrands();
  for (const bool orthographic : {false, true})
    for (const bool reversed : {false, true}) {
      ViewSpec view = someView();
      view.projection.orthographic = orthographic;
      view.projection.reversed = reversed;
      view.projection.tan_half_y = orthographic ? 0.4 : 0.3;
      view.projection.offset_x = 0.1;
      Scene scene(strands, samples::conditionMaterial(samples::HairColor::dark), view);
      scene.setLight(samples::kConditionLight, 4, 512);
      // A wall through the middle of the hair, tilted.
      const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
      std::vector<double> linear(pixels);
      std::vector<float> buffer(pixels);
      const double* p = scene.camera.clip_from_view;
      for (std::size_t i = 0; i < pixels; ++i) {
        linear[i] = 1.40 + 0.2 * double(i % std::size_t(view.width)) / view.width;
        const double clip = -p[10] * linear[i] + p[14];
        buffer[i] = float(orthographic ? clip : clip / linear[i]);
      }
      host().resize(uint32_t(view.width), uint32_t(view.height));
      host().setDepth(buffer);
      FlkFrame frame{};
      frame.method = FLK_METHOD_EXACT;
      const reference::Image actual = scene.toImage(scene.render(frame));
      host().setDepth({});
      const std::vector<reference::ShadowMap> fed{scene.readShadowMap()};
      const reference::Image expected =
          reference::resolve(scene.reference_scene, scene.camera, fed, scene.gather(linear), {});
      const reference::Image whole = reference::resolve(scene.reference_scene, scene.camera, fed, scene.gather(), {});
      const double rmse = reference::compare(actual, expected).rmse;
      std::printf("ROW host depth %s %s: rmse %.3f (without the wall %.1f)\n",
                  orthographic ? "orthographic" : "perspective", reversed ? "reversed" : "standard", rmse,
                  reference::compare(actual, whole).rmse);
      EXPECT_LE(rmse, 0.5);
      EXPECT_GT(reference::compare(actual, whole).rmse, 5);
    }
}

TEST(Target, HairIsCompositedOverTheHostsColour) {
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), someView());
  scene.setLight(samples::kConditionLight, 2, 0);
  const std::vector<float> alone = scene.render();
  std::vector<float> background(alone.size());
  for (std::size_t i = 0; i < background.size(); i += 4)
    background[i] = 0.25f, background[i + 1] = 0.5f, background[i + 2] = 1000.0f, background[i + 3] = 1.0f;
  host().setBackground(background);
  const std::vector<float> over = scene.render();
  host().setBackground({});
  for (std::size_t i = 0; i < alone.size(); i += 4) {
    const float t = 1 - alone[i + 3];
    for (std::size_t c = 0; c < 3; ++c) {
      const float expected = alone[i + c] + t * background[i + c];
      // alone is fp16 in colour and alpha, over in colour: 2^-11 each of the terms.
      ASSERT_NEAR(over[i + c], expected, 3e-3f * (background[i + c] + alone[i + c]) + 1e-6f);
    }
    ASSERT_NEAR(over[i + 3], 1.0f, 1e-3f);
  }
}

// Every display draws the strands it should, and layers counts.
TEST(Display, ShowsSomethingFinite) {
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), someView());
  for (uint32_t display = FLK_DISPLAY_STRAND; display <= FLK_DISPLAY_LAYERS; ++display) {
    FlkFrame frame{};
    frame.display = display;
    EXPECT_GT(finite(scene.render(frame)), 10) << display;
  }
}

// Never a NaN in the picture, whatever strands an asset may hold.
TEST(Hostile, DegenerateStrandsNeverMakeNaN) {
  StrandArrays strands = someStrands();
  strands.add({{0, 0, 0}, {0, 0, 0}, {0.1f, 0, 0}}, 0.01f);                // zero-length segment first
  strands.add({{0, 0, 0}, {0.1f, 0, 0}, {0.1f, 0, 0}}, 0.01f);             // and last
  strands.add({{0, 0.1f, 0}, {0.1f, 0.1f, 0}, {0, 0.1f, 0}}, 0.01f);       // straight back
  strands.add({{0.1f, 0, 0}, {0.1f, 1e-7f, 0}, {0.1f, 2e-7f, 0}}, 0.01f);  // far below a pixel
  strands.add({{0.2f, 0.1f, 1.5f}, {0.2f, 0.1f, 0.0f}}, 0.01f);            // along the view axis, through the eye
  strands.add({{0.1f, 0.1f, 5.0f}, {-0.2f, 0.0f, -5.0f}}, 0.01f);          // crosses the near plane
  strands.add({{-1e5f, 3, 0}, {1e5f, -3, 0}}, 0.01f);                      // far out on both sides
  strands.add({{0, 0, 0.5f}, {0.01f, 0, 0.5f}}, 3.0f);                     // wider than the screen
  strands.add({{0, 0.2f, 0}, {0.2f, 0.2f, 0}}, 0.0f);                      // no width
  strands.add({{0, 1e-38f, 0}, {1e-38f, 0, 1e-38f}, {0.1f, 0.1f, 0.1f}}, 1e-38f);  // denormals
  for (const double eye_z : {1.5, 0.05, 1e3}) {
    ViewSpec view = someView();
    view.eye.z = eye_z;
    Scene scene(strands, samples::conditionMaterial(samples::HairColor::light), view);
    scene.setLight(samples::kConditionLight, 3, 256);
    for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_EXACT, FLK_METHOD_FORWARD}) {
      FlkFrame frame{};
      frame.method = method;
      finite(scene.render(frame));
    }
  }
}

TEST(Hostile, ExtremeMaterialsStayFinite) {
  for (int which = 0; which < 6; ++which) {
    FlkMaterial m = samples::conditionMaterial(samples::HairColor::light);
    if (which == 0) m.shadow_opacity = 1;
    if (which == 1) m.shadow_opacity = 0;
    if (which == 2) m.exponent_r = m.exponent_trt = 1e6f;
    if (which == 3) m.exponent_r = m.exponent_trt = 0;
    if (which == 4) m.fibre_spacing = 1e-30f;
    if (which == 5) m.opacity_root = m.opacity_tip = 1, m.diffuse = m.specular_r = m.specular_trt = 1e3f;
    Scene scene(someStrands(), m, someView());
    scene.setLight(samples::kConditionLight, 1e6, 256);
    for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_EXACT, FLK_METHOD_FORWARD}) {
      FlkFrame frame{};
      frame.method = method;
      finite(scene.render(frame));
    }
  }
}

// A pool that is too small loses fragments, counts them, and draws no garbage.
TEST(Pool, TooSmallIsCountedExactly) {
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), someView());
  scene.render();
  const uint64_t need = scene.statistics.fragments;
  FlkViewDesc desc{};
  desc.type = FLK_TYPE_VIEW;
  desc.pool_budget = 12 * (need / 4);
  FlkView small = nullptr;
  ASSERT_EQ(flkViewCreate(host().context(), &desc, &small), FLK_SUCCESS);
  FlkFrame frame{};
  std::copy(scene.camera.view_from_world, scene.camera.view_from_world + 16, frame.view_from_world);
  for (int i = 0; i < 16; ++i) frame.clip_from_view[i] = float(scene.camera.clip_from_view[i]);
  frame.hairs = &scene.hair, frame.hair_count = 1;
  frame.ambient[0] = 1;
  ASSERT_EQ(host().render(small, frame), FLK_SUCCESS);
  FlkStatistics statistics{};
  ASSERT_EQ(host().statistics(small, statistics), FLK_SUCCESS);
  EXPECT_EQ(statistics.fragments, need);
  EXPECT_EQ(statistics.overflow_fragments, need - need / 4);
  finite(host().readColor());
  flkViewDestroy(small);
}

// What the device draws of one strand and of a crossing pair, against supersampled geometry, at the condition's opacity.
// 1/255 and 2/255 are the bounds; the model itself takes up to 0.7 and 1.9 of them (tests/unit/reference).
TEST(Strands, OpacityMatchesSupersampling) {
  for (const double width : {0.02, 0.1, 0.3, 1.0, 5.0, 20.0}) {
    double worst[2] = {0, 0};
    for (int heading = 0; heading < 7; ++heading)
      for (const bool pair : {false, true}) {
        const double angle = 0.05 + heading * 0.43, pixel = 2.0 / 128;  // an orthographic view of 2 m over 128 pixels
        StrandArrays strands;
        for (int i = 0; i <= int(pair); ++i) {
          const double a = angle + i * (0.4 + 0.15 * heading), x = 0.37 * pixel * i, y = 0.21 * pixel;
          const float dx = float(0.7 * std::cos(a)), dy = float(0.7 * std::sin(a));
          strands.add({{float(x) - dx, float(y) - dy, 0}, {float(x), float(y), 0}, {float(x) + dx, float(y) + dy, 0}},
                      float(width / 2 * pixel));
        }
        ViewSpec view;
        view.width = view.height = 128;
        view.eye = {0, 0, 2};
        view.projection.orthographic = true;
        view.projection.tan_half_y = 1;
        Scene scene(strands, samples::conditionMaterial(samples::HairColor::dark), view);
        const std::vector<float> image = scene.render();
        const std::vector<double> truth = reference::renderCover(scene.reference_scene, scene.camera, 64);
        double squares = 0, pixels = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const double alpha = double(image[i * 4 + 3]);
          if (alpha == 0 && truth[i] == 0) continue;
          squares += std::pow(255 * (alpha - truth[i]), 2), pixels += 1;
        }
        worst[pair] = std::max(worst[pair], std::sqrt(squares / pixels));
      }
    std::printf("ROW drawn opacity against R_cover, %.2f px: one strand %.2f / 255, crossing pair %.2f / 255\n", width,
                worst[0], worst[1]);
    EXPECT_LE(worst[0], 1.0) << width;
    EXPECT_LE(worst[1], 2.0) << width;
  }
}

// Frames of one view that overlap on the queue, each asking for something else: synchronization validation sees every hazard
// between one frame's memory and the next's, and the last picture is that of the same frame alone.
TEST(FramesInFlight, ThreeInOneSubmissionEachDifferent) {
  Scene scene(someStrands(), samples::conditionMaterial(samples::HairColor::dark), someView());
  scene.setLight(samples::kConditionLight, 3, 256);
  FlkFrame plain{};
  plain.method = FLK_METHOD_EXACT;
  const std::vector<float> alone = scene.render(plain);  // also fills in camera, light and hair below
  const std::size_t pixels = alone.size() / 4;
  std::vector<float> wall(pixels, 0.999f);
  for (int round = 0; round < 4; ++round) {
    host().setDepth(wall);
    FlkLight small = scene.light(), unshadowed = scene.light();
    small.shadow_size = round % 2 ? 128 : 512;
    unshadowed.casts_shadow = 0;
    FlkFrame frames[3] = {scene.frame(plain), scene.frame(plain), scene.frame(plain)};
    frames[0].lights = &small, frames[0].method = FLK_METHOD_FORWARD;
    frames[1].lights = &unshadowed, frames[1].method = FLK_METHOD_CORE_TAIL, frames[1].view_from_world[14] += 0.4;
    for (int i = 1; i < 3; ++i) frames[i].depth.layout = samples::HeadlessHost::kNoDepth;
    ASSERT_EQ(host().renderTogether(scene.view, frames), FLK_SUCCESS) << host().messages().back();
    EXPECT_EQ(host().readColor(), alone);
  }
  host().setDepth({});
}

}  // namespace
}  // namespace forelock::test
