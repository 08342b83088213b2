// What a frame visits and pays for, scenes of any size and place, and hosts that keep changing their mind.
#include "world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace forelock::test {
namespace {

const StrandArrays& tuft() {
  static const StrandArrays strands = loadStrands("groom:paper-load", 5);
  return strands;
}

FlkLight sunFrom(double x, double y, double z, float radiance, uint32_t shadow_size) {
  FlkLight light{};
  light.direction[0] = float(x), light.direction[1] = float(y), light.direction[2] = float(z);
  for (float& r : light.radiance) r = radiance;
  light.casts_shadow = shadow_size != 0, light.shadow_size = shadow_size;
  return light;
}

HairSpec specOf(const StrandArrays& strands, const ViewSpec& view, double width_px) {
  HairSpec spec;
  spec.strands = strands;
  spec.material.width_scale = widthScale(strands, view, width_px);
  return spec;
}

// The resolve touches pixels with hair and no other, and shades a lone fragment once.
TEST(Visits, PixelsWithHairOnlyAndALoneFragmentOnce) {
  StrandArrays strands;
  for (int i = 0; i < 5; ++i)  // axis-aligned, a pixel wide, far apart: no pixel has two
    strands.add({{-0.5f, -0.4f + 0.2f * float(i), 0}, {0.5f, -0.4f + 0.2f * float(i), 0}}, 0.5f / 64);
  ViewSpec view;
  view.width = view.height = 128;
  view.eye = {0, 0, 2};
  view.projection.orthographic = true;
  view.projection.tan_half_y = 1;
  World world(view);
  HairSpec spec;
  spec.strands = strands;
  world.add(spec);
  world.addLight(sunFrom(0, 1, 1, 2, 256));
  std::vector<float> background(128 * 128 * 4, 0.375f);
  for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE})
    for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_CORE_ONLY, FLK_METHOD_ALL_LOW, FLK_METHOD_EXACT, FLK_METHOD_HARD}) {
      host().resize(128, 128);
      host().setBackground(background);
      FlkFrame frame = world.frame();
      frame.method = method, frame.capture = capture, frame.count_work = 1;
      const std::vector<float> image = world.render(frame);
      const reference::FragmentLists lists =
          method == FLK_METHOD_HARD ? reference::gatherHard(world.twin, world.camera) : world.gather();
      uint64_t pixels = 0, most = 0;
      for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 128; ++x) {
          const std::size_t n = lists.at(x, y).size();
          pixels += n > 0, most = std::max<uint64_t>(most, n);
          for (std::size_t c = 0; c < 4 && n == 0; ++c) ASSERT_EQ(image[std::size_t(y * 128 + x) * 4 + c], 0.375f) << "touched";
        }
      EXPECT_EQ(most, 1u);
      EXPECT_EQ(world.statistics.pixels, pixels) << method;
      const uint64_t full = method == FLK_METHOD_ALL_LOW ? 0 : pixels;
      EXPECT_EQ(world.statistics.full_shades, full) << method;
      EXPECT_EQ(world.statistics.low_shades, pixels - full) << method;
      EXPECT_EQ(world.statistics.shadow_taps, full * 25 + (pixels - full)) << method;
    }
  host().setBackground({});
  std::printf("ROW visits: pixels without hair untouched, one shade for a lone fragment, by five methods and two captures\n");
}

