// Scene files: what is read, what is refused and how it is said, and that a written scene reads back as it was.
#include "scene_file.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace forelock::samples;

namespace {

std::string faultOf(const std::string& text) {
  try {
    parseScene(text);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

TEST(SceneFile, MeshesAreReadAndWritten) {
  const Scene scene = parseScene(R"({"meshes": [{"source": "head.glb"}, {"source": "b.gltf", "position": [1, 2, 3], "turn": 90, "scale": 0.5, "color": "#ff0000"}]})");
  for (const Scene& read : {scene, parseScene(writeScene(scene))}) {
    ASSERT_EQ(read.meshes.size(), 2u);
    EXPECT_EQ(read.meshes[0].source, "head.glb");
    EXPECT_EQ(read.meshes[0].scale, 1.0);
    EXPECT_FALSE(read.meshes[0].color);
    EXPECT_EQ(read.meshes[1].position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(read.meshes[1].turn_deg, 90.0);
    EXPECT_EQ(read.meshes[1].scale, 0.5);
    ASSERT_TRUE(read.meshes[1].color);
    EXPECT_EQ(*read.meshes[1].color, glm::dvec3(1, 0, 0));
  }
  EXPECT_EQ(faultOf(R"({"meshes": [{}]})"), "meshes[0].source is missing");
  EXPECT_EQ(faultOf(R"({"meshes": [{"source": "a", "material": {}}]})").rfind("meshes[0].material is no key of a scene", 0), 0u);
  EXPECT_EQ(faultOf(R"({"meshes": [{"source": "a", "scale": 0}]})").rfind("meshes[0].scale is 0, must be a number in [", 0), 0u);
}

TEST(SceneFile, SaysKeyValueAndRange) {
  EXPECT_EQ(faultOf("[1]"), "the scene must be an object { ... }");
  EXPECT_EQ(faultOf("{\n\"light\": }").rfind("not valid JSON (line 2", 0), 0u) << faultOf("{\n\"light\": }");
  EXPECT_EQ(faultOf(R"({"lamp": 1})").rfind("lamp is no key of a scene; known here: assets, light", 0), 0u);
  EXPECT_EQ(faultOf(R"({"light": {"hue": 1}})").rfind("light.hue is no key of a scene", 0), 0u);
  EXPECT_EQ(faultOf(R"({"light": 3})"), "light must be an object { ... }");
  EXPECT_EQ(faultOf(R"({"light": {"shadow": 1}})"), "light.shadow is 1, must be true or false");
  EXPECT_EQ(faultOf(R"({"light": {"color": "red"}})"), "light.color is \"red\", must be sRGB as \"#rrggbb\"");
  EXPECT_EQ(faultOf(R"({"size": [0, 10]})"), "size is [0,10], must be two whole numbers in [1, 16384]");
  EXPECT_EQ(faultOf(R"({"method": "best"})"),
            "method is \"best\", must be one of core_tail, exact, forward, core_only, all_low, hard");
  EXPECT_EQ(faultOf(R"({"assets": [{}]})"), "assets[0].source is missing");
  EXPECT_EQ(faultOf(R"({"assets": [{"source": "a", "material": {"opacity_tip": 2}}]})"),
            "assets[0].material.opacity_tip is 2, must be a number in [0, 1]");
  EXPECT_EQ(faultOf(R"({"camera": {"eye": [0, 0, 1]}})"), "camera.target is missing");
  EXPECT_EQ(faultOf(R"({"camera": {"near": 1}})"), "camera.near belongs to a camera with eye, which is missing");
  EXPECT_EQ(faultOf(R"({"camera": {"eye": [0, 0, 1], "target": [0, 0, 1]}})"),
            "camera.target is the same as camera.eye, must differ");
}

TEST(SceneFile, SaysWhatIsWrongWithLights) {
  EXPECT_EQ(faultOf(R"({"light": {}, "lights": []})"),
            "light and lights are both given, must be one of them: light is short for lights with one entry");
  EXPECT_EQ(faultOf(R"({"lights": {}})"), "lights is {}, must be an array of at most 4096 entries");
  EXPECT_EQ(faultOf(R"({"lights": [{}, 3]})"), "lights[1] must be an object { ... }");
  EXPECT_EQ(faultOf(R"({"lights": [{"kind": "sun"}]})"),
            "lights[0].kind is \"sun\", must be one of directional, point, spot");
  EXPECT_EQ(faultOf(R"({"lights": [{"kind": "point"}]})"), "lights[0].position is missing");
  EXPECT_EQ(faultOf(R"({"lights": [{"position": [0, 0, 1]}]})"),
            "lights[0].position belongs to a light of kind point or spot");
  EXPECT_EQ(faultOf(R"({"lights": [{"kind": "spot", "position": [0, 0, 1], "azimuth": 3}]})"),
            "lights[0].azimuth belongs to a light of kind directional");
  EXPECT_EQ(faultOf(R"({"lights": [{"kind": "point", "position": [0, 0, 1], "outer_angle": 3}]})"),
            "lights[0].outer_angle belongs to a light of kind spot");
  const auto spot = [](const std::string& more) {
    return faultOf(R"({"lights": [{"kind": "spot", "position": [0, 0, 1], )" + more + "}]}");
  };
  EXPECT_EQ(spot(R"("target": [0, 0, 1])"), "lights[0].target is the same as position, must differ");
  EXPECT_EQ(spot(R"("range": -1)"), "lights[0].range is -1, must be a number in [0, 1e+06] m");
  EXPECT_EQ(spot(R"("source_radius_mm": 0)"), "lights[0].source_radius_mm is 0, must be a number in [0.1, 1e+06] mm");
  EXPECT_EQ(spot(R"("outer_angle": 91)"), "lights[0].outer_angle is 91, must be a number in [0.1, 90] degrees");
  EXPECT_EQ(spot(R"("inner_angle": 30, "outer_angle": 30)"),
            "lights[0].inner_angle is 30, must be less than outer_angle");
  EXPECT_EQ(spot(R"("intensity": -1)"), "lights[0].intensity is -1, must be a number in [0, 1e+06]");
  EXPECT_EQ(spot(R"("shadow_cover": "area")"), "lights[0].shadow_cover is \"area\", must be one of texel, width");
  EXPECT_EQ(spot(R"("shadow_size": 63)"), "lights[0].shadow_size is 63, must be a whole number in [64, 8192]");
  EXPECT_EQ(faultOf(R"({"sky": {"top": "#ffffff"}})"), "sky.bottom is missing");
  EXPECT_EQ(faultOf(R"({"sky": {"top": "#ffffff", "bottom": "blue"}})"),
            "sky.bottom is \"blue\", must be sRGB as \"#rrggbb\"");
  EXPECT_EQ(faultOf(R"({"sky": {"top": "#ffffff", "bottom": "#000000", "intensity": -1}})"),
            "sky.intensity is -1, must be a number in [0, 1000]");
  EXPECT_EQ(faultOf(R"({"sky": {"top": "#ffffff", "bottom": "#000000"}, "ambient_sh": []})"),
            "sky and ambient_sh are both given, must be one of them: a sky is turned into ambient_sh");
  const std::string shape = "ambient_sh must be 27 numbers in [-1000, 1000], or 9 triples of them";
  for (const char* wrong : {"3", "[1, 2]", "[1,2,3,4,5,6,7,8,9]", "[[1,2],[],[],[],[],[],[],[],[]]",
                            "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1001]",
                            "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,\"x\"]"}) {
    EXPECT_EQ(faultOf(std::string(R"({"ambient_sh": )") + wrong + "}"), shape) << wrong;
  }
}

TEST(SceneFile, SaysWhatIsWrongWithTheRest) {
  EXPECT_EQ(faultOf(R"({"tail": "long"})"), "tail is \"long\", must be one of default, deterministic, list, once");
  EXPECT_EQ(faultOf(R"({"capture": "rays"})"), "capture is \"rays\", must be one of default, raster, compute");
  EXPECT_EQ(faultOf(R"({"near_fade": {}})"), "near_fade.end_m is missing");
  EXPECT_EQ(faultOf(R"({"near_fade": {"start_m": 2, "end_m": 2}})"), "near_fade.end_m is 2, must be beyond start_m");
  EXPECT_EQ(faultOf(R"({"near_fade": {"start_m": -2, "end_m": 2}})"),
            "near_fade.start_m is -2, must be a number in [0, 1e+06] m");
  EXPECT_EQ(faultOf(R"({"lens": {"center": [1]}})"), "lens.center is [1], must be two numbers in [-10, 10]");
  EXPECT_EQ(faultOf(R"({"lens": {"center": [1, 11]}})"), "lens.center is [1,11], must be two numbers in [-10, 10]");
  EXPECT_EQ(faultOf(R"({"lens": {"radius": -1}})"), "lens.radius is -1, must be a number in [0, 10]");
  EXPECT_EQ(faultOf(R"({"lens": {"feather": 0}})"), "lens.feather is 0, must be a number in [0.001, 10]");
  EXPECT_EQ(faultOf(R"({"lens": {"inside": 2}})"), "lens.inside is 2, must be a number in [0, 1]");
  const auto asset = [](const std::string& more) { return faultOf(R"({"assets": [{"source": "a", )" + more + "}]}"); };
  EXPECT_EQ(asset(R"("follow": {})"), "assets[0].follow.count is missing");
  EXPECT_EQ(asset(R"("follow": {"count": 1024})"), "assets[0].follow.count is 1024, must be a whole number in [0, 1023]");
  EXPECT_EQ(asset(R"("follow": {"count": 1, "radius_mm": -1})"),
            "assets[0].follow.radius_mm is -1, must be a number in [0, 1e+06] mm");
  EXPECT_EQ(asset(R"("follow": {"count": 1, "spread_tip": -1})"),
            "assets[0].follow.spread_tip is -1, must be a number in [0, 1000]");
  EXPECT_EQ(asset(R"("follow": {"count": 1, "seed": -1})"),
            "assets[0].follow.seed is -1, must be a whole number in [0, 4294967295]");
  EXPECT_EQ(asset(R"("root_image": 3)"), "assets[0].root_image is 3, must be a string");
  EXPECT_NE(asset(R"("points_per_strand": 1)").find("assets[0].points_per_strand"), std::string::npos);
  EXPECT_EQ(asset(R"("ignore_colors": 3)"), "assets[0].ignore_colors is 3, must be true or false");
  EXPECT_EQ(asset(R"("material": {"tip_blend": 1})"),
            "assets[0].material.tip_blend belongs to a material with tip_color, which is missing");
  EXPECT_EQ(asset(R"("material": {"tip_color": "#ffffff", "tip_blend": 2})"),
            "assets[0].material.tip_blend is 2, must be a number in [0, 1]");
}

TEST(SceneFile, ReadsLights) {
  EXPECT_EQ(parseScene("{}").lights.size(), 1u);
  EXPECT_TRUE(parseScene(R"({"lights": []})").lights.empty());
  const Scene scene = parseScene(R"({"lights": [{"azimuth": 180, "intensity": 2},
      {"kind": "point", "position": [1, 2, 3], "range": 4},
      {"kind": "spot", "position": [0, 1, 0], "outer_angle": 12, "color": "#ff0000", "shadow": false}]})");
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].azimuth_deg, 180.0);
  EXPECT_EQ(scene.lights[0].elevation_deg, 44.0);
  EXPECT_EQ(scene.lights[0].intensity, 2.0);
  EXPECT_EQ(scene.lights[1].kind, static_cast<uint32_t>(FLK_LIGHT_POINT));
  EXPECT_EQ(scene.lights[1].position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[1].range_m, 4.0);
  EXPECT_EQ(scene.lights[1].shadow_size, 1024u);
  EXPECT_EQ(scene.lights[2].inner_angle_deg, 8.0) << "two thirds, where 20 degrees are too many";
  EXPECT_EQ(scene.lights[2].color, glm::dvec3(1, 0, 0));
  EXPECT_FALSE(scene.lights[2].shadow);
  EXPECT_EQ(scene.lights[2].shadow_cover, static_cast<uint32_t>(FLK_SHADOW_COVER_TEXEL));
  EXPECT_EQ(parseScene(R"({"light": {"shadow_cover": "width"}})").lights[0].shadow_cover, static_cast<uint32_t>(FLK_SHADOW_COVER_WIDTH));
}

TEST(SceneFile, FallsOffAsTheMethodsSay) {
  SceneLight light;
  EXPECT_EQ(lightFalloff(light, {9, 9, 9}), 1.0);
  light.kind = FLK_LIGHT_POINT;
  light.position = {0, 0, 2};
  EXPECT_DOUBLE_EQ(lightFalloff(light, {0, 0, 0}), 0.25);
  EXPECT_DOUBLE_EQ(lightFalloff(light, {0, 0, 2}), 1e4) << "not nearer than the source, 10 mm";
  light.range_m = 4.0;  // (1 - (2 / 4)^4)^2 / 4
  EXPECT_DOUBLE_EQ(lightFalloff(light, {0, 0, 0}), 0.9375 * 0.9375 / 4);
  light.range_m = 2.0;
  EXPECT_EQ(lightFalloff(light, {0, 0, 0}), 0.0);
}

// The coefficients against sums of the sky over the sphere. The midpoint rule in the sine of the elevation errs by the
// square of its step where the sky has its kink: 1e-5 with 400 steps.
TEST(SceneFile, SkyIsItsHarmonics) {
  const SceneSky sky{{1, 0.5, 0.2}, {0.3, 0.9, 0.2}, {0.1, 0.1, 0.2}, 0.5};
  constexpr double pi = 3.14159265358979323846;
  constexpr int steps = 400, turns = 8;
  for (const bool z_up : {false, true}) {
    Harmonics sum{};
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) * 2.0 / steps - 1.0, r = std::sqrt(1.0 - t * t);
      const glm::dvec3 radiance = 0.5 * (t > 0.0 ? sky.horizon + t * (sky.top - sky.horizon)
                                                 : sky.horizon - t * (sky.bottom - sky.horizon));
      for (int j = 0; j < turns; ++j) {
        const double c = r * std::cos(2 * pi * j / turns), s = r * std::sin(2 * pi * j / turns);
        const auto basis = harmonicsBasis(z_up ? glm::dvec3(c, s, t) : glm::dvec3(c, t, s));
        for (size_t n = 0; n < 9; ++n) sum[n] += radiance * (basis[n] * 4.0 * pi / (steps * turns));
      }
    }
    const Harmonics closed = skyHarmonics(sky, z_up ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0));
    for (size_t n = 0; n < 9; ++n) {
      for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(closed[n][channel], sum[n][channel], 1e-5) << n;
    }
  }
}

TEST(SceneFile, AroundTakesThePlaceOfTheDefault) {
  const std::string numbers = "[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27]";
  const Scene flat = parseScene("{\"ambient_sh\": " + numbers + "}");
  ASSERT_TRUE(flat.ambient_sh);
  EXPECT_EQ((*flat.ambient_sh)[8], glm::dvec3(25, 26, 27));
  EXPECT_EQ(flat.ambient, glm::dvec3(0.0));
  EXPECT_EQ(*parseScene(writeScene(flat)).ambient_sh, *flat.ambient_sh);
  const Scene both = parseScene(R"({"sky": {"top": "#ffffff", "bottom": "#000000"}, "ambient": [1, 1, 1]})");
  ASSERT_TRUE(both.sky);
  EXPECT_EQ(both.ambient, glm::dvec3(1.0));
  EXPECT_EQ(both.sky->horizon, glm::dvec3(0.5)) << "the mean";
}

TEST(SceneFile, TipColorBlendsWhollyUnlessSaid) {
  const auto material = [](const std::string& keys) {
    return parseScene(R"({"assets": [{"source": "a", "material": {)" + keys + "}}]}").assets[0].material;
  };
  EXPECT_EQ(material("").tip_blend, 0.0f);
  EXPECT_EQ(material(R"("tip_color": "#ff0000")").tip_blend, 1.0f);
  EXPECT_EQ(material(R"("tip_color": "#ff0000", "tip_blend": 0.25)").tip_blend, 0.25f);
  EXPECT_EQ(material(R"("tip_color": "#ff0000")").tip_color[0], 1.0f);
}

TEST(SceneFile, EveryNameIsItsValue) {
  const char* methods[] = {"core_tail", "exact", "forward", "core_only", "all_low", "hard"};
  for (uint32_t i = 0; i <= FLK_METHOD_HARD; ++i) {
    EXPECT_EQ(parseScene(std::string(R"({"method": ")") + methods[i] + "\"}").method, i);
  }
  EXPECT_EQ(parseScene(R"({"low_shade": "mean-lobes"})").low_shade, static_cast<uint32_t>(FLK_LOW_SHADE_MEAN_LOBES));
  EXPECT_EQ(parseScene(R"({"core_taps": 9})").core_taps, 9u);
  EXPECT_EQ(faultOf(R"({"core_taps": 5})"), "core_taps is 5, must be one of 1, 4, 9, 25");
  EXPECT_EQ(parseScene(R"({"tail": "list"})").tail, static_cast<uint32_t>(FLK_TAIL_LIST));
  EXPECT_EQ(parseScene(R"({"capture": "raster"})").capture, static_cast<uint32_t>(FLK_CAPTURE_RASTER));
  EXPECT_EQ(parseScene(R"({"capture": "compute"})").capture, static_cast<uint32_t>(FLK_CAPTURE_COMPUTE));
}

TEST(SceneFile, ZeroKIsNone) {
  EXPECT_EQ(parseScene("{}").k, 0u);
  EXPECT_EQ(parseScene(R"({"k": 0})").k, FLK_K_NONE);
  EXPECT_EQ(parseScene(R"({"k": 5})").k, 5u);
}

TEST(SceneFile, WrittenScenesReadBack) {
  const std::string text = R"({"assets": [{"source": "groom:long-wavy", "turn": 30, "material":
      {"color": "#c9a26b", "opacity_tip": 0.4, "width_mm": 0.2, "exponent_r": 33.3}}],
      "camera": {"eye": [1, 2, 3], "target": [0, 0, 0.5], "vertical_fov": 20, "near": 0.2, "far": 9, "up": "z"},
      "light": {"azimuth": 10, "shadow": false}, "size": [80, 100], "background": "#2a2d31", "head": false, "k": 0,
      "method": "exact", "show": "depth", "payload": "paper", "exposure": 3})";
  const Scene scene = parseScene(text);
  ASSERT_TRUE(scene.camera.placed);
  EXPECT_EQ(scene.camera.placed->up, glm::dvec3(0, 0, 1));
  EXPECT_NEAR(scene.camera.placed->vertical_fov, 0.3490658503988659, 1e-15);
  EXPECT_EQ(scene.display, static_cast<uint32_t>(FLK_DISPLAY_DEPTH));
  const std::string written = writeScene(scene);
  EXPECT_EQ(writeScene(parseScene(written)), written);
  EXPECT_EQ(writeScene(parseScene(writeScene(Scene{}))), writeScene(Scene{}));
  const std::string more = R"({"assets": [{"source": "a.tfx", "root_image": "scalp.png", "ignore_colors": true, "points_per_strand": 100,
      "follow": {"count": 7, "radius_mm": 2.5, "spread_tip": 0.25, "seed": 9},
      "material": {"tip_color": "#d8a860", "tip_blend": 0.75}}],
      "lights": [{"intensity": 0.5}, {"kind": "point", "position": [1, 2, 3], "range": 4, "source_radius_mm": 30},
                 {"kind": "spot", "position": [0, 1, 0], "target": [0, 0, 0.5], "inner_angle": 3, "outer_angle": 40,
                  "color": "#9fc6ff", "shadow": false, "shadow_size": 512, "shadow_cover": "width"}],
      "sky": {"top": "#4a5a76", "horizon": "#808080", "bottom": "#2a2624", "intensity": 0.3},
      "method": "hard", "tail": "list", "low_shade": "lobes", "core_taps": 4, "capture": "compute", "near_fade": {"start_m": 0.5, "end_m": 0.75},
      "lens": {"center": [0.25, 0.75], "radius": 0.2, "feather": 0.1, "inside": 0.5}})";
  const std::string rewritten = writeScene(parseScene(more));
  EXPECT_EQ(writeScene(parseScene(rewritten)), rewritten);
  for (const char* kept : {"\"scalp.png\"", "\"ignore_colors\": true", "\"points_per_strand\": 100", "\"spread_tip\": 0.25", "#d8a860", "\"range\": 4",
                           "\"outer_angle\": 40", "#4a5a76", "\"hard\"", "\"list\"", "\"compute\"", "\"shadow_cover\": \"width\"", "\"end_m\": 0.75",
                           "\"inside\": 0.5"}) {
    EXPECT_NE(rewritten.find(kept), std::string::npos) << kept << " is not in " << rewritten;
  }
}

TEST(SceneFile, ColorsAreSrgb) {
  glm::dvec3 linear;
  ASSERT_TRUE(parseHexColor("#ff8000", linear));
  EXPECT_EQ(linear.x, 1.0);
  EXPECT_NEAR(linear.y, 0.21586, 1e-5);  // IEC 61966-2-1 of 128/255
  EXPECT_EQ(linear.z, 0.0);
  for (const char* text : {"#000000", "#0a0b0c", "#7f80fe", "#ffffff"}) {
    ASSERT_TRUE(parseHexColor(text, linear));
    EXPECT_EQ(hexColor(linear), text);
  }
  for (const char* text : {"", "#12345", "12345g", "#1234567", "red"}) {
    EXPECT_FALSE(parseHexColor(text, linear)) << text;
  }
}
