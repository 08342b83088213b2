// Every variant, light type, material and modifier against its float64 twin at 256x256, captured by the rasteriser and by compute
// shaders; shading fed with the device's own shadow maps, which are compared apart.
#include "world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace forelock::test {
namespace {

using reference::Method;
using reference::TailOrder;

constexpr double kWidth = 1.0;  // pixel

const StrandArrays& tuft() {
  static const StrandArrays strands = loadStrands("groom:paper-load", 5);
  return strands;
}

ViewSpec tuftView() { return frameStrands(tuft(), 256, 256); }

HairSpec tuftSpec(double width_px = kWidth) {
  HairSpec spec;
  spec.strands = tuft();
  spec.material.width_scale = widthScale(spec.strands, tuftView(), width_px);
  return spec;
}

reference::Vec3 middle() { return tuftView().target; }

// To the light: upper left of the camera.
FlkLight sun(float radiance, uint32_t shadow_size = 512) {
  FlkLight light{};
  light.direction[0] = -0.1f, light.direction[1] = 0.7f, light.direction[2] = 0.7f;
  for (float& r : light.radiance) r = radiance;
  light.casts_shadow = shadow_size != 0, light.shadow_size = shadow_size;
  return light;
}

FlkLight lamp(uint32_t kind, std::array<double, 3> from_middle, float radiance, uint32_t shadow_size = 512) {
  FlkLight light = sun(radiance, shadow_size);
  light.kind = kind;
  const reference::Vec3 m = middle();
  const double at[3] = {m.x + from_middle[0], m.y + from_middle[1], m.z + from_middle[2]};
  for (int i = 0; i < 3; ++i) light.position[i] = at[i], light.direction[i] = float(from_middle[std::size_t(i)]);
  light.inner_angle = 0.2f, light.outer_angle = 0.35f;
  return light;
}

FlkLight byWidth(FlkLight light) {
  light.shadow_cover = FLK_SHADOW_COVER_WIDTH;
  return light;
}

struct Feature {
  const char* name;
  std::function<std::unique_ptr<World>()> make;
  bool every_method = false;
};

std::unique_ptr<World> worldOf(std::vector<HairSpec> specs, std::vector<FlkLight> lights, ViewSpec view = tuftView()) {
  auto world = std::make_unique<World>(view);
  for (const HairSpec& spec : specs) world->add(spec);
  for (const FlkLight& light : lights) world->addLight(light);
  return world;
}

// Scene shadow of a wall with a hole, as a map that the host would have drawn: an orthographic projection along z.
void addHostShadow(World& world, FlkLight light, bool reversed) {
  const int size = 64;
  const reference::Vec3 m = middle();
  FlkHostShadow shadow{};
  const double scale = size / 0.5;
  shadow.map_from_world[0] = scale, shadow.map_from_world[5] = scale, shadow.map_from_world[10] = reversed ? 0.5 : -0.5;
  shadow.map_from_world[12] = size / 2.0 - m.x * scale, shadow.map_from_world[13] = size / 2.0 - m.y * scale;
  shadow.map_from_world[14] = 0.5 + (reversed ? -0.5 : 0.5) * m.z;
  shadow.map_from_world[15] = 1;
  shadow.rect[0] = 4, shadow.rect[1] = 6, shadow.rect[2] = 50, shadow.rect[3] = 52;
  shadow.layer = 1, shadow.bias = 0.001f, shadow.reversed = reversed;
  std::vector<float> layers(std::size_t(size) * size * 2, 0.25f);
  std::vector<float> map(std::size_t(size) * size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      map[std::size_t(y * size + x)] = std::hypot(x - 30.0, y - 34.0) < 13 ? (reversed ? 0.0f : 1.0f) : 0.48f + 0.0006f * float(x);
  std::copy(map.begin(), map.end(), layers.begin() + size * size);
  light.host_shadow = &shadow;
  world.addLight(light);
  world.host_shadow_maps = host().uploadArray(uint32_t(size), uint32_t(size), 2, layers);
  reference::HostShadow twin;
  twin.width = twin.height = size;
  twin.values = map;
  std::copy(shadow.map_from_world, shadow.map_from_world + 16, twin.texel_from_world);
  twin.left = 4, twin.top = 6, twin.right = 54, twin.bottom = 58;
  twin.bias = double(shadow.bias), twin.reversed = reversed;
  world.twin.lights.back().host_shadow = twin;
}

// A picture of each light's visibility: stripes.
void addVisibility(World& world) {
  const std::size_t w = 256, h = 256;
  std::vector<float> layers(w * h * world.lights.size());
  for (std::size_t l = 0; l < world.lights.size(); ++l) {
    std::vector<double> twin(w * h);
    for (std::size_t i = 0; i < w * h; ++i)
      twin[i] = layers[l * w * h + i] = float(0.25 * double((i % w / 16 + i / w / 16 + l) % 5));
    world.lights[l].visibility = uint32_t(l) + 1;
    world.twin.lights[l].visibility = twin;
  }
  world.host_visibility = host().uploadArray(uint32_t(w), uint32_t(h), uint32_t(world.lights.size()), layers);
}

void addTiles(World& world, uint32_t tile) {
  const uint32_t tiles = (256 + tile - 1) / tile, layers = uint32_t(world.lights.size() + 31) / 32;
  std::vector<uint32_t> words(std::size_t(tiles) * tiles * layers);
  for (std::size_t l = 0; l < world.lights.size(); ++l)
    for (uint32_t t = 0; t < tiles * tiles; ++t)
      if ((t % tiles + t / tiles + l) % 3 != 0) words[l / 32 * tiles * tiles + t] |= 1u << l % 32;
  world.twin.light_tiles = {int(tile), int(tiles), int(tiles), words};
  world.light_tiles = {host().uploadBuffer(std::as_bytes(std::span(words))), tile, tiles, tiles, VK_PIPELINE_STAGE_2_HOST_BIT,
                       VK_ACCESS_2_HOST_WRITE_BIT};
}

HairSpec colored() {
  HairSpec spec = tuftSpec();
  for (std::size_t v = 0; v < spec.strands.radii.size(); ++v) {
    const float t = float(v % 16) / 15;
    spec.colors.insert(spec.colors.end(), {0.3f + 0.7f * t, 1.0f - 0.8f * t, float(v % 7) / 6});
  }
  spec.material.color[0] = 0.9f, spec.material.color[1] = 0.5f, spec.material.color[2] = 0.3f;
  spec.material.tip_color[0] = 0.1f, spec.material.tip_color[1] = 0.3f, spec.material.tip_color[2] = 0.9f;
  spec.material.tip_blend = 0.8f;
  return spec;
}

const std::vector<float>& rootPixels() {
  static const std::vector<float> pixels = [] {
    std::vector<float> p;
    for (int i = 0; i < 8 * 4; ++i) p.insert(p.end(), {float(i % 8) / 7, 0.5f, float(i / 8) / 3});
    return p;
  }();
  return pixels;
}

const std::vector<Feature>& features() {
  static const std::vector<Feature> list = {
      {"sun", [] { return worldOf({tuftSpec()}, {sun(3)}); }, true},
      {"sun, map covered by width", [] { return worldOf({tuftSpec()}, {byWidth(sun(3))}); }},
      {"sun, map covered by width of strands from six texels to a tenth", [] {
         HairSpec spec = tuftSpec(1.5);
         for (std::size_t v = 0; v < spec.strands.radii.size(); ++v) spec.strands.radii[v] *= v % 40 < 20 ? 1.0f : 0.025f;
         spec.material.opacity_root = 0.9f, spec.material.opacity_tip = 0.1f;
         return worldOf({spec}, {byWidth(sun(3, 1024))});
       }},
      {"lights by width and by texel, two hairs", [] {
         HairSpec other = tuftSpec(1.5);
         other.offset = {0.12, -0.04, 0.03}, other.scale = 0.7;
         FlkLight spot = lamp(FLK_LIGHT_SPOT, {-0.3, 0.4, 0.4}, 1, 256), amid = lamp(FLK_LIGHT_POINT, {0.02, 0.01, 0.03}, 0.3f, 256);
         return worldOf({tuftSpec(), other}, {sun(2), byWidth(spot), byWidth(amid), byWidth(sun(1, 128))});
       }},
      {"sun without shadow", [] { return worldOf({tuftSpec()}, {sun(3, 0)}); }},
      {"no light but ambient", [] {
         auto world = worldOf({tuftSpec()}, {});
         for (int i = 0; i < 3; ++i) world->twin.ambient[i] = world->ambient[i] = 1.0f + float(i);
         return world;
       }},
      {"point light outside", [] { return worldOf({tuftSpec()}, {lamp(FLK_LIGHT_POINT, {-0.3, 0.4, 0.5}, 3)}); }},
      {"point light amid hair", [] { return worldOf({tuftSpec()}, {lamp(FLK_LIGHT_POINT, {0.02, 0.01, 0.03}, 3, 256)}); }},
      {"spot", [] { return worldOf({tuftSpec()}, {lamp(FLK_LIGHT_SPOT, {-0.3, 0.4, 0.4}, 3)}); }},
      {"spot amid hair", [] {
         FlkLight light = lamp(FLK_LIGHT_SPOT, {0.0, 0.1, 0.0}, 3);
         light.inner_angle = 0.5f, light.outer_angle = 1.0f;
         return worldOf({tuftSpec()}, {light});
       }},
      {"five lights", [] {
         FlkLight spot = lamp(FLK_LIGHT_SPOT, {0.5, 0.2, 0.3}, 1, 256), near = lamp(FLK_LIGHT_POINT, {0.2, -0.1, 0.2}, 0.1f, 0);
         near.range = 0.4f, near.source_radius = 0.05f;
         spot.outer_angle = 1.4f;
         FlkLight back = sun(1, 128);
         back.direction[0] = 0.6f, back.direction[2] = -0.7f, back.radiance[0] = 4, back.radiance[2] = 0.2f;
         return worldOf({tuftSpec()}, {sun(2), spot, near, back, lamp(FLK_LIGHT_POINT, {0.0, 0.5, -0.2}, 0.3f, 256)});
       }, true},
      {"ambient harmonics", [] {
         auto world = worldOf({tuftSpec()}, {sun(1)});
         std::vector<float> sh(27);
         for (std::size_t i = 0; i < 27; ++i) sh[i] = (i < 3 ? 3.0f : 0.0f) + 0.9f * float(std::sin(double(i) * 2.3));
         world->setAmbientSh(sh);
         return world;
       }},
      {"host shadow", [] {
         auto world = worldOf({tuftSpec()}, {});
         addHostShadow(*world, sun(3), false);
         return world;
       }},
      {"host shadow, reversed, and visibility", [] {
         auto world = worldOf({tuftSpec()}, {sun(2, 256)});
         addHostShadow(*world, lamp(FLK_LIGHT_POINT, {0.3, 0.4, 0.5}, 1, 0), true);
         addVisibility(*world);
         return world;
       }},
      {"light tiles of 40 lights", [] {
         std::vector<FlkLight> lights;
         for (int i = 0; i < 40; ++i)
           lights.push_back(lamp(i % 3 ? FLK_LIGHT_POINT : FLK_LIGHT_SPOT,
                                 {0.5 * std::cos(i * 1.1), 0.1 + 0.01 * i, 0.5 * std::sin(i * 1.1)}, 0.1f, 0));
         auto world = worldOf({tuftSpec()}, lights);
         addTiles(*world, 24);
         return world;
       }},
      {"two hairs", [] {
         HairSpec other = tuftSpec(1.5);
         other.offset = {0.12, -0.04, 0.03}, other.scale = 0.7;
         other.material.color[0] = 0.7f, other.material.fibre_spacing = 4e-3f, other.material.exponent_r = 80;
         return worldOf({tuftSpec(), other}, {sun(3)});
       }, true},
      {"vertex and tip colours", [] { return worldOf({colored(), [] {
                                          HairSpec plain = tuftSpec();
                                          plain.offset = {-0.1, 0.02, 0.02}, plain.scale = 0.8;
                                          return plain;
                                        }()}, {sun(3)}); }, true},
      {"root image", [] {
         HairSpec spec = tuftSpec();
         for (uint32_t i = 0; i < spec.strands.strands(); ++i)
           spec.root_uvs.insert(spec.root_uvs.end(), {float(i % 13) / 12, float(i % 7) / 6});
         static const FlkRootImage image{rootPixels().data(), 8, 4};
         spec.root_image = &image;
         return worldOf({spec}, {sun(3)});
       }},
      {"near fade and lens", [] {
         auto world = worldOf({tuftSpec()}, {sun(3)});
         const ViewSpec view = tuftView();
         const double away = std::hypot(view.eye.x - view.target.x, view.eye.y - view.target.y, view.eye.z - view.target.z);
         world->addModifier({FLK_OPACITY_NEAR_FADE, float(away - 0.1), float(away + 0.05), {0, 0}, 0, 0, 0});
         world->addModifier({FLK_OPACITY_LENS, 0, 0, {120, 100}, 25, 30, 0.1f});
         return world;
       }, true},
      {"follow strands", [] {
         HairSpec spec = tuftSpec();
         spec.strands = loadStrands("groom:paper-load", 25);
         spec.follow = {4, 0.004f, 0.5f, 7};
         return worldOf({spec}, {sun(3)});
       }},
      {"host positions with follow strands", [] {
         HairSpec spec = tuftSpec();
         spec.strands = loadStrands("groom:paper-load", 25);
         spec.follow = {4, 0.004f, 2.0f, 7};
         spec.flags = 0, spec.seed = 3;  // shuffled: the host's order is the asset's all the same
         const reference::Vec3 m = middle();
         const double c = std::cos(0.7), s = std::sin(0.7);
         for (std::size_t v = 0; v < spec.strands.radii.size(); ++v) {  // turned about z and bent
           const float* p = &spec.strands.positions[v * 3];
           const double x = double(p[0]) - m.x, y = double(p[1]) - m.y;
           spec.moved.insert(spec.moved.end(), {float(m.x + c * x - s * y + 0.1 * y * y), float(m.y + s * x + c * y), p[2] + 0.02f});
         }
         return worldOf({spec}, {sun(3)});
       }},
      {"orthographic camera, point light", [] {
         ViewSpec view = tuftView();
         view.projection.orthographic = true;
         view.projection.tan_half_y = 0.25;
         HairSpec spec = tuftSpec();
         spec.material.width_scale = widthScale(spec.strands, view, 1.0);
         return worldOf({spec}, {lamp(FLK_LIGHT_POINT, {-0.3, 0.4, 0.5}, 3)}, view);
       }},
  };
  return list;
}

class FeatureAt : public testing::TestWithParam<std::size_t> {};

struct Variant {
  const char* name;
  uint32_t method, tail;
  Method twin;
  TailOrder order;
  bool ordered = false;  // depends on the order of arrival, which the rasteriser of lavapipe keeps
  uint32_t low_shade = FLK_LOW_SHADE_DEFAULT, core_taps = 0;
};
constexpr Variant kVariants[] = {
    {"exact", FLK_METHOD_EXACT, FLK_TAIL_DEFAULT, Method::exact, TailOrder::list},
    {"core_tail", FLK_METHOD_CORE_TAIL, FLK_TAIL_DETERMINISTIC, Method::core_tail, TailOrder::deterministic},
    {"hard", FLK_METHOD_HARD, FLK_TAIL_DEFAULT, Method::hard, TailOrder::list},
    {"core_only", FLK_METHOD_CORE_ONLY, FLK_TAIL_DEFAULT, Method::core_only, TailOrder::deterministic},
    {"all_low", FLK_METHOD_ALL_LOW, FLK_TAIL_DETERMINISTIC, Method::all_low, TailOrder::deterministic},
    {"core_tail, list order", FLK_METHOD_CORE_TAIL, FLK_TAIL_LIST, Method::core_tail, TailOrder::list, true},
    {"forward", FLK_METHOD_FORWARD, FLK_TAIL_LIST, Method::forward, TailOrder::list, true},
    {"core_tail once, 9 taps", FLK_METHOD_CORE_TAIL, FLK_TAIL_ONCE, Method::core_tail, TailOrder::once, false, FLK_LOW_SHADE_DEFAULT, 9},
    {"all_low, mean lobes", FLK_METHOD_ALL_LOW, FLK_TAIL_DETERMINISTIC, Method::all_low, TailOrder::deterministic, false, FLK_LOW_SHADE_MEAN_LOBES},
    {"core_tail, lobes, 4 taps", FLK_METHOD_CORE_TAIL, FLK_TAIL_DETERMINISTIC, Method::core_tail, TailOrder::deterministic, false,
     FLK_LOW_SHADE_LOBES, 4},
    {"exact, 1 tap", FLK_METHOD_EXACT, FLK_TAIL_DEFAULT, Method::exact, TailOrder::list, false, FLK_LOW_SHADE_DEFAULT, 1},
};

// A picture without antialiasing jumps where a pixel's centre crosses a strand's edge, and where it lies within rounding of one
// there is no value to compare with. A radius is coded as the square of 11 bits, which leaves half a step of 4.9e-4 of the widest:
// 3.7e-4 pixel of the 1.5 pixels here; fp32 leaves 1.5e-5. Pixels that change by more than 2 codes when everything moves by 4e-4 pixel
// take the actual value, and are counted.
std::size_t settleEdges(const World& world, const std::vector<reference::LightMaps>& maps, const reference::Image& actual,
                        reference::Image& expected) {
  std::vector<bool> jumps(expected.pixels.size());
  constexpr double kShift = 4e-4;
  for (const std::array<double, 2> shift : {std::array{-kShift, 0.0}, {kShift, 0.0}, {0.0, -kShift}, {0.0, kShift}}) {
    const reference::Image moved = world.expected(Method::hard, TailOrder::list, maps, shift);
    for (std::size_t i = 0; i < moved.pixels.size(); ++i) {
      double square = 0;
      for (int c = 0; c < 3; ++c) square += std::pow(255 * (moved.pixels[i].rgb[c] - expected.pixels[i].rgb[c]), 2);
      if (square > 4 || moved.pixels[i].fragments != expected.pixels[i].fragments) jumps[i] = true;
    }
  }
  std::size_t settled = 0;
  for (std::size_t i = 0; i < jumps.size(); ++i)
    if (jumps[i]) expected.pixels[i] = actual.pixels[i], ++settled;
  return settled;
}

// 0.7 and 1.5 are the bounds of the matrix of variants: what is left is the coding of tangents and colours, and fp32.
TEST_P(FeatureAt, MatchesItsTwin) {
  const Feature& feature = features()[GetParam()];
  const auto world = feature.make();
  world->expose();
  for (const uint32_t capture : {FLK_CAPTURE_RASTER, FLK_CAPTURE_COMPUTE}) {
    FlkFrame frame = world->frame();
    frame.capture = capture;
    std::vector<reference::LightMaps> maps;
    for (const Variant& variant : kVariants) {
      if (!feature.every_method && &variant - kVariants > 2) continue;
      if (variant.ordered && capture == FLK_CAPTURE_COMPUTE && variant.method != FLK_METHOD_FORWARD) continue;
      frame.method = variant.method, frame.tail = variant.tail;
      frame.low_shade = variant.low_shade, frame.core_taps = variant.core_taps;
      world->twin.low_shade = reference::LowShade(variant.low_shade);
      world->twin.core_taps = variant.core_taps ? int(variant.core_taps) : 25;
      const reference::Image actual = world->image(world->render(frame));
      if (maps.empty() && !world->lights.empty()) maps = world->readMaps();
      reference::Image expected = world->expected(variant.twin, variant.order, maps);
      const double plain = reference::compare(actual, expected).rmse;
      const std::size_t settled = variant.twin == Method::hard ? settleEdges(*world, maps, actual, expected) : 0;
      const reference::Difference d = reference::compare(actual, expected);
      EXPECT_LE(settled, d.pixels / 100) << variant.name;
      if (settled) std::printf("ROW %s, %s: %zu pixels within rounding of an edge; rmse with them %.3f\n", feature.name, variant.name, settled, plain);
      std::printf("ROW %s, %s, %s: rmse %.3f p99.9 %.3f mean %.1f / %.1f, %zu pixels, %llu fragments\n", feature.name, variant.name,
                  capture == FLK_CAPTURE_COMPUTE ? "compute" : "raster", d.rmse, d.p999, d.mean_a, d.mean_b, d.pixels,
                  static_cast<unsigned long long>(world->statistics.fragments));
      // By compute fragments arrive in any order: what depends on it is only reported there.
      if (!variant.ordered || capture == FLK_CAPTURE_RASTER) {
        EXPECT_LE(d.rmse, variant.ordered ? 1.5 : 0.7) << variant.name;
      }
      EXPECT_GT(d.mean_b, 10) << "the picture is too dark to compare";
      if (HasFailure()) writeFailure(std::string("feature-") + std::to_string(GetParam()) + "-" + variant.name, actual, expected);
    }
    // The maps themselves, against the reference's own. Covered by width a texel is also off where a strand's turn lies within rounding of its
    // share: a chance of 1e-6 by fp32, and of half a step of the coded radius, 4.9e-4 sqrt(widest / own), where radii vary.
    const std::vector<reference::LightMaps> own = world->ownMaps();
    for (std::size_t i = 0; i < maps.size(); ++i)
      for (std::size_t face = 0; face < maps[i].faces.size(); ++face) {
        const double off = mapDifference(own[i].faces[face], maps[i].faces[face], 0.1 * world->twin.hairs[0].material.fibre_spacing);
        std::printf("ROW %s: map %zu of light %zu, %s: %.4f %% of texels off\n", feature.name, face, i,
                    capture == FLK_CAPTURE_COMPUTE ? "compute" : "raster", off);
        EXPECT_LE(off, 0.5) << "map " << face << " of light " << i;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(All, FeatureAt, testing::Range(std::size_t(0), features().size()));

}  // namespace
}  // namespace forelock::test