// Sixteen lights of which each tile sees one cost at most half more than one light. Times in pairs.
TEST(LightTiles, SixteenLightsOfWhichATileSeesOne) {
  for (const bool lamps : {false, true}) {
    const ViewSpec view = storedView("35k");
    const StrandArrays& strands = caseStrands(kAssetCases[0], false);
    const auto lightAt = [&](int i) {
      FlkLight light = sunFrom(std::cos(i * 0.4), 1.2, std::sin(i * 0.4), 2, 512);
      if (!lamps) return light;
      light.kind = FLK_LIGHT_POINT;
      for (int axis = 0; axis < 3; ++axis) {
        const double at[3] = {view.target.x, view.target.y, view.target.z};
        light.position[axis] = at[axis] + double(light.direction[axis]);
      }
      return light;
    };
    std::vector<double> ratios;
    double ms[2] = {};
    World one(view), many(view);
    HairSpec spec;
    spec.strands = strands;
    one.add(spec), many.add(spec);
    one.addLight(lightAt(0));
    for (int i = 0; i < 16; ++i) many.addLight(lightAt(i));
    const uint32_t tiles_x = (uint32_t(view.width) + 31) / 32, tiles_y = (uint32_t(view.height) + 31) / 32;
    std::vector<uint32_t> words(std::size_t(tiles_x) * tiles_y);
    for (std::size_t t = 0; t < words.size(); ++t) words[t] = 1u << t % 16;
    many.light_tiles = {host().uploadBuffer(std::as_bytes(std::span(words))), 32, tiles_x, tiles_y, VK_PIPELINE_STAGE_2_HOST_BIT,
                        VK_ACCESS_2_HOST_WRITE_BIT};
    for (int pair = 0; pair < 4; ++pair) {
      for (int which = 0; which < 2; ++which) {
        World& world = which ? many : one;
        FlkFrame frame = world.frame();
        frame.timestamps = 1;
        world.render(frame);
        ms[which] = world.statistics.milliseconds[FLK_STAGE_RESOLVE];
      }
      if (pair > 0) ratios.push_back(ms[1] / ms[0]);
    }
    std::sort(ratios.begin(), ratios.end());
    std::printf("ROW light tiles, %s: resolve with 16 lights over that with 1: %.2f, median of 3 pairs from %.2f to %.2f\n",
                lamps ? "point lights" : "directional", ratios[1], ratios[0], ratios[2]);
    // A lone sun is read once a pixel, which sixteen are not: masks are for lights that reach few tiles. That ratio is reported.
    if (lamps) {
      EXPECT_LE(ratios[1], 1.5);
    }
  }
}

// The same hair a thousandth and a thousand times as large, and 1,000 km from the origin.
TEST(Place, ScaleAndDistanceFromTheOriginDoNotShow) {
  const ViewSpec view = frameStrands(tuft(), 256, 256);
  const auto pictureAt = [&](double scale, double away, uint32_t capture, uint32_t kind) {
    ViewSpec seen = view;
    for (reference::Vec3* p : {&seen.eye, &seen.target}) {
      p->x = p->x * scale + away, p->y = p->y * scale - away, p->z = p->z * scale + away;
    }
    seen.projection.near_plane *= scale, seen.projection.far_plane *= scale;
    World world(seen);
    HairSpec spec = specOf(tuft(), view, 1.0);
    spec.scale = scale, spec.offset = {away, -away, away};
    spec.material.fibre_spacing = float(double(spec.material.fibre_spacing) * scale);
    world.add(spec);
    FlkLight light = sunFrom(-0.1, 0.7, 0.7, 30, 512);
    light.kind = kind;
    if (kind == FLK_LIGHT_POINT) {
      const double at[3] = {seen.target.x - 0.3 * scale, seen.target.y + 0.4 * scale, seen.target.z + 0.5 * scale};
      for (int i = 0; i < 3; ++i) light.position[i] = at[i], light.radiance[i] = float(3 * scale * scale);
      light.source_radius = float(0.01 * scale);
    }
    world.addLight(light);
    FlkFrame frame = world.frame();
    frame.capture = capture;
    return world.image(world.render(frame));
  };
  for (const uint32_t kind : {FLK_LIGHT_DIRECTIONAL, FLK_LIGHT_POINT})
    for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE}) {
      const reference::Image plain = pictureAt(1, 0, capture, kind);
      for (const auto& [scale, away] : {std::pair{1e-3, 0.0}, {1e3, 0.0}, {1.0, 1e6}, {1.0, -1e5}}) {
        const reference::Difference d = reference::compare(pictureAt(scale, away, capture, kind), plain);
        std::printf("ROW place, %s, %s: scale %g, %g m away: rmse %.3f p99.9 %.2f\n", kind ? "point light" : "directional",
                    capture == FLK_CAPTURE_COMPUTE ? "compute" : "raster", scale, away, d.rmse, d.p999);
        EXPECT_LE(d.rmse, 0.5);
        EXPECT_GT(d.mean_b, 10);
      }
    }
}

// Velocity and the other pictures, against the reference.
TEST(Outputs, MatchTheReference) {
  const ViewSpec view = frameStrands(tuft(), 256, 256);
  for (const uint32_t method : {FLK_METHOD_CORE_TAIL, FLK_METHOD_FORWARD, FLK_METHOD_HARD}) {
    World world(view);
    world.add(specOf(tuft(), view, 1.0));
    world.addLight(sunFrom(-0.1, 0.7, 0.7, 3, 256));
    // The hair came from a turn about y and a step, the camera from beside.
    const double c = std::cos(0.05), s = std::sin(0.05);
    const double before[16] = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 0.01, -0.02, 0.005, 1};
    ASSERT_EQ(flkHairSetPreviousTransform(world.hairs[0], before), FLK_SUCCESS);
    ViewSpec earlier = view;
    earlier.eye.x += 0.01, earlier.target.y += 0.004;
    reference::Motion motion;
    motion.camera_before = reference::makeCamera(earlier.eye, earlier.target, earlier.up, earlier.projection, 256, 256);
    motion.world_from_hair = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    motion.world_from_hair_before.resize(1);
    std::copy(before, before + 16, motion.world_from_hair_before[0].begin());
    float clip_before[16];
    for (int i = 0; i < 16; ++i) clip_before[i] = float(motion.camera_before.clip_from_view[i]);

    FlkFrame frame = world.frame();
    frame.method = method;
    frame.previous_view_from_world = motion.camera_before.view_from_world;
    frame.previous_clip_from_view = clip_before;
    host().setOutputs(15);
    world.render(frame);
    std::vector<float> pictures[FLK_OUTPUT_COUNT];
    for (uint32_t o = 0; o < FLK_OUTPUT_COUNT; ++o) pictures[o] = host().readOutput(o);
    host().setOutputs(0);
    const reference::FragmentLists lists = method == FLK_METHOD_HARD ? reference::gatherHard(world.twin, world.camera) : world.gather();
    const std::vector<reference::OutputPixel> expected = reference::outputsOf(world.twin, world.camera, lists, motion);
    double depth = 0, transmittance = 0, velocity = 0, longest = 0;
    std::size_t pixels = 0, different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const bool written = pictures[FLK_OUTPUT_FRONT_DEPTH][i] >= 0;
      const reference::OutputPixel& e = expected[i];
      if (!written && !e.written) continue;
      ++pixels;
      // A fragment at the rim that one of the two keeps shows as another depth: counted.
      if (written != e.written || std::abs(double(pictures[FLK_OUTPUT_FRONT_DEPTH][i]) - e.front_depth) > 1e-4 ||
          std::abs(double(pictures[FLK_OUTPUT_DEPTH_RANGE][i * 2 + 1]) - e.depth_max) > 1e-4) {
        ++different;
        continue;
      }
      depth = std::max({depth, std::abs(double(pictures[FLK_OUTPUT_FRONT_DEPTH][i]) - e.front_depth),
                        std::abs(double(pictures[FLK_OUTPUT_DEPTH_RANGE][i * 2]) - e.depth_min)});
      transmittance = std::max(transmittance, std::abs(double(pictures[FLK_OUTPUT_TRANSMITTANCE][i]) - e.transmittance));
      for (std::size_t axis = 0; axis < 2; ++axis)
        velocity = std::max(velocity, std::abs(double(pictures[FLK_OUTPUT_VELOCITY][i * 2 + axis]) - e.velocity[axis]));
      longest = std::max(longest, std::hypot(e.velocity[0], e.velocity[1]));
    }
    std::printf("ROW outputs, method %u: depth off by %.2g m, T by %.4f, velocity by %.4f of %.1f px; %zu of %zu pixels have another "
                "nearest or farthest fragment\n", method, depth, transmittance, velocity, longest, different, pixels);
    EXPECT_LE(depth, 2e-6);              // fp32 at 0.8 m, and its reciprocal
    EXPECT_LE(transmittance, 2.0 / 255); // the coding of alpha: 9 bits of `forward`
    EXPECT_LE(velocity, longest / 1024); // fp16
    EXPECT_LE(different, pixels / 200);
    EXPECT_GT(longest, 3);
  }
}

// A host that shades its head with hair's shadow through flkViewGetShadowMap, as render.h describes it, against the reference's
// attenuation by the same maps at the same points, and the maps against the reference's. (The head's shadow on hair: features_test.cpp, "host shadow".)
TEST(Shadow, OfHairOnTheHead) {
  const ViewSpec view = frameStrands(tuft(), 256, 256);
  FlkLight lamp = sunFrom(0.3, 0.9, 0.3, 3, 512), amid = lamp;
  lamp.kind = amid.kind = FLK_LIGHT_POINT;
  const double middle[3] = {view.target.x, view.target.y, view.target.z};
  for (int i = 0; i < 3; ++i)
    lamp.position[i] = middle[i] + 0.6 * double(lamp.direction[i]), amid.position[i] = middle[i] + 0.02 * i;
  for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE}) {
    World world(view);
    world.add(specOf(tuft(), view, 1.0));
    world.addLight(sunFrom(-0.1, 0.7, 0.7, 3, 512));
    world.addLight(lamp);
    world.addLight(amid);
    FlkFrame frame = world.frame();
    frame.capture = capture;
    world.render(frame);
    const auto fed = world.readMaps(), own = world.ownMaps();
    const reference::Material& material = world.twin.hairs[0].material;
    for (uint32_t light = 0; light < 3; ++light) {
      std::vector<FlkShadowMap> maps;
      std::vector<std::vector<float>> values;
      for (uint32_t face = 0; maps.empty() || face < maps[0].face_count; ++face) {
        maps.emplace_back();
        ASSERT_EQ(flkViewGetShadowMap(world.view, light, face, &maps.back()), FLK_SUCCESS);
        values.push_back(host().readShadowMap(maps.back()));
      }
      double square = 0, darkest = 1, points = 0;
      for (int j = 1; j < 60; ++j)
        for (int i = 0; i < 120; ++i) {  // a sphere for a head
          const double a = i * 0.05236, b = j * 0.05236, r = 0.095;
          const double p[3] = {middle[0] + r * std::sin(b) * std::cos(a), middle[1] + r * std::cos(b), middle[2] + r * std::sin(b) * std::sin(a)};
          // The face with the largest distance along its axis; then one tap.
          double best = -1e30, at[4] = {};
          std::size_t face = 0;
          for (std::size_t f = 0; f < maps.size(); ++f) {
            double t[4];
            for (int row = 0; row < 4; ++row)
              t[row] = maps[f].texels_from_world[row] * p[0] + maps[f].texels_from_world[4 + row] * p[1] +
                       maps[f].texels_from_world[8 + row] * p[2] + maps[f].texels_from_world[12 + row];
            if (t[2] > best) best = t[2], face = f, std::copy(t, t + 4, at);
          }
          const FlkShadowMap& map = maps[face];
          double distance = at[2];
          if (map.perspective) {
            at[0] /= at[3], at[1] /= at[3];
            const double* q = world.lights[light].position;
            distance = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
          }
          double lit = 1;
          const double x = std::floor(at[0]), y = std::floor(at[1]);
          if (x >= 0 && y >= 0 && x < map.size && y < map.size) {
            const float value = values[face][std::size_t(y) * map.size + std::size_t(x)];
            if (value < 1) lit = reference::shadowTap(distance, double(value) * double(map.depth_range), 0, material.shadow_opacity, material.fibre_spacing);
          }
          const double expected = reference::shadowLight(fed[light].faces, material, {p[0], p[1], p[2]}, {}, false);
          square += (lit - expected) * (lit - expected), points += 1;
          darkest = std::min(darkest, expected);
        }
      const double rmse = 255 * std::sqrt(square / points);
      std::printf("ROW hair's shadow on the head, light %u, %s: rmse %.3f codes over %.0f points, darkest %.4f\n", light,
                  capture == FLK_CAPTURE_COMPUTE ? "compute" : "raster", rmse, points, darkest);
      EXPECT_LE(rmse, 1.5);
      EXPECT_LT(darkest, 0.5);
      for (std::size_t face = 0; face < own[light].faces.size(); ++face) {
        EXPECT_LE(mapDifference(own[light].faces[face], fed[light].faces[face], 0.1 * material.fibre_spacing), 0.5);
      }
    }
  }
}

// 63 hairs of one view, each with its own material and place.
TEST(Hairs, SixtyThreeInOneView) {
  ViewSpec view = frameStrands(tuft(), 256, 256);
  StrandArrays few = loadStrands("groom:paper-load", 150);
  World world(view);
  for (int i = 0; i < 63; ++i) {
    HairSpec spec = specOf(few, view, 2.0);
    for (int c = 0; c < 3; ++c) spec.material.color[c] = 0.1f + 0.8f * float((i * (c + 3)) % 11) / 10;
    spec.material.opacity_root = 0.3f + 0.01f * float(i);
    spec.offset = {0.03 * std::cos(i * 0.7), 0.03 * std::sin(i * 1.3), 0.001 * i};
    world.add(spec);
  }
  world.addLight(sunFrom(-0.1, 0.7, 0.7, 3, 256));
  for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE}) {
    FlkFrame frame = world.frame();
    frame.capture = capture;
    frame.method = FLK_METHOD_EXACT;
    const reference::Image actual = world.image(world.render(frame));
    const auto maps = world.readMaps();
    const reference::Difference d = reference::compare(actual, world.expected(reference::Method::exact, reference::TailOrder::list, maps));
    std::printf("ROW 63 hairs: exact rmse %.3f p99.9 %.3f mean %.1f\n", d.rmse, d.p999, d.mean_b);
    EXPECT_LE(d.rmse, 0.7);
  }
}

// A window being dragged: another size every frame, for a thousand frames, every few with another method, capture and lights.
TEST(Views, AnotherSizeEveryFrame) {
  StrandArrays few = loadStrands("groom:paper-load", 300);
  ViewSpec view = frameStrands(few, 64, 64);
  World world(view);
  world.add(specOf(few, view, 1.0));
  world.addLight(sunFrom(-0.1, 0.7, 0.7, 3, 64));
  world.addLight(sunFrom(0.5, 0.7, -0.7, 3, 128));
  for (int i = 0; i < 1000; ++i) {
    world.view_spec.width = 16 + i * 7 % 90, world.view_spec.height = 16 + i * 13 % 90;
    world.camera = reference::makeCamera(view.eye, view.target, view.up, view.projection, world.view_spec.width, world.view_spec.height);
    FlkFrame frame = world.frame();
    frame.method = uint32_t(i / 3 % 6), frame.capture = 1 + uint32_t(i / 2 % 2), frame.light_count = uint32_t(i % 3);
    world.render(frame, true);
    FlkPlanInfo info{};
    flkPlanGetInfo(world.plan, &info);
    ASSERT_LT(info.bytes_transient, uint64_t(4) << 20) << "memory grows";
  }
  std::printf("ROW 1,000 sizes: no message, transient memory below 4 MiB throughout\n");
}

}  // namespace
}  // namespace forelock::test
